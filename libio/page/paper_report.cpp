#include "libio/page/paper_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "libbase/error.hpp"
#include "libfe/assembly/properties.hpp"
#include "libio/figures/comparison.hpp"
#include "libio/page/findings.hpp"
#include "libio/page/machine_report.hpp"
#include "libio/page/page_assets.hpp"
#include "libio/page/paper_html.hpp"
#include "libio/page/paper_template.hpp"
#include "libio/page/part_sheets.hpp"
#include "libio/page/report_figures.hpp"
#include "libio/page/scope.hpp"
#include "libio/results/call.hpp"
#include "libio/results/digest.hpp"
#include "libio/results/study_status.hpp"
#include "libio/text/format.hpp"
#include "libio/text/xml.hpp"

namespace whirl::inline io {

namespace {

using Results = std::vector<std::unique_ptr<ResultView>>;

/// A text in a style sheet's quotation marks.
std::string css_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_special = byte < 0x20 || c == '"' || c == '\\' || c == '<' || c == '>';
    out += is_special ? fmt::format("\\{:x} ", byte) : std::string(1, c);
  }
  return out + '"';
}

/// The first so many characters of a text.
std::string shortened(const std::string& text, std::size_t most) {
  std::size_t at = 0;
  for (std::size_t count = 0; at < text.size() && count < most; ++count) {
    at += std::max<std::size_t>(1, character_length(std::string_view(text).substr(at)));
  }
  return at >= text.size() ? text : text.substr(0, at) + "…";
}

/// Style of the report, with head and foot of every page.
std::string paper_style_of(const Cover& cover) {
  constexpr std::size_t most = 60, digits = 12;
  const ReportWords& w = cover.words;
  std::string document = w.document;
  if (!w.revision.empty()) {
    document += fmt::format("{}revision {}", document.empty() ? "" : ", ", w.revision);
  }
  const std::string model =
      fmt::format("whirl {}, model {}", cover.version, cover.digest.substr(0, digits));
  return fmt::format(
      "{}\n@page {{\n  @top-left {{ content: {}; }}\n  @top-right {{ content: {}; }}\n"
      "  @bottom-left {{ content: {}; }}\n  @bottom-center {{ content: {}; }}\n"
      "  @bottom-right {{ content: \"page \" counter(page) \" of \" counter(pages); }}\n}}\n",
      page_paper_style, css_text(shortened(w.title, most)), css_text(shortened(document, most)),
      css_text(shortened(w.company, most)), css_text(model));
}

const char* class_of(Standing standing) {
  switch (standing) {
    case Standing::passed:
      return "passed";
    case Standing::failed:
      return "failed";
    case Standing::open:
      return "open";
    case Standing::told:
      break;
  }
  return "told";
}

/// A result with all that is said of it.
struct Chapter {
  const ResultView& result;
  std::string name;
  Findings findings;
};

std::string cover_html(const Cover& cover) {
  std::string html = fmt::format("<header class=\"cover\">\n<p class=\"company\">{}</p>\n",
                                 xml_text(cover.words.company));
  html += fmt::format("<p class=\"title\">{}</p>\n<table class=\"facts\">\n",
                      xml_text(cover.words.title));
  for (const auto& [name, value] : lines_of(cover)) {
    if (name == "Company") continue;  // stands above
    html += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", name, xml_text(value));
  }
  return html + "</table>\n</header>\n";
}

/// What the program remarked when a result was computed.
std::vector<std::string> program_remarks(const ResultView& result) {
  std::vector<std::string> remarks = remarks_in(result);
  if (!result.problem.empty()) {
    remarks.push_back("the model cannot be read again: " + result.problem);
  }
  return remarks;
}

std::string verdict_html(const std::vector<Chapter>& chapters) {
  std::string html = "<section class=\"verdict\">\n<p class=\"label\">Verdict</p>\n";
  for (const Chapter& c : chapters) {
    html += fmt::format(
        "<div class=\"standing {}\"><p class=\"what\">{}</p><p class=\"headline\">{}</p></div>\n",
        class_of(c.findings.standing), xml_text(c.name), xml_text(c.findings.headline));
    for (const std::string& text : c.findings.sentences) {
      html += fmt::format("<p>{}</p>\n", xml_text(text));
    }
    if (!c.findings.summary.rows.empty()) html += table_html(c.findings.summary);
  }
  return html + "</section>\n";
}

std::string signatures_html(const ReportWords& w) {
  std::string html =
      "<table class=\"signatures\">\n<thead><tr><th></th><th>name</th><th>date</th>"
      "<th>signature</th></tr></thead>\n<tbody>\n";
  for (const auto& [role, name] :
       {std::pair{"Author", &w.author}, {"Checked", &w.checked_by}, {"Approved", &w.approved_by}}) {
    html +=
        fmt::format("<tr><td>{}</td><td>{}</td><td></td><td></td></tr>\n", role, xml_text(*name));
  }
  return html + "</tbody>\n</table>\n";
}

/// A column of a table.
std::vector<std::string> column_of(const FigureTable& t, std::size_t c) {
  std::vector<std::string> cells;
  for (const auto& row : t.rows) cells.push_back(c < row.size() ? row[c] : "");
  return cells;
}

/// Whether a sheet tells what a table does: the first column of the table is one of the sheet.
bool is_told_by(const Sheet& sheet, const FigureTable& table) {
  if (table.rows.empty() || table.rows.size() != sheet.table.rows.size()) return false;
  const std::vector<std::string> first = column_of(table, 0);
  for (std::size_t c = 0; c < sheet.table.header.size(); ++c) {
    if (column_of(sheet.table, c) == first) return true;
  }
  return false;
}

/// A figure without the table and the notes that sheets of its result tell already.
Figure without_told(Figure figure, const Findings& findings) {
  for (const auto* sheets : {&findings.first, &findings.sheets}) {
    const auto same = std::find_if(sheets->begin(), sheets->end(),
                                   [&](const Sheet& s) { return is_told_by(s, figure.table); });
    if (same == sheets->end()) continue;
    std::erase_if(figure.notes, [&](const std::string& note) {
      return std::any_of(same->notes.begin(), same->notes.end(), [&](const std::string& told) {
        return note.size() == told.size() && note.substr(1) == told.substr(1);  // but for a capital
      });
    });
    figure.table = {};
  }
  return figure;
}

/// A report on its way.
class Paper {
 public:
  explicit Paper(const Results& results) : results_(results), is_machine_(is_one_machine(results)) {
    const std::vector<std::string> names =
        results.size() > 1 ? names_of(results) : std::vector<std::string>{};
    std::map<const ResultView*, std::string> name_of_view;
    for (std::size_t i = 0; i < names.size(); ++i) name_of_view[results[i].get()] = names[i];
    for (const ResultView* r : ordered()) {
      std::string name = heading_of(*r);
      if (name.empty()) name = r->path;
      if (!is_machine_ && results.size() > 1) name += ", " + name_of_view[r];
      chapters_.push_back({*r, name, checked_findings(*r)});
    }
  }

  const std::vector<Chapter>& chapters() const { return chapters_; }
  const PaperWriter& writer() const { return out_; }

  void write(const Cover& cover) {
    write_remarks();
    write_findings();
    write_models();
    if (results_.size() > 1 && !is_machine_) write_comparison();
    for (const Chapter& chapter : chapters_) write_result(chapter);
    write_scope(cover);
    write_sources();
    write_appendix();
  }

 private:
  std::vector<const ResultView*> ordered() const {
    if (is_machine_) return in_order(results_);
    std::vector<const ResultView*> all;
    for (const auto& result : results_) all.push_back(result.get());
    return all;
  }

  static Findings checked_findings(const ResultView& result) {
    try {
      return findings_of(result);
    } catch (const std::exception& error) {  // figures are drawn nevertheless
      return {Standing::open, fmt::format("Not judged: {}", error.what())};
    }
  }

  /// What the program remarked, apart from the first page: that one keeps room for signatures.
  void write_remarks() {
    bool is_begun = false;
    for (const Chapter& c : chapters_) {
      const std::vector<std::string> remarks = program_remarks(c.result);
      if (remarks.empty()) continue;
      if (!is_begun) out_.chapter("Remarks of the program");
      is_begun = true;
      if (chapters_.size() > 1) out_.section(c.name);
      out_.list(remarks, "remarks");
    }
  }

  /// The tables behind the verdicts, where there are any.
  void write_findings() {
    const auto has_tables = [](const Chapter& c) { return !c.findings.first.empty(); };
    if (std::none_of(chapters_.begin(), chapters_.end(), has_tables)) return;
    out_.chapter("What the verdict rests on");
    for (const Chapter& c : chapters_) {
      if (!has_tables(c)) continue;
      if (chapters_.size() > 1) out_.section(c.name);
      for (const Sheet& sheet : c.findings.first) out_.sheet(sheet);
    }
  }

  /// Every model once, with its drawing.
  void write_models() {
    std::vector<std::string> known;
    for (const Chapter& c : chapters_) {
      const std::string text = stored_model(c.result.file);
      if (std::find(known.begin(), known.end(), text) != known.end()) continue;
      known.push_back(text);
      if (is_machine_ && known.size() > 1) continue;  // another speed only
      write_model(c);
    }
  }

  void write_model(const Chapter& c) {
    const ResultView& result = c.result;
    out_.chapter(is_machine_ || results_.size() == 1 ? "Model" : "Model of " + c.name);
    if (!result.assembler) {
      out_.paragraph("The model cannot be read again: " + result.problem);
      return;
    }
    const ModelParts parts{*result.model, *result.assembler};
    const RotorProperties rotor = rotor_properties(parts.structure, parts.mesh);
    out_.paragraph(fmt::format(
        "{} nodes, {} bodies; mass of the rotor {}, polar moment of inertia {}, length {}.{}",
        parts.mesh.nodes(), parts.structure.bodies.size(), format_engineering(rotor.mass, "kg"),
        format_engineering(rotor.Ip, "kg.m^2"),
        parts.structure.length() > 0.0 ? format_length(parts.structure.length()) : "-",
        parts.model.has_speed ? " Operating speed " + format_speed(parts.model.speed) + "." : ""));
    std::vector<std::string> missing;
    try {
      const std::vector<Sheet> sheets = model_sheets(parts);
      for (std::size_t i = 0; i < sheets.size(); ++i) {
        out_.sheet(sheets[i]);
        if (i == 0) write_figures(figure_kinds().front(), c, missing);  // the layout
      }
    } catch (const std::exception& error) {
      missing.push_back(fmt::format("not all tables of the model: {}", error.what()));
    }
    out_.list(missing, "warnings");
  }

  void write_comparison() {
    std::vector<std::vector<Figure>> all;
    std::vector<std::string> texts;
    for (const auto& result : results_) {
      texts.push_back(stored_model(result->file));
      all.emplace_back();
      for (const FigureKind& kind : figure_kinds()) {
        try {
          for (Figure& f : figures_of(kind, *result)) all.back().push_back(std::move(f));
        } catch (const std::exception&) {  // told where the result itself is shown
        }
      }
    }
    const std::vector<std::string> names = names_of(results_);
    out_.chapter("Compared");
    const FigureTable rows = differences(texts, names);
    if (rows.rows.empty()) {
      out_.paragraph("The models do not differ.");
    } else {
      out_.sheet({"Differences of the models", rows});
    }
    for (const Figure& figure : compared_figures(all, names)) out_.figure(figure);
  }

  void write_figures(const FigureKind& kind, const Chapter& c, std::vector<std::string>& missing) {
    try {
      constexpr std::size_t few = 4;  // beyond, they stand side by side
      constexpr double wide = 880.0;  // [pixels], too wide for that
      const std::vector<Figure> made = figures_with_others(kind, c.result, results_);
      const bool are_half =
          made.size() > few && std::all_of(made.begin(), made.end(), [](const Figure& f) {
            return f.width < wide && f.table.rows.empty();  // a table would part them
          });
      for (const Figure& f : made) out_.figure(without_told(f, c.findings), are_half);
    } catch (const std::exception& error) {  // what fails of one does not cost the others
      missing.push_back(fmt::format("no figure \"{}\": {}", kind.name, error.what()));
    }
  }

  void write_result(const Chapter& c) {
    out_.chapter(c.name);
    for (const Sheet& sheet : c.findings.sheets) out_.sheet(sheet);
    std::vector<std::string> missing;
    for (const FigureKind& kind : figure_kinds()) {
      if (kind.name == figure_kinds().front().name) continue;  // the layout, of the model
      write_figures(kind, c, missing);
    }
    out_.list(missing, "warnings");
  }

  void write_scope(const Cover& cover) {
    std::vector<const ResultView*> views;
    for (const Chapter& c : chapters_) views.push_back(&c.result);
    const Scope scope = scope_of(views);
    out_.chapter("Scope");
    out_.section("Assumptions");
    out_.list(scope.assumptions);
    out_.section("What was not checked");
    out_.list(scope.unchecked);
    if (cover.words.remarks.empty()) return;
    out_.section("Remarks of the author");
    std::string_view rest = cover.words.remarks;
    while (!rest.empty()) {
      const auto end = std::min(rest.find('\n'), rest.size());
      if (end > 0) out_.paragraph(rest.substr(0, end));
      rest.remove_prefix(std::min(rest.size(), end + 1));
    }
  }

  /// How each result came to be.
  void write_sources() {
    out_.chapter("Where the numbers come from");
    for (const Chapter& c : chapters_) {
      const ResultReader& file = c.result.file;
      FigureTable table{.header = {"result", c.result.path}};
      const auto add = [&](const char* name, const std::string& value) {
        if (!value.empty()) table.rows.push_back({name, value});
      };
      const auto attribute = [&](const char* name) {
        return file.has_attribute("/", name) ? file.string_attribute("/", name) : "";
      };
      add("command", attribute("command"));
      add("program", "whirl " + attribute("whirl_version"));
      add("computed", attribute("created"));
      add("computed with", attribute("instruction_set"));
      add("model", c.result.model_path);
      add("model, SHA-256", sha256_of(stored_model(file)));
      add("result file, SHA-256", sha256_of_file(c.result.path));
      out_.sheet({"Origin: " + c.name, table});
    }
    out_.paragraph(
        "A digest of a model is that of its text as the result holds it, with everything that the "
        "command set in it; it is the digest of the model file where the command set nothing and "
        "the model names no other files.");
  }

  /// The text of the models, so that the tables can be made again.
  void write_appendix() {
    constexpr std::size_t longest = 100'000;  // characters, some 40 pages
    std::vector<std::string> known;
    for (const Chapter& c : chapters_) {
      const std::string text = stored_model(c.result.file);
      if (std::find(known.begin(), known.end(), text) != known.end()) continue;
      known.push_back(text);
      out_.chapter(known.size() == 1 ? "Appendix: model file"
                                     : "Appendix: model file of " + c.name);
      if (text.size() > longest) {
        out_.paragraph(fmt::format("Left out: {} characters. The result holds it.", text.size()));
      } else {
        out_.raw(fmt::format("<pre>{}</pre>\n", model_listing(text)));
      }
    }
  }

  const Results& results_;
  bool is_machine_;
  std::vector<Chapter> chapters_{};
  PaperWriter out_{};
};

TemplateValues values_of(const Cover& cover, const Paper& paper) {
  const ReportWords& w = cover.words;
  TemplateValues values;
  std::apply(
      [&](const auto&... field) {
        ((values.texts[std::string(field.name)] = w.*field.member), ...);
      },
      ReportWords::fields());
  values.texts["version"] = cover.version;
  values.texts["digest"] = cover.digest;
  values.texts["model"] = cover.model;
  values.texts["computed"] = cover.computed;
  values.blocks["style"] = paper_style_of(cover);
  values.blocks["cover"] = cover_html(cover);
  values.blocks["verdict"] = verdict_html(paper.chapters());
  values.blocks["signatures"] = signatures_html(w);
  values.blocks["report"] = paper.writer().html();
  return values;
}

}  // namespace

PaperReport paper_report(const Results& results, const Cover& cover, const PaperTemplate& around) {
  Paper paper(results);
  paper.write(cover);
  const TemplateValues values = values_of(cover, paper);
  const std::string_view page = around.name.empty() ? page_paper : std::string_view(around.html);
  return {filled_template(page, around.name, values), paper.writer().figures(),
          paper.writer().tables()};
}

}  // namespace whirl::inline io
