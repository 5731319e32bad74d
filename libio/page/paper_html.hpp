#pragma once
/// Parts of a printed report as HTML: tables, figures, lists.

#include <string>
#include <string_view>
#include <vector>

#include "libio/drawing/figure.hpp"
#include "libio/page/sheet.hpp"

namespace whirl::inline io {

/// A table as HTML; a long one of few columns is half as long and has twice as many.
std::string table_html(const FigureTable& table);

/// The text of a model as HTML, texts of several rows row by row.
std::string model_listing(std::string_view text);

/// Writes parts of a report, with the numbers of its chapters, tables and figures.
class PaperWriter {
 public:
  /// A chapter on a new page, or a section of it.
  void chapter(std::string_view heading);
  void section(std::string_view heading);
  void paragraph(std::string_view text);
  /// A list of sentences, in the color of a warning or plain.
  void list(const std::vector<std::string>& sentences, std::string_view kind = "");
  void sheet(const Sheet& sheet);
  /// A figure with its number, titles and notes as caption; its table below.
  /// @param is_half  one of two side by side
  void figure(const Figure& figure, bool is_half = false);
  /// HTML as it is.
  void raw(std::string_view html) { html_ += html; }

  int figures() const { return figures_; }
  int tables() const { return tables_; }
  const std::string& html() const { return html_; }

 private:
  std::string html_{};
  int chapters_ = 0, sections_ = 0, figures_ = 0, tables_ = 0;
};

}  // namespace whirl::inline io
