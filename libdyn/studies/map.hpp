#pragma once
/// A map: every point of a plane of two parameters, or of several planes, classified.

#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/parameter_grid.hpp"
#include "libdyn/studies/point_rows.hpp"
#include "libdyn/studies/row_travel.hpp"
#include "libdyn/studies/study_models.hpp"

namespace whirl::inline dyn {

struct MapOptions {
  ParameterGrid grid{};  ///< of any number of axes
  ClassifyOptions classify{};
  int threads = 1;
  Stripe stripe{};  ///< the points that are computed
};

struct MapResult {
  static constexpr std::string_view group = "/map";
  StudySystem system{};
  PointRows<ClassifiedMotion> points{};  ///< in the order of the grid

  /// Sizes of the dimensions of its columns that no other column has.
  ColumnSizes sizes() const { return {{"exponents", system.exponents()}}; }
  static constexpr auto columns() {
    return ColumnList{contact_names<MapResult>(), rows(&MapResult::points, "point")};
  }
};

/// Classifies the motion at every point of a grid, each from the start of its model.
///
/// The numbers depend neither on threads nor on which points were there already.
///
/// @param earlier  what another call with the same models and options has found: its points stay as
///                 they are; empty: none
/// @return  with fewer points if the monitor stopped it
/// @throws ModelError      as models
/// @throws NumericalError  if the first point cannot be computed, or nothing moves
MapResult map(const StudyModels& models, const MapOptions& options,
              const Monitor<MapResult>& monitor = {}, MapResult earlier = {});

}  // namespace whirl::inline dyn
