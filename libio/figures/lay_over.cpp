// What a continuation followed, over figures of studies of the same model.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libdyn/studies/map.hpp"
#include "libdyn/studies/sweep.hpp"
#include "libio/figures/bifurcation_curve_lines.hpp"
#include "libio/figures/branch_lines.hpp"
#include "libio/figures/comparison.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/results/call.hpp"
#include "libio/results/study_columns.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Shown numbers in one of SI, from the title of their axis: "x [mm]".
double shown_in_one(const std::string& title) {
  const auto bracket = title.rfind(" [");
  if (bracket == std::string::npos || !title.ends_with(']')) return 1.0;
  const auto one = parse_quantity("1 " + title.substr(bracket + 2, title.size() - bracket - 3));
  return one ? 1.0 / one->value : 1.0;
}

/// The largest of all contacts.
double largest_of_contacts(const std::vector<double>& numbers) {
  double most = 0.0;
  for (const double number : numbers) most = std::max(most, number);
  return most;
}

/// Lays branches over the panels of a bifurcation diagram that show numbers which branches have.
/// @param station  number of the figure's station among those of the branches
/// @param probe    whose readings the figure shows; null: it shows the station itself
void add_branches(Figure& f, const BranchPoints& b, std::size_t station, const Probe* probe) {
  const auto row = static_cast<Eigen::Index>(station);
  const Eigen::Index sections = b.size() > 0 ? b.of.points[0].sections_x.cols() : 0;
  const bool has_sections = sections > 0, has_contacts = !b.of.contacts.empty();
  const BranchStyle style{.is_named = true, .is_ink = true};
  for (Panel& p : f.panels) {
    const auto is_of = [&](const char* title) { return p.y.title.starts_with(title); };
    const auto add = [&](std::vector<double> values, double factor) {
      add_branch_lines(p, b, scaled(std::move(values), factor), style);
    };
    const bool is_section = is_of(probe ? "reading once a revolution" : "x once a revolution");
    if (is_section && probe && probe->is_axial()) continue;  // branches keep no tilts
    if (is_section && has_sections) {
      const double factor = shown_in_one(p.y.title);
      const auto seen = [&](const BranchOrbit& point, Eigen::Index k) {
        const double x = point.sections_x(row, k);
        const auto of = [&](int c) { return c == 0 ? x : point.sections_y(row, k); };
        return probe ? probe->reading(of) : x;
      };
      for (Eigen::Index k = 0; k < sections; ++k) {
        const std::vector<double> x =
            b.numbers([&](const BranchOrbit& point) { return factor * seen(point, k); });
        add_branch_lines(p, b, x, style);
        add_branch_marks(p, b, x);
      }
    } else if (is_of("exponent") && has_sections) {
      const auto exponent = [&](const BranchOrbit& point) {
        return std::log(largest_multiplier(point)) /
               b.period[static_cast<std::size_t>(point.branch) - 1];
      };
      add(b.numbers(exponent), 1.0);
    } else if (is_of("share in touch") && has_contacts) {
      add(b.numbers([](const BranchOrbit& o) { return largest_of_contacts(o.duty); }), 1.0);
    } else if (is_of("largest force") && has_contacts) {
      add(b.numbers([](const BranchOrbit& o) { return largest_of_contacts(o.max_normal); }),
          shown_in_one(p.y.title));
    } else if (probe && is_of("peak to peak")) {
      const std::vector<std::string>& names = b.of.probes.names;
      const auto named = std::find(names.begin(), names.end(), probe->name);
      const auto number = static_cast<std::size_t>(named - names.begin());
      add(b.numbers(&BranchOrbit::probe_peak_to_peak, number), shown_in_one(p.y.title));
    } else if (is_of("largest radius")) {
      add(b.numbers(&BranchOrbit::radii, station), shown_in_one(p.y.title));
    }
  }
}

std::string branches_over(std::vector<Figure>& figures, const ResultView& study,
                          const ResultView& over) {
  if (!over.file.has(dataset_of<BranchResult>(&BranchOrbit::radii))) {
    return "expected branches of whirl continue over a bifurcation diagram";
  }
  const ShownAxis axis = shown_axes(study, SweepResult::group).at(0);
  BranchPoints b(over);
  if (b.axis.path != axis.path) {
    return fmt::format("its branches run along {}, the sweep along {}", b.axis.path, axis.path);
  }
  b.show_as(axis);
  const auto ends = std::minmax_element(axis.values.begin(), axis.values.end());
  const bool is_within = std::any_of(b.axis.values.begin(), b.axis.values.end(), [&](double v) {
    return v >= *ends.first && v <= *ends.second;
  });
  if (!is_within) return "its branches have no point within the sweep's values";
  const std::vector<std::string>& stations = b.of.stations;
  bool fits = false;
  for (Figure& f : figures) {
    const Probe* probe = f.probes.empty() ? nullptr : probe_of(study, f.probes.front());
    const auto station = std::find_if(stations.begin(), stations.end(), [&](const auto& name) {
      return probe ? is_at(study, probe->at, name) : name == f.variant;
    });
    if (station == stations.end()) continue;
    add_branches(f, b, static_cast<std::size_t>(station - stations.begin()), probe);
    fits = true;
  }
  if (fits) return "";
  return fmt::format("it has no station of the sweep; it has {}", fmt::join(stations, ", "));
}

std::string bifurcation_curves_over(std::vector<Figure>& figures, const ResultView& study,
                                    const ResultView& over) {
  if (!over.file.has(dataset_of<CurveResult>(&CurvePlace::second))) {
    return "expected bifurcation curves over a map, of whirl continue with two --over";
  }
  const std::vector<ShownAxis> axes = shown_axes(study, MapResult::group);
  if (axes.size() > 2) return "bifurcation curves go over maps of two values, not of three";
  const ShownAxis &x = axes.at(0), &y = axes.at(1);
  const BifurcationCurvePoints b(over);
  const bool is_same = b.first.path == x.path && b.second.path == y.path,
             is_turned = b.first.path == y.path && b.second.path == x.path;
  if (!is_same && !is_turned) {
    return fmt::format(
        "its bifurcation curves are in the plane of {} and {}, the map in that of {} and {}",
        b.first.path, b.second.path, x.path, y.path);
  }
  const ShownAxis &along_x = is_same ? b.first : b.second, &along_y = is_same ? b.second : b.first;
  const auto curves = bifurcation_curve_lines(b, scaled(along_x.values, along_x.factor / x.factor),
                                              scaled(along_y.values, along_y.factor / y.factor));
  for (Figure& f : figures) {
    for (Curve c : curves) {
      c.is_key = false;  // the map says what is seen
      f.panels.at(0).curves.push_back(std::move(c));
    }
  }
  return "";
}

/// Whether two texts of a model say the same value: "0.001 m" and "1 mm".
bool is_same_value(const std::string& a, const std::string& b) {
  const auto x = parse_quantity(a), y = parse_quantity(b);
  constexpr double rounding = 1e-12;
  return x && y && std::abs(x->value - y->value) <= rounding * std::abs(x->value);
}

/// Parameters of a study or continuation, each path for itself.
std::vector<std::string> varied(const ResultView& result) {
  std::vector<StoredParameter> parameters = stored_parameters(result.file, SweepResult::group);
  for (StoredParameter& p : stored_parameters(result.file, MapResult::group)) {
    parameters.push_back(std::move(p));
  }
  for (const std::string& dataset : {dataset_of<BranchResult>(&BranchOrbit::value),
                                     dataset_of<CurveResult>(&CurvePlace::second)}) {
    if (result.file.has(dataset)) parameters.push_back(stored_parameter(result.file, dataset));
  }
  std::vector<std::string> paths;
  for (const StoredParameter& p : parameters) {
    const std::string& all = p.path;
    for (std::size_t from = 0; from <= all.size();) {
      const std::size_t to = std::min(all.find(',', from), all.size());
      paths.push_back(all.substr(from, to - from));
      from = to + 1;
    }
  }
  return paths;
}

}  // namespace

std::vector<std::string> other_values(const ResultView& study, const ResultView& over) {
  // what the study varies; of bifurcation curves the second value is fixed for the branches
  const std::vector<std::string> paths = varied(study);
  const FigureTable table =
      differences({stored_model(study.file), stored_model(over.file)}, {"a", "b"});
  std::vector<std::string> others;
  for (const auto& row : table.rows) {
    if (row[0] == "title" || is_same_value(row[1], row[2])) continue;
    if (std::find(paths.begin(), paths.end(), row[0]) == paths.end()) others.push_back(row[0]);
  }
  return others;
}

std::string lay_over(std::vector<Figure>& figures, const ResultView& study, const ResultView& over,
                     const std::string& name) {
  constexpr std::array<std::string_view, 3> maps{"map", "exponent_map", "regime_map"};
  if (figures.empty()) return "there is nothing to draw";
  const std::string& kind = figures.front().kind;
  std::string problem;
  if (kind == "bifurcation") {
    problem = branches_over(figures, study, over);
  } else if (std::find(maps.begin(), maps.end(), kind) != maps.end()) {
    problem = bifurcation_curves_over(figures, study, over);
  } else {
    problem = "something is laid over bifurcation, map, exponent_map and regime_map only";
  }
  if (!problem.empty()) return problem;
  std::string note = kind == "bifurcation"
                         ? fmt::format(
                               "Lines: periodic orbits of {}, solid where stable, dashed "
                               "where unstable.",
                               name)
                         : fmt::format(
                               "Lines: bifurcation curves of {}, thin where another multiplier is "
                               "outside of the unit circle.",
                               name);
  const std::string curves = dataset_of<CurveResult>(&CurvePlace::second);
  if (kind == "bifurcation" && over.file.has(curves)) {
    const ShownAxis second = shown_axis(over, curves);  // they begin on the branches
    note += fmt::format(" They are at {} = {:.6g}.", second.title, second.values.at(0));
  }
  if (const auto others = other_values(study, over); !others.empty()) {
    note += fmt::format(" Its model is another one in {}.", fmt::join(others, ", "));
  }
  for (Figure& f : figures) f.notes.push_back(note);
  return "";
}

}  // namespace whirl::inline io
