#include "tests/fuzz/result_edits.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "libio/results/hdf5.hpp"
#include "libio/results/result_schema.hpp"

namespace whirl::fuzz {

namespace {

namespace fs = std::filesystem;
using Index = Eigen::Index;

constexpr Index most_numbers = 100'000;  ///< of an edited dataset: edits shall be fast

/// A dataset or attribute in memory.
struct Item {
  std::string path;
  ObjectKind kind = ObjectKind::real;
  std::vector<Index> shape;
  std::vector<double> numbers;  ///< of complex ones real and imaginary parts in turn
  std::vector<std::string> texts;
  std::string units, long_name;
  std::vector<std::string> axes;

  bool is_attribute() const { return path.find('@') != std::string::npos; }
  Index count() const {
    Index n = 1;
    for (const Index size : shape) n *= size;
    return n;
  }
};

Item read_attribute(const ResultReader& file, const std::string& path, ObjectKind kind) {
  const std::size_t at = path.find('@');
  const std::string object = path.substr(0, at), name = path.substr(at + 1);
  Item item{path, kind};
  if (kind == ObjectKind::text) {
    item.texts = {file.string_attribute(object, name)};
  } else {
    item.numbers = {file.number_attribute(object, name)};
  }
  return item;
}

Item read_dataset(const ResultReader& file, const std::string& path) {
  Item item{path, file.kind(path), file.shape(path)};
  if (item.kind == ObjectKind::text) {
    item.texts = file.strings(path);
  } else if (item.kind == ObjectKind::complex) {
    const CMat all =
        item.shape.size() == 1 ? CMat(file.complex_vector(path)) : file.complex_matrix(path);
    for (Index i = 0; i < all.rows(); ++i) {
      for (Index j = 0; j < all.cols(); ++j) {
        item.numbers.push_back(all(i, j).real());
        item.numbers.push_back(all(i, j).imag());
      }
    }
  } else {
    item.numbers = file.numbers(path);
  }
  if (file.has_attribute(path, "units")) item.units = file.string_attribute(path, "units");
  if (file.has_attribute(path, "long_name")) {
    item.long_name = file.string_attribute(path, "long_name");
  }
  item.axes = file.axes(path);
  return item;
}

/// All that the schema knows of a file; what others lie along comes first.
std::vector<Item> read_seed(const fs::path& path) {
  const ResultReader file(path);
  std::vector<Item> items;
  const auto take = [&](const std::string& name, ObjectKind kind) {
    const std::size_t at = name.find('@');
    const bool is_attribute = at != std::string::npos;
    const bool is_there =
        is_attribute ? file.has_attribute(name.substr(0, at), name.substr(at + 1)) : file.has(name);
    if (!is_there) return;
    items.push_back(is_attribute ? read_attribute(file, name, kind) : read_dataset(file, name));
  };
  for (const char* name : {"/@title", "/@command", "/@whirl_version", "/model@path"}) {
    take(name, ObjectKind::text);
  }
  take("/@speed", ObjectKind::real);
  for (const ResultSet& set : result_schema()) {
    for (const ResultEntry& entry : set.entries) take(std::string(entry.path), entry.kind);
  }
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    return std::pair(a.is_attribute(), a.shape.size()) <
           std::pair(b.is_attribute(), b.shape.size());
  });
  return items;
}

const std::vector<std::vector<Item>>& seeds() {
  static const std::vector<std::vector<Item>> all = [] {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(WHIRL_SOURCE_DIR "/tests/fuzz/results")) {
      paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    std::vector<std::vector<Item>> read;
    for (const fs::path& path : paths) read.push_back(read_seed(path));
    return read;
  }();
  return all;
}

double number_of(std::uint8_t code) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 16> special{0.0,
                                           -1.0,
                                           1.0,
                                           1e308,
                                           -1e308,
                                           1e-308,
                                           std::numeric_limits<double>::quiet_NaN(),
                                           inf,
                                           -inf,
                                           1e-12,
                                           2147483647.0,
                                           -2147483648.0,
                                           1e18,
                                           0.5,
                                           4.0,
                                           1e9};
  return code < special.size() ? special[code] : static_cast<double>(code) - 64.0;
}

std::string text_of(std::uint8_t code) {
  const std::array<std::string, 10> special{"",
                                            "=1+1",
                                            "\xff\xfe",
                                            "\xef\xbf\xbe",
                                            "</script><!--",
                                            "forward",
                                            std::string(5000, 'x'),
                                            "format = 1\n[[body]]\nname = \"a\"\nmass = 1\n",
                                            "1 rotor",
                                            "^{x"};
  return code < special.size() ? special[code] : std::to_string(code);
}

/// Numbers or texts repeated or cut to as many as the shape says.
void fit(Item& item) {
  const Index per = item.kind == ObjectKind::complex ? 2 : 1;
  const auto repeat = [](auto& values, Index count, auto otherwise) {
    if (values.empty()) values.push_back(otherwise);
    const auto first = values;
    while (std::ssize(values) < count) values.insert(values.end(), first.begin(), first.end());
    values.resize(static_cast<std::size_t>(count));
  };
  if (item.kind == ObjectKind::text) {
    repeat(item.texts, item.count(), std::string());
  } else {
    repeat(item.numbers, per * item.count(), 0.0);
  }
}

/// @return  whether the item is still there
bool edit(Item& item, std::uint8_t how, std::uint8_t a, std::uint8_t b) {
  constexpr std::array<ObjectKind, 4> kinds{ObjectKind::real, ObjectKind::integer, ObjectKind::text,
                                            ObjectKind::complex};
  const bool is_text = item.kind == ObjectKind::text;
  switch (how % 8) {
    case 0:
      return false;
    case 1:
      if (!item.shape.empty()) item.shape[a % item.shape.size()] = b % 40;
      break;
    case 2:
      if (item.shape.size() > 1) item.shape.erase(item.shape.begin() + a % std::ssize(item.shape));
      break;
    case 3:
      if (item.shape.size() < 4 && !item.is_attribute()) item.shape.push_back(b % 3);
      break;
    case 4:
      item.kind = kinds[a % (item.is_attribute() ? 3 : 4)];
      break;
    case 5:
      if (is_text && !item.texts.empty()) item.texts[a % item.texts.size()] = text_of(b);
      if (!is_text && !item.numbers.empty()) item.numbers[a % item.numbers.size()] = number_of(b);
      break;
    case 6:
      std::fill(item.numbers.begin(), item.numbers.end(), number_of(b));
      std::fill(item.texts.begin(), item.texts.end(), text_of(b));
      break;
    default:
      (a % 2 == 0 ? item.long_name : item.units) = text_of(b);
  }
  if (item.shape.size() > 2 && item.kind != ObjectKind::integer) item.kind = ObjectKind::real;
  if (item.kind == ObjectKind::text && item.shape.size() > 1) {
    item.shape.erase(item.shape.begin() + 1, item.shape.end());
  }
  if (item.count() > most_numbers) return false;
  fit(item);
  return true;
}

/// Gives whatever is as long as a side of an item another length: a file that agrees with itself,
/// but of no points or of one.
void resize_alike(std::vector<Item>& items, const Item& like, std::uint8_t a, std::uint8_t b) {
  if (like.shape.empty()) return;
  const Index before = like.shape[a % like.shape.size()], after = b % 4;
  for (Item& item : items) {
    const std::vector<Index> shape = item.shape;
    std::replace(item.shape.begin(), item.shape.end(), before, after);
    if (item.count() > most_numbers) item.shape = shape;
    fit(item);
  }
}

void write(ResultWriter& file, const Item& item, std::map<std::string, Index>& lines) {
  const std::size_t at = item.path.find('@');
  if (item.is_attribute()) {
    const std::string object = item.path.substr(0, at), name = item.path.substr(at + 1);
    if (item.kind == ObjectKind::text) return file.attribute(object, name, item.texts.at(0));
    return file.attribute(object, name, item.numbers.at(0));
  }
  DatasetInfo info{item.units, item.long_name, item.axes};
  info.axes.resize(item.shape.size());
  for (std::size_t i = 0; i < info.axes.size(); ++i) {
    const auto axis = lines.find(info.axes[i]);
    if (axis == lines.end() || axis->second != item.shape[i]) info.axes[i].clear();
  }
  if (item.shape.size() == 1) lines[item.path] = item.shape[0];
  if (item.kind == ObjectKind::text) return file.dataset(item.path, item.texts, info);
  if (item.kind == ObjectKind::complex) {
    const auto* first = reinterpret_cast<const Complex*>(item.numbers.data());
    if (item.shape.size() == 1) {
      return file.dataset(item.path, CVec(Eigen::Map<const CVec>(first, item.shape[0])), info);
    }
    const Eigen::Map<const CMat> columns(first, item.shape[1], item.shape[0]);
    return file.dataset(item.path, CMat(columns.transpose()), info);
  }
  if (item.kind == ObjectKind::real) {
    return file.dataset(item.path, item.numbers, item.shape, info);
  }
  std::vector<int> whole;
  for (const double x : item.numbers) whole.push_back(std::abs(x) < 2e9 ? static_cast<int>(x) : -7);
  file.dataset(item.path, whole, item.shape, info);
}

}  // namespace

void write_edited(std::span<const std::uint8_t> input, const fs::path& path) {
  if (input.empty()) throw FileError("no seed");
  std::vector<Item> items = seeds()[input[0] % seeds().size()];
  for (std::size_t i = 1; i + 3 < input.size() && !items.empty(); i += 4) {
    const auto at = items.begin() + input[i] % std::ssize(items);
    if (input[i + 1] >= 192) {
      resize_alike(items, Item(*at), input[i + 2], input[i + 3]);
    } else if (!edit(*at, input[i + 1], input[i + 2], input[i + 3])) {
      items.erase(at);
    }
  }
  ResultWriter file(path);
  std::map<std::string, Index> lines;
  for (const Item& item : items) write(file, item, lines);
  file.commit();
}

}  // namespace whirl::fuzz
