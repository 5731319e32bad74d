// Import of a machine as ROSS saves it: from its file to the model's, with all tables, read again.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

#include "libio/import/import_file.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl {
namespace {

namespace fs = std::filesystem;

std::string list(int rows, double first, double step) {
  std::string text = "[";
  for (int i = 0; i < rows; ++i) {
    text += (i > 0 ? ", " : "") + std::to_string(first + i * step);
  }
  return text + "]";
}

/// 54 elements between 55 nodes, 37 layers on them, 12 seals and two bearings by tables of ten
/// speeds.
std::string compressor() {
  std::string text = R"({"ross_version": "2.3.0", "parameters": {})";
  const auto element = [&](int number, int node, double inner, double outer) {
    const std::string tag = "Shaft Element " + std::to_string(number);
    const std::string id = std::to_string(inner), od = std::to_string(outer);
    text += ", \"ShaftElement_" + tag + "\": {\"L\": 0.03, \"idl\": " + id + ", \"odl\": " + od +
            ", \"idr\": " + id + ", \"odr\": " + od + ", \"n\": " + std::to_string(node) +
            R"(, "material": {"name": "steel", "rho": 7810.0, "E": 211e9, "G_s": 81.2e9},
            "axial_force": 0, "torque": 0, "shear_effects": true, "rotary_inertia": true,
            "gyroscopic": true, "shear_method_calc": "cowper", "alpha": 0.0, "beta": 0.0,
            "tag": ")" +
            tag + "\"}";
  };
  for (int i = 0; i < 54; ++i) element(i, i, 0.0, 0.1 + 0.001 * (i % 7));
  for (int i = 0; i < 37; ++i) element(54 + i, 8 + i, 0.11, 0.13 + 0.002 * (i % 5));
  for (int i = 0; i < 14; ++i) {
    const bool is_bearing = i < 2;
    const std::string tag = (is_bearing ? "bearing " : "seal ") + std::to_string(i);
    const int node = is_bearing ? 3 + 48 * i : 8 + 3 * i;
    text += (is_bearing ? ", \"BearingElement_" : ", \"SealElement_") + tag +
            "\": {\"n\": " + std::to_string(node) + ", \"tag\": \"" + tag + "\"";
    const double size = is_bearing ? 1e8 : 1e6;
    for (const std::string name : {"kxx", "kyy", "kxy", "kyx", "cxx", "cyy", "cxy", "cyx"}) {
      text += ", \"" + name + "\": " + list(10, name[0] == 'k' ? size : 1e-3 * size, 1e-2 * size);
    }
    text += ", \"frequency\": " + list(10, 100.0, 100.0) + "}";
  }
  return text + "}";
}

void ImportOf91Elements(benchmark::State& state) {
  const fs::path place = fs::temp_directory_path() / "whirl_import_bench";
  fs::create_directories(place);
  replace_file(place / "rotor.json", compressor(), Replaces::anything);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        import_file(place / "rotor.json", place / "rotor.toml", Replaces::anything));
  }
  fs::remove_all(place);
}
BENCHMARK(ImportOf91Elements)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace whirl
