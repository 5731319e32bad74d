#include "libio/results/packed.hpp"

#include "libio/results/hdf5.hpp"

namespace whirl::inline io {

namespace {

/// Of the arrangement of the numbers of all walks; it grows with every change of one. Files without
/// the number are of the first one.
constexpr int walk_format = 1;

}  // namespace

void write_walk(ResultWriter& file, const std::string& group, const Packer& walk) {
  const std::string path = group + "/walk";
  file.dataset(path, walk.numbers(), {"", "what the walk goes on from", {""}});
  file.attribute(path, "format", walk_format);
}

Unpacker read_walk(const ResultReader& file, const std::string& group) {
  const std::string path = group + "/walk";
  Unpacker walk(path, file.numbers(path));
  const double format =
      file.has_attribute(path, "format") ? file.number_attribute(path, "format") : 1.0;
  if (format != walk_format) {
    walk.fail(fmt::format("its format is {}, expected {}", format, walk_format));
  }
  return walk;
}

}  // namespace whirl::inline io
