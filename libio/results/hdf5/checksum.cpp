#include "libio/results/hdf5/checksum.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "libio/results/replace_file.hpp"

namespace whirl::inline io::hdf5 {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t piece = 1024 * 1024;  ///< bytes read at a time

[[noreturn]] void fail(const fs::path& file, const char* action) {
  throw FileError(fmt::format("cannot {} {}: {}", action, file.string(), std::strerror(errno)));
}

std::string line_of(std::uint64_t bytes, std::uint32_t checksum) {
  return fmt::format("\nwhirl: {} bytes, crc32 {:08x}\n", bytes, checksum);
}

/// Where HDF5's superblock says that the file ends; none for what is no HDF5 file from its first
/// byte on, or has addresses of other than 8 bytes. [HDF5 File Format Specification 3.0, II.A]
std::optional<std::uint64_t> end_of(std::ifstream& stream) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::array<char, 64> head{};
  stream.read(head.data(), head.size());
  if (stream.gcount() < std::ssize(head)) return std::nullopt;
  if (std::string_view(head.data(), signature.size()) != signature) return std::nullopt;
  // version: where the size of addresses is written, where the address of the end
  struct Places {
    std::size_t size, end;
  };
  constexpr std::array<Places, 4> of_version{{{13, 40}, {13, 44}, {9, 28}, {9, 28}}};
  const auto version = static_cast<std::size_t>(static_cast<unsigned char>(head[8]));
  if (version >= of_version.size() || head[of_version[version].size] != 8) return std::nullopt;
  std::uint64_t end = 0;
  for (std::size_t i = 8; i-- > 0;) {
    end = end << 8 | static_cast<unsigned char>(head[of_version[version].end + i]);
  }
  return end;
}

std::uint32_t checksum(std::ifstream& stream, std::uint64_t bytes) {
  std::vector<char> buffer(piece);
  std::uint32_t sum = 0;
  stream.clear();
  stream.seekg(0);
  while (bytes > 0 && stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(piece, bytes)));
    const auto got = static_cast<std::uint64_t>(stream.gcount());
    sum = crc32_of({buffer.data(), static_cast<std::size_t>(got)}, sum);
    bytes -= got;
  }
  return sum;
}

}  // namespace

std::uint32_t crc32_of(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void seal(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "read");
  const std::uint64_t bytes = fs::file_size(file);
  const std::string line = line_of(bytes, checksum(in, bytes));
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out << line;
  out.close();
  if (!out) fail(file, "write");
}

Seal seal_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "read");
  const std::uint64_t size = fs::file_size(file);
  const auto end = end_of(in);
  if (!end || *end >= size) return Seal::none;
  constexpr std::uint64_t longest = 64;  // of the line
  if (size - *end > longest) return Seal::broken;
  std::string line(size - *end, '\0');
  in.clear();
  in.seekg(static_cast<std::streamoff>(*end));
  in.read(line.data(), std::ssize(line));
  return line == line_of(*end, checksum(in, *end)) ? Seal::whole : Seal::broken;
}

}  // namespace whirl::inline io::hdf5
