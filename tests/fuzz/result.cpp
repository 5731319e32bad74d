// Result files: what a file holds instead of what whirl wrote is refused by its schema, or
// everything that reads results copes with it.
//
// The bytes of HDF5 are not what is tried here (foreign.cpp does, behind a child process), but
// what a stranger's file can say in them: each input is a list of edits of one of the seeds beside
// the corpus, read into memory once. An edit replaces a dataset or attribute, drops it, or gives it
// other sizes, another kind or single other values.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libio/drawing/figure_svg.hpp"
#include "libio/figures/figures.hpp"
#include "libio/page/report_page.hpp"
#include "libio/results/csv_tables.hpp"
#include "libio/results/hdf5.hpp"
#include "tests/fuzz/result_edits.hpp"
#include "tests/fuzz/scratch.hpp"

namespace {

namespace fs = std::filesystem;
using namespace whirl;

void use(const fs::path& path, const fs::path& folder) {
  try {
    auto result = std::make_unique<ResultView>(path);
    for (const FigureKind& kind : figure_kinds()) {
      for (const Figure& figure : figures_of(kind, *result)) svg_of(figure);
    }
    write_csv_tables(result->file, folder / "table");
    std::vector<std::unique_ptr<ResultView>> results;
    results.push_back(std::move(result));
    report_page(results, cover_of(results, {}));
  } catch (const FileError&) {
  } catch (const ModelError&) {
  } catch (const NumericalError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Scratch scratch;
  const fs::path path = scratch.folder / "result.h5";
  try {
    fuzz::write_edited({data, size}, path);
  } catch (const FileError&) {
    return 0;  // an edit that HDF5 cannot write
  }
  use(path, scratch.folder);
  return 0;
}
