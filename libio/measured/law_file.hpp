#pragma once
/// Laws of supports in files of other programs.

#include "libio/model/foreign_table.hpp"

namespace whirl::inline io {

/// Reads a frequency response or a state space from a file, whose ending says its format.
///
///   .uff .unv .ufb   datasets 58 of frequency responses: displacement, velocity or acceleration
///                    over force, or the other way round, in the units that they say
///   .mat             MATLAB of levels 4, 5 and 7.3, in the file or in a struct
///   .h5 .hdf5        datasets at the root or in a group
///
/// MATLAB and HDF5: A, B, C, D; or omega [rad/s] or frequency [Hz] and a complex response. Files
/// are read by child processes (ConfinedChild), with limits of what they may hold.
///
/// @param part    of .mat the struct and of HDF5 the group; of universal files the number of a
///                function, from 1, or the coordinates: "12+x", "12+x, 14+y", or response and
///                reference, "12+x/14+y"; empty: everything
/// @param wanted  a response is told as the form that the model says; of a universal file that says
///                what its values are, and where the model says no form, as a dynamic stiffness
Parsed<ConvertedTable> law_table(const std::filesystem::path& file, const std::string& part,
                                 const ForeignTable& wanted);

}  // namespace whirl::inline io
