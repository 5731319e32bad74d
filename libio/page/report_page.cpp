#include "libio/page/report_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "libbase/error.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/studies/classification_result.hpp"
#include "libfe/assembly/properties.hpp"
#include "libio/drawing/figure_json.hpp"
#include "libio/figures/comparison.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/page/cover.hpp"
#include "libio/page/findings.hpp"
#include "libio/page/machine_report.hpp"
#include "libio/page/motion_json.hpp"
#include "libio/page/page_assets.hpp"
#include "libio/page/report_figures.hpp"
#include "libio/results/call.hpp"
#include "libio/results/study_status.hpp"
#include "libio/text/format.hpp"
#include "libio/text/xml.hpp"

namespace whirl::inline io {

namespace {

/// Adds a name and a value, if there is one.
void add_fact(Record& facts, const char* name, const std::string& value) {
  if (value.empty()) return;
  Record::Array pair{Record(name), Record(value)};
  facts.add(Record(pair));
}

/// What the rotor is made of.
std::string parts_of(const ResultView& result) {
  if (!result.assembler) return "";
  const Model& m = *result.model;
  const Structure& s = m.structure;
  std::vector<std::string> parts;
  const auto count = [&](std::size_t number, const char* one, const char* several) {
    parts.push_back(fmt::format("{} {}", number, number == 1 ? one : several));
  };
  count(static_cast<std::size_t>(result.assembler->mesh().nodes()), "node", "nodes");
  count(s.bodies.size(), "body", "bodies");
  count(s.disks.size(), "disk", "disks");
  count(s.bearings.size(), "bearing", "bearings");
  if (!s.seals.empty()) count(s.seals.size(), "seal", "seals");
  if (const auto rolling = rolling_bearings(m.contacts).size(); rolling > 0) {
    count(rolling, "rolling bearing", "rolling bearings");
  }
  count(stator_contacts(m.contacts).size(), "contact", "contacts");
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// The machine that several results are of.
Record machine_record(const ResultView& result, const std::string& model) {
  Record facts = Record::array();
  add_fact(facts, "title", result.title);
  add_fact(facts, "model", result.model_path);
  add_fact(facts, "rotor", parts_of(result));
  if (result.assembler) {
    const Structure& s = result.model->structure;
    const RotorProperties rotor = rotor_properties(s, result.assembler->mesh());
    add_fact(facts, "mass", fmt::format("{:.4g} kg", rotor.mass));
    if (s.length() > 0.0) add_fact(facts, "length", format_length(s.length()));
  }
  return Record().set("facts", facts).set("model", model);
}

/// What was run, name by name.
Record facts_of(const ResultView& result) {
  Record facts = Record::array();
  const auto add = [&](const char* name, const std::string& value) {
    add_fact(facts, name, value);
  };
  const auto attribute = [&](const char* name) {
    return result.file.has_attribute("/", name) ? result.file.string_attribute("/", name) : "";
  };
  add("result", result.path);
  add("model", result.model_path);
  add("command", attribute("command"));
  add("made by", "whirl " + attribute("whirl_version"));
  add("made at", attribute("created"));
  if (result.file.has_attribute("/", "instruction_set")) {
    add("computed with", attribute("instruction_set") + ", " + attribute("mathematics"));
  }
  if (result.file.has_attribute("/", "speed")) {
    add("speed", format_speed(result.file.number_attribute("/", "speed")));
  }
  if (result.file.has(dataset_of<MotionRecord>(&MotionRecord::time))) {
    const auto& run = figures::result_of<RunFacts>(result);
    add("recorded", fmt::format("{:g} revolutions, {} samples each", run.revolutions,
                                run.samples_per_revolution));
    if (run.steps > 0.0) {
      add("cost", fmt::format("{:.0f} steps, {:.0f} evaluations, {:.0f} events", run.steps,
                              run.evaluations, run.events));
    }
  }
  if (const std::string group(ClassificationResult::group);
      result.file.has_attribute(group, "motion")) {
    add("motion", result.file.string_attribute(group, "motion"));
  }
  add("rotor", parts_of(result));
  return facts;
}

Record warnings_of(const ResultView& result, const std::vector<std::string>& missing) {
  Record warnings = Record::array();
  if (!result.problem.empty()) {
    warnings.add("the model cannot be read again, the layout is left out: " + result.problem);
  }
  if (const auto& run = figures::result_of<RunFacts>(result); run.failure) {
    warnings.add("the run failed: " + run.failure.text());
  }
  if (!says_complete(result.file)) {
    warnings.add("the study is not complete: run its command again to go on");
  }
  for (const std::string& text : missing) warnings.add(text);
  return warnings;
}

Record list_of(const std::vector<std::string>& texts) {
  Record list = Record::array();
  for (const std::string& text : texts) list.add(text);
  return list;
}

/// Measures of the contacts as a table.
Record contacts_of(const ResultView& result) {
  FigureTable t;
  const std::vector<ContactShare>& contacts = figures::result_of<ContactShares>(result).contacts;
  if (contacts.empty()) return {};
  t.header = {"contact",
              "regime",
              "time in touch",
              "impacts per revolution",
              "largest normal force",
              "largest friction force"};
  Record rows = Record::array();
  for (const ContactShare& c : contacts) {
    Record row = Record::array();
    row.add(c.name);
    row.add(name_of(c.regime));
    row.add(fmt::format("{:.2f} %", 100.0 * c.duty));
    row.add(fmt::format("{:.4g}", c.impacts_per_rev));
    row.add(format_engineering(c.max_normal, "N"));
    row.add(format_engineering(c.max_tangential, "N"));
    rows.add(row);
  }
  return Record().set("header", list_of(t.header)).set("rows", rows);
}

/// The tables that a printed report has of a result.
Record sheets_of(const ResultView& result) {
  const Findings found = findings_of(result);
  Record list = Record::array();
  for (const std::vector<Sheet>* sheets : {&found.first, &found.sheets}) {
    for (const Sheet& sheet : *sheets) {
      Record rows = Record::array(), one;
      for (const std::vector<std::string>& row : sheet.table.rows) rows.add(list_of(row));
      one.set("caption", sheet.caption).set("header", list_of(sheet.table.header));
      list.add(one.set("rows", rows).set("notes", list_of(sheet.notes)));
    }
  }
  return list;
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

/// What several results show over each other: figures of one kind and variant that all of them
/// have.
Record comparison_record(const std::vector<std::unique_ptr<ResultView>>& results,
                         const std::vector<std::vector<Figure>>& figures, ArrayStore& arrays) {
  const std::vector<std::string> names = names_of(results);
  std::vector<std::string> texts;
  for (const auto& result : results) texts.push_back(stored_model(result->file));
  Record list = Record::array();
  for (const Figure& both : compared_figures(figures, names)) {
    list.add(record_of(both, arrays).set("summary", ""));
  }
  Record title = Record::array();
  for (const std::string& name : names) title.add(name);
  return Record()
      .set("names", title)
      .set("figures", list)
      .set("differences", table_record(differences(texts, names)));
}

/// What is said of a result, but what fails, which is told.
template <class Make>
Record attempt(const char* what, std::vector<std::string>& missing, const Make& make) {
  try {
    return make();
  } catch (const std::exception& error) {
    missing.push_back(fmt::format("no {}: {}", what, error.what()));
    return {};
  }
}

/// The head of a report, name by name.
Record cover_record(const Cover& cover) {
  Record lines = Record::array();
  for (const auto& [name, value] : lines_of(cover)) add_fact(lines, name.c_str(), value);
  return Record().set("title", cover.words.title).set("lines", lines);
}

/// A page on its way.
struct PageBuilder {
  const std::vector<std::unique_ptr<ResultView>>& results;
  ArrayStore arrays = {};
  int figures = 0;
  bool moves = false;

  /// Adds the figures of a kind; why there is none goes to what is missing.
  std::vector<Figure> add(const FigureKind& kind, const ResultView& result, Record& to,
                          std::vector<std::string>& missing) {
    try {
      std::vector<Figure> made = figures_with_others(kind, result, results);
      for (const Figure& f : made) {
        to.add(record_of(f, arrays).set("summary", kind.summary));
        ++figures;
      }
      return made;
    } catch (const std::exception& error) {  // what fails of one does not cost the others
      missing.push_back(fmt::format("no figure \"{}\": {}", kind.name, error.what()));
      return {};
    }
  }

  /// A result with all its figures; of one of a machine without the layout, which is drawn once.
  Record add(const ResultView& result, bool is_of_machine, std::vector<Figure>& made) {
    Record list = Record::array();
    std::vector<std::string> missing;
    for (const FigureKind& kind : figure_kinds()) {
      if (is_of_machine && kind.name == "layout") continue;
      const std::vector<Figure> of_kind = add(kind, result, list, missing);
      made.insert(made.end(), of_kind.begin(), of_kind.end());
    }
    Record r;
    r.set("title", result.title).set("path", result.path);
    r.set("heading", heading_of(result));
    r.set("facts", attempt("facts", missing, [&] { return facts_of(result); }));
    const Record motion =
        attempt("picture in space", missing, [&] { return motion_record(result, arrays); });
    moves = moves || !motion.is_empty();
    r.set("figures", list).set("motion", motion);
    r.set("contacts", attempt("table of contacts", missing, [&] { return contacts_of(result); }));
    r.set("sheets", attempt("tables", missing, [&] { return sheets_of(result); }));
    r.set("model", stored_model(result.file));
    return r.set("warnings", warnings_of(result, missing));
  }
};

}  // namespace

ReportPage report_page(const std::vector<std::unique_ptr<ResultView>>& results,
                       const Cover& cover) {
  PageBuilder builder{results};
  const bool is_machine = is_one_machine(results);
  std::vector<const ResultView*> ordered;
  if (is_machine) {
    ordered = in_order(results);
  } else {
    for (const auto& result : results) ordered.push_back(result.get());
  }
  Record list = Record::array(), data;
  data.set("version", cover.version).set("cover", cover_record(cover));
  data.set("colors", color_record()).set("style", style_record());
  if (is_machine) {
    const ResultView& first = *ordered.front();
    Record drawings = Record::array();
    std::vector<std::string> missing;
    builder.add(figure_kinds().front(), first, drawings, missing);
    Record machine = machine_record(first, stored_model(first.file));
    data.set("machine", machine.set("figures", drawings));
  }
  std::vector<std::vector<Figure>> all(ordered.size());
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    list.add(builder.add(*ordered[i], is_machine, all[i]));
  }
  data.set("results", list);
  if (results.size() > 1 && !is_machine) {
    data.set("comparison", comparison_record(results, all, builder.arrays));
  }
  data.set("arrays", builder.arrays.record());
  const std::string title = xml_text(results.empty() ? "whirl" : results.front()->title);
  const std::string json = for_script(data.json());
  const std::string html =
      filled(page_html, {{"title", title},
                         {"style", page_style},
                         {"three", builder.moves ? page_three : std::string_view{}},
                         {"data", json},
                         {"script", page_script}});
  return {html, builder.figures};
}

}  // namespace whirl::inline io
