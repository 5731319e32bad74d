#pragma once
/// The machine of a lateral analysis: its rotor without unbalance, journals, probes and cases of
/// unbalance. For lateral_report.cpp and lateral_stability.cpp.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libfe/analyses/unbalance.hpp"

namespace whirl::inline dyn {

constexpr double first_lateral_speed = 0.1;  ///< of responses, over the maximum continuous one
constexpr double last_lateral_speed = 1.5;   ///< likewise, and of modes that are excited

/// Ascending, each once.
inline void sort_out(std::vector<double>& speeds) {
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
}

/// What all parts of the report ask of a model.
struct Lateral {
  const Model& model;
  LateralOptions options;
  Structure structure;  ///< linear, without unbalance and bow
  Assembler assembler;
  std::vector<Journal> journals;
  std::vector<NamedPoint> probes;

  Lateral(const Model& given, const LateralOptions& how)
      : model(given), options(how), structure(bare(given)), assembler(structure) {
    if (structure.shaft.empty()) throw ModelError({}, "shaft", "a lateral analysis needs a shaft");
    if (!structure.rotors.empty()) {
      throw ModelError(structure.rotors.front().where, "rotor." + structure.rotors.front().name,
                       "the rules of a lateral analysis are those of one shaft; see modes, "
                       "campbell, critical and unbalance");
    }
    journals = journals_of(model, assembler, options.range.maximum);
    if (journals.empty()) {
      throw ModelError({}, "bearing",
                       "a lateral analysis needs a bearing or an oil film on the shaft");
    }
    probes = at_probes();
    if (probes.empty()) probes = at_journals();
  }

  static Structure bare(const Model& model) {
    Structure s = linear_structure(model);
    for (const Unbalance& u : s.unbalances)
      s.stations.push_back(u.at);  // nodes stay where they are
    s.unbalances.clear();
    s.bow = {};
    return s;
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
      if (std::any_of(journals.begin(), journals.end(),
                      [&](const Journal& j) { return j.node + 1 == p.node(); })) {
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

  /// The node nearest to the middle between the outermost journals, from 0.
  int middle_node() const {
    const double middle = 0.5 * (journals.front().z + journals.back().z);
    const std::vector<double>& z = assembler.mesh().z;
    const auto nearest = std::min_element(z.begin(), z.end(), [&](double a, double b) {
      return std::abs(a - middle) < std::abs(b - middle);
    });
    return static_cast<int>(nearest - z.begin());
  }

  /// The rotor with the unbalance of a case.
  Assembler unbalanced(const UnbalanceCase& of) const {
    Structure s = structure;
    for (const UnbalancePlane& p : of.planes) {
      s.unbalances.push_back({.at = {.kind = Station::Kind::node, .node = p.node + 1},
                              .moment = p.moment,
                              .phase = p.phase});
    }
    return Assembler(s);
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
  int first_case = 0;                   ///< number of its first case in the report
  std::vector<Assembler> unbalanced{};  ///< for each of its cases
  Campbell campbell{};
  std::vector<std::vector<double>> speeds{};  ///< that the curve of each needs
};

/// A check of something that should be at least, or at most, so much.
inline Verdict verdict_of(double found, double limit, bool is_least) {
  if (std::isnan(found) || !std::isfinite(limit)) return Verdict::unknown;
  return (is_least ? found >= limit : found <= limit) ? Verdict::passed : Verdict::failed;
}

/// Adds what level I and level II find of a machine.
/// @param is_first  whether it is the model itself
void add_stability(const Machine& machine, bool is_first, LateralStudy& study);

}  // namespace whirl::inline dyn
