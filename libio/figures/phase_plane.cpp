#include <fmt/format.h>

#include "libio/figures/result_of.hpp"
#include "libio/figures/sampled_motion.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr double drawn_planes = 48.0;  ///< revolutions, of a phase plane

std::vector<Figure> phase_plane_figures(const ResultView& result) {
  const Motion m(result);
  const MotionSamples shown = m.shown(drawn_planes);
  std::vector<Figure> figures;
  for (const std::size_t i : stations_by_interest(result, m.stations)) {
    const StationMotion& s = m.record.stations[i];
    Figure f{.variant = m.stations[i], .width = 900.0, .height = 460.0};
    f.columns = 2;
    f.subtitle = fmt::format("{}: phase planes{}", m.stations[i], at_speed(result));
    const auto begins = touches(m.record.normal, contact_at(result, m.stations[i]), shown);
    f.panels = {phase_plane(m, shown, {"x", s.x, rates(s.x, m.time), "m"}, begins),
                phase_plane(m, shown, {"y", s.y, rates(s.y, m.time), "m"}, begins)};
    f.notes = m.notes(drawn_planes);
    f.notes.push_back(rates_note(m));
    figures.push_back(std::move(f));
  }
  return figures;
}

}  // namespace

FigureKind phase_plane_kind() {
  return {
      .name = "phase_plane",
      .title = "Phase plane",
      .summary = "x against x', y against y', a dot a revolution, and where touch begins",
      .needs = {dataset_of<MotionRecord>(&StationMotion::x)},
      .make = phase_plane_figures,
      .takes_window = true,
  };
}

}  // namespace whirl::inline io
