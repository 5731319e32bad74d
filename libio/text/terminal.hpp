#pragma once
/// Where a program prints: how wide a line may be, and whether there is anything to print to.

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace whirl::inline io {

/// Columns of the terminal: those of the environment's COLUMNS, else those of standard output. 0
/// where standard output is no terminal, as in a pipe: lines may be of any width.
std::size_t terminal_columns();

/// A text whose long lines go on below, broken at blanks and indented as their beginnings are.
/// @param columns  0: no limit
std::string folded(const std::string& text, std::size_t columns);

/// Parts of a line at blanks, none wider than so many columns unless it is one word.
std::vector<std::string> folded_words(const std::string& line, std::size_t columns);

/// Whether a character of UTF-8 steers a terminal instead of being shown: a control character but
/// for the ends of lines and tabs, or one that turns the direction of what follows.
bool steers_terminal(std::string_view character);

/// A text that steers no terminal: characters that do so, and bytes that are no UTF-8, become
/// U+FFFD.
std::string shown_text(std::string_view text);

/// A name or title that may be a stranger's as part of a line: ends of lines become U+FFFD, too.
std::string shown_line(std::string_view text);

/// Prints a text as shown_text has it. All that a program tells people goes this way, since names,
/// titles and files of strangers stand in it.
void say(std::FILE* to, std::string_view text);

/// Opens /dev/null in place of standard streams that are closed: else a result file would get the
/// number of such a stream, and what is printed there would end in the file. Printing to a standard
/// output that was closed still fails.
void fill_standard_streams();

}  // namespace whirl::inline io
