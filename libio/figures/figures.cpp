#include "libio/figures/figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/error.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/drawn_grid.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/call.hpp"
#include "libio/results/result_schema.hpp"

// clang-format off
#define KINDS            \
  layout_kind(),         \
  lateral_kind(),        \
  static_kind(),         \
  modes_kind(),          \
  campbell_kind(),       \
  log_decrement_kind(),  \
  critical_map_kind(),   \
  modes_over_kind(),     \
  root_locus_kind(),     \
  critical_over_kind(),  \
  bode_kind(),           \
  polar_kind(),          \
  forced_kind(),         \
  deflection_kind(),     \
  support_forces_kind(), \
  unbalance_over_kind(), \
  frf_kind(),            \
  sensitivity_kind(),    \
  support_fit_kind(),    \
  step_response_kind(),  \
  lateral_response_kind(), \
  coupling_kind(),       \
  balancing_kind(),      \
  orbit_kind(),          \
  time_history_kind(),   \
  spectrum_kind(),       \
  waterfall_kind(),      \
  orbits_kind(),         \
  centerline_kind(),     \
  measured_orbit_kind(), \
  measured_spectrum_kind(), \
  measured_waterfall_kind(), \
  measured_cascade_kind(), \
  measured_deflection_kind(), \
  order_bode_kind(),     \
  order_polar_kind(),    \
  trend_kind(),          \
  poincare_kind(),       \
  phase_plane_kind(),    \
  tilts_kind(),          \
  contact_motion_kind(), \
  contact_forces_kind(), \
  contact_angles_kind(), \
  support_history_kind(), \
  mac_kind(),            \
  all_spectra_kind(),    \
  stabilization_kind(),  \
  fit_kind(),            \
  exponents_kind(),      \
  bifurcation_kind(),    \
  exponents_over_kind(), \
  spectral_map_kind(),   \
  cascade_kind(),        \
  multipliers_kind(),    \
  branches_kind(),       \
  borders_kind(),        \
  torus_kind(),          \
  map_kind(),            \
  exponent_map_kind(),   \
  regime_map_kind(),     \
  shares_kind(),         \
  contact_edges_kind(),  \
  basins_kind(),         \
  work_precision_kind()
// clang-format on

namespace whirl::inline io {

// The list twice: as declarations of functions, each in the file of its figures, and as their
// calls.
FigureKind KINDS;

ResultView::ResultView(const std::filesystem::path& file_path)
    : path(file_path.string()), file(file_path) {
  check_result(file);
  if (file.has_attribute("/", "title")) title = file.string_attribute("/", "title");
  if (title.empty()) title = file_path.filename().string();
  try {
    if (file.has_attribute("/model", "path")) model_path = file.string_attribute("/model", "path");
    model = parse_model(stored_model(file), path);
    assembler.emplace(linear_structure(*model));
    const auto contacts = static_cast<Eigen::Index>(model->contacts.size());
    if (file.has("/contacts/name") && file.shape("/contacts/name").at(0) != contacts) {
      throw FileError(fmt::format("{}: /contacts/name is not of the contacts of its model", path));
    }
  } catch (const FileError&) {  // the file is damaged, not only its model
    throw;
  } catch (const std::exception& error) {  // figures of numbers alone are drawn nevertheless
    model.reset();
    assembler.reset();
    problem = error.what();
  }
}

std::optional<DisplayUnit> frequency_unit(std::string_view name) {
  for (const DisplayUnit& unit :
       {DisplayUnit{"Hz", 1.0 / hertz}, {"cpm", 1.0 / rpm}, {"rad/s", 1.0}}) {
    if (unit.name == name) return unit;
  }
  return std::nullopt;
}

const std::vector<FigureKind>& figure_kinds() {
  static const std::vector<FigureKind> kinds{KINDS};
  return kinds;
}

bool is_in(const FigureKind& kind, const ResultView& result) {
  if (kind.needs_model && !result.assembler) return false;
  const auto has = [&](const std::string& dataset) { return result.file.has(dataset); };
  const bool has_one =
      kind.needs_one.empty() || std::any_of(kind.needs_one.begin(), kind.needs_one.end(), has);
  return has_one && std::all_of(kind.needs.begin(), kind.needs.end(), has);
}

std::vector<Figure> figures_of(const FigureKind& kind, const ResultView& result) {
  if (!is_in(kind, result)) return {};
  std::vector<Figure> figures = kind.make(result);
  const std::string first = kind.first_need().empty() ? "/" : kind.first_need();
  const std::string note = figures::coarseness(result.file, first.substr(0, first.find('/', 1)));
  for (Figure& f : figures) {
    if (!note.empty()) f.notes.push_back(note);
    f.kind = kind.name;
    f.heading = kind.title;
    f.subject = kind.subject;
    if (f.title.empty()) f.title = result.title;
  }
  return figures;
}

}  // namespace whirl::inline io
