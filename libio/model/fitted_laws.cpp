#include "libio/model/fitted_laws.hpp"

#include <algorithm>

#include "libio/model/model_builder.hpp"

namespace whirl::inline io {

namespace {

constexpr int most_between = 3;  ///< points of a law between two samples
constexpr std::size_t most_samples_with_more = 5000;

/// The frequencies of a response and, unless there are very many, some between them [rad/s].
std::vector<double> curve_frequencies(const std::vector<double>& omega) {
  const int between = omega.size() > most_samples_with_more ? 0 : most_between;
  std::vector<double> all;
  for (std::size_t k = 0; k + 1 < omega.size(); ++k) {
    for (int i = 0; i <= between; ++i) {
      all.push_back(omega[k] + (omega[k + 1] - omega[k]) * i / (between + 1.0));
    }
  }
  all.push_back(omega.back());
  return all;
}

/// Adds every entry of a stiffness over frequency, entry by entry.
void add_points(const std::vector<double>& omega, const std::vector<CMat>& K, int support,
                std::vector<StiffnessPoint>& to) {
  const auto rows = static_cast<int>(K.front().rows()),
             columns = static_cast<int>(K.front().cols());
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      for (std::size_t k = 0; k < omega.size(); ++k) {
        const Complex value = K[k](i, j);
        to.push_back({support, i, j, omega[k], value.real(), value.imag()});
      }
    }
  }
}

}  // namespace

SupportFits fitted_laws(const Model& model) {
  SupportFits found;
  const bool has_any = std::ranges::any_of(model.structure.supports,
                                           [](const Support& s) { return s.fit.has_value(); });
  if (!has_any) return found;
  const ConfigNode root = parse_toml(model.source, model.path);
  ModelBuilder builder(root, NamedFiles());
  builder.build();
  for (const FileTable& table : builder.file_tables()) {
    if (!table.fitted) continue;
    const FittedLaw& law = *table.fitted;
    const auto number = static_cast<int>(found.fits.size());
    const LawFit& f = law.fit;
    found.fits.push_back({law.support, f.samples, f.poles, f.error, f.largest, f.largest_at,
                          f.mirrored, f.least_damping, f.least_damping_at});
    add_points(law.response.omega, law.response.K, number, found.samples);
    const std::vector<double> omega = curve_frequencies(law.response.omega);
    std::vector<CMat> K;
    for (const double w : omega) K.push_back(law.law.stiffness_at(Complex(0.0, w)));
    add_points(omega, K, number, found.curve);
  }
  return found;
}

}  // namespace whirl::inline io
