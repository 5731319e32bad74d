#pragma once

#include <string>

#include "libbase/error.hpp"

namespace whirl::inline fe {

/// A place that something is attached to, as it was written.
struct Station {
  enum class Kind { position, node, body, ground };
  Kind kind = Kind::ground;
  double z = 0.0;       ///< position along the shaft [m]                     (Kind::position)
  int node = 0;         ///< node number from 1                               (Kind::node)
  std::string body;     ///< name of a body                                   (Kind::body)
  std::string rotor{};  ///< on whose shaft the position is; empty: the first shaft
  Where where{};
  std::string key{};  ///< path of the entry in the model file, for messages
  bool operator==(const Station&) const = default;
};

}  // namespace whirl::inline fe
