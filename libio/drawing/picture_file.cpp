#include "libio/drawing/picture_file.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <optional>
#include <regex>
#include <vector>

#include "libbase/system/program.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/temporary_folder.hpp"

namespace whirl::inline io {

namespace {

namespace fs = std::filesystem;

constexpr double least_side = 20.0, most_side = 2000.0;   ///< of a picture [mm]
constexpr double least_font = 4.0, most_font = 40.0;      ///< [pt]
constexpr double least_marker = 0.1, most_marker = 40.0;  ///< [pt]

/// Lets rsvg-convert make another format of an SVG file.
void convert(const fs::path& svg, const fs::path& to, const PictureFileOptions& options) {
  std::vector<std::string> words{"rsvg-convert", "--format", std::string(name_of(options.format))};
  if (options.format == PictureFormat::pdf) {  // a pixel is 1/96 inch, as in browsers
    words.insert(words.end(), {"--dpi-x", "96", "--dpi-y", "96"});
  } else if (options.is_printed) {
    words.insert(words.end(), {"--dpi-x", "600", "--dpi-y", "600"});
  } else {
    words.insert(words.end(), {"--zoom", "2"});
  }
  // absolute, so that no name is taken for an option
  words.insert(words.end(), {"--output", fs::absolute(to).string(), fs::absolute(svg).string()});
  const std::optional<int> status = run_program(words);
  if (!status) {
    throw FileError(fmt::format(
        "cannot write {}: this needs rsvg-convert, of the Debian package librsvg2-bin (or write an "
        ".svg)",
        to.string()));
  }
  if (*status != 0) {
    throw FileError(fmt::format("cannot write {}: rsvg-convert failed", to.string()));
  }
}

}  // namespace

Parsed<PictureFormat> picture_format_of(std::string_view file) {
  for (const auto& [name, format] : choices(PictureFormat{})) {
    if (fs::path(file).extension() == fmt::format(".{}", name)) return format;
  }
  return Parsed<PictureFormat>::failed(
      "expected a file that ends in .svg, .png or .pdf, or --format");
}

Parsed<PrintedSides> parse_sides(std::string_view text) {
  static const std::regex pattern(
      R"(([0-9]*\.?[0-9]+)(mm|cm|in|pt)?x([0-9]*\.?[0-9]+)(mm|cm|in|pt))");
  static const std::map<std::string, double> units{
      {"mm", 1.0}, {"cm", 10.0}, {"in", 25.4}, {"pt", 25.4 / 72.0}};
  PrintedSides sides;
  std::match_results<std::string_view::const_iterator> parts;
  if (std::regex_match(text.begin(), text.end(), parts, pattern)) {
    const std::string unit = parts[4], first = parts[2].length() > 0 ? parts[2].str() : unit;
    sides.width = std::stod(parts[1]) * units.at(first);
    sides.height = std::stod(parts[3]) * units.at(unit);
  }
  const auto is_fit = [](double side) { return side >= least_side && side <= most_side; };
  if (is_fit(sides.width) && is_fit(sides.height)) return sides;
  return Parsed<PrintedSides>::failed(
      fmt::format("expected a size such as 85x60mm (mm, cm, in, pt), of {:g} to {:g} mm",
                  least_side, most_side));
}

namespace {

Parsed<double> parse_points(std::string_view text, double least, double most) {
  const double size = std::strtod(std::string(text).c_str(), nullptr);
  const bool is_number = text.find_first_not_of("0123456789.") == std::string_view::npos;
  if (is_number && size >= least && size <= most) return size;
  return Parsed<double>::failed(fmt::format("expected points, {:g} to {:g}", least, most));
}

}  // namespace

Parsed<double> parse_font(std::string_view text) {
  return parse_points(text, least_font, most_font);
}

Parsed<double> parse_marker_size(std::string_view text) {
  return parse_points(text, least_marker, most_marker);
}

void write_picture(const std::string& svg, const fs::path& place,
                   const PictureFileOptions& options) {
  if (options.format == PictureFormat::svg) return replace_file(place, svg, options.replaces);
  FileReplacement file(place, options.replaces);
  const TemporaryFolder folder("plot", place);
  const fs::path source = folder.path() / "picture.svg";
  replace_file(source, svg);
  convert(source, file.temporary(), options);
  mark_as_own(file.temporary());
  file.commit();
}

}  // namespace whirl::inline io
