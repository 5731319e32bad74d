#include "libio/model/read_connections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libbase/structs/family.hpp"
#include "libio/model/bearing_table.hpp"

namespace whirl::inline io {

namespace {

/// Whether a table has one of some keys.
bool has_any(const TableReader& table, const std::vector<std::string>& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&](const std::string& key) { return table.has(key); });
}

std::vector<std::string> keys_of_kind(const AnyBearing& bearing) {
  return std::visit([](const auto& b) { return keys_of<std::remove_cvref_t<decltype(b)>>(); },
                    bearing);
}

/// Whether any key of a kind must be there.
bool has_required_key(const AnyBearing& bearing) {
  const auto any = [](const auto&... field) { return (field.is_required || ...); };
  return std::visit([&](const auto& b) { return std::apply(any, b.fields()); }, bearing);
}

/// A kind of bearing as it is made, and the key that told it.
struct ToldKind {
  AnyBearing bearing;
  std::string key;  ///< "kind", or that of a file; empty: coefficients stand there, or nothing
  bool is_wrong = false;  ///< its name is no kind, which is reported: it is told by other keys
};

/// The kind that a table is of. The keys of all kinds that may be meant become known.
ToldKind kind_of(TableReader& table) {
  const auto name = table.choice("kind", member_names<AnyBearing>());
  if (name) return {member_named<AnyBearing>(*name), "kind"};
  const bool is_wrong = table.has("kind");
  ToldKind told;
  for_each_member<AnyBearing>([&](const auto& kind) {
    const bool is_first = AnyBearing(kind).index() == 0;
    if (!is_wrong && !is_first && kind.told_by.empty()) return;
    for (const std::string& key : keys_of_kind(kind)) table.node(key);
    if (!is_first && table.has(kind.told_by)) told = {kind, std::string(kind.told_by)};
  });
  told.is_wrong = is_wrong;
  return told;
}

/// Reports keys of kinds that nothing tells: what says how a table is read, where there is none.
void report_left_over(TableReader& table, const ToldKind& told) {
  if (told.key == "kind") return;  // such keys are unknown then
  const std::vector<std::string> own = keys_of_kind(told.bearing);
  for_each_member<AnyBearing>([&](const auto& kind) {
    if (kind.told_by.empty() || kind.told_by == told.key) return;
    for (const std::string& key : keys_of_kind(kind)) {
      if (key == kind.told_by || std::find(own.begin(), own.end(), key) != own.end()) continue;
      if (!table.has(key)) continue;
      table.problem(key, fmt::format("belongs to a {}, which is missing", kind.told_by));
    }
  });
}

/// Says what a bearing needs that has no coefficients.
void report_no_values(TableReader& table, const ToldKind& told) {
  std::vector<std::string> keys = keys_of_kind(told.bearing);
  const std::string first = keys.front();
  std::string expected = fmt::format("one of {}", fmt::join(keys, ", "));
  keys.erase(keys.begin());
  if (told.key.empty()) {
    expected = "a stiffness (N/m), damping, rigid = true, clamped = true";
    keys.insert(keys.end(), {"rigid", "clamped", "kind"});
    for_each_member<AnyBearing>([&](const auto& kind) {
      if (kind.told_by.empty()) return;
      expected += fmt::format(", or a {}", kind.told_by);
      keys.emplace_back(kind.told_by);
    });
  }
  table.missing(first, expected, keys);
}

/// Reports that a bearing is rigid and has coefficients, or neither.
void check_kind(TableReader& table, const ToldKind& told, bool is_rigid, bool has_values) {
  if (is_rigid && !told.key.empty()) {
    table.problem(told.key,
                  "a rigid bearing has no coefficients of its own; leave out the " + told.key);
  } else if (is_rigid && has_values) {
    table.problem("rigid",
                  "a rigid bearing has no stiffness or damping of its own; leave them out");
  } else if (!is_rigid && !has_values && !has_required_key(told.bearing)) {
    report_no_values(table, told);
  }
}

std::optional<CoefficientTable> coefficient_table(ModelReading& reading, TableReader& table,
                                                  std::string_view key) {
  const auto from = reading.text_of(table, key, "", 0,  // who owns it, its reader knows
                                    coefficients_named_in);
  if (!from) return std::nullopt;
  std::vector<Problem> wrong;
  const CoefficientTable read = parse_bearing_table(from->text, from->name, wrong, &reading.doubts);
  reading.add_problems(wrong);
  return read;
}

}  // namespace

bool read_coefficients(ModelReading& reading, TableReader& table, AnyBearing& to) {
  const auto read_table = [&](const auto& field, CoefficientTable& member) {
    if (auto read = coefficient_table(reading, table, field.name)) member = std::move(*read);
    if (field.is_required && !table.has(field.name)) {
      table.missing(field.name, "a file with coefficients against speed (CSV)");
    }
  };
  std::visit([&](auto& kind) { table.read(kind, read_table); }, to);
  return has_any(table, keys_of_kind(to));
}

ModelTable connection_table(std::string_view name, std::string_view meaning,
                            void (*read)(ModelReading& reading)) {
  return {.name = name,
          .meaning = meaning,
          .read = read,
          .example =
              "body = \"b\"\n"
              "stiffness = 1\n",
          .switches = {{"kind"}},
          .notes = {{"kind", "how its coefficients are given; left out: told by the other keys"}}};
}

void read_link_keys(ModelReading& reading, TableReader& table, std::string_view word,
                    Connection& to) {
  const bool has_values = read_coefficients(reading, table, to.coefficients);
  to.is_clamped = table.boolean("clamped").value_or(false);
  to.is_rigid = table.boolean("rigid").value_or(false) || to.is_clamped;
  if (!has_values && !to.is_rigid) {
    table.missing("stiffness", "a stiffness (N/m), damping, rigid = true or clamped = true",
                  {"damping", "tilt_stiffness", "tilt_damping", "added_mass", "rigid", "clamped"});
  }
  if (has_values && to.is_rigid) {
    table.problem(
        "rigid",
        fmt::format("a rigid {} has no stiffness or damping of its own; leave them out", word));
  }
}

void read_connections(ModelReading& reading, const char* array, std::vector<Connection>& to) {
  reading.for_each(array, [&](TableReader& table, std::size_t i) {
    Connection c;
    c.where = table.where();
    c.name = table.string("name").value_or(fmt::format("{} {}", array, i + 1));
    const auto at = reading.station(table);
    if (at) c.from = *at;
    if (const auto to_name = table.string("to")) {
      if (const auto s = reading.named_station(*to_name, table, "to", true, at)) c.to = *s;
    }
    table.read(c);
    const ToldKind told = kind_of(table);
    c.coefficients = told.bearing;
    const std::size_t known_tables = reading.file_tables.size();
    const bool has_values = read_coefficients(reading, table, c.coefficients);
    c.is_clamped = table.boolean("clamped").value_or(false);
    c.is_rigid = table.boolean("rigid").value_or(false) || c.is_clamped;
    const bool is_by_file = !told.key.empty() && told.key != "kind";
    if (AnyBearing coefficients; is_by_file && read_coefficients(reading, table, coefficients)) {
      table.problem(told.key,
                    fmt::format("found a {} and coefficients, expected one of them", told.key));
    }
    if (!told.is_wrong) {  // else it is not known which keys belong to it
      check_kind(table, told, c.is_rigid, has_values);
      report_left_over(table, told);
    }
    for (std::size_t k = known_tables; k < reading.file_tables.size(); ++k) {
      reading.file_tables[k].owner = array;
      reading.file_tables[k].item = i;
    }
    to.push_back(c);
  });
}

}  // namespace whirl::inline io
