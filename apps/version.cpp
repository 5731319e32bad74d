#include "apps/version.hpp"

namespace whirl {

const char* const version = WHIRL_VERSION;

}  // namespace whirl
