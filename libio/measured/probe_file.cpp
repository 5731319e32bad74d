#include "libio/measured/probe_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libio/measured/channel_unit.hpp"
#include "libio/measured/probe_table.hpp"
#include "libio/model/config.hpp"
#include "libio/model/file_text.hpp"
#include "libio/model/model_builder.hpp"
#include "libio/model/read_fields.hpp"
#include "libio/text/encoding.hpp"
#include "libio/text/table_file.hpp"
#include "libio/text/workbook.hpp"

namespace whirl::inline io {

namespace {

/// What a probe has beside what it has in a model.
struct ProbeKeys {
  std::string channel;
  ProbeGain gain{};
  std::optional<FullScale> full_scale{};
};

/// The text of a key, of a number as it is written.
std::string text_of(const ConfigNode& node) {
  return node.kind == ConfigNode::Kind::string ? node.text : node.as_written();
}

/// Name or number of a channel; empty: it is left out or wrong.
std::string channel_in(TableReader& table) {
  const ConfigNode* node = table.node("channel");
  if (!node) return "";
  if (node->kind == ConfigNode::Kind::integer && node->number >= 1.0) {
    return fmt::format("{:.0f}", node->number);
  }
  if (node->kind == ConfigNode::Kind::string && !node->text.empty()) return node->text;
  table.problem("channel", fmt::format("found {}, expected the name of a channel or its number "
                                       "from 1",
                                       node->as_written()));
  return "";
}

ProbeGain gain_in(TableReader& table) {
  const ConfigNode* node = table.node("gain");
  if (!node) return {};
  const auto gain = parse_gain(text_of(*node));
  if (!gain) table.problem("gain", gain.problem);
  return gain ? *gain : ProbeGain{};
}

std::optional<FullScale> full_scale_in(TableReader& table) {
  const ConfigNode* node = table.node("full_scale");
  if (!node) return std::nullopt;
  const auto value = channel_value(text_of(*node));
  const bool has_unit = value && (value->second.name == "V" || value->second.name == "m");
  if (has_unit && value->first > 0.0) return FullScale{value->first, value->second.name};
  table.problem("full_scale", fmt::format("found {}, expected what a sample of 1 is, such as "
                                          "\"10 V\"",
                                          node->as_written()));
  return std::nullopt;
}

/// Takes the keys off a probe that models do not have.
ProbeKeys take_probe_keys(ConfigNode& item, std::size_t number, std::vector<Problem>& problems) {
  TableReader table(&item, fmt::format("probe.{}", number), problems);
  ProbeKeys keys{channel_in(table), gain_in(table), full_scale_in(table)};
  std::erase_if(item.entries, [](const ConfigNode::Entry& e) {
    return e.key == "channel" || e.key == "gain" || e.key == "full_scale";
  });
  return keys;
}

/// @param full_scale  above all probes
std::optional<KeyPhasor> read_key_phasor(const ConfigNode& root,
                                         const std::optional<FullScale>& full_scale,
                                         std::vector<Problem>& problems) {
  const ConfigNode* node = root.find("keyphasor");
  if (!node) return std::nullopt;
  KeyPhasor key;
  TableReader table(node, "keyphasor", problems);
  table.read(key);
  key.channel = channel_in(table);
  if (!table.has("channel")) table.missing("channel", "the name or number of its channel");
  if (const ConfigNode* threshold = table.node("threshold")) {
    const auto value = channel_value(text_of(*threshold));
    const std::string unit = value ? value->second.name : "none";
    if (unit.empty() || unit == "V" || unit == "m") {
      key.threshold = value->first;
      key.threshold_unit = unit;
    } else {
      table.problem("threshold", fmt::format("found {}, expected a voltage such as \"-5 V\", or a "
                                             "number as the channel has it",
                                             threshold->as_written()));
    }
  }
  key.full_scale = full_scale_in(table);
  if (!key.full_scale) key.full_scale = full_scale;
  table.finish();
  return key;
}

/// The model with these probes and no others: its builder checks them.
/// @param probes  the array of a file
Model model_with(const ConfigNode& probes, const Model& model) {
  ConfigNode root = parse_toml(model.source, model.path);
  std::erase_if(root.entries, [](const ConfigNode::Entry& e) { return e.key == "probe"; });
  root.entries.push_back({"probe", probes});
  // the model has its tables in it
  return ModelBuilder(root, NamedFiles::none_in(std::filesystem::path(model.path).parent_path()))
      .build();
}

}  // namespace

MeasurementSetup probes_in(ConfigNode root, const Model& model) {
  std::vector<Problem> problems;
  MeasurementSetup setup;
  std::optional<FullScale> full_scale;
  {
    TableReader top(&root, "", problems);
    top.node("probe");
    top.node("keyphasor");
    full_scale = full_scale_in(top);
    top.finish();
  }
  setup.key_phasor = read_key_phasor(root, full_scale, problems);
  ConfigNode* list = root.find("probe");
  if (!list) {
    problems.push_back({root.where, "probe", "missing, expected one [[probe]] or more"});
    throw ModelError(std::move(problems));
  }
  std::vector<ProbeKeys> keys;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    keys.push_back(take_probe_keys(list->items[i], i + 1, problems));
  }
  std::vector<Probe> probes;
  try {
    probes = model_with(*list, model).structure.probes;
  } catch (const ModelError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
  if (!problems.empty()) throw ModelError(std::move(problems));
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const std::string channel = keys[i].channel.empty() ? probes[i].name : keys[i].channel;
    setup.probes.push_back({probes[i], channel, keys[i].gain, *parse_as("1 " + probes[i].unit, "m"),
                            list->items[i].find("unit") != nullptr,
                            keys[i].full_scale ? keys[i].full_scale : full_scale});
  }
  return setup;
}

MeasurementSetup parse_probe_file(const std::string& text, const std::string& name,
                                  const Model& model) {
  return probes_in(parse_toml(text, name), model);
}

MeasurementSetup read_probe_file(const std::filesystem::path& path, const Model& model) {
  // a table has no [[probe]], and a workbook is no text
  const std::string name = sheet_name(path.string()).file;
  const std::string ending = lower_case(std::filesystem::path(name).extension().string());
  static constexpr std::string_view of_tables[] = {".csv", ".txt",  ".tsv",
                                                   ".dat", ".xlsx", ".xlsm"};
  if (std::ranges::find(of_tables, ending) == std::end(of_tables)) {
    return parse_probe_file(file_text(path), path.string(), model);
  }
  const auto table = table_file("", path.string(), FileKind::stream, probe_columns_named_in);
  if (!table) throw ModelError({path.string()}, "", table.problem);
  try {
    return probes_in(probe_table(table->text, table->name), model);
  } catch (const ModelError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) problem.where = with_cell_name(problem.where);
    throw ModelError(std::move(problems));
  }
}

MeasurementSetup model_probes(const Model& model) {
  MeasurementSetup setup;
  for (const Probe& probe : model.structure.probes) {
    const bool is_unit_given = probe.unit != Probe{}.unit;  // as far as one can tell
    setup.probes.push_back(
        {probe, probe.name, {}, *parse_as("1 " + probe.unit, "m"), is_unit_given});
  }
  return setup;
}

}  // namespace whirl::inline io
