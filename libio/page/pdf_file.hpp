#pragma once
/// Pages as PDF files, printed by a program of its own.

#include <filesystem>
#include <string>

#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

/// The address of a file of this machine, or of a folder with a slash at its end, for pages:
/// "file:///a%20b.html".
std::string file_address(const std::filesystem::path& file);

/// Prints an HTML page to a PDF file, whole or not at all.
///
/// Chromium prints where it is installed, of a version that numbers pages, else WeasyPrint does.
/// The program runs without scripts, network or a profile of its user, and is ended after five
/// minutes.
///
/// @param html      whole page; files that it names are local ones
/// @throws FileError  if the file cannot be written, if neither program is installed, which names
///                    their Debian packages, or if the program fails
void write_pdf(const std::string& html, const std::filesystem::path& place, Replaces replaces);

}  // namespace whirl::inline io
