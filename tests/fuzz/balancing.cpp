// Files of balancing: weights with finite predictions come of one, or problems with their places.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "libbase/error.hpp"
#include "libio/measured/balancing_file.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/replace_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace whirl;
  static const Model model = parse_model(R"(format = 1
operation = { speed = "100 rad/s" }
body = [{ name = "rotor", mass = 2, spins = true }]
bearing = [{ body = "rotor", stiffness = 2e4, damping = 40 }]
unbalance = [{ body = "rotor", moment = "100 g.mm" }]
)");
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const BalancingCase read =
        parse_balancing_file(text, "nowhere/balance.toml", model, {.speeds = {100.0}});
    const Balancing found = balance(read.input);
    for (const PlaneBalance& plane : found.planes) {
      if (!std::isfinite(plane.mass)) std::abort();
    }
  } catch (const ModelError& error) {
    if (error.problems().empty()) std::abort();
  } catch (const FileError&) {
  } catch (const NumericalError&) {
  }
  return 0;
}
