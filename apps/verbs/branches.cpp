#include "apps/verbs/branches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/constants.hpp"
#include "libio/results/branch_ends.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/record.hpp"

namespace whirl {

namespace {

const std::string group = "/branch";
constexpr double most_small = 1e6;  ///< of a packed number that counts nothing in its file

/// All numbers of points one after another.
class Packed {
 public:
  explicit Packed(const std::vector<std::string>& contacts, std::vector<double> numbers = {})
      : contacts_(contacts), numbers_(std::move(numbers)) {}

  void put(const TracedBranch& b) {
    for (const double x :
         {double(b.branch.period), double(b.parent), double(b.generation), b.direction,
          double(b.kind), double(b.branch.points.size()), double(b.branch.bifurcations.size())}) {
      put(x);
    }
    for (std::size_t i = 0; i < b.branch.points.size(); ++i) {
      put(b.branch.points[i]);
      const OrbitMeasure m = i < b.measures.size() ? b.measures[i] : OrbitMeasure();
      put(static_cast<double>(m.radii.size()));
      for (const double r : m.radii) put(r);
      put(m.work);
      put(static_cast<double>(m.sections.cols()));
      put(Vec(m.sections.reshaped()));
      put(i < b.starts.size() ? b.starts[i] : Vec());
    }
    for (const Bifurcation& x : b.branch.bifurcations) {
      put(x.at);
      for (const double v :
           {double(x.kind), double(x.after), x.change, x.multiplier.real(), x.multiplier.imag()}) {
        put(v);
      }
    }
  }

  TracedBranch take_branch() {
    TracedBranch b;
    b.branch.period = take_count();
    b.parent = take_count();
    b.generation = take_count();
    b.direction = take();
    b.kind = static_cast<BifurcationKind>(take_count());
    const int points = take_count(), bifurcations = take_count();
    for (int i = 0; i < points; ++i) {
      b.branch.points.push_back(take_point());
      OrbitMeasure m;
      m.radii.resize(static_cast<std::size_t>(take_count()));
      for (double& r : m.radii) r = take();
      m.work = take();
      const int revolutions = take_count();
      const Vec sections = take_vector();
      if (revolutions > 0) {
        m.sections = sections.reshaped(sections.size() / revolutions, revolutions);
      }
      b.measures.push_back(std::move(m));
      b.starts.push_back(take_vector());
    }
    for (int i = 0; i < bifurcations; ++i) {
      Bifurcation x{.at = take_point()};
      x.kind = static_cast<BifurcationKind>(take_count());
      x.after = static_cast<std::size_t>(take_count());
      x.change = take();
      const double real = take();
      x.multiplier = {real, take()};
      b.branch.bifurcations.push_back(std::move(x));
    }
    return b;
  }

  const std::vector<double>& numbers() const { return numbers_; }

 private:
  void put(double x) { numbers_.push_back(x); }
  void put(const Vec& v) {
    put(static_cast<double>(v.size()));
    numbers_.insert(numbers_.end(), v.begin(), v.end());
  }
  void put(const BranchPoint& p) {
    put(p.value);
    put(p.z);
    put(p.tangent);
    put(p.step);
    put(p.residual);
    put(static_cast<double>(p.multipliers.size()));
    for (const Complex& m : p.multipliers) put(m.real()), put(m.imag());
    put(static_cast<double>(p.contacts.size()));
    for (const ContactMeasure& c : p.contacts) {
      for (const double x :
           {c.duty, c.impacts, c.sticking, c.max_normal, c.max_tangential, c.touch_time}) {
        put(x);
      }
    }
  }

  BranchPoint take_point() {
    BranchPoint p;
    p.value = take();
    p.z = take_vector();
    p.tangent = take_vector();
    p.step = take();
    p.residual = take();
    p.multipliers.resize(take_count());
    for (Complex& m : p.multipliers) {
      const double real = take();
      m = {real, take()};
    }
    p.contacts.resize(static_cast<std::size_t>(take_count()));
    for (std::size_t i = 0; i < p.contacts.size(); ++i) {
      ContactMeasure& c = p.contacts[i];
      if (i < contacts_.size()) c.name = contacts_[i];
      c.mean_slip = nan;
      for (double* x :
           {&c.duty, &c.impacts, &c.sticking, &c.max_normal, &c.max_tangential, &c.touch_time}) {
        *x = take();
      }
    }
    return p;
  }
  Vec take_vector() {
    Vec v(take_count());
    for (double& x : v) x = take();
    return v;
  }
  double take() {
    if (next_ == numbers_.size()) throw FileError("the walk is too short: it is of another study");
    return numbers_[next_++];
  }
  int take_count() {
    const double x = take();
    const auto left = static_cast<double>(numbers_.size() - next_);
    if (!(x >= 0.0 && x <= std::max(left, most_small)))
      throw FileError("the walk is damaged, or of another version");
    return static_cast<int>(x);
  }

  const std::vector<std::string>& contacts_;
  std::vector<double> numbers_;
  std::size_t next_ = 0;
};

std::vector<std::optional<BranchEnd>> ends_of(const std::vector<TracedBranch>& branches) {
  std::vector<std::optional<BranchEnd>> ends;
  for (const TracedBranch& b : branches) ends.push_back(b.branch.end);
  return ends;
}

/// The branches of a walk, with the ends and the names of contacts that stand beside it.
std::vector<TracedBranch> read_walk(const ResultReader& file, const std::string& of,
                                    const BranchLayout& layout) {
  Packed walk(layout.contacts, file.numbers(of + "/walk"));
  std::vector<std::string> grazing;
  if (file.has(of + "/bifurcation_contact")) grazing = file.strings(of + "/bifurcation_contact");
  std::size_t known = 0;
  std::vector<TracedBranch> branches;
  for (std::optional<BranchEnd>& end : read_ends(file, of)) {
    branches.push_back(walk.take_branch());
    branches.back().branch.end = std::move(end);
    for (Bifurcation& x : branches.back().branch.bifurcations) {
      x.contact = known < grazing.size() ? grazing[known] : "";
      ++known;
    }
  }
  return branches;
}

/// Where the stations are once a revolution, as a sweep has it: NaN beyond the period.
void write_sections(ResultWriter& file, const std::vector<TracedBranch>& branches, Eigen::Index n,
                    Eigen::Index stations) {
  Eigen::Index longest = 0;
  for (const TracedBranch& b : branches) {
    for (const OrbitMeasure& m : b.measures) longest = std::max(longest, m.sections.cols());
  }
  if (longest == 0) return;
  const std::vector<Eigen::Index> shape{n, stations, longest};
  for (const Eigen::Index component : {0, 1}) {
    std::vector<double> values;
    for (const TracedBranch& b : branches) {
      for (const OrbitMeasure& m : b.measures) {
        const Mat& sections = m.sections;
        for (Eigen::Index s = 0; s < stations; ++s) {
          for (Eigen::Index k = 0; k < longest; ++k) {
            values.push_back(k < sections.cols() ? sections(2 * s + component, k) : nan);
          }
        }
      }
    }
    file.dataset(group + (component == 0 ? "/poincare_x" : "/poincare_y"), values, shape,
                 {"m",
                  component == 0 ? "x at phase 0" : "y at phase 0",
                  {group + "/value", group + "/station", ""}});
  }
}

}  // namespace

void write_branches(ResultWriter& file, const BranchLayout& layout,
                    const std::vector<TracedBranch>& branches, bool is_complete) {
  Packed walk(layout.contacts);
  std::vector<std::string> kinds, grazing;
  std::vector<int> number, period, parent, of_point, stable, of_bifurcation, after;
  std::vector<double> value, revolutions, work, residual, radius, duty, impacts, normal, tangential,
      at, change;
  std::vector<Complex> multiplier, critical;
  std::vector<double> states;
  for (const TracedBranch& b : branches) {
    number.push_back(static_cast<int>(number.size()) + 1);
    period.push_back(b.branch.period);
    parent.push_back(b.parent);
    walk.put(b);
    for (std::size_t i = 0; i < b.branch.points.size(); ++i) {
      const BranchPoint& p = b.branch.points[i];
      of_point.push_back(number.back());
      value.push_back(p.value);
      revolutions.push_back(layout.period(b.branch, p));
      residual.push_back(p.residual);
      stable.push_back(p.multipliers.size() == 0 ? -1 : p.is_stable() ? 1 : 0);
      const OrbitMeasure& m = b.measures[i];
      radius.insert(radius.end(), m.radii.begin(), m.radii.end());
      work.push_back(m.work);
      for (Eigen::Index k = 0; k < layout.states; ++k) {
        multiplier.push_back(k < p.multipliers.size() ? p.multipliers(k) : Complex(nan, nan));
      }
      const Vec& y = b.starts[i];
      states.insert(states.end(), y.begin(), y.end());
      for (const ContactMeasure& c : p.contacts) {
        duty.push_back(c.duty);
        impacts.push_back(c.impacts / revolutions.back());
        normal.push_back(c.max_normal);
        tangential.push_back(c.max_tangential);
      }
    }
    for (const Bifurcation& x : b.branch.bifurcations) {
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
  write_ends(file, group, group + "/number", ends_of(branches));
  file.dataset(path("value"), value, {layout.unit, layout.path, {""}});
  file.attribute(group, "parameter", layout.path);
  const std::string along = path("value");
  file.dataset(path("branch"), of_point, {"", "branch of a point", {along}});
  file.dataset(path("stable"), stable, {"", "1 stable, 0 unstable, -1 not known", {along}});
  file.dataset(path("revolutions"), revolutions, {"", "period [revolutions]", {along}});
  file.dataset(path("work"), work, {"J", "work of the unbalance per revolution", {along}});
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
    write_sections(file, branches, n, stations);
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
  return read_walk(file, group, layout);
}

void write_borders(ResultWriter& file, const BranchLayout& layout, const BorderAxes& axes,
                   const std::vector<TracedBranch>& borders, bool is_complete) {
  const std::string of = "/border";
  const auto path = [&](const char* name) { return of + "/" + name; };
  Packed walk(layout.contacts);
  std::vector<std::string> kinds, contacts;
  std::vector<int> number, period, curve, stable;
  std::vector<double> first, second;
  for (const TracedBranch& b : borders) {
    walk.put(b);
    number.push_back(static_cast<int>(number.size()) + 1);
    kinds.emplace_back(name_of(b.kind));
    contacts.push_back(b.contact);
    period.push_back(b.branch.period);
    for (const BranchPoint& p : b.branch.points) {
      curve.push_back(number.back());
      first.push_back(axes.first_value(p));
      second.push_back(p.value);
      const CVec& others = p.multipliers;
      stable.push_back(others.size() == 0 || others.cwiseAbs().maxCoeff() < 1.0 ? 1 : 0);
    }
  }
  file.dataset(path("number"), number, {"", "curve", {""}});
  const std::vector<std::string> of_curve{path("number")};
  file.dataset(path("kind"), kinds, {"", "kind of the bifurcation", of_curve});
  file.dataset(path("contact"), contacts, {"", "contact that grazes", of_curve});
  file.dataset(path("period"), period, {"", "period of the orbits [revolutions]", of_curve});
  write_ends(file, of, of + "/number", ends_of(borders));
  file.dataset(path("first"), first, {layout.unit, layout.path, {""}});
  const std::vector<std::string> of_point{path("first")};
  file.dataset(path("second"), second, {axes.unit, axes.path, of_point});
  file.dataset(path("curve"), curve, {"", "curve of a point", of_point});
  file.dataset(path("stable"), stable,
               {"", "1: no other multiplier is outside of the unit circle", of_point});
  file.dataset(path("walk"), walk.numbers(), {"", "what the walk goes on from", {""}});
  file.attribute(of, "complete", is_complete ? 1 : 0);
}

std::vector<TracedBranch> read_borders(const ResultReader& file, const BranchLayout& layout) {
  if (!file.has("/border/walk")) return {};
  std::vector<TracedBranch> borders = read_walk(file, "/border", layout);
  const std::vector<std::string> contacts = file.strings("/border/contact");
  for (std::size_t i = 0; i < borders.size(); ++i) borders[i].contact = contacts[i];
  return borders;
}

Record bifurcations_record(const std::vector<TracedBranch>& branches) {
  Record list = Record::array();
  for (std::size_t k = 0; k < branches.size(); ++k) {
    for (const Bifurcation& b : branches[k].branch.bifurcations) {
      Record r;
      r.set("value", b.at.value).set("kind", name_of(b.kind));
      r.set("branch", static_cast<int>(k) + 1).set("after_point", static_cast<long>(b.after) + 1);
      const bool is_grazing = b.kind == BifurcationKind::grazing;
      r.set("contact", is_grazing ? Record(b.contact) : Record(nullptr));
      r.set("multiplier", is_grazing ? Record(nullptr) : Record(b.multiplier));
      list.add(r);
    }
  }
  return list;
}

}  // namespace whirl
