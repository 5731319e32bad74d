#pragma once
/// Frequency responses as a universal file: datasets 58, which programs of modal tests read.

#include <filesystem>
#include <string>

#include "libdyn/linear/frequency_response.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

/// A dataset 164 (units: SI) and for each pair three datasets 58: receptance, mobility,
/// accelerance.
///
/// Records have 80 columns. Values are complex double precision, E20.12; frequencies in Hz are even
/// or, where they are not to six digits, written one by one as E13.5, which is all that the format
/// has. Undamped resonances, where responses are NaN, are left out. The speed is the value of the z
/// axis [rpm]. Nodes are numbered as in results, bodies behind them; forward and backward motions
/// and probes have no direction in the format (0, a scalar), but stand there by name. Tilts are in
/// rad.
///
/// @source [UniversalFile58]
std::string universal_text(const FrequencyResponse& found, const Model& model,
                           const Assembler& assembler);

/// Writes a universal file; one that this program wrote is replaced.
/// @throws FileError  if the file cannot be written
void write_universal(const std::filesystem::path& place, const FrequencyResponse& found,
                     const Model& model, const Assembler& assembler, Replaces replaces);

}  // namespace whirl::inline io
