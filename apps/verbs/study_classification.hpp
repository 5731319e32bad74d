#pragma once
/// Classified motions in the table of a study: a column per quantity, a row per point.

#include <string>
#include <vector>

#include "apps/verbs/study.hpp"
#include "libdyn/system/scene.hpp"
#include "libio/results/checkpoint.hpp"

namespace whirl {

/// Columns of a classified motion: motion, period, exponents, what contacts do.
std::vector<PointColumn> classification_columns(const Scene& scene, const std::string& group);
/// Axes of these columns.
void write_classification_axes(ResultWriter& file, const Scene& scene, const std::string& group);
/// Their numbers.
PointRow classification_row(const StudyPoint& point);

/// Name of the motion at a point of a table; empty where it failed.
std::string motion_name(const PointTable& table, std::size_t point);

}  // namespace whirl
