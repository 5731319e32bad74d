#include "libverbs/command/version.hpp"

namespace whirl::inline cli {

const char* const version = WHIRL_VERSION;

}  // namespace whirl::inline cli
