#pragma once
/// Which files this program wrote itself: only these may be replaced without being asked.

#include <filesystem>
#include <string>
#include <string_view>

namespace whirl::inline io {

enum class Origin {
  nowhere,  ///< there is no file, or nothing in it
  result,   ///< an HDF5 file that this program wrote
  picture,  ///< a picture, page, answer or export that this program wrote
  foreign,  ///< anything else
};

/// Where a file comes from, by its content, whatever its name.
///
/// Results have the attribute whirl_version. SVG, HTML, XML and the JSON of verbs and of the schema
/// carry a mark in their first or last lines, PNG, PDF, GIF and OGV that of mark_as_own; what early
/// versions wrote without a mark is known by its first lines. CSV tables and meshes of other
/// programs cannot carry a mark.
Origin origin_of(const std::filesystem::path& file);

/// What stands in the first lines of XML and HTML that this program writes.
constexpr std::string_view xml_mark = "<!-- written by whirl -->";
constexpr std::string_view html_mark = "<meta name=\"generator\" content=\"whirl\">";
/// The last entry of JSON that this program writes.
constexpr std::string_view json_mark_key = "program", json_mark = "whirl";

/// Marks a PNG, PDF, GIF or OGV that another program made, in a way that leaves it valid: PNG, a
/// text chunk "Software"; PDF, a comment before its last line; GIF, a comment block; OGV, the
/// vendor of Theora's comment header. Any other file stays as it is.
/// @throws FileError  if the file cannot be read or written
void mark_as_own(const std::filesystem::path& file);

/// The first line of a file, without its end, as far as 16 MB; empty if there is none.
std::string first_line(const std::filesystem::path& file);

}  // namespace whirl::inline io
