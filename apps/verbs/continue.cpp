#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/borders.hpp"
#include "apps/verbs/branches.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "apps/verbs/study_file.hpp"
#include "libbase/error.hpp"
#include "libdyn/branches/bifurcation.hpp"
#include "libdyn/branches/harmonic_branch.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/orbits/cycle.hpp"
#include "libdyn/orbits/orbit_measure.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

constexpr double same_place = 1e-5;  ///< of the range, where branches meet

/// All branches of a call, each walked in its turn.
class Tracing {
 public:
  Tracing(const BranchParameters& parameters, std::shared_ptr<const Scene> first,
          std::vector<NamedPoint> stations, ContinuationOptions options, int generations,
          OrbitMethod method, bool is_rotating)
      : method_(method),
        parameters_(parameters),
        first_(std::move(first)),
        stations_(std::move(stations)),
        options_(std::move(options)),
        generations_(generations) {
    layout_ = {.states = first_->contacts.size(),
               .scale = first_->contacts.state_scale(),
               .path = parameters.along.axis.path,
               .unit = parameters.along.axis.unit,
               .is_rotating = is_rotating};
    layout_.contacts.resize(static_cast<std::size_t>(first_->contacts.owners()));
    for (const ReducedContact& c : first_->contacts.contacts()) {
      layout_.contacts[static_cast<std::size_t>(c.owner)] = c.name;
    }
    for (const NamedPoint& p : stations_) layout_.stations.push_back(point_label(p));
  }

  const BranchLayout& layout() const { return layout_; }
  std::vector<TracedBranch>& branches() { return branches_; }
  bool is_complete() const {
    return !branches_.empty() && std::all_of(branches_.begin(), branches_.end(), [](const auto& b) {
      return b.branch.end.has_value();
    });
  }

  FlowAt flow_at() const {
    return [this](double value) { return flow_of(scene(value), *first_); };
  }
  FreeFlowAt free_flow_at() const {
    return [this](double value) { return rotating_flow(scene(value), *first_); };
  }

  /// What series have in common with those of an earlier file.
  void set_harmonics(int harmonics) { layout_.harmonics = harmonics; }

  /// The first branch, or two of them, from an orbit near a start.
  /// @param harmonics  of harmonic balance; 0: as many as it takes
  void begin(const Vec& start, int harmonics) {
    std::optional<Vec> unknowns;
    if (method_ == OrbitMethod::harmonic_balance) unknowns = series_of(start, harmonics);
    const double period =
        layout_.is_rotating ? guessed_period(*first_, start) / first_->contacts.period() : 0.0;
    for (const double direction : parameters_.along.range.directions()) {
      ContinuationOptions how = options_;
      how.direction = direction;
      const Continuation walk = unknowns ? Continuation(equations(), *unknowns, how)
                                : layout_.is_rotating
                                    ? cycle_continuation(free_flow_at(), start, period, how)
                                    : orbit_continuation(flow_at(), start, how);
      branches_.push_back({.branch = walk.branch(), .direction = direction});
      measure(branches_.back(), walk.branch().points[0]);
    }
  }

  /// Walks until all branches have ended; false: interrupted. Where one closes, it is not walked the
  /// other way, too.
  /// @param added  called after each point
  bool walk(const std::function<void(std::size_t points)>& added) {
    for (std::size_t i = 0; i < branches_.size(); ++i) {
      if (!branches_[i].branch.end) {
        ContinuationOptions how = options_;
        how.direction = branches_[i].direction;
        Continuation on(equations(), branches_[i].branch, how);
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
        if (!on.branch().end) return false;
        if (on.branch().ends_as(EndKind::period_halved)) drop_same(i);
        if (i == 0 && on.branch().ends_as(EndKind::closed) && branches_.size() > 1) {
          branches_.erase(branches_.begin() + 1);
        }
        add_switched(i);
        added(points_);
      }
    }
    return true;
  }

 private:
  std::shared_ptr<const Scene> scene(double value) const { return parameters_.scene(value); }

  /// A branch that ends on another one would be walked again from there.
  void drop_same(std::size_t number) {
    const Branch& done = branches_[number].branch;
    const double u = done.points.back().value;
    for (std::size_t i = number + 1; i < branches_.size(); ++i) {
      const TracedBranch& b = branches_[i];
      if (b.parent == branches_[number].parent && b.branch.period == done.period &&
          b.branch.points.size() == 1 &&
          std::abs(b.branch.points[0].value - u) < same_place * options_.range()) {
        branches_.erase(branches_.begin() + static_cast<std::ptrdiff_t>(i));
        return;
      }
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

  /// Unknowns of harmonic balance for the orbit near a start.
  Vec series_of(const Vec& start, int harmonics) {
    const ContactOrbit found = find_harmonic_orbit(
        first_->contacts, start, {.period = options_.period, .harmonics = harmonics});
    if (!found.orbit.is_good()) {
      throw NumericalError(
          fmt::format("at the first value, {:g}: {}", options_.first, found.orbit.failure));
    }
    const Vec unknowns = harmonic_unknowns(found.orbit, first_->contacts.length_scale());
    if (unknowns.size() == 0) {
      throw NumericalError(
          "harmonic balance: without contacts or films there is one motion for each value, which "
          "whirl unbalance has");
    }
    set_harmonics(found.orbit.harmonics());
    return unknowns;
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

  BranchEquations equations() const {
    if (method_ == OrbitMethod::harmonic_balance) {
      return harmonic_equations([this](double value) { return problem_at(value); }, options_.period,
                                layout_.harmonics, first_->contacts.length_scale());
    }
    return layout_.is_rotating ? cycle_equations(free_flow_at(), layout_.scale)
                               : shooting_equations(flow_at(), layout_.scale);
  }

  /// State at phase 0, and what the orbit does.
  void measure(TracedBranch& branch, const BranchPoint& point) const {
    const auto at = scene(point.value);
    const BasisChange change(*at, *first_);
    std::vector<Point> places;
    for (const NamedPoint& p : stations_) places.push_back(p.point);
    OrbitMeasure found;
    if (method_ == OrbitMethod::harmonic_balance) {
      const HarmonicOrbit orbit =
          orbit_of_unknowns(harmonic_problem(at->contacts), point.z.head(point.z.size() - 1),
                            options_.period, first_->contacts.length_scale());
      found = measure_orbit(*at, places, orbit.motion);
      branch.starts.emplace_back(change.back(orbit.state()));
    } else {
      // the state in the basis of this value; in most cases the first one's
      branch.starts.push_back(point.state(layout_.scale));
      found = measure_orbit(*at, places, change.to(branch.starts.back()),
                            layout_.period(branch.branch, point));
    }
    if (layout_.is_rotating) found.sections.resize(found.sections.rows(), 0);
    branch.measures.push_back(std::move(found));
  }

  OrbitMethod method_;
  const BranchParameters& parameters_;
  std::shared_ptr<const Scene> first_;
  std::vector<NamedPoint> stations_;
  ContinuationOptions options_;
  int generations_;
  BranchLayout layout_;
  std::vector<TracedBranch> branches_;
  std::size_t points_ = 0;
};

Record points_record(const std::vector<TracedBranch>& branches, const BranchLayout& layout) {
  Record list = Record::array();
  for (std::size_t k = 0; k < branches.size(); ++k) {
    for (std::size_t i = 0; i < branches[k].branch.points.size(); ++i) {
      const BranchPoint& p = branches[k].branch.points[i];
      const auto& [radii, work, sections] = branches[k].measures[i];
      const double period = layout.period(branches[k].branch, p);
      Record r, duty = Record::array(), impacts = Record::array(), normal = Record::array(),
                floquet = Record::array();
      for (const ContactMeasure& c : p.contacts) {
        duty.add(c.duty);
        impacts.add(c.impacts / period);
        normal.add(c.max_normal);
      }
      for (const Complex& m : p.multipliers) floquet.add(m);
      r.set("value", p.value).set("branch", static_cast<int>(k) + 1).set("period_revs", period);
      r.set("amplitude_m", radii.empty() ? Record(nullptr) : Record(radii[0]));
      r.set("work_j", work);
      r.set("stable", p.multipliers.size() == 0 ? Record(nullptr) : Record(p.is_stable()));
      r.set("duty", duty).set("impacts_per_rev", impacts).set("max_normal_n", normal);
      r.set("floquet", floquet);
      list.add(r);
    }
  }
  return list;
}

std::string period_text(const Branch& branch, const BranchLayout& layout) {
  double least = layout.period(branch, branch.points.front()), most = least;
  for (const BranchPoint& p : branch.points) {
    least = std::min(least, layout.period(branch, p));
    most = std::max(most, layout.period(branch, p));
  }
  return least == most ? fmt::format("{:.6g}", least)
                       : fmt::format("{:.6g} to {:.6g}", least, most);
}

std::string branches_text(const std::vector<TracedBranch>& branches, const BranchLayout& layout,
                          const BranchParameters& parameters) {
  std::string text;
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const Branch& b = branches[k].branch;
    const auto stable = std::count_if(b.points.begin(), b.points.end(), [](const BranchPoint& p) {
      return p.multipliers.size() > 0 && p.is_stable();
    });
    text += fmt::format(
        "\n  branch {}: period {}, {} points, {} of them stable; from {:.8g} to {:.8g}{}\n  it "
        "ends: {}\n",
        k + 1, period_text(b, layout), b.points.size(), stable, b.points.front().value,
        b.points.back().value,
        branches[k].parent > 0 ? fmt::format("; begins on branch {}", branches[k].parent) : "",
        b.end ? b.end->text : "not yet");
    if (b.bifurcations.empty()) continue;
    const std::string unit =
        parameters.along.axis.unit.empty() ? "" : " [" + parameters.along.axis.unit + "]";
    Table table({"bifurcation", parameters.along.axis.path + unit, "after point", "multiplier"});
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

Report run_continue(const Invocation& call) {
  const Model model = call.model();
  const bool is_rotating = is_rotating_frame(call);
  if (is_rotating && (call.has("switch") || call.has("period"))) {
    throw ModelError({"--frame rotating"}, "", "expected neither --period nor --switch beside it");
  }
  const BranchParameters parameters = branch_parameters(call, model);
  if (is_rotating && parameters.across) {
    throw ModelError({"--frame rotating"}, "", "expected one --over beside it");
  }
  ContinuationOptions options = parameters.along.range.options(parameters.along.range.direction);
  options.period = static_cast<int>(call.integer("period"));
  options.most_points = static_cast<int>(call.integer("most"));
  const int generations = static_cast<int>(call.integer("switch", 0));
  const OrbitMethod method = orbit_method(call);
  const bool is_series = method == OrbitMethod::harmonic_balance;
  if (is_series && (generations > 0 || parameters.across || is_rotating)) {
    throw ModelError({generations > 0 ? "--switch"
                      : is_rotating   ? "--frame rotating"
                                      : "--over"},
                     "", "goes with --method shooting only");
  }
  const int harmonics = harmonics_of(call, options.period);

  const Model at_first = parameters.model(parameters.along.range.first);
  const auto first = std::make_shared<const Scene>(make_scene(at_first));
  Tracing tracing(parameters, first,
                  select_points(at_first, first->assembler, call.text("stations")), options,
                  generations, method, is_rotating);
  Borders borders(parameters, first, tracing.layout(), options.most_points);
  const std::optional<EarlierEnd> start = earlier_start(call, model);
  StudyFile file(
      call, start,
      [&] {
        auto made = call.result_file(model);
        write_start(*made, start);
        return made;
      },
      [&](ResultWriter& to) {
        write_branches(to, tracing.layout(), tracing.branches(), tracing.is_complete());
        write_fixed(to, parameters);
        borders.write(to);
      },
      [&](const ResultReader& earlier) {
        if (is_series) tracing.set_harmonics(harmonics_in(earlier));
        tracing.branches() = read_branches(earlier, tracing.layout());
        borders.read(earlier);
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
    install_interrupt_handler();
    Progress progress("points of branches", options.most_points, call.shows_progress);
    try {
      if (!tracing.walk([&](std::size_t points) {
            progress.update(static_cast<long>(points));
            file.save_if_due();
          }) ||
          !borders.walk(tracing.branches(), [&](std::size_t points) {
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
  note_tables(call, model, report);
  Record list = Record::array();
  for (const TracedBranch& b : branches) {
    Record r;
    r.set("period_revs", b.branch.period);
    r.set("parent", b.parent > 0 ? Record(b.parent) : Record(nullptr))
        .set("end", b.branch.end_text());
    r.set("end_kind", b.branch.end ? Record(name_of(b.branch.end->kind)) : Record(nullptr));
    list.add(r);
  }
  Record& r = report.record;
  r.set("parameter", parameters.along.axis.path).set("unit", parameters.along.axis.unit);
  r.set("method", call.text("method"));
  if (is_series) r.set("harmonics", tracing.layout().harmonics);
  r.set("branches", list).set("points", points_record(branches, tracing.layout()));
  r.set("bifurcations", bifurcations_record(branches)).set("resumed", static_cast<long>(resumed));
  report.text = "Periodic orbits along " + parameters.along.axis.path +
                (model.title.empty() ? "" : ": " + model.title) + "\n" +
                (is_series ? fmt::format("  by harmonic balance with {} harmonics\n",
                                         tracing.layout().harmonics)
                           : "") +
                branches_text(branches, tracing.layout(), parameters);
  if (parameters.across) {
    r.set("borders", borders.record());
    report.text += borders.text();
  }
  if (resumed > 0) report.text += fmt::format("\n  {} points were there already\n", resumed);
  if (status == 130) {
    report.text +=
        fmt::format("\n  stopped{}\n", call.has("out") ? "; the same line goes on from there" : "");
  }
  if (call.has("out")) report.text += fmt::format("\n  result: {}\n", call.given.at("out"));
  return report;
}

}  // namespace

Verb continue_verb() {
  return {
      .name = "continue",
      .group = "Contact",
      .summary =
          "a branch of periodic orbits along a parameter, round its folds, with its bifurcations",
      .example =
          "whirl continue models/jeffcott_stator.toml --speed 138.4rad/s --set "
          "contact.ring.stiffness=64e6 --over contact.ring.friction=0.1:0.15:0.002 --at 0.15",
      .options = {{"over", "PATH=A:B:STEP",
                   "a value of the model, from where to where, and the largest step; first:last: a "
                   "hundredth; a second one: borders in the plane of both"},
                  branch_points_option,
                  {"at", "VALUE[,VALUE]",
                   "where the first orbit is looked for, between first and last; left out: first"},
                  {"period", "N", "revolutions after which the first orbit repeats", "1"},
                  frame_option,
                  orbit_method_option,
                  harmonics_option,
                  {"switch", "N",
                   "generations of branches that begin at period doublings and pitchforks", "0"},
                  {"most", "N", "points of a branch at most", "2000"},
                  {"stations", "NAME,...",
                   "whose amplitude is said: names, node numbers, all; left out: as sweep"},
                  branch_discard_option,
                  tolerance_option,
                  from_option,
                  restart_option},
      .run = run_continue,
  };
}

}  // namespace whirl
