#pragma once
/// What a fit searches for: parameters, and the states that the motions of records begin at.

#include <algorithm>
#include <optional>
#include <vector>

#include "libdata/fit/fit.hpp"
#include "libdata/fit/shooting_windows.hpp"

namespace whirl::inline data {

/// A record during the search.
struct RecordShooting {
  const FitSource* source;
  std::vector<ShootingWindow> windows{};
  std::vector<Vec> starts{};  ///< of windows, over scale
  Vec scale{};                ///< of states
  Vec gap{};                  ///< of the state between windows that counts as the noise does
  Vec offset{};               ///< of readings, over length, per probe; zero where it is known
  double length = 1.0;        ///< scale of displacements [m]
  /// The system at the current parameters; nothing: they make no system.
  std::optional<FitSystem> system;

  bool has_offset() const { return !source->record.is_offset_known; }
};

/// The unknowns of a fit, and the systems at the current parameters.
struct FitSearch {
  FitSearch(const std::vector<FitSource>& sources, const std::vector<FreeParameter>& free,
            const FitOptions& asked, int steady_windows_per_revolution);

  long readings() const;
  /// Current values of the parameters.
  Vec values() const { return x.cwiseProduct(sizes); }
  void make_systems();
  bool has_steady() const {
    return std::any_of(shootings.begin(), shootings.end(),
                       [](const RecordShooting& s) { return s.source->record.period > 0; });
  }

  const std::vector<FreeParameter>& parameters;
  const FitOptions& options;
  Vec x;      ///< parameters over their sizes
  Vec sizes;  ///< of parameters
  std::vector<RecordShooting> shootings;
  double between = 1.0;  ///< gap that may be left between windows, over RecordShooting::gap
};

}  // namespace whirl::inline data
