#include "libio/page/paper_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "libio/drawing/figure_svg.hpp"
#include "libio/text/xml.hpp"

namespace whirl::inline io {

namespace {

constexpr double full_width = 174.0, half_width = 84.0;  ///< of figures [mm], A4 without margins
/// Most height [mm]: two figures fill a page; one of many rows of panels has a page to itself.
constexpr double most_height = 104.0, tall_height = 205.0;
constexpr double letters = 7.5;  ///< of figures [pt]

/// An SVG document as part of a page: without its head, with names of its own.
std::string inline_svg(std::string svg, int number) {
  svg.erase(0, svg.find("<svg"));
  const std::string own = fmt::format("figure{}-clip", number);
  for (const std::string_view before : {"id=\"", "url(#"}) {
    const std::string old = std::string(before) + "clip", now = std::string(before) + own;
    for (auto at = svg.find(old); at != std::string::npos; at = svg.find(old, at + now.size())) {
      svg.replace(at, old.size(), now);
    }
  }
  return svg;
}

/// Whether a figure has so many panels below each other that half a page is not enough.
bool is_tall(const Figure& figure) {
  constexpr std::size_t many = 4;
  return figure.panels.size() / static_cast<std::size_t>(std::max(1, figure.columns)) >= many;
}

/// A figure without what its caption says, as large as the paper lets it be.
std::string drawn(Figure figure, double width) {
  figure.title.clear();
  figure.subtitle.clear();
  figure.notes.clear();
  figure.table = {};
  const double most = is_tall(figure) ? tall_height : most_height;
  const double height = std::min(most, width * figure.height / figure.width);
  const Picture picture =
      picture_of(figure, {.width = width, .height = height, .font = letters, .has_title = false});
  if (picture.left_out.empty()) return picture.svg;
  return svg_of(figure);  // as large as it wants to be, and then made smaller
}

/// Whether a cell holds a number, perhaps with a sign or share: no letters but that of an exponent.
bool is_number(const std::string& cell) {
  return cell == "none" || std::none_of(cell.begin(), cell.end(), [](unsigned char c) {
           return std::isalpha(c) && c != 'e';
         });
}

/// Whether a column holds numbers, which stand right.
std::vector<bool> number_columns(const FigureTable& t) {
  std::vector<bool> are(t.header.size(), !t.rows.empty());
  for (const auto& row : t.rows) {
    for (std::size_t c = 0; c < std::min(row.size(), are.size()); ++c) {
      are[c] = are[c] && is_number(row[c]);
    }
  }
  return are;
}

/// A long table of few columns as one half as long of twice as many.
FigureTable folded(const FigureTable& t) {
  constexpr std::size_t most_columns = 3, long_table = 12;
  if (t.header.size() > most_columns || t.rows.size() < long_table) return t;
  const std::size_t half = (t.rows.size() + 1) / 2;
  FigureTable twice{.header = t.header};
  twice.header.insert(twice.header.end(), t.header.begin(), t.header.end());
  for (std::size_t i = 0; i < half; ++i) {
    std::vector<std::string> row = t.rows[i];
    row.resize(t.header.size());
    if (i + half < t.rows.size()) {
      row.insert(row.end(), t.rows[i + half].begin(), t.rows[i + half].end());
    }
    row.resize(twice.header.size());
    twice.rows.push_back(std::move(row));
  }
  return twice;
}

/// How a cell looks that says a verdict.
const char* verdict_class(const std::string& cell) {
  if (cell == "FAILED" || cell == "NOT KEPT" || cell == "UNSTABLE") return "failed";
  if (cell == "passed" || cell == "kept" || cell == "stable") return "passed";
  constexpr std::string_view open[] = {"unknown", "not checked", "passed in part", "not known"};
  return std::find(std::begin(open), std::end(open), cell) != std::end(open) ? "open" : "";
}

/// A sentence that begins with a capital letter and ends with a point.
std::string sentence(std::string text) {
  if (!text.empty() && std::string_view(".!?:").find(text.back()) == std::string_view::npos) {
    text += '.';
  }
  return text;
}

/// What a figure shows, said once: subtitles of many begin with their kind, or name their station.
std::string caption_of(const Figure& f) {
  const bool names_variant = f.variant.empty() || f.subtitle.find(f.variant) != std::string::npos;
  std::string caption = names_variant ? f.heading : fmt::format("{}, {}", f.heading, f.variant);
  if (f.subtitle.empty()) return sentence(caption);
  if (names_variant && f.subtitle.starts_with(f.heading)) return sentence(f.subtitle);
  return sentence(caption) + " " + sentence(f.subtitle);
}

}  // namespace

std::string table_html(const FigureTable& given) {
  const FigureTable t = folded(given);
  const std::vector<bool> are_numbers = number_columns(t);
  constexpr std::size_t many = 9, pair = 2;  // columns
  std::string html = t.header.size() > many    ? "<table class=\"dense\">\n<thead><tr>"
                     : t.header.size() == pair ? "<table class=\"pair\">\n<thead><tr>"
                                               : "<table>\n<thead><tr>";
  for (std::size_t c = 0; c < t.header.size(); ++c) {
    html +=
        fmt::format("<th{}>{}</th>", are_numbers[c] ? " class=\"n\"" : "", xml_text(t.header[c]));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : t.rows) {
    html += "<tr>";
    for (std::size_t c = 0; c < std::min(row.size(), t.header.size()); ++c) {
      const std::string kind = are_numbers[c] ? "n" : verdict_class(row[c]);
      html += fmt::format("<td{}>{}</td>", kind.empty() ? "" : fmt::format(" class=\"{}\"", kind),
                          xml_text(row[c]));
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

void PaperWriter::chapter(std::string_view heading) {
  ++chapters_;
  sections_ = 0;
  html_ += fmt::format("<h1>{} {}</h1>\n", chapters_, xml_text(heading));
}

void PaperWriter::section(std::string_view heading) {
  ++sections_;
  html_ += fmt::format("<h2>{}.{} {}</h2>\n", chapters_, sections_, xml_text(heading));
}

void PaperWriter::paragraph(std::string_view text) {
  html_ += fmt::format("<p>{}</p>\n", xml_text(text));
}

void PaperWriter::list(const std::vector<std::string>& sentences, std::string_view kind) {
  if (sentences.empty()) return;
  html_ += kind.empty() ? "<ul>\n" : fmt::format("<ul class=\"{}\">\n", kind);
  for (const std::string& text : sentences) {
    html_ += fmt::format("<li>{}</li>\n", xml_text(sentence(text)));
  }
  html_ += "</ul>\n";
}

void PaperWriter::sheet(const Sheet& sheet) {
  ++tables_;
  html_ += fmt::format("<div class=\"sheet{}\">\n<p class=\"caption\"><b>Table {}.</b> {}</p>\n",
                       sheet.table.rows.size() <= 12 ? " whole" : "", tables_,
                       xml_text(sentence(sheet.caption)));
  if (!sheet.table.rows.empty()) html_ += table_html(sheet.table);
  for (const std::string& note : sheet.notes) {
    html_ += fmt::format("<p class=\"note\">{}</p>\n", xml_text(sentence(note)));
  }
  html_ += "</div>\n";
}

void PaperWriter::figure(const Figure& f, bool is_half) {
  ++figures_;
  const std::string kind = is_half ? " class=\"half\"" : is_tall(f) ? " class=\"tall\"" : "";
  html_ += fmt::format("<figure{}>\n{}<figcaption><b>Figure {}.</b> {}", kind,
                       inline_svg(drawn(f, is_half ? half_width : full_width), figures_), figures_,
                       xml_text(caption_of(f)));
  for (const std::string& note : f.notes) html_ += " " + xml_text(sentence(note));
  html_ += "</figcaption>\n</figure>\n";
  if (!f.table.rows.empty()) sheet({fmt::format("Numbers of figure {}", figures_), f.table});
}

namespace {

/// A model whose texts of several rows, which a result holds in one line each, stand row by row:
/// the same model to a reader of TOML.
std::string with_rows_apart(std::string_view text) {
  constexpr std::string_view row_end = "\\n", quotes = "\"\"\"";
  std::string out;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), end + 1));
    const auto first = line.find('"');
    const bool is_one_text = first != line.npos && line.ends_with('"') &&
                             line.substr(0, first).find('=') != line.npos &&
                             line.find(row_end) != line.npos && line.find("\\\\") == line.npos;
    if (!is_one_text) {
      out += std::string(line) + '\n';
      continue;
    }
    std::string rows(line.substr(first + 1, line.size() - first - 2));
    for (auto at = rows.find(row_end); at != rows.npos; at = rows.find(row_end, at)) {
      rows.replace(at, row_end.size(), "\n");
    }
    out += fmt::format("{}{}\n{}{}\n", line.substr(0, first), quotes, rows, quotes);
  }
  return out;
}

/// Text with its line breaks.
std::string xml_lines(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    out += xml_text(text.substr(0, end)) + '\n';
    text.remove_prefix(std::min(text.size(), end + 1));
  }
  return out;
}

}  // namespace

std::string model_listing(std::string_view text) {
  return xml_lines(with_rows_apart(text));
}

}  // namespace whirl::inline io
