#include "libio/drawing/terminal_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libio/drawing/disk_shape.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline io {

namespace {

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
    const Point p = assembler.point(station);
    return p.kind == Point::Kind::node ? assembler.mesh().z[static_cast<std::size_t>(p.index)]
                                       : -1.0;
  };
  for (const Connection& b : model.structure.bearings) all.push_back({place(b.from), "▲", b.name});
  for (const Connection& s : model.structure.seals) all.push_back({place(s.from), "≋", s.name});
  for (const Contact& c : model.contacts) all.push_back({place(c.at), "◯", c.name});
  for (const OilFilm& f : model.films) all.push_back({place(f.at), "▲", f.name});
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

std::string legend(const Structure& s, bool has_disk, bool has_symbol) {
  return std::string("  ▲ bearing   ") + (s.seals.empty() ? "" : "≋ seal   ") + "◯ contact" +
         (has_disk ? "   ▓ disk" : "") + (has_symbol ? "\n  ╎ disk, size not given (symbol)" : "");
}

}  // namespace

std::string draw_layout(const Model& model, const Assembler& assembler, int columns) {
  const Structure& s = model.structure;
  const double length = s.length();
  if (!(length > 0.0)) return "";
  const auto column = [&](double z) {
    return std::clamp(static_cast<int>(std::lround(z / length * (columns - 1))), 0, columns - 1);
  };
  // radii of shaft, disks and symbols of disks in every column
  std::vector<double> shaft(static_cast<std::size_t>(columns)), disk(shaft.size()),
      symbol(shaft.size());
  double largest = 0.0;
  for (int c = 0; c < columns; ++c) {
    shaft[static_cast<std::size_t>(c)] =
        0.5 * shaft_diameter(s, assembler.mesh(), length * (c + 0.5) / columns);
    largest = std::max(largest, shaft[static_cast<std::size_t>(c)]);
  }
  for (const Disk& d : s.disks) {
    const double z = assembler.mesh().z[static_cast<std::size_t>(assembler.point(d.at).index)];
    const DiskShape shape = disk_shape(d, model, assembler);
    const int middle = column(z),
              half = static_cast<int>(std::lround(0.5 * shape.width / length * columns));
    std::vector<double>& to = shape.not_given.empty() ? disk : symbol;
    for (int c = std::max(0, middle - half); c <= std::min(columns - 1, middle + half); ++c) {
      double& radius = to[static_cast<std::size_t>(c)];
      radius = std::max(radius, shape.outer_radius);
    }
    largest = std::max(largest, shape.outer_radius);
  }

  std::string text;
  for (int row = half_rows; row >= -half_rows; --row) {
    std::string line;
    for (std::size_t c = 0; c < shaft.size(); ++c) {
      const double at = (std::abs(row) - 0.5) / half_rows * largest;  // inner edge of the row
      const bool in_shaft = row == 0 || at < shaft[c] - 0.25 * largest / half_rows;
      line += in_shaft ? "█" : at < disk[c] ? "▓" : at < symbol[c] ? "╎" : " ";
    }
    line.erase(line.find_last_not_of(' ') + 1);
    if (line.empty()) continue;
    text += "  " + line + "\n";
  }

  // marks in one line, names below, each in the first line where it has room
  const std::vector<Mark> all = marks(model, assembler);
  std::vector<std::string> signs(static_cast<std::size_t>(columns), " ");
  std::vector<std::vector<std::string>> lines;
  for (const Mark& m : all) {
    const int c = column(m.z);
    std::string& sign = signs[static_cast<std::size_t>(c)];
    sign = sign == " " || sign == "┃" ? m.sign : sign;
    const std::string label = shortened(m.name, fmt::format(" ({:g} mm)", 1e3 * m.z), columns);
    const int width = static_cast<int>(display_width(label));
    const int start = std::clamp(c - width / 2, 0, std::max(0, columns - width));
    for (std::size_t i = 0;; ++i) {
      if (i == lines.size()) lines.emplace_back(static_cast<std::size_t>(columns), " ");
      auto& line = lines[i];
      const int from = std::max(0, start - 1), to = std::min(columns, start + width + 1);
      const bool is_free = std::all_of(line.begin() + from, line.begin() + to,
                                       [](const std::string& cell) { return cell == " "; });
      if (!is_free) continue;
      line[static_cast<std::size_t>(start)] = label;
      for (int k = 1; k < width && start + k < columns; ++k)
        line[static_cast<std::size_t>(start + k)] = "";
      break;
    }
  }
  if (!all.empty()) lines.insert(lines.begin(), signs);
  for (const auto& cells : lines) {
    std::string line;
    for (const std::string& cell : cells) line += cell;
    line.erase(line.find_last_not_of(' ') + 1);
    text += "  " + line + "\n";
  }
  return text + "\n" + legend(s, !is_flat(disk), !is_flat(symbol)) + "\n";
}

}  // namespace whirl::inline io
