#include "libio/results/own_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "libio/results/hdf5.hpp"
#include "libio/text/files_in_use.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

constexpr std::size_t head_size = 4096, tail_size = 256;  ///< bytes in which a mark stands

constexpr std::string_view png_begin = "\x89PNG\r\n\x1a\n", pdf_begin = "%PDF-", gif_begin = "GIF8",
                           ogg_begin = "OggS", hdf5_begin = "\x89HDF";
constexpr std::string_view png_text = "tEXtSoftware\0whirl"sv;
constexpr std::string_view png_end = "\0\0\0\0IEND\xae\x42\x60\x82"sv;
constexpr std::string_view pdf_mark = "% written by whirl\n", pdf_end = "%%EOF";
constexpr std::string_view gif_mark = "\x21\xfe\x05whirl\0"sv;  ///< a comment extension
constexpr std::string_view theora_comments = "\x81theora", theora_mark = "whirl; ";

/// First and last bytes of a file.
struct Ends {
  std::string head, tail;
};

Ends ends_of(const fs::path& place) {
  Ends ends{std::string(head_size, '\0'), std::string(tail_size, '\0')};
  std::ifstream file(place, std::ios::binary);
  file.read(ends.head.data(), static_cast<std::streamsize>(head_size));
  ends.head.resize(static_cast<std::size_t>(file.gcount()));
  file.clear();
  file.seekg(0, std::ios::end);
  const auto size = static_cast<std::streamoff>(file.tellg());
  file.seekg(std::max<std::streamoff>(0, size - static_cast<std::streamoff>(tail_size)));
  file.read(ends.tail.data(), static_cast<std::streamsize>(tail_size));
  ends.tail.resize(static_cast<std::size_t>(file.gcount()));
  return ends;
}

bool holds(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// Whether a result was written by this program, or the numbers of an XDMF series.
bool is_own_hdf5(const fs::path& place) {
  try {
    const ResultReader file(place);
    if (file.has_attribute("/", "whirl_version")) return true;
    if (file.has_attribute("/", "program")) return file.string_attribute("/", "program") == "whirl";
    return file.has("/points") && file.has("/lines") &&  // a series of an early version
           file.string_attribute("/points", "long_name") == "points at rest";
  } catch (const FileError&) {
    return false;
  }
}

/// Whether a JSON begins with the two entries of a verb's answer, as early versions wrote them.
bool begins_as_early_answer(std::string_view head) {
  for (const std::string_view space : {"", "\n  "}) {
    const std::string begin = fmt::format("{{{}\"model\": \"", space);
    if (!head.starts_with(begin)) continue;
    std::size_t end = begin.size();
    while (end < head.size() && head[end] != '"') end += head[end] == '\\' ? 2 : 1;
    if (end >= head.size()) return false;
    return head.substr(end).starts_with(
        fmt::format("\",{}\"version\": \"0.1.0\"", space.empty() ? " " : space));
  }
  return false;
}

/// Whether a text begins with the first lines of what early versions wrote, without a mark.
bool begins_as_early_versions(std::string_view head) {
  constexpr std::string_view svg =
      "font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\">\n<title>";
  constexpr std::string_view page = "<link rel=\"icon\" href=\"data:,\">\n<style>\n";
  constexpr std::string_view series =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  constexpr std::string_view xdmf =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n    <Grid Name=\"motion\" ";
  constexpr std::string_view mesh =
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n";
  if (head.starts_with("<?xml") && (holds(head, svg) || holds(head, mesh))) return true;
  if (head.starts_with("<!DOCTYPE html>") && holds(head, page)) return true;
  if (head.starts_with(series) || head.starts_with(xdmf)) return true;
  return begins_as_early_answer(head);
}

/// Whether a file of points and cells is a frame of a series: its arrays are named as here only.
bool is_frame(std::string_view head) {
  return head.starts_with("<VTKFile type=\"PolyData\"") && holds(head, "\"deflection scale\"") &&
         holds(head, "\"force scale [m/N]\"");
}

bool is_own_picture(const Ends& ends) {
  const std::string_view head = ends.head, tail = ends.tail;
  if (head.starts_with(png_begin)) return holds(tail, png_text);
  if (head.starts_with(pdf_begin)) return holds(tail, pdf_mark);
  if (head.starts_with(gif_begin)) return holds(tail, gif_mark);
  if (head.starts_with(ogg_begin)) {
    const auto comments = head.find(theora_comments);
    return comments != std::string_view::npos &&
           head.substr(comments + theora_comments.size() + 4).starts_with(theora_mark);
  }
  if (head.starts_with("<")) {
    return holds(head, xml_mark) || holds(head, html_mark) || is_frame(head) ||
           begins_as_early_versions(head);
  }
  if (head.starts_with("{")) {
    const std::string entry = fmt::format("\"{}\": \"{}\"", json_mark_key, json_mark);
    return tail.ends_with(entry + "\n}\n") || tail.ends_with(entry + "}\n") ||
           holds(head, "\"title\": \"whirl model\"") || begins_as_early_versions(head);
  }
  return false;
}

/// Remainder of a polynomial of degree 32, bytes with their highest bit first (Ogg) or last (PNG).
template <bool highest_first>
std::uint32_t remainder_of(std::string_view bytes, std::uint32_t begin) {
  std::uint32_t r = begin;
  for (const char c : bytes) {
    const std::uint32_t byte = static_cast<unsigned char>(c);
    r ^= highest_first ? byte << 24u : byte;
    for (int bit = 0; bit < 8; ++bit) {
      if constexpr (highest_first) {
        r = (r & 0x80000000u) != 0 ? (r << 1u) ^ 0x04c11db7u : r << 1u;
      } else {
        r = (r & 1u) != 0 ? (r >> 1u) ^ 0xedb88320u : r >> 1u;
      }
    }
  }
  return r;
}

std::string four_bytes(std::uint32_t value, bool is_big_endian) {
  std::string bytes;
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned shift = 8 * (is_big_endian ? 3 - i : i);
    bytes += static_cast<char>(value >> shift & 0xffu);
  }
  return bytes;
}

/// A text chunk in front of the last one.
/// @source ISO/IEC 15948, 11.3.4.3
void mark_png(std::string& file) {
  if (!file.ends_with(png_end)) return;
  constexpr std::uint32_t all = 0xffffffffu;
  const auto length = static_cast<std::uint32_t>(png_text.size() - 4);  // of the data alone
  const std::string chunk = four_bytes(length, true) + std::string(png_text) +
                            four_bytes(remainder_of<false>(png_text, all) ^ all, true);
  file.insert(file.size() - png_end.size(), chunk);
}

/// A comment between the place of the cross-references, the last that is read, and the last line.
void mark_pdf(std::string& file) {
  const auto end = file.rfind(pdf_end);
  if (end != std::string::npos) file.insert(end, pdf_mark);
}

void mark_gif(std::string& file) {
  constexpr char trailer = '\x3b';
  if (file.ends_with(trailer)) file.insert(file.size() - 1, gif_mark);
}

/// The vendor of the comment header, as long as it was, so that only a check sum changes.
void mark_ogv(std::string& file) {
  const auto comments = file.find(theora_comments);
  if (comments == std::string::npos) return;
  const std::size_t vendor = comments + theora_comments.size() + 4;
  const auto page = file.rfind(ogg_begin, comments);
  constexpr std::size_t check = 22, header = 27;  // of a page: its sum, and up to its segments
  if (page == std::string::npos || vendor + theora_mark.size() > file.size()) return;
  const std::size_t length = static_cast<unsigned char>(file[vendor - 4]);
  if (length <= theora_mark.size() || file[vendor - 3] != '\0') return;
  const std::size_t segments = static_cast<unsigned char>(file[page + header - 1]);
  std::size_t size = header + segments;
  for (std::size_t i = 0; i < segments; ++i) {
    size += static_cast<unsigned char>(file[page + header + i]);
  }
  if (page + size > file.size()) return;
  const std::string marked = std::string(theora_mark) + file.substr(vendor, length);
  file.replace(vendor, length, marked.substr(0, length));
  file.replace(page + check, 4, std::string(4, '\0'));
  const std::uint32_t sum = remainder_of<true>(std::string_view(file).substr(page, size), 0);
  file.replace(page + check, 4, four_bytes(sum, false));
}

}  // namespace

Origin origin_of(const fs::path& place) {
  const LooksAtOutput look;
  std::error_code ignored;
  if (!fs::is_regular_file(place, ignored) || fs::file_size(place, ignored) == 0) {
    return Origin::nowhere;
  }
  const Ends ends = ends_of(place);
  if (ends.head.starts_with(hdf5_begin)) {
    return is_own_hdf5(place) ? Origin::result : Origin::foreign;
  }
  return is_own_picture(ends) ? Origin::picture : Origin::foreign;
}

void mark_as_own(const fs::path& place) {
  std::ostringstream content;
  content << std::ifstream(place, std::ios::binary).rdbuf();
  std::string file = content.str();
  const std::string before = file;
  if (file.starts_with(png_begin)) mark_png(file);
  if (file.starts_with(pdf_begin)) mark_pdf(file);
  if (file.starts_with(gif_begin)) mark_gif(file);
  if (file.starts_with(ogg_begin)) mark_ogv(file);
  if (file == before) return;
  std::ofstream stream(place, std::ios::binary);
  stream << file;
  stream.close();
  if (!stream) throw FileError(fmt::format("cannot write {}", place.string()));
}

std::string first_line(const fs::path& place) {
  constexpr std::size_t longest = 1u << 24u;  // a file of others may have no end of a line
  std::error_code ignored;
  if (!fs::is_regular_file(place, ignored)) return "";
  std::string line(std::min<std::uintmax_t>(longest, fs::file_size(place, ignored)), '\0');
  std::ifstream file(place, std::ios::binary);
  file.read(line.data(), std::ssize(line));
  line.resize(static_cast<std::size_t>(file.gcount()));
  return line.substr(0, line.find('\n'));
}

}  // namespace whirl::inline io
