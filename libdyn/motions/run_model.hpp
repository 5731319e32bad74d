#pragma once
/// A model, from its start to a finished run.

#include <functional>
#include <optional>
#include <string>

#include "libdyn/motions/run_result.hpp"
#include "libdyn/motions/start.hpp"

namespace whirl::inline dyn {

struct RunOptions {
  SimulationOptions simulation{};  ///< but for its method and its functions
  std::string method{};     ///< name of an integrator; empty: the one that suits the contacts
  std::string stations{};   ///< as select_points
  bool is_written = false;  ///< what is to be written takes memory, too
  /// Called with the revolutions done and all of them; may be empty.
  std::function<void(long done, long total)> progress{};
  /// Asked often; true: stop after the revolution under way, or within it if it has no end. May be
  /// empty.
  std::function<bool()> is_stopped{};
};

/// Integrates a model that has a speed.
///
/// @param earlier  the motion that its [start] goes on from
/// @throws ModelError      for an unknown method or one that does not suit the contacts, and for a
///                         recording that this machine has no memory for
/// @throws NumericalError  as make_scene
Run run_model(const Model& model, const RunOptions& options,
              const std::optional<EarlierEnd>& earlier = {});

}  // namespace whirl::inline dyn
