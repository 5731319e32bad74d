#include "libio/figures/shaft_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libbase/error.hpp"
#include "libdyn/system/stations.hpp"
#include "libfe/assembly/shaft_line.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

constexpr int parts = 8;  ///< of an element, between which a shape is drawn straight

}  // namespace

figures::ShaftShapes figures::shaft_shapes(const ResultView& result, const CMat& full) {
  const auto& at_rest = result_of<PointNames>(result);
  const Vec& z = at_rest.z;
  const auto nodes = z.size();
  if (full.rows() < 4 * nodes) throw FileError("/modes/shape and /points/z do not fit");
  std::vector<std::string> what = at_rest.node_names;
  what.resize(static_cast<std::size_t>(nodes));
  const auto name = [&](Eigen::Index i) {
    const std::string& at = what.at(static_cast<std::size_t>(i));
    return fmt::format("node {}{}{}", i + 1, at.empty() ? "" : ": ", at);
  };
  ShaftShapes s;
  if (result.assembler) {
    if (nodes != result.assembler->mesh().nodes()) {
      throw FileError("/points/z is not of the nodes of its model");
    }
    const ShaftLine line = shaft_line(*result.assembler, parts);
    if (line.x.cols() == full.rows() && line.z.size() > 0) {
      const auto places = line.z.size();
      s.z = numbers(line.z);
      s.x = line.x * full;
      s.y = line.y * full;
      s.names.resize(static_cast<std::size_t>(places));
      std::size_t at = 0;
      for (const std::vector<int>& shaft : result.assembler->mesh().lines()) {
        for (std::size_t i = 0; i < shaft.size(); ++i) s.names.at(at + i * parts) = name(shaft[i]);
        at += (shaft.size() - 1) * parts + 2;  // behind the gap
      }
      return s;
    }
  }
  std::vector<Eigen::Index> order(static_cast<std::size_t>(nodes));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return z(a) < z(b); });
  s.x.resize(nodes, full.cols());
  s.y.resize(nodes, full.cols());
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const Eigen::Index node = order[static_cast<std::size_t>(i)];
    s.z.push_back(z(node));
    s.names.push_back(name(node));
    s.x.row(i) = full.row(4 * node);
    s.y.row(i) = full.row(4 * node + 1);
  }
  return s;
}

FigureAxis figures::shaft_axis(const ShaftShapes& shapes) {
  double first = INFINITY, last = -INFINITY;
  for (const double z : shapes.z) {
    if (!std::isfinite(z)) continue;  // between two shafts
    first = std::min(first, per_mm() * z);
    last = std::max(last, per_mm() * z);
  }
  const double room = 0.03 * (last - first);
  return {.title = shown_heading("position along the shaft", "mm"),
          .first = first - room,
          .last = last + room};
}

Complex figures::turn_of(const CVec& values) {
  Eigen::Index at = 0;
  const double top = values.cwiseAbs().maxCoeff(&at);
  return top > 0.0 ? std::conj(values(at)) / top : Complex(0.0);
}

}  // namespace whirl::inline io
