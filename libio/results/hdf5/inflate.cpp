#include "libio/results/hdf5/inflate.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>

namespace whirl::inline io::hdf5 {

std::optional<std::string> inflated(std::string_view compressed, std::size_t most) {
  constexpr std::size_t piece = 1u << 20u;
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return std::nullopt;
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(compressed.data()));
  stream.avail_in =
      static_cast<uInt>(std::min<std::size_t>(compressed.size(), std::numeric_limits<uInt>::max()));
  std::string bytes;
  int status = Z_OK;
  while (status == Z_OK && bytes.size() < most) {
    const std::size_t before = bytes.size(), room = std::min(piece, most - before);
    bytes.resize(before + room);
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + before);
    stream.avail_out = static_cast<uInt>(room);
    status = inflate(&stream, Z_NO_FLUSH);
    bytes.resize(before + room - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status != Z_OK && status != Z_STREAM_END) return std::nullopt;
  return bytes;
}

}  // namespace whirl::inline io::hdf5
