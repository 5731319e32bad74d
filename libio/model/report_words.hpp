#pragma once
/// Words for the cover of a report. They are no part of a Model, as nothing is computed from them.

#include <string>
#include <string_view>
#include <tuple>

#include "libbase/structs/field.hpp"

namespace whirl::inline io {

/// What table [report] of a model file says; texts, empty where it does not say.
struct ReportWords {
  std::string title{}, company{}, client{}, project{}, document{}, revision{};
  std::string author{}, checked_by{}, approved_by{}, date{};
  std::string remarks{};  ///< paragraphs, a line each
  std::string units{};    ///< that numbers are shown in, as of ShownUnits::named

  static constexpr auto fields() {
    using enum Range;
    using R = ReportWords;
    return std::tuple{
        alternative("title", &R::title, "", any, "of the report; left out: that of the model"),
        alternative("company", &R::company, "", any, "that makes the analysis"),
        alternative("client", &R::client, "", any, "for whom it is made"),
        alternative("project", &R::project, "", any, "machine, order or tag number"),
        alternative("document", &R::document, "", any, "number of the report"),
        alternative("revision", &R::revision, "", any, "of the report"),
        alternative("author", &R::author, "", any, "who makes the analysis"),
        alternative("checked_by", &R::checked_by, "", any, "who checks it"),
        alternative("approved_by", &R::approved_by, "", any, "who approves it"),
        alternative("date", &R::date, "", any,
                    "of the report, in any form; left out: the day on which it is made"),
        alternative("remarks", &R::remarks, "", any,
                    "the author's own words on assumptions and results, a paragraph per line"),
        alternative("units", &R::units, "", any,
                    "that tables, figures and pages show numbers in, as of --units: \"us\"")};
  }
};

/// The words of a model file, which need not be one of a whole model.
/// @param text  of the file
/// @return      without words where the text is not TOML
ReportWords report_words(std::string_view text);

}  // namespace whirl::inline io
