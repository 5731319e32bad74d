// Linear rotordynamics: time from a structure in memory to the result, one core.

#include <benchmark/benchmark.h>

#include <numbers>

#include "libdyn/system/film_equilibrium.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/unbalance.hpp"
#include "libio/model/model_file.hpp"

namespace whirl {
namespace {

constexpr double rpm = std::numbers::pi / 30.0;

/// The two-disk rotor of models/two_disk_mac.toml with a number of nodes.
Structure rotor(int nodes) {
  std::string text = R"(
format = 1
material.steel = { density = 7800, youngs_modulus = "211 GPa", shear_modulus = "81.2 GPa" }
[[shaft]]
material = "steel"
length = "600 mm"
outer_diameter = "20 mm"
)";
  text += "elements = " + std::to_string(nodes - 1) + "\n";
  for (const std::string at : {"150 mm", "400 mm"}) {
    text +=
        "[[disk]]\nmaterial = \"steel\"\nouter_diameter = \"300 mm\"\ninner_diameter = \"20 "
        "mm\"\nwidth = \"10 mm\"\n"
        "unbalance = { offset = \"0.5 mm\" }\nat = \"" +
        at + "\"\n";
  }
  for (const std::string at : {"0 mm", "600 mm"}) {
    text += "[[bearing]]\nstiffness = \"4 MN/m\"\ndamping = \"5e3 N.s/m\"\nat = \"" + at + "\"\n";
  }
  return parse_model(text).structure;
}

std::vector<double> speeds(int count, double last) {
  std::vector<double> values;
  for (int i = 1; i <= count; ++i) values.push_back(last * i / count);
  return values;
}

void Campbell50Nodes100Speeds6Modes(benchmark::State& state) {
  const Structure s = rotor(50);
  for (auto _ : state) {
    const Assembler assembler(s);
    benchmark::DoNotOptimize(campbell(assembler, speeds(100, 8000.0 * rpm), 6));
  }
}
BENCHMARK(Campbell50Nodes100Speeds6Modes)->Unit(benchmark::kMillisecond);

/// A machine on oil films with twelve seals by tables: from the model to its diagram.
void CampbellOfTheCompressor100Speeds(benchmark::State& state) {
  const Model model = read_model(WHIRL_MODELS "/compressor.toml");
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        campbell(Assembler(linear_structure(model)), speeds(100, 12000.0 * rpm), 8));
  }
}
BENCHMARK(CampbellOfTheCompressor100Speeds)->Unit(benchmark::kMillisecond);

void find_modes(benchmark::State& state, Completeness completeness) {
  const Structure s = rotor(1000);
  for (auto _ : state) {
    const Assembler assembler(s);
    benchmark::DoNotOptimize(complex_modes(assembler.at(4000.0 * rpm), 8, completeness));
  }
}
void Modes1000NodesAtOneSpeed(benchmark::State& state) {
  find_modes(state, Completeness::proven);
}
void Modes1000NodesAtOneSpeedUnproven(benchmark::State& state) {
  find_modes(state, Completeness::unproven);
}
BENCHMARK(Modes1000NodesAtOneSpeed)->Unit(benchmark::kMillisecond);
BENCHMARK(Modes1000NodesAtOneSpeedUnproven)->Unit(benchmark::kMillisecond);

void Unbalance50Nodes500Speeds(benchmark::State& state) {
  const Structure s = rotor(50);
  for (auto _ : state) {
    const Assembler assembler(s);
    std::vector<Point> points;
    for (int i = 0; i < assembler.mesh().nodes(); ++i) points.push_back({Point::Kind::node, i});
    benchmark::DoNotOptimize(unbalance_response(assembler, speeds(500, 8000.0 * rpm), points));
  }
}
BENCHMARK(Unbalance50Nodes500Speeds)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace whirl
