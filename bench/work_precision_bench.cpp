// Speed against error of our integrators, SUNDIALS and Boost.odeint, in one run, on the reference
// points of the rotor and stator: P1 (five impacts a revolution), P3 (permanent contact).
//
//   whirl_work_precision

#include <fmt/format.h>

#include "bench/odeint.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/system/model.hpp"
#include "libio/text/table.hpp"

namespace whirl {
namespace {

constexpr long settled = 400, revolutions = 20;
constexpr TimingOptions timing{.most_runs = 15, .most_time = 0.5, .least_time = 5e-3};

struct Row {
  Candidate candidate;
  std::vector<double> tolerances;
};

/// Who is measured on a point. A new engine is an entry here.
std::vector<Row> rows(const ContactSystem& system, const test::RotorStator& rotor) {
  const std::vector<double> usual{1e-6, 1e-8, 1e-10, 1e-12};
  std::vector<Row> all;
  for (const std::string_view name : candidate_names()) {
    all.push_back({candidate(system, name), usual});
  }
  all.push_back({odeint_candidate(rotor), usual});
  return all;
}

void run(const std::string& name, const test::RotorStator& rotor) {
  const Model model = rotor.model();
  const Scene scene = make_scene(model);
  MotionState start = start_state(model, scene, nullptr);
  integrate(Dop853{}, scene.contacts, start, settled, {});
  const ReferenceMotion reference = reference_motion(scene.contacts, start, revolutions);
  Table table({"method", "tolerance", "error", "ns/revolution", "steps/rev", "evaluations/rev"});
  for (const Row& row : rows(scene.contacts, rotor)) {
    for (const double tolerance : row.tolerances) {
      const TimedRun r =
          measure(row.candidate, tolerance, scene.contacts, start, reference, timing);
      const auto per = [](long count) {
        return fmt::format("{:.1f}", static_cast<double>(count) / revolutions);
      };
      table.row({r.method, fmt::format("{:.0e}", tolerance),
                 r.has_failed() ? "-" : fmt::format("{:.1e}", r.error),
                 r.has_failed() ? "-" : fmt::format("{:.0f}", 1e9 * r.time),
                 per(r.integration.cost.steps), per(r.integration.cost.evaluations)});
    }
  }
  fmt::print("{}: error after {} revolutions against {}, whose own error is about {:.0e}\n\n{}\n",
             name, revolutions, reference.made_by, reference.error, table.text());
}

}  // namespace
}  // namespace whirl

int main() {
  whirl::run("P1, five impacts a revolution", whirl::test::P1);
  whirl::run("P3, permanent contact", whirl::test::P3);
}
