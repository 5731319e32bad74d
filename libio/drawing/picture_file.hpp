#pragma once
/// Pictures as files: SVG, and PNG or PDF, which rsvg-convert makes of SVG.

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "libbase/structs/field.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// Formats of pictures; their names are the endings of files, too.
enum class PictureFormat { svg, png, pdf };
constexpr auto choices(PictureFormat) {
  return std::array{Choice<PictureFormat>{"svg", PictureFormat::svg},
                    Choice<PictureFormat>{"png", PictureFormat::png},
                    Choice<PictureFormat>{"pdf", PictureFormat::pdf}};
}
/// The format that a file's name ends in.
Parsed<PictureFormat> picture_format_of(std::string_view file);

/// Sides of a printed picture [mm].
struct PrintedSides {
  double width = 0.0, height = 0.0;
};
/// Reads sides such as 85x60mm: a unit (mm, cm, in, pt) of both, or one of each.
Parsed<PrintedSides> parse_sides(std::string_view text);

/// Reads the size of letters, a number of points without unit.
Parsed<double> parse_font(std::string_view text);

/// Reads the size of markers, a number of points without unit.
Parsed<double> parse_marker_size(std::string_view text);

struct PictureFileOptions {
  PictureFormat format = PictureFormat::svg;
  bool is_printed = false;  ///< its size is one on paper: PNG gets as many pixels as print needs
  Replaces replaces = Replaces::own_pictures;
};

/// Writes a picture, whole or not at all.
/// @throws FileError  if the file cannot be written; names the package of rsvg-convert if that is
///                    missing
void write_picture(const std::string& svg, const std::filesystem::path& place,
                   const PictureFileOptions& options);

}  // namespace whirl::inline io
