#pragma once
/// Which points of a large study its figures draw.

#include <string>
#include <string_view>

#include "libio/figures/figures.hpp"
#include "libio/results/study_columns.hpp"

namespace whirl::inline io::figures {

/// How many points are drawn at most; a study with more is drawn coarser.
struct DrawnPoints {
  std::size_t of_plane = 400'000;        ///< cells or starts: more than such a figure has pixels
  std::size_t of_planes = 2'000'000;     ///< of all planes of a study of three parameters
  std::size_t values_of_sweep = 20'000;  ///< each with tens of sections
};

/// The points of a study that are drawn, by the shape of its datasets.
/// @param is_sweep  whether the first dimension is that of the ways along the values
CoarseGrid drawn_grid(const std::vector<std::size_t>& shape, bool is_sweep,
                      const DrawnPoints& most = {});
/// The same of the study that a file has as a group.
CoarseGrid drawn_grid(const ResultReader& file, std::string_view group);

/// What a figure of such a study says if not all points are drawn; else empty.
std::string coarseness(const ResultReader& file, std::string_view group);

/// Values along an axis of a study that are drawn.
/// @param axis  of its parameters, from 0
std::vector<double> drawn_values(const CoarseGrid& grid, std::size_t axis,
                                 const std::vector<double>& values);

}  // namespace whirl::inline io::figures
