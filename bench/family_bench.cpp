// What a point of a study costs before its motion: the model at a value, assembled and reduced. As
// a member of a family, and by reading the whole text again.

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "libio/model/model_family.hpp"
#include "libio/model/model_file.hpp"

namespace whirl {
namespace {

const char* path_of(int which) {
  return which == 0 ? WHIRL_MODELS "/two_disk_mac.toml" : WHIRL_MODELS "/jeffcott_stator.toml";
}

ParameterAxis axis_of(int which) {
  const char* axes[] = {"contact.ring.stiffness=4e6 N/m", "operation.speed=400 rad/s",
                        "gravity=9.81 m/s^2"};
  return *parse_axis(axes[which], 0);
}

void MemberOfAFamily(benchmark::State& state) {
  const Model base = read_model(path_of(static_cast<int>(state.range(0))));
  const ModelFamily family(base, {axis_of(static_cast<int>(state.range(1)))});
  double value = axis_of(static_cast<int>(state.range(1))).values[0];
  for (auto _ : state) {
    value *= 1.0 + 1e-9;  // never the same
    const Model member = family.model(std::vector{value});
    benchmark::DoNotOptimize(family.scene(member).get());
  }
}

void WholeModel(benchmark::State& state) {
  const Model base = read_model(path_of(static_cast<int>(state.range(0))));
  const ParameterAxis axis = axis_of(static_cast<int>(state.range(1)));
  double value = axis.values[0];
  for (auto _ : state) {
    value *= 1.0 + 1e-9;
    const Model member = parse_model(base.source, base.path, axis.assignments_of(value));
    benchmark::DoNotOptimize(make_scene(member, ReductionEstimate::no).contacts.coordinates());
  }
}

/// Two-disk rotor, rotor and stator; a contact's stiffness, the speed, gravity (all again).
void cases(benchmark::internal::Benchmark* b) {
  b->ArgsProduct({{0, 1}, {0, 1, 2}})->ArgNames({"model", "axis"})->Unit(benchmark::kMicrosecond);
}
BENCHMARK(MemberOfAFamily)->Apply(cases);
BENCHMARK(WholeModel)->Apply(cases);

}  // namespace
}  // namespace whirl
