// What keeping a large study costs: rows of a map that cost nothing to compute, kept as a study's
// are.
//
//   whirl_growing_study [points] [points of a saving] [FILE.h5]
//
// prints the table of docs/benchmarks.md
//
// The file is kept where it is named, for what else is done with it.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "libdyn/studies/map.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/call.hpp"
#include "libio/results/kept_study.hpp"
#include "libio/text/table.hpp"

namespace whirl {
namespace {

using clock = std::chrono::steady_clock;

double milliseconds_since(clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(clock::now() - begin).count();
}

/// Of a processor, since it began [s].
double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Memory of this process at its most [MB].
double most_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024.0;
  }
  return std::nan("");
}

/// A motion of the rotor in its stator, as a map keeps it: as many numbers as a chaotic one.
ClassifiedMotion row(std::size_t point) {
  const double x = std::fmod(0.6180339887 * static_cast<double>(point), 1.0);
  ClassifiedMotion motion{.kind = x < 0.3 ? MotionKind::quasi_periodic : MotionKind::chaotic,
                          .transient = 300,
                          .revolutions = 1000};
  motion.resolution = 1e-3 * x;
  for (int i = 0; i < 8; ++i) motion.exponents.push_back(x - i);
  motion.contacts.push_back(
      {.regime = Regime::intermittent, .duty = x, .impacts_per_rev = 3.0 * x});
  return motion;
}

/// What savings took, in ten parts of the study.
struct Costs {
  std::vector<std::vector<double>> of_part{10};
  void add(std::size_t done, std::size_t points, double cost) {
    of_part[std::min<std::size_t>(9, 10 * done / points)].push_back(cost);
  }
};

void print(const Costs& costs, const std::filesystem::path& file) {
  Table table({"done [%]", "savings", "median [ms]", "largest [ms]"});
  for (std::size_t i = 0; i < costs.of_part.size(); ++i) {
    std::vector<double> all = costs.of_part[i];
    if (all.empty()) continue;
    std::sort(all.begin(), all.end());
    table.row({fmt::format("{} to {}", 10 * i, 10 * i + 10), std::to_string(all.size()),
               fmt::format("{:.1f}", all[all.size() / 2]), fmt::format("{:.1f}", all.back())});
  }
  fmt::print("{}\n{:.0f} MB of memory at most; the file has {:.0f} MB\n", table.text(),
             most_memory(), static_cast<double>(std::filesystem::file_size(file)) / 1e6);
}

int run(std::size_t points, std::size_t at_once, const std::string& kept) {
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(points))));
  const auto axis = [&](const char* path, double first, double last) {
    return fmt::format("{}={}:{}", path, first, last);
  };
  const StudyPoints study_points(
      read_model(WHIRL_MODELS "/jeffcott_stator.toml"),
      parse_axes({axis("operation.speed", 130, 165), axis("contact.ring.friction", 0.0, 0.3)},
                 static_cast<int>(side), 2, 2),
      std::nullopt);
  const std::filesystem::path file =
      kept.empty() ? std::filesystem::temp_directory_path() / "whirl_growing.h5"
                   : std::filesystem::path(kept);
  std::filesystem::remove(file);
  const Model& model = study_points.model();
  const StudyKeeping keeping{
      .place = {.file = file.string(),
                .call = {.verb = "map"},
                .model = model.source,
                .version = "bench"},
      .begin = [&] {
        auto writer = std::make_unique<ResultWriter>(file, Replaces::own_results);
        write_origin(*writer, {{.verb = "map"}, {"whirl", "map"}, "bench"}, model);
        return writer;
      }};
  Costs costs;
  double whole = 0.0;
  const auto grow = [&](MapResult result, const Monitor<MapResult>& monitor) {
    result.system =
        study_system(*study_points.models().member(study_points.grid().values_at(0)).scene, {});
    result.points.resize(study_points.grid().points());
    std::vector<std::size_t> news;
    for (std::size_t i = 0; i < result.points.size(); ++i) {
      result.points.set(i, row(i));
      news.push_back(i);
      if (news.size() < at_once) continue;
      const auto begin = clock::now();
      monitor.add(result, news);
      costs.add(i, result.points.size(), milliseconds_since(begin));
      news.clear();
    }
    monitor.add(result, news);
    const double begin = processor_time();
    monitor.save(result);
    whole = processor_time() - begin;
    return result;
  };
  const auto study = [&](const auto& f) {
    run_study<MapResult>(keeping, study_points, study_points.grid().points(), f,
                         [](std::size_t i) { return std::to_string(i); });
  };
  study(grow);
  print(costs, file);
  const double begin = processor_time();
  study([](MapResult result, const auto&) { return result; });
  fmt::print("of a processor: {:.1f} s for the whole file, {:.1f} s to go on with it\n", whole,
             processor_time() - begin);
  if (kept.empty()) std::filesystem::remove(file);
  return 0;
}

}  // namespace
}  // namespace whirl

int main(int argc, char** argv) {
  const auto number = [&](int i, std::size_t otherwise) {
    return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
  };
  return whirl::run(number(1, 1'000'000), number(2, 2000), argc > 3 ? argv[3] : "");
}
