#pragma once
/// The parts of a report's page, from the folder web/, put into the program by the build.

#include <string_view>

namespace whirl::inline io {

extern const std::string_view page_html;         ///< with places for the others
extern const std::string_view page_style;        ///< CSS
extern const std::string_view page_script;       ///< JavaScript
extern const std::string_view page_three;        ///< three.js, minified
extern const std::string_view page_paper;        ///< the report for paper, with places
extern const std::string_view page_paper_style;  ///< its CSS

}  // namespace whirl::inline io
