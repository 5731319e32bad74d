#pragma once
/// A model, from its start to a finished run.

#include <functional>
#include <optional>
#include <string>

#include "libdyn/motions/run_result.hpp"
#include "libdyn/motions/start.hpp"

namespace whirl::inline dyn {

struct RunOptions {
  SimulationOptions simulation{};  ///< its method and its functions do not count
  std::string method{};     ///< name of an integrator; empty: the one that suits the contacts
  std::string stations{};   ///< as select_points
  bool is_written = false;  ///< whether results are written, which takes memory, too
  /// Called with the revolutions done and their number in all; may be empty.
  std::function<void(long done, long total)> progress{};
  /// Asked often; true: stop after the revolution under way, or within it if that takes longer than
  /// half a second. May be empty.
  std::function<bool()> is_stopped{};
};

/// Integrates a model that has a speed.
///
/// @param earlier  the motion that the model's [start] goes on from
/// @throws ModelError      for an unknown method or one that does not suit the contacts, and for a
///                         recording that this machine has no memory for
/// @throws NumericalError  as make_scene
Run run_model(const Model& model, const RunOptions& options,
              const std::optional<EarlierEnd>& earlier = {});

}  // namespace whirl::inline dyn
