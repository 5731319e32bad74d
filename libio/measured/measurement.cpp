#include "libio/measured/measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/measured/law_file.hpp"
#include "libio/measured/probe_file.hpp"
#include "libio/measured/record_file.hpp"
#include "libio/model/config.hpp"
#include "libio/model/file_text.hpp"
#include "libio/model/model_file.hpp"
#include "libio/model/read_fields.hpp"

namespace whirl::inline io {

namespace {

constexpr double other_speed = 0.01;   ///< of the key-phasor against the one that is given
constexpr double uneven_speed = 0.02;  ///< change of speed that smears lines of the speed
constexpr double far_speed = 3.0;      ///< times the model's, or a part of it, that is a mistake

/// Gives the model the speed of the record, and says what is odd about it.
void take_speed(Model& model, ProbeReadings& readings, bool is_given) {
  if (!readings.clock) {
    require_speed(model);
    if (!is_given) {
      readings.notes.push_back(fmt::format(
          "no key-phasor and no --speed: the record is taken to be at the model's {:.6g} "
          "rpm",
          model.speed / rpm));
    }
    return;
  }
  const double speed = readings.clock->mean_speed();
  if (!is_given && model.has_speed && model.speed > 0.0) {
    const double ratio = speed / model.speed;
    const bool is_double = std::abs(std::max(ratio, 1.0 / ratio) / 2.0 - 1.0) < other_speed;
    if (is_double || ratio > far_speed || ratio < 1.0 / far_speed) {
      readings.notes.push_back(fmt::format(
          "the key-phasor says {:.6g} rpm, the model {:.6g} rpm: are the times or --rate, the edge "
          "and the number of pulses per revolution right?",
          speed / rpm, model.speed / rpm));
    }
  }
  if (is_given && std::abs(model.speed / speed - 1.0) > other_speed) {
    readings.notes.push_back(
        fmt::format("--speed says {:.6g} rpm, the key-phasor {:.6g} rpm, which is taken",
                    model.speed / rpm, speed / rpm));
  }
  if (readings.clock->variation() > uneven_speed) {
    readings.notes.push_back(fmt::format(
        "the speed changes by {:.3g} % in the record: lines of the spectrum are smeared, "
        "and modes are those at its mean",
        100.0 * readings.clock->variation()));
  }
  model.speed = speed;
  model.has_speed = true;
}

/// Readings of a record; what is wrong with it is said of its file.
ProbeReadings readings_of(const SourcedRecord& read, const MeasurementSetup& setup) {
  try {
    return probe_readings(read.record, setup);
  } catch (const OptionError& error) {
    throw ModelError({read.source.file}, "", error.problems().front().message);
  }
}

/// The records of a list, as far as they are right.
class ListReader {
 public:
  ListReader(std::filesystem::path folder, const RecordSource& all)
      : folder_(std::move(folder)), all_(all) {}

  RecordSource source(const ConfigNode& item, std::size_t number, std::vector<Problem>& problems) {
    TableReader table(&item, fmt::format("record.{}", number), problems);
    RecordSource found = all_;
    found.file = in_folder(table.string("file", true).value_or(""));
    if (const auto probes = table.string("probes")) found.probes = in_folder(*probes);
    if (const auto rate = table.quantity("rate", "1/s", Range::positive)) found.rate = *rate;
    if (const ConfigNode* sets = table.node("set")) {
      found.sets_from = sets->where;
      for (const ConfigNode& line : sets->items) {
        if (line.kind == ConfigNode::Kind::string) found.sets.push_back(line.text);
      }
      if (found.sets.size() != all_.sets.size() + sets->items.size() || sets->items.empty()) {
        table.problem("set", fmt::format("found {}, expected a list of texts such as "
                                         "[\"disk.fan.unbalance=200g.mm\"]",
                                         sets->as_written()));
      }
    }
    if (const auto speed = table.quantity("speed", "rad/s", Range::positive)) {
      found.has_speed = true;
      found.sets.push_back(fmt::format("operation.speed={:.17g} rad/s", *speed));
    }
    table.finish();
    return found;
  }

 private:
  std::string in_folder(const std::string& file) const { return (folder_ / file).string(); }

  std::filesystem::path folder_;
  RecordSource all_;
};

/// @throws ModelError  with every problem found and its place in the file
std::vector<RecordSource> read_list(const std::filesystem::path& path, const RecordSource& all) {
  const ConfigNode root = parse_toml(file_text(path), path.string());
  std::vector<Problem> problems;
  {
    TableReader top(&root, "", problems);
    top.node("record");
    top.finish();
  }
  const ConfigNode* list = root.find("record");
  if (!list || list->kind != ConfigNode::Kind::array || list->items.empty()) {
    problems.push_back({root.where, "record", "missing, expected one [[record]] or more"});
    throw ModelError(std::move(problems));
  }
  ListReader reader(path.parent_path(), all);
  std::vector<RecordSource> sources;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    sources.push_back(reader.source(list->items[i], i + 1, problems));
  }
  if (!problems.empty()) throw ModelError(std::move(problems));
  return sources;
}

}  // namespace

Model with_values(const Model& model, const std::vector<std::string>& sets) {
  return parse_model(
      model.source, model.path, sets,
      NamedFiles::of_sets_in(std::filesystem::path(model.path).parent_path()).with(law_table));
}

Model model_for(const Model& model, const RecordSource& source) {
  try {
    return with_values(model, source.sets);
  } catch (const ModelError& error) {
    if (source.sets_from.file.empty()) throw;
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      if (!problem.where.set.empty()) problem.where = source.sets_from;
    }
    throw ModelError(std::move(problems));
  }
}

Measurement measurement_of(Model model, const SourcedRecord& record) {
  const RecordSource& source = record.source;
  Measurement found{std::move(model), {}};
  const MeasurementSetup setup = source.probes.empty()
                                     ? model_probes(found.model)
                                     : read_probe_file(source.probes, found.model);
  found.readings = readings_of(record, setup);
  take_speed(found.model, found.readings, source.has_speed);
  return found;
}

Measurement read_measurement(Model model, const RecordSource& source) {
  return measurement_of(std::move(model), {source, read_record(source.file, source.rate)});
}

bool is_list_of_records(const RecordSource& source) {
  return std::filesystem::path(source.file).extension() == ".toml";
}

std::vector<SourcedRecord> read_records(const RecordSource& source) {
  const bool is_list = is_list_of_records(source);
  std::vector<SourcedRecord> records;
  for (const RecordSource& one : is_list ? read_list(source.file, source) : std::vector{source}) {
    records.push_back({one, read_record(one.file, one.rate)});
  }
  return records;
}

}  // namespace whirl::inline io
