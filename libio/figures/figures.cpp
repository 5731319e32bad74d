#include "libio/figures/figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/error.hpp"
#include "libio/figures/all.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/result_schema.hpp"

namespace whirl {

ResultView::ResultView(const std::filesystem::path& file_path)
    : path(file_path.string()), file(file_path) {
  check_result(file);
  if (file.has_attribute("/", "title")) title = file.string_attribute("/", "title");
  if (title.empty()) title = file_path.filename().string();
  try {
    if (file.has_attribute("/model", "path")) model_path = file.string_attribute("/model", "path");
    model = parse_model(file.strings("/model").at(0), path, {},
                        std::filesystem::path(model_path).parent_path());
    assembler.emplace(model->structure);
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
  static const std::vector<FigureKind> kinds{
      {"layout",
       "Layout",
       "the rotor to scale, with disks, bearings and contacts",
       {},
       true,
       layout_figures},
      {"static",
       "Sag and bending",
       "sag under gravity, bearing loads, bending moment and shear force",
       {"/static/z", "/static/deflection", "/static/moment", "/static/shear"},
       false,
       static_figures},
      {"modes",
       "Mode shapes",
       "mode shapes along the rotor",
       {"/modes/shape", "/points/z"},
       false,
       mode_figures},
      {"campbell",
       "Campbell",
       "natural frequencies over speed, with the critical speeds",
       {"/campbell/frequency"},
       false,
       campbell_figures},
      {"log_decrement",
       "Log decrement",
       "logarithmic decrements over speed, with the limit of stability",
       {"/campbell/log_decrement"},
       false,
       log_decrement_figures},
      {"critical_map",
       "Critical speeds",
       "critical speeds over the stiffness of the bearings",
       {"/critical/speed"},
       true,
       critical_figures},
      {"bode",
       "Bode",
       "amplitude and phase of the unbalance response",
       {"/unbalance/x"},
       false,
       bode_figures},
      {"polar",
       "Polar",
       "the same in the plane of its complex amplitude",
       {"/unbalance/x"},
       false,
       polar_figures},
      {"deflection",
       "Deflected shapes",
       "deflected shape at the peaks of the response",
       {"/unbalance/major", "/points/z"},
       false,
       deflection_figures},
      {"orbit",
       "Orbit",
       "path of a station, seen from the ground and from the rotor",
       {"/trajectory/x"},
       false,
       orbit_figures,
       true},
      {"time_history",
       "Time history",
       "displacements and contact forces in time",
       {"/trajectory/x"},
       false,
       time_history_figures,
       true},
      {"spectrum",
       "Spectrum",
       "full spectrum, backward left and forward right",
       {"/spectra/amplitude"},
       false,
       spectrum_figures},
      {"waterfall",
       "Waterfall",
       "full spectra one after another in time, one above the other",
       {"/trajectory/x"},
       false,
       waterfall_figures},
      {"poincare",
       "Poincaré",
       "where a station is once a revolution",
       {"/trajectory/x"},
       false,
       poincare_figures,
       true},
      {"contact_forces",
       "Contact forces",
       "normal and friction force of the contacts in time",
       {"/trajectory/normal_force"},
       false,
       contact_force_figures,
       true},
      {"contact_angles",
       "Contact angles",
       "where around the stator it touches, and how hard",
       {"/trajectory/normal_force", "/trajectory/coordinates"},
       true,
       contact_angle_figures},
      {"mac",
       "MAC",
       "which modes make up the peaks of the response",
       {"/mac/mac"},
       false,
       mac_figures},
      {"exponents",
       "Exponents",
       "Lyapunov exponents of the motion",
       {"/classify/exponent"},
       false,
       exponent_figures},
      {"bifurcation",
       "Bifurcation",
       "bifurcation diagram, with exponents, time in touch and forces",
       {"/sweep/poincare_x"},
       false,
       bifurcation_figures},
      {"spectral_map",
       "Spectral map",
       "spectra along a parameter, as colors",
       {"/sweep/spectrum"},
       false,
       spectral_map_figures},
      {"cascade",
       "Cascade",
       "spectra along a parameter, one above the other",
       {"/sweep/spectrum"},
       false,
       cascade_figures},
      {"branches",
       "Branches",
       "periodic orbits along a parameter, stable and unstable, with their bifurcations",
       {"/branch/max_radius"},
       false,
       branch_figures},
      {"borders",
       "Borders",
       "where periodic orbits change, in a plane of two parameters",
       {"/border/second"},
       false,
       border_figures},
      {"torus",
       "Quasi-periodic",
       "rotation and largest exponent of a quasi-periodic motion along a parameter",
       {"/torus/value"},
       false,
       torus_figures},
      {"map",
       "Map",
       "kinds of motion in a plane of two parameters",
       {"/map/motion"},
       false,
       map_figures},
      {"exponent_map",
       "Exponent map",
       "largest Lyapunov exponent in the plane",
       {"/map/exponent"},
       false,
       exponent_map_figures},
      {"regime_map",
       "Contact map",
       "contact in the plane",
       {"/map/regime"},
       false,
       regime_map_figures},
      {"basins",
       "Basins",
       "which motion each start leads to",
       {"/basins/attractor"},
       false,
       basin_figures},
      {"work_precision",
       "Speed against error",
       "speed against error of the integrators",
       {"/bench/error"},
       false,
       work_precision_figures},
  };
  return kinds;
}

bool is_in(const FigureKind& kind, const ResultView& result) {
  if (kind.needs_model && !result.assembler) return false;
  return std::all_of(kind.needs.begin(), kind.needs.end(), [&](std::string_view dataset) {
    return result.file.has(std::string(dataset));
  });
}

std::vector<Figure> figures_of(const FigureKind& kind, const ResultView& result) {
  if (!is_in(kind, result)) return {};
  std::vector<Figure> figures = kind.make(result);
  for (Figure& f : figures) {
    f.kind = kind.name;
    f.heading = kind.title;
    if (f.title.empty()) f.title = result.title;
  }
  return figures;
}

}  // namespace whirl
