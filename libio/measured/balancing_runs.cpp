#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libbase/numerics/constants.hpp"
#include "libdata/balancing/run_readings.hpp"
#include "libio/measured/balancing_parts.hpp"
#include "libio/measured/record_file.hpp"

namespace whirl::inline io::balancing {

namespace {

/// The number of a name in a list; what there is, where it is not there.
template <class List>
std::optional<Eigen::Index> named_in(TableReader& table, const char* key, const List& list) {
  const auto name = table.string(key, true);
  if (!name) return std::nullopt;
  std::vector<std::string> known;
  for (const auto& item : list) {
    if (item.name == *name) return std::ssize(known);
    known.push_back(item.name);
  }
  table.unknown_choice(key, *name, known);
  return std::nullopt;
}

/// Calls f(reader) for every table of a list at a key.
template <class F>
void each_table(TableReader& table, const char* key, std::vector<Problem>& problems, const F& f) {
  const ConfigNode* list = table.node(key);
  if (!list) return;
  if (list->kind != ConfigNode::Kind::array) {
    table.problem(key, fmt::format("found {}, expected a list of tables", list->as_written()));
    return;
  }
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    TableReader item(&list->items[i], fmt::format("{}.{}", table.path(key), i + 1), problems);
    f(item);
    item.finish();
  }
}

/// Reads runs one after the other.
class RunReader {
 public:
  RunReader(const Planes& planes, const Probes& probes, const BalancingConvention& convention,
            std::filesystem::path folder, bool accepts, std::vector<Problem>& problems)
      : planes_(planes.planes),
        probes_(probes),
        convention_(convention),
        folder_(std::move(folder)),
        accepts_(accepts),
        problems_(problems) {
    found_.kept = CVec::Zero(std::ssize(planes_));
  }

  void read(const ConfigNode& item, std::size_t number) {
    TableReader table(&item, fmt::format("run.{}", number), problems_);
    Run run{.name = table.string("name").value_or(fmt::format("run {}", number))};
    run.readings = CVec::Constant(std::ssize(probes_.probes), Complex(nan, nan));
    run.is_slow_roll = table.boolean("slow_roll").value_or(false);
    run.speed = table.quantity("speed", "rad/s", Range::positive).value_or(0.0);
    read_weights(table, run);
    const auto rate = table.quantity("rate", "1/s", Range::positive);
    if (table.has("record") == table.has("readings")) {
      table.problem("readings", "expected one of readings and record");
      table.node("record");
      table.node("readings");
    } else if (table.has("record")) {
      read_record_of(table, rate, run);
    } else {
      if (!table.has("speed")) table.missing("speed", "the speed of these readings");
      read_vectors(table, run);
    }
    table.finish();
    found_.runs.push_back(std::move(run));
  }

  Runs take() { return std::move(found_); }

 private:
  void read_weights(TableReader& table, Run& run) {
    run.weights = found_.kept;
    each_table(table, "weights", problems_, [&](TableReader& weight) {
      const auto plane = named_in(weight, "plane", planes_);
      const auto mass = weight.quantity("mass", "kg", Range::nonnegative, true);
      const auto angle = read_angle(weight, "angle", true);
      const bool is_kept = weight.boolean("kept").value_or(false);
      if (!plane || !mass || !angle) return;
      const Complex w = convention_.weight(*mass, *angle);
      run.weights(*plane) += w;
      if (is_kept) found_.kept(*plane) += w;
    });
  }

  void read_vectors(TableReader& table, Run& run) {
    each_table(table, "readings", problems_, [&](TableReader& reading) {
      const auto probe = named_in(reading, "probe", probes_.probes);
      if (!reading.has("amplitude")) reading.missing("amplitude", "what the probe reads");
      const BalancingProbe unknown;
      const auto size = read_amplitude(
          reading, "amplitude", probe ? probes_.probes[static_cast<std::size_t>(*probe)] : unknown,
          convention_);
      const auto phase = read_angle(reading, "phase", true);
      if (!probe || !size || !phase) return;
      if (!std::isnan(run.readings(*probe).real())) {
        reading.problem("probe", "the run has two readings of this probe, expected one");
      }
      // read_amplitude gives the peak, of which the convention takes what is told
      run.readings(*probe) = convention_.reading(*size * convention_.per_peak(), *phase);
    });
  }

  void read_record_of(TableReader& table, std::optional<double> rate, Run& run) {
    const std::string file = table.string("record").value_or("");
    if (!probes_.setup) {
      table.problem("record", "a record needs probes with a station each: at, node or body");
      return;
    }
    try {
      const ProbeReadings readings =
          probe_readings(read_record(folder_ / file, rate), *probes_.setup);
      const RunReadings found = run_readings(readings);
      constexpr double other_speed = 0.01;
      if (run.speed > 0.0 && std::abs(run.speed / found.speed - 1.0) > other_speed) {
        table.problem("speed", fmt::format("the key-phasor of the record says {:.6g} rpm",
                                           found.speed / rpm));
      }
      run.speed = found.speed;
      run.readings = found.vectors;
      for (const std::string& note : readings.notes) {
        found_.notes.push_back(fmt::format("{}: {}", file, note));
      }
      note_rub(table, found.signs_of_rub, run.name);
    } catch (const OptionError& error) {
      table.problem("record", error.problems().front().message);
    }
  }

  void note_rub(TableReader& table, const std::vector<std::string>& signs, const std::string& run) {
    if (signs.empty()) return;
    const std::string what = fmt::format(
        "{}: as of a rotor that rubs, whose vibration does not follow its weights linearly",
        fmt::join(signs, ", "));
    if (accepts_) {
      found_.notes.push_back(fmt::format("{}: {}", run, what));
    } else {
      table.problem("record", what);
    }
  }

  const std::vector<BalancingPlane>& planes_;
  const Probes& probes_;
  const BalancingConvention& convention_;
  std::filesystem::path folder_;
  bool accepts_;
  std::vector<Problem>& problems_;
  Runs found_{};
};

/// Takes readings of a slow roll off all others.
void take_slow_roll_off(std::vector<Run>& runs) {
  const auto slow = std::find_if(runs.begin(), runs.end(), [](auto& r) { return r.is_slow_roll; });
  if (slow == runs.end()) return;
  const CVec runout = slow->readings;
  runs.erase(slow);
  for (Run& run : runs) {
    for (Eigen::Index p = 0; p < runout.size(); ++p) {
      if (!std::isnan(runout(p).real())) run.readings(p) -= runout(p);
    }
  }
}

}  // namespace

Runs read_runs(const ConfigNode& root, const Planes& planes, const Probes& probes,
               const BalancingConvention& convention, const std::filesystem::path& folder,
               bool accepts, std::vector<Problem>& problems) {
  RunReader reader(planes, probes, convention, folder, accepts, problems);
  if (const ConfigNode* list = root.find("run")) {
    if (list->kind != ConfigNode::Kind::array) {
      problems.push_back({list->where, "run", "expected [[run]] tables"});
      return reader.take();
    }
    for (std::size_t i = 0; i < list->items.size(); ++i) reader.read(list->items[i], i + 1);
  }
  Runs found = reader.take();
  take_slow_roll_off(found.runs);
  return found;
}

}  // namespace whirl::inline io::balancing
