#include "apps/verbs/branches.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "libio/hdf5.hpp"

namespace whirl {

namespace {

const std::string group = "/branch";
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// All numbers of points one after another.
class Packed {
 public:
  Packed(const BranchLayout& layout, std::vector<double> numbers = {})
      : layout_(layout), numbers_(std::move(numbers)) {}

  void put(const BranchPoint& p) {
    put(p.value);
    for (const double x : p.z) put(x);
    for (const double x : p.tangent) put(x);
    put(p.step);
    put(p.residual);
    put(p.multipliers.size() > 0 ? 1.0 : 0.0);
    for (const Complex& m : p.multipliers) put(m.real()), put(m.imag());
    for (const ContactMeasure& c : p.contacts) {
      for (const double x :
           {c.duty, c.impacts, c.sticking, c.max_normal, c.max_tangential, c.touch_time}) {
        put(x);
      }
    }
  }
  void put(double x) { numbers_.push_back(x); }

  BranchPoint take_point(int period) {
    BranchPoint p;
    p.value = take();
    const bool is_series = layout_.harmonics > 0;
    const Eigen::Index size = (is_series ? layout_.unknowns : layout_.states * period) + 1;
    p.z.resize(size);
    for (double& x : p.z) x = take();
    p.tangent.resize(size);
    for (double& x : p.tangent) x = take();
    p.step = take();
    p.residual = take();
    if (take() != 0.0) p.multipliers.resize(layout_.states);
    for (Complex& m : p.multipliers) {
      const double real = take();
      m = {real, take()};
    }
    for (const std::string& name : layout_.contacts) {
      ContactMeasure c{.name = name, .mean_slip = nan};
      for (double* x :
           {&c.duty, &c.impacts, &c.sticking, &c.max_normal, &c.max_tangential, &c.touch_time}) {
        *x = take();
      }
      p.contacts.push_back(std::move(c));
    }
    return p;
  }
  double take() {
    if (next_ == numbers_.size())
      throw FileError(group + "/walk is too short: it is of another study");
    return numbers_[next_++];
  }
  int take_count() { return static_cast<int>(take()); }

  const std::vector<double>& numbers() const { return numbers_; }

 private:
  const BranchLayout& layout_;
  std::vector<double> numbers_;
  std::size_t next_ = 0;
};

}  // namespace

void write_branches(ResultWriter& file, const BranchLayout& layout,
                    const std::vector<TracedBranch>& branches, bool is_complete) {
  Packed walk(layout);
  std::vector<std::string> ends, kinds, grazing;
  std::vector<int> number, period, parent, of_point, stable, of_bifurcation, after;
  std::vector<double> value, residual, radius, duty, impacts, normal, tangential, at, change;
  std::vector<Complex> multiplier, critical;
  std::vector<double> states;
  for (const TracedBranch& b : branches) {
    number.push_back(static_cast<int>(number.size()) + 1);
    period.push_back(b.branch.period);
    parent.push_back(b.parent);
    ends.push_back(b.branch.end);
    for (const double x :
         {double(b.branch.period), double(b.parent), double(b.generation), b.direction,
          double(b.branch.points.size()), double(b.branch.bifurcations.size())}) {
      walk.put(x);
    }
    for (std::size_t i = 0; i < b.branch.points.size(); ++i) {
      const BranchPoint& p = b.branch.points[i];
      walk.put(p);
      for (const double r : b.radii[i]) walk.put(r);
      if (layout.harmonics > 0) {
        for (const double x : b.starts[i]) walk.put(x);
      }
      of_point.push_back(number.back());
      value.push_back(p.value);
      residual.push_back(p.residual);
      stable.push_back(p.multipliers.size() == 0 ? -1 : p.is_stable() ? 1 : 0);
      radius.insert(radius.end(), b.radii[i].begin(), b.radii[i].end());
      for (Eigen::Index k = 0; k < layout.states; ++k) {
        multiplier.push_back(p.multipliers.size() > 0 ? p.multipliers(k) : Complex(nan, nan));
      }
      const Vec& y = b.starts[i];
      states.insert(states.end(), y.begin(), y.end());
      for (const ContactMeasure& c : p.contacts) {
        duty.push_back(c.duty);
        impacts.push_back(c.impacts / b.branch.period);
        normal.push_back(c.max_normal);
        tangential.push_back(c.max_tangential);
      }
    }
    for (const Bifurcation& x : b.branch.bifurcations) {
      walk.put(x.at);
      for (const double v :
           {double(x.kind), double(x.after), x.change, x.multiplier.real(), x.multiplier.imag()}) {
        walk.put(v);
      }
      kinds.emplace_back(name_of(x.kind));
      grazing.push_back(x.contact);
      of_bifurcation.push_back(number.back());
      after.push_back(static_cast<int>(x.after) + 1);
      at.push_back(x.at.value);
      change.push_back(x.change);
      critical.push_back(x.multiplier);
    }
  }
  const Eigen::Index n = std::ssize(value), stations = std::ssize(layout.stations),
                     contacts = std::ssize(layout.contacts);
  const auto path = [](const char* name) { return group + "/" + name; };
  file.dataset(path("number"), number, {"", "branch", {""}});
  file.dataset(path("period"), period, {"", "period [revolutions]", {path("number")}});
  file.dataset(path("parent"), parent, {"", "branch that it begins on; 0: none", {path("number")}});
  file.dataset(path("end"), ends, {"", "why it ends", {path("number")}});
  file.dataset(path("value"), value, {layout.unit, layout.path, {""}});
  file.attribute(group, "parameter", layout.path);
  const std::string along = path("value");
  file.dataset(path("branch"), of_point, {"", "branch of a point", {along}});
  file.dataset(path("stable"), stable, {"", "1 stable, 0 unstable, -1 not known", {along}});
  file.dataset(path("residual"), residual, {"", "residual of the orbit [length scales]", {along}});
  file.dataset(path("state"), states, std::vector<Eigen::Index>{n, layout.states},
               {"", "reduced state at phase 0, in the basis of the first value", {along, ""}});
  const Eigen::Map<const CMat> m(multiplier.data(), layout.states, n);
  file.dataset(path("multiplier"), CMat(m.transpose()),
               {"", "Floquet multipliers of the period, the largest first", {along, ""}});
  if (stations > 0) {
    file.dataset(path("station"), layout.stations, {"", "station", {""}});
    file.dataset(path("max_radius"), radius, std::vector<Eigen::Index>{n, stations},
                 {"m", "largest distance from the axis", {along, path("station")}});
  }
  if (contacts > 0) {
    file.dataset(path("contact"), layout.contacts, {"", "contact", {""}});
    const std::vector<Eigen::Index> shape{n, contacts};
    const std::vector<std::string> axes{along, path("contact")};
    file.dataset(path("duty"), duty, shape, {"", "share of time in touch", axes});
    file.dataset(path("impacts_per_rev"), impacts, shape, {"", "impacts per revolution", axes});
    file.dataset(path("max_normal"), normal, shape, {"N", "largest normal force", axes});
    file.dataset(path("max_tangential"), tangential, shape, {"N", "largest friction force", axes});
  }
  if (!kinds.empty()) {
    file.dataset(path("bifurcation"), at, {layout.unit, layout.path, {""}});
    const std::vector<std::string> axes{path("bifurcation")};
    file.dataset(path("bifurcation_kind"), kinds, {"", "kind", axes});
    file.dataset(path("bifurcation_branch"), of_bifurcation, {"", "branch", axes});
    file.dataset(path("bifurcation_after"), after, {"", "number of the point before", axes});
    file.dataset(path("bifurcation_contact"), grazing, {"", "contact that grazes", axes});
    file.dataset(path("bifurcation_change"), change, {"", "change of its impacts a period", axes});
    file.dataset(path("bifurcation_multiplier"),
                 CVec(Eigen::Map<const CVec>(critical.data(), std::ssize(critical))),
                 {"", "critical multiplier", axes});
  }
  file.dataset(path("walk"), walk.numbers(), {"", "what the walk goes on from", {""}});
  file.attribute(group, "complete", is_complete ? 1 : 0);
  if (layout.harmonics > 0) file.attribute(group, "harmonics", layout.harmonics);
}

int harmonics_in(const ResultReader& file) {
  if (!file.has_attribute(group, "harmonics")) return 0;
  return static_cast<int>(file.number_attribute(group, "harmonics"));
}

std::vector<TracedBranch> read_branches(const ResultReader& file, const BranchLayout& layout) {
  Packed walk(layout, file.numbers(group + "/walk"));
  const std::vector<std::string> ends = file.strings(group + "/end");
  std::vector<std::string> grazing;
  if (file.has(group + "/bifurcation_contact")) {
    grazing = file.strings(group + "/bifurcation_contact");
  }
  std::size_t known = 0;
  std::vector<TracedBranch> branches;
  for (const std::string& end : ends) {
    TracedBranch b;
    b.branch.end = end;
    b.branch.period = walk.take_count();
    b.parent = walk.take_count();
    b.generation = walk.take_count();
    b.direction = walk.take();
    const int points = walk.take_count(), bifurcations = walk.take_count();
    for (int i = 0; i < points; ++i) {
      b.branch.points.push_back(walk.take_point(b.branch.period));
      b.radii.emplace_back();
      for (std::size_t k = 0; k < layout.stations.size(); ++k)
        b.radii.back().push_back(walk.take());
      if (layout.harmonics == 0) {
        b.starts.push_back(b.branch.points.back().state(layout.scale));
        continue;
      }
      b.starts.emplace_back(layout.states);
      for (double& x : b.starts.back()) x = walk.take();
    }
    for (int i = 0; i < bifurcations; ++i) {
      Bifurcation x{.at = walk.take_point(b.branch.period)};
      x.kind = static_cast<BifurcationKind>(walk.take_count());
      x.after = static_cast<std::size_t>(walk.take_count());
      x.change = walk.take();
      const double real = walk.take();
      x.multiplier = {real, walk.take()};
      x.contact = known < grazing.size() ? grazing[known] : "";
      ++known;
      b.branch.bifurcations.push_back(std::move(x));
    }
    branches.push_back(std::move(b));
  }
  return branches;
}

}  // namespace whirl
