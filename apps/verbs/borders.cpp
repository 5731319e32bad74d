#include "apps/verbs/borders.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/progress.hpp"
#include "libbase/error.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

constexpr double finest = 1e-5;  ///< arc length, to which a border comes near its end

bool is_followed(const Bifurcation& b) {
  if (b.kind == BifurcationKind::pitchfork) return false;
  // a grazing that ends a branch is not on it
  return b.kind != BifurcationKind::grazing || b.at.residual < 1e-8;
}

}  // namespace

Borders::Borders(const BranchParameters& parameters, std::shared_ptr<const Scene> first,
                 const BranchLayout& layout, int most_points)
    : parameters_(parameters),
      first_(std::move(first)),
      layout_(layout),
      most_points_(most_points) {}

BorderAxes Borders::axes() const {
  return {.path = parameters_.across->axis.path,
          .unit = parameters_.across->axis.unit,
          .low = parameters_.along.range.low,
          .high = parameters_.along.range.high};
}

BranchEquations Borders::equations(const TracedBranch& border) const {
  const FlowPlane plane{
      [this](double a, double b) { return flow_of(parameters_.scene(a, b), *first_); },
      [this, contact = border.contact](double a, double b, std::span<const Vec> starts) {
        const auto scene = parameters_.scene(a, b);
        const BasisChange change(*scene, *first_);
        std::vector<Vec> own;
        for (const Vec& y : starts) own.push_back(change.to(y));
        return nearest_graze(*scene, contact, own);
      }};
  return border_equations(border.kind, plane, layout_.scale, parameters_.along.range.low,
                          parameters_.along.range.high);
}

ContinuationOptions Borders::options(const TracedBranch& border) const {
  ContinuationOptions how = parameters_.across->range.options(border.direction);
  how.period = border.branch.period;
  how.most_points = most_points_;
  how.smallest_step = finest;
  return how;
}

void Borders::begin(const std::vector<TracedBranch>& branches) {
  for (std::size_t k = 0; k < branches.size(); ++k) {
    for (const Bifurcation& b : branches[k].branch.bifurcations) {
      if (!is_followed(b)) continue;
      TracedBranch border{.parent = static_cast<int>(k) + 1, .kind = b.kind, .contact = b.contact};
      for (const double direction : parameters_.across->range.directions()) {
        border.direction = direction;
        border.branch = {.period = branches[k].branch.period};
        try {
          border.branch = Continuation(equations(border), b.at.z, options(border)).branch();
        } catch (const NumericalError& error) {  // a point where two of them meet, say
          border.branch.points = {b.at};
          border.branch.end = {EndKind::no_start, error.what()};
          border.branch.points[0].value = parameters_.across->range.first;
          Vec z(b.at.z.size() + 1);  // the second parameter is appended
          z << b.at.z, 0.0;
          border.branch.points[0].z = z;
        }
        borders_.push_back(border);
      }
    }
  }
}

bool Borders::walk(const std::vector<TracedBranch>& branches,
                   const std::function<void(std::size_t)>& added) {
  if (!parameters_.across) return true;
  if (borders_.empty()) begin(branches);
  std::size_t points = 0;
  for (TracedBranch& border : borders_) {
    if (border.branch.end) continue;
    Continuation on(equations(border), border.branch, options(border));
    while (!is_interrupted() && on.advance()) {
      border.branch = on.branch();
      added(++points);
    }
    border.branch = on.branch();
    if (!border.branch.end) return false;
  }
  return true;
}

void Borders::write(ResultWriter& file) const {
  if (borders_.empty()) return;
  const bool is_complete = std::all_of(borders_.begin(), borders_.end(),
                                       [](const auto& b) { return b.branch.end.has_value(); });
  write_borders(file, layout_, axes(), borders_, is_complete);
}

void Borders::read(const ResultReader& file) {
  borders_ = read_borders(file, layout_);
}

Record Borders::record() const {
  Record list = Record::array();
  for (const TracedBranch& b : borders_) {
    Record r, points = Record::array();
    r.set("kind", name_of(b.kind)).set("period_revs", b.branch.period).set("branch", b.parent);
    r.set("contact", b.contact.empty() ? Record(nullptr) : Record(b.contact));
    for (const BranchPoint& p : b.branch.points) {
      Record pair = Record::array();
      pair.add(axes().first_value(p));
      pair.add(p.value);
      points.add(pair);
    }
    r.set("points", points).set("end", b.branch.end_text());
    r.set("end_kind", b.branch.end ? Record(name_of(b.branch.end->kind)) : Record(nullptr));
    list.add(r);
  }
  return list;
}

std::string Borders::text() const {
  const auto named = [](const BranchParameter& p) {
    return p.axis.path + (p.axis.unit.empty() ? "" : " [" + p.axis.unit + "]");
  };
  if (borders_.empty()) return "\n  no border: there is no bifurcation to follow\n";
  Table table({"border", "of branch", "points", named(parameters_.along),
               "at " + named(*parameters_.across), "it ends"});
  for (const TracedBranch& b : borders_) {
    const auto &first = b.branch.points.front(), &last = b.branch.points.back();
    table.row({std::string(name_of(b.kind)) + (b.contact.empty() ? "" : " of " + b.contact),
               std::to_string(b.parent), std::to_string(b.branch.points.size()),
               fmt::format("{:.6g} to {:.6g}", axes().first_value(first), axes().first_value(last)),
               fmt::format("{:.6g} to {:.6g}", first.value, last.value), b.branch.end_text()});
  }
  return "\n  borders in the plane of both parameters\n\n" + table.text();
}

}  // namespace whirl
