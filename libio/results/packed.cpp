#include "libio/results/packed.hpp"

#include "libio/results/hdf5.hpp"

namespace whirl::inline io {

namespace {

/// Of the arrangement of the numbers of all walks; it grows with every change of one. Files without
/// the number are of the first one.
constexpr int walk_format = 1;

std::string walk_of(std::string_view group) {
  return std::string(group) + "/walk";
}

}  // namespace

void write_walk_format(ResultWriter& file, std::string_view group) {
  file.attribute(walk_of(group), "format", walk_format);
}

Unpacker read_walk(const ResultReader& file, std::string_view group, std::vector<double> numbers) {
  const std::string path = walk_of(group);
  Unpacker walk(path, std::move(numbers));
  const double format =
      file.has_attribute(path, "format") ? file.number_attribute(path, "format") : 1.0;
  if (format != walk_format) {
    walk.fail(fmt::format("its format is {}, expected {}", format, walk_format));
  }
  return walk;
}

}  // namespace whirl::inline io
