#pragma once
/// Files of balancing: planes, probes, and runs with trial weights.

#include <filesystem>
#include <string>
#include <vector>

#include "libdata/balancing/balancing.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline io {

/// Where influence coefficients come from.
enum class CoefficientSource { runs, model };
constexpr auto choices(CoefficientSource) {
  return std::array{Choice<CoefficientSource>{"runs", CoefficientSource::runs},
                    Choice<CoefficientSource>{"model", CoefficientSource::model}};
}

/// What a call says beside the file.
struct BalancingAsked {
  BalancingCriterion criterion = BalancingCriterion::least_squares;
  /// Left out: those of the runs, where one of these has a weight, else those of the model.
  std::optional<CoefficientSource> coefficients{};
  /// Speeds at which the vibration of the model itself is balanced, where the file has no runs
  /// [rad/s].
  std::vector<double> speeds{};
  bool accepts_nonlinear = false;  ///< signs of a rub become notes
};

struct BalancingCase {
  BalancingInput input;
  std::vector<std::string> notes;
};

/// Reads a file of balancing (docs/balancing.md): `phase`, `angles` and `amplitudes`, a [[plane]],
/// [[probe]] and [[run]] each, [keyphasor] and [rotor]. Records of runs are read from the folder of
/// the file.
///
/// Coefficients of the model, where these are asked for, are those of its linear response.
///
/// @throws ModelError      with every problem found and its place in the file, for records that
///                         cannot be read, and for a rotor that rubs, in a record or in the model
/// @throws NumericalError  as model_influence
BalancingCase read_balancing_file(const std::filesystem::path& path, const Model& model,
                                  const BalancingAsked& asked);

/// The same of a text.
/// @param path  of the file, for messages and for the folder of its records
BalancingCase parse_balancing_file(const std::string& text, const std::filesystem::path& path,
                                   const Model& model, const BalancingAsked& asked);

}  // namespace whirl::inline io
