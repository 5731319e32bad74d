#include "libio/drawing/terminal_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libio/drawing/disk_shape.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline io {

namespace {

/// " (250 mm)"
std::string place_text(double z) {
  const std::string unit = shown_unit("mm").name;
  return fmt::format(" ({}{}{})", shown_digits(z, "mm", 6), unit.empty() ? "" : " ", unit);
}

constexpr int half_rows = 4;  ///< above and below the axis

/// A mark below the rotor and what it stands for.
struct Mark {
  double z;
  const char* sign;
  std::string name;
};

std::vector<Mark> marks(const Model& model, const Assembler& assembler) {
  std::vector<Mark> all;
  const auto place = [&](const Station& station) {
    return assembler.mesh().position_of(assembler.point(station)).value_or(-1.0);
  };
  for (const Connection& b : model.structure.bearings) all.push_back({place(b.from), "▲", b.name});
  for (const Connection& s : model.structure.seals) all.push_back({place(s.from), "≋", s.name});
  for (const Contact& c : model.contacts) {
    if (c.limits) continue;  // supports are marked
    all.push_back({place(c.at), is_rolling_bearing(c) ? "▲" : "◯", c.name});
  }
  for (const OilFilm& f : model.films) all.push_back({place(f.at), "▲", f.name});
  for (const GearPair& g : model.structure.gears) {
    for (const Station* wheel : {&g.driving, &g.driven})
      all.push_back({place(*wheel), "✱", g.name});
  }
  for (const Support& support : model.structure.supports) {
    for (const Station* at : places_of(support)) all.push_back({place(*at), "△", support.name});
  }
  for (const Disk& d : model.structure.disks) all.push_back({place(d.at), "┃", d.name});
  std::erase_if(all, [](const Mark& m) { return m.z < 0.0; });
  std::stable_sort(all.begin(), all.end(), [](const Mark& a, const Mark& b) { return a.z < b.z; });
  return all;
}

/// A name and what follows it in so many columns; a longer name loses its end.
std::string shortened(const std::string& name, const std::string& rest, int columns) {
  const auto room = static_cast<std::size_t>(columns);
  const std::size_t beside = display_width(rest);
  if (display_width(name) + beside <= room) return name + rest;
  const std::size_t most = room > beside ? room - beside - 1 : 0;  // one is for the dots
  std::size_t end = 0, letters = 0;
  const auto begins_letter = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
  };
  for (; end < name.size(); ++end) {
    if (begins_letter(name[end]) && letters++ == most) break;
  }
  return name.substr(0, end) + "…" + rest;
}

bool is_flat(const std::vector<double>& radii) {
  return std::all_of(radii.begin(), radii.end(), [](double r) { return r == 0.0; });
}

std::string legend(const Structure& s, bool has_support, bool has_disk, bool has_symbol) {
  return std::string("  ▲ bearing   ") + (s.seals.empty() ? "" : "≋ seal   ") + "◯ contact" +
         (s.gears.empty() ? "" : "   ✱ gear") + (has_support ? "   △ support" : "") +
         (has_disk ? "   ▓ disk" : "") +
         (has_symbol ? "\n  ╎ disk, size not given (not to scale)" : "");
}

/// Radii over the columns of the picture.
struct Outline {
  std::vector<double> shaft, disk, symbol;  ///< a symbol stands for a disk without a size
  double largest = 0.0;
};

/// The column of each position along the rotor.
struct Columns {
  double length;
  int count;
  int of(double z) const {
    return std::clamp(static_cast<int>(std::lround(z / length * (count - 1))), 0, count - 1);
  }
};

Outline outline(const Model& model, const Assembler& assembler, const Columns& columns) {
  const Structure& s = model.structure;
  const auto count = static_cast<std::size_t>(columns.count);
  Outline outline{std::vector<double>(count), std::vector<double>(count),
                  std::vector<double>(count)};
  const int shafts = static_cast<int>(s.shafts().size());
  for (int c = 0; c < columns.count; ++c) {
    double& radius = outline.shaft[static_cast<std::size_t>(c)];
    const double z = columns.length * (c + 0.5) / columns.count;
    for (int of = 0; of < shafts; ++of)
      radius = std::max(radius, 0.5 * shaft_diameter(s, assembler.mesh(), z, of));
    outline.largest = std::max(outline.largest, radius);
  }
  for (const Disk& d : s.disks) {
    const double z = assembler.mesh().z[static_cast<std::size_t>(assembler.point(d.at).index)];
    const DiskShape shape = disk_shape(d, model, assembler);
    const int middle = columns.of(z);
    const int half =
        static_cast<int>(std::lround(0.5 * shape.width / columns.length * columns.count));
    std::vector<double>& to = shape.not_given.empty() ? outline.disk : outline.symbol;
    for (int c = std::max(0, middle - half); c <= std::min(columns.count - 1, middle + half); ++c) {
      double& radius = to[static_cast<std::size_t>(c)];
      radius = std::max(radius, shape.outer_radius);
    }
    outline.largest = std::max(outline.largest, shape.outer_radius);
  }
  return outline;
}

/// The line without blanks at its end, indented.
std::string indented(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line.empty() ? "" : "  " + line + "\n";
}

std::string rows_of(const Outline& outline) {
  std::string text;
  for (int row = half_rows; row >= -half_rows; --row) {
    std::string line;
    const double inner_edge = (std::abs(row) - 0.5) / half_rows * outline.largest;
    for (std::size_t c = 0; c < outline.shaft.size(); ++c) {
      const bool in_shaft =
          row == 0 || inner_edge < outline.shaft[c] - 0.25 * outline.largest / half_rows;
      line += in_shaft                         ? "█"
              : inner_edge < outline.disk[c]   ? "▓"
              : inner_edge < outline.symbol[c] ? "╎"
                                               : " ";
    }
    text += indented(line);
  }
  return text;
}

/// Marks in one line, names below, each in the first line where it has room.
std::string lines_of(const std::vector<Mark>& all, const Columns& columns) {
  std::vector<std::string> signs(static_cast<std::size_t>(columns.count), " ");
  std::vector<std::vector<std::string>> lines;
  for (const Mark& m : all) {
    const int c = columns.of(m.z);
    std::string& sign = signs[static_cast<std::size_t>(c)];
    sign = sign == " " || sign == "┃" ? m.sign : sign;
    const std::string label = shortened(m.name, place_text(m.z), columns.count);
    const int width = static_cast<int>(display_width(label));
    const int start = std::clamp(c - width / 2, 0, std::max(0, columns.count - width));
    for (std::size_t i = 0;; ++i) {
      if (i == lines.size()) lines.emplace_back(static_cast<std::size_t>(columns.count), " ");
      auto& line = lines[i];
      const int from = std::max(0, start - 1), to = std::min(columns.count, start + width + 1);
      const bool is_free = std::all_of(line.begin() + from, line.begin() + to,
                                       [](const std::string& cell) { return cell == " "; });
      if (!is_free) continue;
      line[static_cast<std::size_t>(start)] = label;
      for (int k = 1; k < width && start + k < columns.count; ++k)
        line[static_cast<std::size_t>(start + k)] = "";
      break;
    }
  }
  if (!all.empty()) lines.insert(lines.begin(), signs);
  std::string text;
  for (const auto& cells : lines) {
    std::string line;
    for (const std::string& cell : cells) line += cell;
    text += indented(line);
  }
  return text;
}

}  // namespace

std::string draw_layout(const Model& model, const Assembler& assembler, int columns) {
  const Structure& s = model.structure;
  const Columns places{s.extent(), columns};
  if (!(places.length > 0.0)) return "";
  const Outline radii = outline(model, assembler, places);
  const std::vector<Mark> below = marks(model, assembler);
  const bool has_support =
      std::ranges::any_of(below, [](const Mark& m) { return m.sign == std::string_view("△"); });
  return rows_of(radii) + lines_of(below, places) + "\n" +
         legend(s, has_support, !is_flat(radii.disk), !is_flat(radii.symbol)) + "\n";
}

}  // namespace whirl::inline io
