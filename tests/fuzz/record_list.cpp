// Lists of records: records come of one, each of a regular file, or problems with their places.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "libbase/error.hpp"
#include "libio/measured/measurement.hpp"
#include "libio/results/replace_file.hpp"
#include "tests/fuzz/scratch.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace whirl;
  static const fuzz::Scratch scratch;
  const std::filesystem::path list = scratch.folder / "records.toml";
  std::ofstream(scratch.folder / "a.csv") << "time [s],x [um]\n0,1\n0.001,2\n0.002,1\n";
  std::ofstream(list, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    for (const SourcedRecord& one : read_records({.file = list.string()})) {
      if (one.record.samples.size() == 0 || !(one.record.rate > 0.0)) std::abort();
    }
  } catch (const ModelError& error) {
    if (error.problems().empty()) std::abort();
  } catch (const FileError&) {
  }
  return 0;
}
