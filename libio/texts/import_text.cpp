#include "libio/texts/import_text.hpp"

#include <fmt/format.h>

#include "libio/results/columns.hpp"

namespace whirl::inline io {

namespace {

std::string counted(std::size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

std::string listed(const char* heading, const std::vector<std::string>& lines) {
  std::string text = lines.empty() ? "" : fmt::format("\n  {}:\n", heading);
  for (const std::string& line : lines) text += fmt::format("    {}\n", line);
  return text;
}

}  // namespace

std::string text_of(const Imported& imported) {
  const Structure& s = imported.model.structure;
  std::string parts = counted(s.shaft.size(), "shaft segment");
  const std::pair<std::size_t, const char*> others[] = {
      {s.layers.size(), "layer"},     {s.disks.size(), "disk"}, {s.bodies.size(), "support"},
      {s.bearings.size(), "bearing"}, {s.seals.size(), "seal"}, {s.links.size(), "link"}};
  for (const auto& [count, name] : others) {
    if (count > 0) parts += ", " + counted(count, name);
  }
  return fmt::format("Imported {}\n{}{}{}", parts, listed("written", imported.files),
                     listed("taken differently", imported.taken_differently),
                     listed("left out", imported.left_out));
}

Record record_of(const Imported& imported) {
  return Record()
      .set("files", columns::record_value(imported.files, 1.0))
      .set("left_out", columns::record_value(imported.left_out, 1.0))
      .set("taken_differently", columns::record_value(imported.taken_differently, 1.0));
}

}  // namespace whirl::inline io
