#include "libio/figures/sweep_view.hpp"

#include <algorithm>
#include <cmath>

#include "libio/figures/result_of.hpp"

namespace whirl::inline io::figures {

SweepWayStyle way_style(const std::string& direction) {
  if (direction == "down") return {"down", Paint::down};
  if (direction == "fresh") return {"each from the model's start", Paint::up};
  return {"up", Paint::up};
}

double number_of(const Mat& m, std::size_t row, std::size_t column) {
  const auto i = static_cast<Eigen::Index>(row), j = static_cast<Eigen::Index>(column);
  return i < m.rows() && j < m.cols() ? m(i, j) : std::nan("");
}

namespace {

/// The rows of a sweep, made once for all figures.
const std::vector<std::optional<SweepPoint>>& rows_of(const ResultView& result) {
  using Rows = std::vector<std::optional<SweepPoint>>;
  std::shared_ptr<const void>& known = result.known[typeid(Rows)];
  if (!known) {
    const auto& points = study_of<SweepResult>(result).points;
    Rows rows;
    for (std::size_t i = 0; i < points.size(); ++i) rows.push_back(points[i]);
    known = std::make_shared<const Rows>(std::move(rows));
  }
  return *static_cast<const Rows*>(known.get());
}

}  // namespace

SweepView::SweepView(const ResultView& result)
    : study(study_of<SweepResult>(result)),
      points(rows_of(result)),
      axis(shown_axes(result, SweepResult::group).at(0)),
      ways(result.file.strings(dataset_of<SweepResult>(&SweepResult::ways))),
      stations(study.stations) {
  for (const auto& p : points) {
    if (p) sections = std::max(sections, static_cast<std::size_t>(p->portrait.poincare_x.cols()));
  }
}

double SweepView::most(std::size_t i, double ContactDoing::*number) const {
  double largest = std::nan("");
  if (!point(i)) return largest;
  for (const ContactDoing& c : point(i)->motion.contacts) {
    if (std::isfinite(c.*number)) largest = std::fmax(largest, c.*number);
  }
  return largest;
}

DisplayUnit SweepView::unit(std::size_t station) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < sections; ++j) {
      if (std::isfinite(x(i, station, j))) largest = std::max(largest, std::abs(x(i, station, j)));
    }
  }
  return unit_for(largest, "m");
}

}  // namespace whirl::inline io::figures
