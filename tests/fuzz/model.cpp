// Text of models: whatever it is, a model comes of it or an error that says where.

#include <cstddef>
#include <cstdint>
#include <string>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const whirl::Model model = whirl::parse_model(text, "model.toml");
    // what a result stores is a model too
    whirl::parse_model(model.source, "stored.toml");
  } catch (const whirl::ModelError&) {
  }
  return 0;
}
