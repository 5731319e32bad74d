#pragma once
/// The machine of a lateral analysis: its rotor without unbalance, shafts, journals, probes and
/// cases of unbalance. For lateral_report.cpp and lateral_stability.cpp.

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libfe/lateral/lateral_rules.hpp"
#include "libfe/lateral/turning_shaft.hpp"

namespace whirl::inline dyn {

constexpr double first_lateral_speed = 0.1;  ///< of responses, over the maximum continuous one
constexpr double last_lateral_speed = 1.5;   ///< likewise, and of modes that are excited

/// Ascending, each once.
inline void sort_out(std::vector<double>& speeds) {
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
}

/// A shaft that turns and that journals carry: the rules are asked of each for itself.
struct JournaledShaft {
  TurningShaft of;
  std::string name{};               ///< "shaft": the first of several; empty: there is one
  std::vector<Journal> journals{};  ///< left to right

  /// Largest continuous speed of its own [rad/s].
  double maximum(const OperatingRange& range) const { return of.order() * range.maximum; }
};

/// The rotor with the unbalance of a case.
struct UnbalancedRotor {
  Assembler assembler;
  std::size_t shaft = 0;  ///< on which it is, of Lateral::shafts
  /// The load, where it has another frequency than the speed; nothing: all that has that.
  std::optional<Excitation> load{};

  const Excitation* load_or_null() const { return load ? &*load : nullptr; }
};

/// What all parts of the report ask of a model.
struct Lateral {
  const Model& model;
  LateralOptions options;
  Structure structure;  ///< linear, without unbalance and bow
  Assembler assembler;
  std::vector<JournaledShaft> shafts;
  std::vector<NamedPoint> probes;

  Lateral(const Model& given, const LateralOptions& how)
      : model(given), options(how), structure(bare(given)), assembler(structure) {
    if (structure.shaft.empty()) throw ModelError({}, "shaft", "a lateral analysis needs a shaft");
    if (const Rotor* own = structure.rotor_of_own_speed()) {
      throw ModelError(own->where, "rotor." + own->name,
                       "it has a speed of its own, and the margins, limits and responses of a "
                       "lateral analysis go by shafts of constant ratios; expected a ratio, or see "
                       "campbell and unbalance");
    }
    shafts = journaled_shafts();
    if (shafts.empty()) {
      throw ModelError({}, "bearing",
                       "a lateral analysis needs a bearing or an oil film on the shaft");
    }
    if (!std::ranges::any_of(shafts, [&](const JournaledShaft& s) { return is_coupled(s); })) {
      throw ModelError({}, "bearing",
                       "the shaft that cross-coupled stiffness is expected on needs a bearing or "
                       "an oil film");
    }
    probes = at_probes();
    if (probes.empty()) probes = at_journals();
  }

  static Structure bare(const Model& model) {
    Structure s = linear_structure(model);
    for (const Unbalance& u : s.unbalances)
      s.stations.push_back(u.at);  // nodes stay where they are
    s.unbalances.clear();
    s.straighten();
    return s;
  }

  /// Those of a machine that has several are named.
  std::vector<JournaledShaft> journaled_shafts() const {
    const std::vector<Journal> journals = journals_of(model, assembler, options.range.maximum);
    const bool has_several = has_several_shafts(assembler.mesh());
    std::vector<JournaledShaft> all;
    int number = 0;
    for (const Structure::Shaft& shaft : structure.shafts()) {
      JournaledShaft own{.of = {number, shaft.ratio}};
      if (has_several) own.name = shaft.name.empty() ? "shaft" : shaft.name;
      std::ranges::copy_if(journals, std::back_inserter(own.journals),
                           [&](const Journal& j) { return j.shaft == number; });
      if (shaft.ratio != 0.0 && !own.journals.empty()) all.push_back(std::move(own));
      ++number;
    }
    return all;
  }

  bool has_several() const { return !shafts.front().name.empty(); }

  /// Whether Q_A, where it is told, acts on a shaft.
  bool is_coupled(const JournaledShaft& shaft) const {
    return shaft.name.empty() || shaft.of.number == options.coupled_shaft;
  }

  /// Name of the shaft that a point is on; empty: there is one, or it is on none that is looked at.
  std::string shaft_at(const Point& point) const {
    const JournaledShaft* shaft = found_at(point);
    return shaft ? shaft->name : "";
  }

  /// Vibration that is allowed at a probe, by the speed of its own shaft [m].
  double vibration_limit_at(const Point& point) const {
    const JournaledShaft* shaft = found_at(point);
    return vibration_limit(shaft ? shaft->maximum(options.range) : options.range.maximum);
  }

  const JournaledShaft* found_at(const Point& point) const {
    if (point.kind != Point::Kind::node) return nullptr;
    const auto found = std::ranges::find_if(shafts, [&](const JournaledShaft& s) {
      return s.of.has_node(point.index, assembler.mesh());
    });
    return found == shafts.end() ? nullptr : &*found;
  }

  /// Stations with a probe of the model across the shaft, each once; vibration is told along the
  /// major axis there.
  std::vector<NamedPoint> at_probes() const {
    std::vector<NamedPoint> all;
    for (const NamedPoint& p : named_points(model, assembler)) {
      if (std::any_of(structure.probes.begin(), structure.probes.end(), [&](const Probe& probe) {
            return !probe.is_axial() && assembler.point(probe.at) == p.point;
          })) {
        all.push_back(p);
      }
    }
    return all;
  }

  std::vector<NamedPoint> at_journals() const {
    std::vector<NamedPoint> all;
    for (const NamedPoint& p : named_points(model, assembler)) {
      const auto is_here = [&](const Journal& j) { return j.node + 1 == p.node(); };
      if (std::ranges::any_of(shafts, [&](const JournaledShaft& s) {
            return std::ranges::any_of(s.journals, is_here);
          })) {
        all.push_back(p);
      }
    }
    return all;
  }

  /// The unit that all probes of the model have; empty: they have several, or none but um.
  std::string probe_unit() const {
    const std::vector<Probe>& all = structure.probes;
    const bool is_one = std::all_of(all.begin(), all.end(),
                                    [&](const Probe& p) { return p.unit == all.front().unit; });
    return all.empty() || !is_one || all.front().unit == Probe{}.unit ? "" : all.front().unit;
  }

  std::vector<Point> points() const {
    std::vector<Point> all;
    for (const NamedPoint& p : probes) all.push_back(p.point);
    return all;
  }

  std::string label_of(int node) const {
    for (const NamedPoint& p : named_points(model, assembler)) {
      if (p.node() == node + 1) return p.label();
    }
    return std::to_string(node + 1);
  }

  /// The node of a shaft nearest to the middle between its outermost journals, from 0.
  int middle_node(const JournaledShaft& shaft) const {
    const double middle = 0.5 * (shaft.journals.front().z + shaft.journals.back().z);
    int nearest = shaft.journals.front().node;
    double least = INFINITY;
    for (int node = 0; node < assembler.mesh().nodes(); ++node) {
      if (!shaft.of.has_node(node, assembler.mesh())) continue;
      const double away = std::abs(assembler.mesh().z[static_cast<std::size_t>(node)] - middle);
      if (away < least) least = away, nearest = node;
    }
    return nearest;
  }

  /// The rotor with the unbalance of a case.
  /// @param shaft  number of its shaft among shafts
  UnbalancedRotor unbalanced(const UnbalanceCase& of, std::size_t shaft) const {
    Structure s = structure;
    for (const UnbalancePlane& p : of.planes) {
      s.unbalances.push_back({.at = {.kind = Station::Kind::node, .node = p.node + 1},
                              .moment = p.moment,
                              .phase = p.phase});
    }
    UnbalancedRotor rotor{Assembler(s), shaft};
    if (shafts[shaft].of.order() == 1.0) return rotor;
    for (const Excitation& e : other_excitations(rotor.assembler)) {
      if (e.growth == Growth::unbalance) rotor.load = e;
    }
    return rotor;
  }

  /// Speeds that every response goes through.
  std::vector<double> landmarks() const {
    const OperatingRange& r = options.range;
    std::vector<double> all{first_lateral_speed * r.maximum, r.minimum, r.maximum, r.trip,
                            std::max(last_lateral_speed * r.maximum, r.trip)};
    sort_out(all);
    return all;
  }
};

/// The model or a variant of it, with its cases of unbalance.
struct Machine {
  std::string variant;
  Lateral lateral;
  int first_case = 0;                         ///< number of its first case in the report
  std::vector<UnbalancedRotor> unbalanced{};  ///< for each of its cases
  Campbell campbell{};
  std::vector<std::vector<double>> speeds{};  ///< that the curve of each needs
};

/// What the cases of unbalance of one shaft come to, of the model and its variants.
struct ShaftCurves {
  std::vector<double> speeds{};     ///< that their responses go through [rad/s]
  std::vector<double> unbounded{};  ///< their undamped resonances [rad/s]
};
/// By the number of the shaft.
using CurvesOfShafts = std::map<int, ShaftCurves>;

/// A check of something that should be at least, or at most, so much.
inline Verdict verdict_of(double found, double limit, bool is_least) {
  if (std::isnan(found) || !std::isfinite(limit)) return Verdict::unknown;
  return (is_least ? found >= limit : found <= limit) ? Verdict::passed : Verdict::failed;
}

/// Adds what level I and level II find of the shafts of a machine.
/// @param is_first  whether it is the model itself
void add_stability(const Machine& machine, bool is_first, LateralStudy& study);

}  // namespace whirl::inline dyn
