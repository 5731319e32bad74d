#include "libio/measured/balancing_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/model_facts.hpp"
#include "libio/measured/balancing_parts.hpp"
#include "libio/model/file_text.hpp"
#include "libio/model/model_builder.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

constexpr double same_speed = 0.01;  ///< of runs that are at one speed

bool has_readings_by_hand(const ConfigNode& root) {
  const ConfigNode* runs = root.find("run");
  return runs && std::any_of(runs->items.begin(), runs->items.end(),
                             [](const ConfigNode& run) { return run.find("readings"); });
}

BalancingConvention read_convention(TableReader& top, const ConfigNode& root) {
  BalancingConvention convention;
  if (const auto phase = top.choice<PhaseSense>("phase")) convention.phase = *phase;
  if (const auto angles = top.choice<AngleSense>("angles")) convention.angles = *angles;
  if (const auto a = top.choice<AmplitudeMeasure>("amplitudes")) convention.amplitudes = *a;
  // nobody can know what others mean by a phase
  if (!top.has("phase") && has_readings_by_hand(root)) {
    top.missing("phase",
                "whether phases of readings lead the mark or lag behind it, \"lead\" or "
                "\"lag\"");
  }
  if (!top.has("angles")) {
    top.missing("angles",
                "in which direction angles of weights count from the mark, \"with "
                "rotation\" or \"against rotation\"");
  }
  return convention;
}

/// A grade, "G2.5" or "2.5 mm/s".
std::optional<double> read_quality(TableReader& table) {
  const ConfigNode* node = table.node("grade");
  if (node && node->kind == ConfigNode::Kind::string && node->text.starts_with("G")) {
    const auto value = parse_as(node->text.substr(1) + " mm/s", "m/s");
    if (value && *value > 0.0) return *value;
    table.problem("grade",
                  fmt::format("found {}, expected a grade such as \"G2.5\"", node->as_written()));
    return std::nullopt;
  }
  return table.quantity("grade", "m/s", Range::positive, true);
}

std::optional<RotorGrade> read_rotor(const ConfigNode& root, const Model& model,
                                     std::vector<Problem>& problems) {
  const ConfigNode* node = root.find("rotor");
  if (!node) return std::nullopt;
  TableReader table(node, "rotor", problems);
  RotorGrade found;
  const auto grade = read_quality(table);
  const auto mass = table.quantity("mass", "kg", Range::positive);
  const auto speed = table.quantity("speed", "rad/s", Range::positive);
  const auto center = table.quantity("center", "m", Range::any);
  if (!speed && !(model.speed > 0.0)) table.missing("speed", "the highest speed of the rotor");
  table.finish();
  if (!grade || !problems.empty()) return std::nullopt;
  const ModelFacts facts = model_facts(model, Assembler(linear_structure(model)));
  found.grade = *grade;
  found.mass = mass.value_or(facts.mass);
  found.speed = speed.value_or(model.speed);
  found.center = center ? center : facts.center_of_mass;
  return found;
}

/// The model with a node at every plane and probe that has a station.
struct PlacedModel {
  Model model;
  std::vector<std::optional<std::size_t>> planes;  ///< their unbalances in the model
};

PlacedModel placed(const Model& model, const balancing::Planes& planes,
                   const balancing::Probes& probes) {
  ConfigNode root = parse_toml(model.source, model.path);
  ConfigNode* list = root.find("unbalance");
  if (!list) {
    ConfigNode none;
    none.kind = ConfigNode::Kind::array;
    root.entries.push_back({"unbalance", none});
    list = &root.entries.back().value;
  }
  PlacedModel found{model, {}};
  std::size_t count = 0;
  for (const auto& station : planes.stations) {
    if (station) list->items.push_back(*station);
    count += station.has_value();
  }
  if (count > 0) {
    try {
      const auto folder = std::filesystem::path(model.path).parent_path();
      found.model = ModelBuilder(root, NamedFiles::none_in(folder)).build();
    } catch (const ModelError& error) {
      std::vector<Problem> problems = error.problems();
      for (Problem& p : problems) {
        if (p.key.starts_with("unbalance.")) p.key = "plane" + p.key.substr(9);
      }
      throw ModelError(std::move(problems));
    }
    found.model.speed = model.speed;
    found.model.has_speed = model.has_speed;
  }
  std::size_t next = found.model.structure.unbalances.size() - count;
  for (const auto& station : planes.stations) {
    found.planes.push_back(station ? std::optional(next++) : std::nullopt);
  }
  if (probes.setup) {
    found.model.structure.probes.clear();
    for (const MeasuredProbe& p : probes.setup->probes) {
      found.model.structure.probes.push_back(p.probe);
    }
  }
  return found;
}

/// Places along the shaft, of planes on it.
void find_places(const PlacedModel& at, std::vector<BalancingPlane>& planes) {
  const Assembler assembler(linear_structure(at.model));
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (!at.planes[k]) continue;
    const Point point = assembler.point(at.model.structure.unbalances[*at.planes[k]].at);
    if (const auto z = assembler.mesh().position_of(point)) planes[k].z = *z;
  }
}

/// Runs at each of their speeds, readings of all speeds one after the other.
void arrange(const std::vector<balancing::Run>& runs, BalancingInput& input) {
  std::vector<double> speeds;
  std::vector<std::size_t> speed_of;
  for (const balancing::Run& run : runs) {
    const auto known = std::find_if(speeds.begin(), speeds.end(), [&](double speed) {
      return std::abs(run.speed / speed - 1.0) < same_speed;
    });
    speed_of.push_back(static_cast<std::size_t>(known - speeds.begin()));
    if (known == speeds.end()) speeds.push_back(run.speed);
  }
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    for (std::size_t p = 0; p < input.probes.size(); ++p) {
      bool is_read = false;
      for (std::size_t r = 0; r < runs.size(); ++r) {
        is_read |=
            speed_of[r] == s && !std::isnan(runs[r].readings(static_cast<Eigen::Index>(p)).real());
      }
      if (is_read) input.places.push_back({p, speeds[s]});
    }
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    BalancingRun run{runs[r].name, runs[r].weights, CVec(std::ssize(input.places))};
    for (std::size_t j = 0; j < input.places.size(); ++j) {
      const bool is_here = speeds[speed_of[r]] == input.places[j].speed;
      run.readings(static_cast<Eigen::Index>(j)) =
          is_here ? runs[r].readings(static_cast<Eigen::Index>(input.places[j].probe))
                  : Complex(nan, nan);
    }
    input.runs.push_back(std::move(run));
  }
}

/// Coefficients of the model, and where there are no runs its own vibration in place of one.
void take_from_model(const PlacedModel& at, const balancing::Probes& probes,
                     const BalancingAsked& asked, BalancingCase& found) {
  BalancingInput& input = found.input;
  std::vector<Problem> problems;
  for (std::size_t k = 0; k < input.planes.size(); ++k) {
    const std::string key = "plane." + input.planes[k].name;
    if (!at.planes[k]) problems.push_back({{}, key, "coefficients of the model need its station"});
    if (!(input.planes[k].radius > 0.0)) {
      problems.push_back({{}, key, "coefficients of the model need its radius"});
    }
  }
  if (!probes.setup) {
    problems.push_back({{}, "probe", "coefficients of the model need a station of every probe"});
  }
  if (input.runs.empty() && asked.speeds.empty()) {
    problems.push_back({{}, "run", "missing, and the model has no speed to be balanced at"});
  }
  if (!problems.empty()) throw ModelError(std::move(problems));
  const bool is_model_alone = input.runs.empty();
  if (is_model_alone) {
    for (const double speed : asked.speeds) {
      for (std::size_t p = 0; p < input.probes.size(); ++p) input.places.push_back({p, speed});
    }
  }
  std::vector<std::size_t> planes;
  for (const auto& plane : at.planes) planes.push_back(*plane);
  ModelInfluence influence =
      model_influence(at.model, planes, at.model.structure.probes, input.places);
  if (!influence.touched.empty()) {
    const std::string what = fmt::format(
        "the rotor touches {}: its vibration does not follow its unbalance linearly there",
        fmt::join(influence.touched, ", "));
    if (!asked.accepts_nonlinear) throw OptionError(what);
    found.notes.push_back(what);
  }
  for (std::size_t k = 0; k < planes.size(); ++k) {
    influence.coefficients.col(static_cast<Eigen::Index>(k)) *= input.planes[k].radius;
  }
  input.coefficients = std::move(influence.coefficients);
  if (is_model_alone) {
    input.runs.push_back({"model", CVec::Zero(std::ssize(planes)), influence.vibration});
  }
}

/// What goes for every probe that says nothing else.
void read_common_demands(TableReader& top, const BalancingConvention& convention,
                         std::vector<BalancingProbe>& probes) {
  top.node("allowed");
  top.node("uncertainty");
  for (BalancingProbe& probe : probes) {
    for (const auto& [key, member] : {std::pair{"allowed", &BalancingProbe::allowed},
                                      {"uncertainty", &BalancingProbe::uncertainty}}) {
      if (probe.*member > 0.0) continue;
      probe.*member = balancing::read_amplitude(top, key, probe, convention).value_or(0.0);
    }
  }
}

/// Readings of different kinds have no common size.
void require_weights(const ConfigNode& root, const std::vector<BalancingProbe>& probes,
                     std::vector<Problem>& problems) {
  for (std::size_t p = 1; p < probes.size(); ++p) {
    if (probes[p].si_unit == probes[0].si_unit) continue;
    for (const ConfigNode& item : root.find("probe")->items) {
      if (item.find("weight")) continue;
      problems.push_back({item.where, "probe",
                          "probes measure different things: give each a weight, such as one over "
                          "its largest reading in SI units"});
    }
    return;
  }
}

ConfigNode probe_tree_of(const std::filesystem::path& file) {
  return parse_toml(file_text(file), file.string());
}

}  // namespace

BalancingCase parse_balancing_file(const std::string& text, const std::filesystem::path& path,
                                   const Model& model, const BalancingAsked& asked) {
  const ConfigNode root = parse_toml(text, path.string());
  std::vector<Problem> problems;
  BalancingCase found;
  BalancingInput& input = found.input;
  TableReader top(&root, "", problems);
  input.convention = read_convention(top, root);
  for (const char* key : {"plane", "probe", "run", "rotor", "keyphasor", "full_scale"}) {
    top.node(key);
  }
  const auto probe_file = top.string("probes");
  if (probe_file && root.find("probe")) {
    top.problem("probes", "found both, expected one of probes and [[probe]] tables");
  }
  const ConfigNode probe_root = probe_file ? probe_tree_of(path.parent_path() / *probe_file) : root;
  balancing::Planes planes = balancing::read_planes(root, input.convention, problems);
  balancing::Probes probes = balancing::read_probes(probe_root, model, input.convention, problems);
  read_common_demands(top, input.convention, probes.probes);
  top.finish();
  require_weights(probe_root, probes.probes, problems);
  balancing::Runs runs =
      balancing::read_runs(root, planes, probes, input.convention, path.parent_path(),
                           asked.accepts_nonlinear, problems);
  input.grade = read_rotor(root, model, problems);
  if (!problems.empty()) throw ModelError(std::move(problems));
  const PlacedModel at = placed(model, planes, probes);
  find_places(at, planes.planes);
  input.planes = std::move(planes.planes);
  input.probes = probes.probes;
  input.kept = std::move(runs.kept);
  input.criterion = asked.criterion;
  input.accepts_nonlinear = asked.accepts_nonlinear;
  found.notes = std::move(runs.notes);
  arrange(runs.runs, input);
  const bool has_weights = std::any_of(runs.runs.begin(), runs.runs.end(),
                                       [](const auto& run) { return !run.weights.isZero(0.0); });
  const auto source =
      asked.coefficients.value_or(has_weights ? CoefficientSource::runs : CoefficientSource::model);
  if (source == CoefficientSource::model) {
    take_from_model(at, probes, asked, found);
  } else if (input.runs.empty()) {
    throw ModelError(root.where, "run", "missing, expected [[run]] tables with trial weights");
  }
  return found;
}

BalancingCase read_balancing_file(const std::filesystem::path& path, const Model& model,
                                  const BalancingAsked& asked) {
  return parse_balancing_file(file_text(path), path, model, asked);
}

}  // namespace whirl::inline io
