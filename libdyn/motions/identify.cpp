#include "libdyn/motions/identify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "libdyn/motions/motion_lines.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/own_frequency_modes.hpp"
#include "libfe/analyses/reduced_modes.hpp"
#include "libfe/assembly/excitations.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int largest_number = 9;     ///< in a ratio p:q
constexpr double good_enough = 0.01;  ///< error of a ratio from which smaller numbers are preferred
constexpr double located = 0.25;      ///< error of a peak's place, in bins
constexpr double wide = 1.5;          ///< distance of one line from another, in bins
constexpr double same_mac = 1e-6;     ///< difference of values that nothing tells apart

/// The two strongest lines that turn in the rotating frame.
std::optional<FrequencyRatio> resonance_of(const std::vector<IdentifiedPeak>& peaks) {
  std::vector<double> turning;
  for (const IdentifiedPeak& p : peaks) {
    if (p.forced.empty()) turning.push_back(std::abs(p.frequency_rotating));
  }
  if (turning.size() < 2) return std::nullopt;
  return ratio_of(std::max(turning[0], turning[1]), std::min(turning[0], turning[1]));
}

/// Peaks of the whole response, without the weaker halves of elliptic motions: these are in the
/// deflection shapes of the stronger ones already.
std::vector<Peak> distinct_peaks(const Vec& total, double bin, const IdentifyOptions& options) {
  std::vector<Peak> kept;
  for (const Peak& peak : find_peaks(total, bin, options.share, 4 * options.most_peaks)) {
    const bool is_other_half = std::any_of(kept.begin(), kept.end(), [&](const Peak& p) {
      return std::abs(p.frequency + peak.frequency) < wide * bin;
    });
    if (!is_other_half) kept.push_back(peak);
  }
  if (static_cast<int>(kept.size()) > options.most_peaks) {
    kept.resize(static_cast<std::size_t>(options.most_peaks));
  }
  return kept;
}

/// Names the peaks that are forced, and those that are combinations of stronger ones.
void find_causes(std::vector<IdentifiedPeak>& peaks, const std::vector<ForcedLine>& lines,
                 double bin) {
  std::vector<double> stronger;
  for (IdentifiedPeak& p : peaks) {
    const ForcedLine* forced = forced_line_at(p.frequency, lines, bin);
    if (forced) p.forced = forced->name;
    if (std::abs(p.frequency) < wide * bin) continue;  // it rests
    if (!forced) p.combination = combination_of(p.frequency, stronger, located * bin);
    if (!p.combination) stronger.push_back(forced ? forced->frequency : p.frequency);
  }
}

}  // namespace

int most_alike(const std::vector<double>& mac) {
  const auto most = std::max_element(mac.begin(), mac.end());
  if (most == mac.end()) return -1;
  const auto first =
      std::find_if(mac.begin(), mac.end(), [&](double m) { return m >= *most - same_mac; });
  return static_cast<int>(first - mac.begin());
}

std::vector<ForcedLine> forced_lines(const Assembler& assembler, double Omega) {
  std::vector<ForcedLine> lines{{"1X", Omega}};
  if (has_synchronous_force(assembler.structure())) lines.push_back({"1X", -Omega});
  for (const Excitation& load : other_excitations(assembler)) {
    const double w = load.frequency_at(Omega);
    if (w == 0.0) continue;  // of an order, at rest
    lines.push_back({load.label(), w});
    lines.push_back({load.label(), -w});
  }
  return lines;
}

const ForcedLine* forced_line_at(double frequency, const std::vector<ForcedLine>& lines,
                                 double bin) {
  const ForcedLine* nearest = nullptr;
  double least = wide * bin;
  for (const ForcedLine& line : lines) {
    const double away = std::abs(frequency - line.frequency);
    if (away < least) least = away, nearest = &line;
  }
  return nearest;
}

FrequencyRatio ratio_of(double high, double low) {
  FrequencyRatio best;
  double least = std::numeric_limits<double>::infinity();
  const double ratio = high / low;
  for (int sum = 2; sum <= 2 * largest_number; ++sum) {
    for (int q = 1; q <= sum / 2; ++q) {
      const int p = sum - q;
      if (p > largest_number || std::gcd(p, q) != 1) continue;
      const double error = std::abs(ratio * q / p - 1.0);
      if (error >= least) continue;
      least = error;
      best = {p, q, error, high, low};
    }
    if (least < good_enough) break;
  }
  return best;
}

Sparse mac_weights(const DofMap& dofs, double length) {
  std::vector<Triplet> entries;
  for (const Point& p : dofs.points()) {
    for (int component = 0; component < 4; ++component) {
      const int i = dofs.full_index(p, component);
      if (i >= 0) entries.emplace_back(i, i, component >= THETA_X ? length * length : 1.0);
    }
  }
  Sparse W(dofs.full_size, dofs.full_size);
  W.setFromTriplets(entries.begin(), entries.end());
  return dofs.T.transpose() * Sparse(W * dofs.T);
}

System stiffened(const Model& model, const Scene& scene) {
  return stiffened(model, scene, linear_system(model, scene));
}

System stiffened(const Model& model, const Scene& scene, System system) {
  int owner = -1;
  for (const ReducedContact& reduced : scene.contacts.contacts()) {
    if (reduced.owner == owner) continue;  // another place
    owner = reduced.owner;
    const Contact& c = model.contacts[static_cast<std::size_t>(owner)];
    if (!is_with_stator(c)) continue;  // linear systems have it
    const double depth = 1e-3 * c.clearance;
    // of the reduced contact, whose law knows how a blade bends
    const double k = normal_force(reduced.law, depth, 0.0) / depth;
    const PlaneRows rows = closing_rows(c, scene.assembler, system.dofs);
    const auto direction = direction_of(reduced.geometry);
    const std::vector<Vec2> pressed =
        direction ? std::vector{*direction} : std::vector<Vec2>{Vec2::UnitX(), Vec2::UnitY()};
    for (const Vec2& n : pressed) {
      const Sparse column = Vec(rows.transpose() * n).sparseView();
      system.K += k * Sparse(column * Sparse(column.transpose()));
    }
  }
  return system;
}

std::vector<Mode> compared_modes(const Model& model, const Scene& scene,
                                 const IdentifyOptions& options) {
  if (options.reduced) return reduced_modes(scene.reduced, options.modes);
  const auto closed = [&](System at) {
    return options.stiffened ? stiffened(model, scene, std::move(at)) : at;
  };
  const System system = closed(linear_system(model, scene));
  if (!scene.assembler.depends_on_whirl()) {
    return complex_modes(system, options.modes).oscillatory;
  }
  const Assembler linear(linear_structure(model));
  const SystemAtFrequency at_frequency = [&](double omega) {
    return closed(linear.at(system.Omega, omega));
  };
  return own_frequency_modes(at_frequency, options.modes).oscillatory;
}

Identification identify(const MotionLines& lines, std::vector<Mode> modes, const CMat& shapes,
                        const Sparse& weights, const std::vector<ForcedLine>& forced, double Omega,
                        const IdentifyOptions& options) {
  Identification result{.modes = std::move(modes), .bin = lines.bin};
  for (const Peak& peak : distinct_peaks(lines.total, lines.bin, options)) {
    IdentifiedPeak found{.frequency = peak.frequency};
    found.frequency_rotating = peak.frequency - Omega;
    const auto place = (peak.bin + lines.total.size()) % lines.total.size();
    found.amplitude = lines.radius(peak.bin) * (peak.amplitude / lines.total(place));

    const CVec shape = lines.shape(peak.bin);
    for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
      found.mac.push_back(mac(shapes.col(i), shape, weights));
    }
    if (const int best = most_alike(found.mac); best >= 0) {
      found.mode = best;
      const Mode& mode = result.modes[static_cast<std::size_t>(found.mode)];
      found.shift = std::abs(found.frequency) / mode.frequency() - 1.0;
    }
    result.peaks.push_back(std::move(found));
  }
  find_causes(result.peaks, forced, lines.bin);
  result.resonance = resonance_of(result.peaks);
  return result;
}

Identification identify(const Model& model, const Scene& scene, const Recording& recording,
                        const IdentifyOptions& options) {
  const System system = linear_system(model, scene);
  const double length = scene.assembler.structure().length();
  const double arm = !options.rotations ? 0.0 : length > 0.0 ? length : 1.0;
  const Sparse weights = options.mass_weighted ? system.M : mac_weights(system.dofs, arm);

  const ResponseSpectra spectra(scene, recording);
  MotionLines lines{.bin = spectra.bin(), .total = spectra.total()};
  lines.radius = [&](Eigen::Index bin) {
    double largest = 0.0;
    for (const Point& p : system.dofs.points()) {
      largest = std::max(largest, std::abs(spectra.line(p, bin)));
    }
    return largest;
  };
  lines.shape = [&](Eigen::Index bin) -> CVec {
    return scene.reduced.Phi * spectra.amplitudes(bin);
  };
  std::vector<Mode> modes = compared_modes(model, scene, options);
  CMat shapes(system.dofs.size(), std::ssize(modes));
  for (std::size_t i = 0; i < modes.size(); ++i) {
    shapes.col(static_cast<Eigen::Index>(i)) = modes[i].shape;
  }
  return identify(lines, std::move(modes), shapes, weights,
                  forced_lines(scene.assembler, system.Omega), system.Omega, options);
}

}  // namespace whirl::inline dyn
