#include "libio/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "libfe/base/error.hpp"
#include "libio/comparison.hpp"
#include "libio/figure_json.hpp"
#include "libio/format.hpp"
#include "libio/motion_json.hpp"
#include "libio/page_assets.hpp"
#include "libio/xml.hpp"

namespace whirl {

namespace {

/// What was run, name by name.
Record facts_of(const ResultView& result) {
  Record facts = Record::array();
  const auto add = [&](const char* name, const std::string& value) {
    if (value.empty()) return;
    Record::Array pair{Record(name), Record(value)};
    facts.add(Record(pair));
  };
  const auto attribute = [&](const char* name) {
    return result.file.has_attribute("/", name) ? result.file.string_attribute("/", name) : "";
  };
  add("result", result.path);
  add("model", result.model_path);
  add("command", attribute("command"));
  add("made by", "whirl " + attribute("whirl_version"));
  add("made at", attribute("created"));
  if (result.file.has_attribute("/", "speed")) {
    add("speed", format_speed(result.file.number_attribute("/", "speed")));
  }
  if (result.file.has("/trajectory/time")) {
    add("recorded",
        fmt::format("{:g} revolutions, {:g} samples each",
                    result.file.number_attribute("/trajectory", "revolutions"),
                    result.file.number_attribute("/trajectory", "samples_per_revolution")));
    if (result.file.has_attribute("/trajectory", "steps")) {
      add("cost", fmt::format("{:.0f} steps, {:.0f} evaluations, {:.0f} events",
                              result.file.number_attribute("/trajectory", "steps"),
                              result.file.number_attribute("/trajectory", "evaluations"),
                              result.file.number_attribute("/trajectory", "events")));
    }
  }
  if (result.file.has_attribute("/classify", "motion")) {
    add("motion", result.file.string_attribute("/classify", "motion"));
  }
  if (result.assembler) {
    const Model& m = *result.model;
    add("rotor",
        fmt::format("{} nodes, {} bodies, {} disks, {} bearings, {} contacts",
                    result.assembler->mesh().nodes(), m.structure.bodies.size(),
                    m.structure.disks.size(), m.structure.bearings.size(), m.contacts.size()));
  }
  return facts;
}

Record warnings_of(const ResultView& result, const std::vector<std::string>& missing) {
  Record warnings = Record::array();
  if (!result.problem.empty()) {
    warnings.add("the model cannot be read again, the layout is left out: " + result.problem);
  }
  if (result.file.has_attribute("/trajectory", "failure")) {
    warnings.add("the run failed: " + result.file.string_attribute("/trajectory", "failure"));
  }
  for (const char* group : {"/sweep", "/map", "/basins"}) {
    if (result.file.has_attribute(group, "complete") &&
        result.file.number_attribute(group, "complete") == 0.0) {
      warnings.add("the study is not complete: run its command again to go on");
    }
  }
  for (const std::string& text : missing) warnings.add(text);
  return warnings;
}

/// Measures of the contacts as a table.
Record contacts_of(const ResultView& result) {
  FigureTable t;
  if (!result.file.has("/contacts/name")) return {};
  t.header = {"contact",
              "regime",
              "time in touch",
              "impacts per revolution",
              "largest normal force",
              "largest friction force"};
  const auto names = result.file.strings("/contacts/name"),
             regimes = result.file.strings("/contacts/regime");
  const Vec duty = result.file.vector("/contacts/duty"),
            impacts = result.file.vector("/contacts/impacts_per_rev"),
            normal = result.file.vector("/contacts/max_normal"),
            tangential = result.file.vector("/contacts/max_tangential");
  Record rows = Record::array();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    Record row = Record::array();
    row.add(names[i]);
    row.add(regimes[i]);
    row.add(fmt::format("{:.2f} %", 100.0 * duty(k)));
    row.add(fmt::format("{:.4g}", impacts(k)));
    row.add(format_engineering(normal(k), "N"));
    row.add(format_engineering(tangential(k), "N"));
    rows.add(row);
  }
  Record header = Record::array();
  for (const std::string& h : t.header) header.add(h);
  return Record().set("header", header).set("rows", rows);
}

/// JSON that can stand in a <script>: "</script>" would end it, "<!--" change how it is read.
std::string for_script(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) out += c == '<' ? "\\u003c" : std::string_view(&c, 1);
  return out;
}

/// The page with its parts in their places, "{{name}}"; what the parts hold is left as it is.
std::string filled(std::string_view page,
                   const std::map<std::string_view, std::string_view>& parts) {
  std::string out;
  for (auto at = page.find("{{"); at != std::string_view::npos; at = page.find("{{")) {
    const auto end = page.find("}}", at);
    out += page.substr(0, at);
    out += parts.at(page.substr(at + 2, end - at - 2));
    page.remove_prefix(end + 2);
  }
  return out.append(page);
}

Record table_record(const FigureTable& table) {
  const auto list = [](const std::vector<std::string>& texts) {
    Record array = Record::array();
    for (const std::string& text : texts) array.add(text);
    return array;
  };
  Record rows = Record::array();
  for (const auto& row : table.rows) rows.add(list(row));
  return Record().set("header", list(table.header)).set("rows", rows);
}

/// What several results show over each other: figures of one kind and variant that all of them have.
Record comparison_record(const std::vector<std::unique_ptr<ResultView>>& results,
                         const std::vector<std::vector<Figure>>& figures, ArrayStore& arrays) {
  const std::vector<std::string> names = names_of(results);
  std::vector<std::string> texts;
  for (const auto& result : results) texts.push_back(result->file.strings("/model").at(0));
  Record list = Record::array();
  for (const Figure& f : figures.front()) {
    std::vector<const Figure*> alike{&f};
    for (std::size_t n = 1; n < figures.size(); ++n) {
      const auto same = std::find_if(
          figures[n].begin(), figures[n].end(),
          [&](const Figure& other) { return other.kind == f.kind && other.variant == f.variant; });
      if (same != figures[n].end()) alike.push_back(&*same);
    }
    if (alike.size() != figures.size()) continue;
    if (const auto both = overlay(alike, names)) {
      list.add(record_of(*both, arrays).set("summary", ""));
    }
  }
  Record title = Record::array();
  for (const std::string& name : names) title.add(name);
  return Record()
      .set("names", title)
      .set("figures", list)
      .set("differences", table_record(differences(texts, names)));
}

}  // namespace

ReportPage report_page(const std::vector<std::unique_ptr<ResultView>>& results,
                       const std::string& version) {
  ReportPage made;
  ArrayStore arrays;
  Record list = Record::array();
  bool moves = false;
  std::vector<std::vector<Figure>> all;
  for (const auto& result : results) {
    Record figures = Record::array();
    std::vector<std::string> missing;
    all.emplace_back();
    for (const FigureKind& kind : figure_kinds()) {
      try {
        std::vector<Figure> of_kind = figures_of(kind, *result);
        for (const auto& other : results) {  // what fits is laid over it
          if (other == result || !other_values(*result, *other).empty()) continue;
          lay_over(of_kind, *result, *other, std::filesystem::path(other->path).filename());
        }
        for (const Figure& f : of_kind) {
          Record r = record_of(f, arrays);
          r.set("summary", kind.summary);
          figures.add(r);
          ++made.figures;
          if (results.size() > 1) all.back().push_back(f);
        }
      } catch (const std::exception& error) {  // what fails of one does not cost the others
        missing.push_back(fmt::format("no figure \"{}\": {}", kind.name, error.what()));
      }
    }
    Record r;
    r.set("title", result->title).set("path", result->path).set("facts", facts_of(*result));
    Record motion;
    try {
      motion = motion_record(*result, arrays);
    } catch (const std::exception& error) {
      missing.push_back(fmt::format("no picture in space: {}", error.what()));
    }
    moves = moves || motion.json().find("motions") != std::string::npos;
    r.set("figures", figures).set("motion", motion).set("contacts", contacts_of(*result));
    r.set("model", result->file.strings("/model").at(0));
    list.add(r.set("warnings", warnings_of(*result, missing)));
  }
  Record data;
  data.set("version", version).set("colors", color_record()).set("results", list);
  if (results.size() > 1) data.set("comparison", comparison_record(results, all, arrays));
  data.set("arrays", arrays.record());
  const std::string title = xml_text(results.empty() ? "whirl" : results.front()->title);
  const std::string json = for_script(data.json());
  made.html = filled(page_html, {{"title", title},
                                 {"style", page_style},
                                 {"three", moves ? page_three : std::string_view{}},
                                 {"data", json},
                                 {"script", page_script}});
  return made;
}

}  // namespace whirl
