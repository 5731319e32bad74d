#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "apps/verbs/all.hpp"
#include "apps/verbs/branches.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "apps/verbs/study.hpp"
#include "libdyn/bifurcation.hpp"
#include "libdyn/contact_flow.hpp"
#include "libdyn/contact_harmonics.hpp"
#include "libdyn/harmonic_branch.hpp"
#include "libfe/base/error.hpp"
#include "libio/hdf5.hpp"
#include "libio/model_file.hpp"
#include "libio/parameter_axis.hpp"
#include "libio/table.hpp"

namespace whirl {

namespace {

/// The parameter, its range, and the model at its values.
struct Parameter {
  ParameterAxis axis;
  double low = 0.0, high = 0.0, first = 0.0, largest_step = 0.0;
  double direction = 1.0;  ///< towards the last value
  bool goes_both = false;  ///< the start is within the range
  std::string file, source;

  Model model(double value) const {
    ParameterAxis at = axis;
    at.values = {value};
    return parse_model(source, file, at.assignments(0), std::filesystem::path(file).parent_path());
  }
  std::string text(double value) const {
    return fmt::format("{} = {:.8g}{}{}", axis.path, value, axis.unit.empty() ? "" : " ",
                       axis.unit);
  }
};

Parameter parameter_of(const Invocation& call, const Model& model) {
  if (call.over.size() != 1) {
    throw ModelError(
        {"--over"}, "",
        fmt::format("found {} of them, expected one: --over PATH=first:last:step, such "
                    "as --over contact.ring.friction=0.15:0:0.002",
                    call.over.size()));
  }
  const int points = static_cast<int>(call.integer("points", 101, 2));
  const auto axis = parse_axis(call.over[0], points);
  if (!axis) throw ModelError({"--over " + call.over[0]}, "", axis.problem);
  Parameter p{.axis = *axis, .file = call.file, .source = model.source};
  const auto& values = axis->values;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  p.low = *low;
  p.high = *high;
  p.first = values.front();
  if (!(p.low < p.high)) {
    throw ModelError({"--over " + call.over[0]}, "", "expected two values that differ");
  }
  p.direction = values.back() >= values.front() ? 1.0 : -1.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    p.largest_step = std::max(p.largest_step, std::abs(values[i] - values[i - 1]));
  }
  if (call.has("at")) {
    const std::string line = p.axis.path + "=" + call.text("at");
    const auto at = parse_axis(line + (p.axis.unit.empty() ? "" : p.axis.unit), 0);
    const auto own = parse_axis(line, 0);  // with a unit of its own
    const auto& found = own && !own->unit.empty() ? own : at;
    if (!found || found->values.size() != 1 || found->unit != p.axis.unit) {
      throw ModelError({"--at " + call.text("at")}, "", "expected a value such as those of --over");
    }
    p.first = found->values[0];
    if (p.first < p.low || p.first > p.high) {
      throw ModelError({"--at " + call.text("at")}, "", "expected a value within --over");
    }
    p.goes_both = p.first > p.low && p.first < p.high;
    if (p.first == p.high) p.direction = -1.0;
    if (p.first == p.low) p.direction = 1.0;
  }
  for (const double end : {p.low, p.high, p.first}) require_speed(p.model(end));
  return p;
}

/// All branches of a call, each walked in its turn.
class Tracing {
 public:
  Tracing(const Parameter& parameter, std::shared_ptr<const Scene> first,
          std::vector<NamedPoint> stations, ContinuationOptions options, int generations,
          OrbitMethod method)
      : method_(method),
        parameter_(parameter),
        first_(std::move(first)),
        stations_(std::move(stations)),
        options_(std::move(options)),
        generations_(generations) {
    layout_ = {.states = first_->contacts.size(),
               .scale = first_->contacts.state_scale(),
               .path = parameter.axis.path,
               .unit = parameter.axis.unit};
    layout_.contacts.resize(static_cast<std::size_t>(first_->contacts.owners()));
    for (const ReducedContact& c : first_->contacts.contacts()) {
      layout_.contacts[static_cast<std::size_t>(c.owner)] = c.name;
    }
    for (const NamedPoint& p : stations_) layout_.stations.push_back(point_label(p));
  }

  const BranchLayout& layout() const { return layout_; }
  std::vector<TracedBranch>& branches() { return branches_; }
  bool is_complete() const {
    return !branches_.empty() && std::all_of(branches_.begin(), branches_.end(),
                                             [](const auto& b) { return !b.branch.end.empty(); });
  }

  FlowAt flow_at() const {
    return [this](double value) { return flow_of(scene(value), *first_); };
  }

  /// What series have in common with those of an earlier file.
  void set_harmonics(int harmonics) {
    layout_.harmonics = harmonics;
    layout_.unknowns = HarmonicEquations(*problem_at(parameter_.first), 1, 0).ports() *
                       (2 * Eigen::Index{harmonics} + 1);
  }

  /// The first branch, or two of them, from an orbit near a start.
  /// @param harmonics  of harmonic balance; 0: as many as it takes
  void begin(const Vec& start, int harmonics) {
    std::optional<Vec> unknowns;
    if (method_ == OrbitMethod::harmonic_balance) {
      const ContactOrbit found = find_harmonic_orbit(
          first_->contacts, start, {.period = options_.period, .harmonics = harmonics});
      if (!found.orbit.is_good()) {
        throw NumericalError(
            fmt::format("at the first value, {:g}: {}", options_.first, found.orbit.failure));
      }
      unknowns = harmonic_unknowns(found.orbit, first_->contacts.length_scale());
      if (unknowns->size() == 0) {
        throw NumericalError(
            "harmonic balance: without contacts or films there is one motion for "
            "each value, which whirl unbalance has");
      }
      set_harmonics(found.orbit.harmonics());
    }
    for (const double direction : {-parameter_.direction, parameter_.direction}) {
      if (direction != parameter_.direction && !parameter_.goes_both) continue;
      ContinuationOptions how = options_;
      how.direction = direction;
      const Continuation walk = unknowns ? Continuation(equations(), *unknowns, how)
                                         : Continuation(flow_at(), start, how);
      branches_.push_back({.branch = walk.branch(), .direction = direction});
      measure(branches_.back(), walk.branch().points[0]);
    }
  }

  /// Walks until all branches have ended; false: interrupted.
  /// @param added  called after each point
  bool walk(const std::function<void(std::size_t points)>& added) {
    for (std::size_t i = 0; i < branches_.size(); ++i) {
      if (branches_[i].branch.end.empty()) {
        ContinuationOptions how = options_;
        how.direction = branches_[i].direction;
        Continuation on = method_ == OrbitMethod::harmonic_balance
                              ? Continuation(equations(), branches_[i].branch, how)
                              : Continuation(flow_at(), layout_.scale, branches_[i].branch, how);
        while (!is_interrupted() && on.advance()) {
          Branch& known = branches_[i].branch;  // a copy of what is new only
          known.points.push_back(on.branch().points.back());
          for (std::size_t b = known.bifurcations.size(); b < on.branch().bifurcations.size();
               ++b) {
            known.bifurcations.push_back(on.branch().bifurcations[b]);
          }
          known.end = on.branch().end;
          measure(branches_[i], on.branch().points.back());
          added(++points_);
        }
        branches_[i].branch = on.branch();
        if (on.branch().end.empty()) return false;
        add_switched(i);
        added(points_);
      }
    }
    return true;
  }

 private:
  std::shared_ptr<const Scene> scene(double value) const {
    try {
      return std::make_shared<const Scene>(make_scene(parameter_.model(value)));
    } catch (const ModelError& error) {  // no model there: the branch ends
      throw NumericalError(error.what());
    }
  }

  void add_switched(std::size_t number) {
    const TracedBranch from = branches_[number];
    if (from.generation >= generations_) return;
    for (const Bifurcation& b : from.branch.bifurcations) {
      const auto next = switch_branch(flow_at(), layout_.scale, from.branch.period, b);
      if (!next) continue;
      TracedBranch branch{.branch = {.period = next->period, .points = {next->start}},
                          .parent = static_cast<int>(number) + 1,
                          .generation = from.generation + 1};
      measure(branch, next->start);
      branches_.push_back(std::move(branch));
    }
  }

  struct Problem {
    std::shared_ptr<const Scene> scene;
    HarmonicProblem equations;
  };
  std::shared_ptr<const HarmonicProblem> problem_at(double value) const {
    const auto at = scene(value);
    const auto both = std::make_shared<const Problem>(Problem{at, harmonic_problem(at->contacts)});
    return {both, &both->equations};
  }
  OrbitEquations equations() const {
    return harmonic_equations([this](double value) { return problem_at(value); }, options_.period,
                              layout_.harmonics, first_->contacts.length_scale());
  }

  /// State at phase 0, and the largest distance of the stations from the axis over the period [m].
  void measure(TracedBranch& branch, const BranchPoint& point) const {
    std::vector<double> largest(stations_.size(), 0.0);
    const auto at = scene(point.value);
    const Mat map = at->displacement_map();
    const DofMap& dofs = at->reduced.dofs;
    const auto n = at->contacts.coordinates();
    Vec y(2 * n);
    const auto add = [&] {
      for (std::size_t i = 0; i < stations_.size(); ++i) {
        const double x = map.row(dofs.full_index(stations_[i].point, X)) * y.head(n);
        const double z = map.row(dofs.full_index(stations_[i].point, Y)) * y.head(n);
        largest[i] = std::max(largest[i], std::hypot(x, z));
      }
    };
    if (method_ == OrbitMethod::harmonic_balance) {
      const HarmonicOrbit orbit =
          orbit_of_unknowns(harmonic_problem(at->contacts), point.z.head(layout_.unknowns),
                            options_.period, first_->contacts.length_scale());
      const int samples = 8 * layout_.harmonics;
      for (int k = 0; k < samples; ++k) {
        y.head(n) = orbit.motion.at(2.0 * std::numbers::pi * k / samples).x;
        add();
      }
      branch.starts.push_back(basis_change(*first_, *at, orbit.state()));
    } else {
      // the state in the basis of this value; in most cases the first one's
      Trajectory t{.system = &at->contacts,
                   .revolutions = static_cast<long>((point.z.size() - 1) / layout_.states)};
      t.state.y = basis_change(*at, *first_, point.state(layout_.scale));
      integrate_single(t, {}, [&](const Step& step) {
        for (int k = 1; k <= 8; ++k) {
          step.at(k / 8.0, y.data());
          add();
        }
        return true;
      });
      branch.starts.push_back(point.state(layout_.scale));
    }
    branch.radii.push_back(std::move(largest));
  }

  OrbitMethod method_;
  const Parameter& parameter_;
  std::shared_ptr<const Scene> first_;
  std::vector<NamedPoint> stations_;
  ContinuationOptions options_;
  int generations_;
  BranchLayout layout_;
  std::vector<TracedBranch> branches_;
  std::size_t points_ = 0;
};

Record points_record(const std::vector<TracedBranch>& branches) {
  Record list = Record::array();
  for (std::size_t k = 0; k < branches.size(); ++k) {
    for (std::size_t i = 0; i < branches[k].branch.points.size(); ++i) {
      const BranchPoint& p = branches[k].branch.points[i];
      const auto& radii = branches[k].radii[i];
      Record r, duty = Record::array(), impacts = Record::array(), normal = Record::array(),
                floquet = Record::array();
      for (const ContactMeasure& c : p.contacts) {
        duty.add(c.duty);
        impacts.add(c.impacts / branches[k].branch.period);
        normal.add(c.max_normal);
      }
      for (const Complex& m : p.multipliers) floquet.add(m);
      r.set("value", p.value).set("branch", static_cast<int>(k) + 1);
      r.set("amplitude_m", radii.empty() ? Record(nullptr) : Record(radii[0]));
      r.set("stable", p.multipliers.size() == 0 ? Record(nullptr) : Record(p.is_stable()));
      r.set("duty", duty).set("impacts_per_rev", impacts).set("max_normal_n", normal);
      r.set("floquet", floquet);
      list.add(r);
    }
  }
  return list;
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

std::string branches_text(const std::vector<TracedBranch>& branches, const Parameter& parameter) {
  std::string text;
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const Branch& b = branches[k].branch;
    const auto stable = std::count_if(b.points.begin(), b.points.end(), [](const BranchPoint& p) {
      return p.multipliers.size() > 0 && p.is_stable();
    });
    text += fmt::format(
        "\n  branch {}: period {}, {} points, {} of them stable; from {:.8g} to {:.8g}{}\n  it "
        "ends: "
        "{}\n",
        k + 1, b.period, b.points.size(), stable, b.points.front().value, b.points.back().value,
        branches[k].parent > 0 ? fmt::format("; begins on branch {}", branches[k].parent) : "",
        b.end.empty() ? "not yet" : b.end);
    if (b.bifurcations.empty()) continue;
    const std::string unit = parameter.axis.unit.empty() ? "" : " [" + parameter.axis.unit + "]";
    Table table({"bifurcation", parameter.axis.path + unit, "after point", "multiplier"});
    for (const Bifurcation& x : b.bifurcations) {
      const bool is_grazing = x.kind == BifurcationKind::grazing;
      table.row({std::string(name_of(x.kind)) + (is_grazing ? " of " + x.contact : ""),
                 fmt::format("{:.9g}", x.at.value), std::to_string(x.after + 1),
                 is_grazing
                     ? fmt::format("{:+g} impacts", x.change)
                     : fmt::format("{:+.6f} {:+.6f} i", x.multiplier.real(), x.multiplier.imag())});
    }
    text += "\n" + table.text();
  }
  return text;
}

}  // namespace

Report run_continue(const Invocation& call) {
  const Model model = call.model();
  require_stationary_frame(call);
  const Parameter parameter = parameter_of(call, model);
  ContinuationOptions options{.low = parameter.low,
                              .high = parameter.high,
                              .first = parameter.first,
                              .direction = parameter.direction,
                              .largest_step = parameter.largest_step};
  options.period = static_cast<int>(call.integer("period", 1));
  options.most_points = static_cast<int>(call.integer("most", 2000));
  const int generations = static_cast<int>(call.integer("switch", 0, 0));
  const OrbitMethod method = orbit_method(call);
  const bool is_series = method == OrbitMethod::harmonic_balance;
  if (is_series && generations > 0) {
    throw ModelError({"--switch"}, "", "goes with --method shooting only");
  }
  const int harmonics = harmonics_of(call, options.period);

  const Model at_first = parameter.model(parameter.first);
  const auto first = std::make_shared<const Scene>(make_scene(at_first));
  Tracing tracing(parameter, first,
                  select_points(at_first, first->assembler, call.text("stations")), options,
                  generations, method);
  StudyFile file(
      call, [&] { return call.result_file(model); },
      [&](ResultWriter& to) {
        write_branches(to, tracing.layout(), tracing.branches(), tracing.is_complete());
      },
      [&](const ResultReader& earlier) {
        if (is_series) tracing.set_harmonics(harmonics_in(earlier));
        tracing.branches() = read_branches(earlier, tracing.layout());
      });
  std::size_t resumed = 0;
  for (const TracedBranch& b : tracing.branches()) resumed += b.branch.points.size();
  int status = 0;
  if (resumed == 0) {
    const Trajectory transient = after_transient(call, at_first, *first);
    status = status_of(transient.outcome);
    if (status == 3) throw NumericalError(transient.diagnosis);
    if (status == 0) tracing.begin(transient.state.y, harmonics);
  }
  if (status == 0) {
    is_interrupted();  // from now on Ctrl-C stops with what is done
    Progress progress("points of branches", options.most_points, call.shows_progress);
    try {
      if (!tracing.walk([&](std::size_t points) {
            progress.update(static_cast<long>(points));
            file.save_if_due();
          })) {
        status = 130;
      }
    } catch (...) {
      file.save();
      throw;
    }
    file.save();
  }

  const std::vector<TracedBranch>& branches = tracing.branches();
  Report report{.record = begin_record(call, model), .status = status};
  Record list = Record::array();
  for (const TracedBranch& b : branches) {
    Record r;
    r.set("period_revs", b.branch.period);
    r.set("parent", b.parent > 0 ? Record(b.parent) : Record(nullptr)).set("end", b.branch.end);
    list.add(r);
  }
  Record& r = report.record;
  r.set("parameter", parameter.axis.path).set("unit", parameter.axis.unit);
  r.set("method", call.text("method", "shooting"));
  if (is_series) r.set("harmonics", tracing.layout().harmonics);
  r.set("branches", list).set("points", points_record(branches));
  r.set("bifurcations", bifurcations_record(branches)).set("resumed", static_cast<long>(resumed));
  report.text = "Periodic orbits along " + parameter.axis.path +
                (model.title.empty() ? "" : ": " + model.title) + "\n" +
                (is_series ? fmt::format("  by harmonic balance with {} harmonics\n",
                                         tracing.layout().harmonics)
                           : "") +
                branches_text(branches, parameter);
  if (resumed > 0) report.text += fmt::format("\n  {} points were there already\n", resumed);
  if (status == 130) {
    report.text +=
        fmt::format("\n  stopped{}\n", call.has("out") ? "; the same line goes on from there" : "");
  }
  if (call.has("out")) report.text += fmt::format("\n  result: {}\n", call.given.at("out"));
  return report;
}

}  // namespace whirl
