// ResultReader: questions to a child process, where HDF5 reads the file.

#include <fmt/format.h>

#include <algorithm>

#include "libbase/structs/travel.hpp"
#include "libio/results/confined_child.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/hdf5/open_file.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;
using hdf5::OpenFile, hdf5::Sizes;

namespace {

enum class Asked {
  open,
  has,
  has_attribute,
  string_attribute,
  number_attribute,
  kind,
  axes,
  shape,
  numbers,
  numbers_of_rank,
  complex_numbers,
  box,
  numbers_from,
  integers,
  strings,
  attributes,
  list,
  groups,
  datasets,
};

struct Question {
  Asked what{};
  std::string object{}, name{};
  Sizes sizes{};
};

template <class Bytes>
void travel(Bytes& bytes, Is<Question> auto& question) {
  auto& [what, object, name, sizes] = question;
  bytes(what, object, name, sizes);
}

/// What comes back beside numbers.
struct Found {
  std::vector<std::string> texts{};
  Sizes sizes{};
  std::vector<int> integers{};
};

template <class Bytes>
void travel(Bytes& bytes, Is<Found> auto& found) {
  auto& [texts, sizes, integers] = found;
  bytes(texts, sizes, integers);
}

/// All paths of a file, in their order; none where there are others, or very many.
std::vector<std::string> all_paths(const hdf5::Outline& outline) {
  constexpr std::size_t most = 10'000;
  const bool is_all = outline.is_whole && !outline.has_other_paths;
  std::vector<std::string> all;
  for (const auto* some : {&outline.groups, &outline.datasets, &outline.others}) {
    if (!is_all || some->size() > most) return {};
    all.insert(all.end(), some->begin(), some->end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// In the child.
ConfinedChild::Letter answer(const OpenFile& file, const Question& q) {
  Found found;
  std::vector<double> numbers;
  switch (q.what) {
    case Asked::open:
      found.texts = all_paths(file.outline());
      break;
    case Asked::has:
      found.integers = {file.has(q.object)};
      break;
    case Asked::has_attribute:
      found.integers = {file.has_attribute(q.object, q.name)};
      break;
    case Asked::string_attribute:
      found.texts = {file.string_attribute(q.object, q.name)};
      break;
    case Asked::number_attribute:
      numbers = {file.number_attribute(q.object, q.name)};
      break;
    case Asked::kind:
      found.integers = {static_cast<int>(file.kind(q.object))};
      break;
    case Asked::axes:
      found.texts = file.axes(q.object);
      break;
    case Asked::shape:
      found.sizes = file.shape(q.object);
      break;
    case Asked::numbers:
      numbers = file.numbers(q.object);
      break;
    case Asked::numbers_of_rank:
      found.sizes = file.shape(q.object);
      numbers = file.numbers(q.object, q.sizes.at(0));
      break;
    case Asked::complex_numbers:
      found.sizes = file.shape(q.object);
      numbers = file.complex_numbers(q.object, q.sizes.at(0));
      break;
    case Asked::box: {
      const auto middle = q.sizes.begin() + std::ssize(q.sizes) / 2;
      numbers = file.numbers(q.object, {q.sizes.begin(), middle}, {middle, q.sizes.end()});
      break;
    }
    case Asked::numbers_from:
      numbers = file.numbers_from(q.object, q.sizes.at(0), q.sizes.at(1));
      break;
    case Asked::integers:
      found.integers = file.integers(q.object);
      break;
    case Asked::strings:
      found.texts = file.strings(q.object);
      break;
    case Asked::attributes:
      found.texts = file.attributes(q.object);
      break;
    case Asked::list:
      found.texts = file.list(q.object);
      break;
    case Asked::groups:
      found.texts = file.whole_outline().groups;
      break;
    case Asked::datasets:
      found.texts = file.whole_outline().datasets;
      break;
  }
  return {packed(found), std::move(numbers)};
}

struct Reply {
  Found found;
  std::vector<double> numbers;
};

/// @throws FileError  as ConfinedChild, and for an answer of fewer things than were asked for
Reply ask(const ConfinedChild& child, const Question& question, std::size_t texts = 0,
          std::size_t integers = 0, std::size_t numbers = 0) {
  ConfinedChild::Letter letter = child.ask(packed(question));
  Reply reply{{}, std::move(letter.numbers)};
  bool is_whole = true;
  try {
    unpack(letter.bytes, reply.found);
  } catch (const NumericalError&) {
    is_whole = false;
  }
  if (!is_whole || reply.found.texts.size() < texts || reply.found.integers.size() < integers ||
      reply.numbers.size() < numbers) {
    throw FileError(fmt::format("cannot read {}: the file is damaged", question.object));
  }
  return reply;
}

/// Numbers with the sizes of a matrix, or of a vector as one of one column.
template <class Scalar>
auto matrix_of(const ConfinedChild& child, const std::string& path, std::size_t rank) {
  constexpr bool is_complex = std::is_same_v<Scalar, Complex>;
  const Asked what = is_complex ? Asked::complex_numbers : Asked::numbers_of_rank;
  const Reply reply = ask(child, {what, path, "", {rank}});
  const Sizes& sizes = reply.found.sizes;
  const auto rows = sizes.size() == rank ? static_cast<Eigen::Index>(sizes[0]) : -1;
  const auto columns = rank == 1 || rows < 0 ? 1 : static_cast<Eigen::Index>(sizes[1]);
  const auto count = std::ssize(reply.numbers) / (is_complex ? 2 : 1);
  const bool fits = rows >= 0 && columns >= 0 &&
                    (rows == 0 || columns == 0 || columns == count / rows) &&
                    rows * columns == count;
  if (!fits) throw FileError(fmt::format("cannot read {}: the file is damaged", path));
  using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> values = Eigen::Map<const RowMajor>(
      reinterpret_cast<const Scalar*>(reply.numbers.data()), rows, columns);
  return values;
}

}  // namespace

ResultReader::ResultReader(const fs::path& path) : path_(path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw FileError(fmt::format("cannot open {}: not an HDF5 file", path.string()));
  }
  const OpenedFile file(path);
  // opened there by the first question
  const auto opened = std::make_shared<std::unique_ptr<OpenFile>>();
  child_ =
      std::make_unique<ConfinedChild>(file, path.string(), "HDF5", [=](const std::string& bytes) {
        Question question;
        unpack(bytes, question);
        if (!*opened) *opened = std::make_unique<OpenFile>(path);
        return answer(**opened, question);
      });
  paths_ = ask(*child_, {Asked::open, "/"}).found.texts;
}

ResultReader::~ResultReader() = default;

bool ResultReader::has(const std::string& object) const {
  if (!paths_.empty()) return std::binary_search(paths_.begin(), paths_.end(), object);
  return ask(*child_, {Asked::has, object}, 0, 1).found.integers[0] != 0;
}

bool ResultReader::has_attribute(const std::string& object, const std::string& name) const {
  if (!paths_.empty() && !has(object)) return false;
  return ask(*child_, {Asked::has_attribute, object, name}, 0, 1).found.integers[0] != 0;
}

std::string ResultReader::string_attribute(const std::string& object,
                                           const std::string& name) const {
  return ask(*child_, {Asked::string_attribute, object, name}, 1).found.texts[0];
}

double ResultReader::number_attribute(const std::string& object, const std::string& name) const {
  return ask(*child_, {Asked::number_attribute, object, name}, 0, 0, 1).numbers[0];
}

ObjectKind ResultReader::kind(const std::string& object) const {
  const int kind = ask(*child_, {Asked::kind, object}, 0, 1).found.integers[0];
  const bool is_known = kind >= 0 && kind <= static_cast<int>(ObjectKind::other);
  return is_known ? static_cast<ObjectKind>(kind) : ObjectKind::other;
}

std::vector<std::string> ResultReader::axes(const std::string& path) const {
  return ask(*child_, {Asked::axes, path}).found.texts;
}

std::vector<Eigen::Index> ResultReader::shape(const std::string& path) const {
  const Sizes sizes = ask(*child_, {Asked::shape, path}).found.sizes;
  return {sizes.begin(), sizes.end()};
}

Vec ResultReader::vector(const std::string& path) const {
  return matrix_of<double>(*child_, path, 1);
}

std::vector<double> ResultReader::numbers(const std::string& path) const {
  return ask(*child_, {Asked::numbers, path}).numbers;
}

std::vector<double> ResultReader::numbers(const std::string& path,
                                          const std::vector<Stretch>& along) const {
  Question question{Asked::box, path};
  for (const Stretch& s : along) question.sizes.push_back(static_cast<std::uint64_t>(s.first));
  std::size_t count = 1;
  for (const Stretch& s : along) {
    question.sizes.push_back(static_cast<std::uint64_t>(s.count));
    count *= static_cast<std::size_t>(s.count);
  }
  return ask(*child_, question, 0, 0, count).numbers;
}

std::vector<double> ResultReader::numbers(const std::string& path, std::size_t first,
                                          std::size_t count) const {
  return ask(*child_, {Asked::numbers_from, path, "", {first, count}}, 0, 0, count).numbers;
}

void ResultReader::each_block(const std::string& path,
                              const std::function<void(std::span<const double>)>& f) const {
  constexpr std::size_t at_once = std::size_t{1} << 17u;
  std::size_t all = 1;
  for (const Eigen::Index size : shape(path)) all *= static_cast<std::size_t>(size);
  for (std::size_t first = 0; first < all; first += at_once) {
    f(numbers(path, first, std::min(at_once, all - first)));
  }
}

Mat ResultReader::matrix(const std::string& path) const {
  return matrix_of<double>(*child_, path, 2);
}

CVec ResultReader::complex_vector(const std::string& path) const {
  return matrix_of<Complex>(*child_, path, 1);
}

CMat ResultReader::complex_matrix(const std::string& path) const {
  return matrix_of<Complex>(*child_, path, 2);
}

std::vector<int> ResultReader::integers(const std::string& path) const {
  return ask(*child_, {Asked::integers, path}).found.integers;
}

std::vector<std::string> ResultReader::strings(const std::string& path) const {
  return ask(*child_, {Asked::strings, path}).found.texts;
}

std::vector<std::string> ResultReader::attributes(const std::string& object) const {
  return ask(*child_, {Asked::attributes, object}).found.texts;
}

std::vector<std::string> ResultReader::list(const std::string& group) const {
  return ask(*child_, {Asked::list, group}).found.texts;
}

std::vector<std::string> ResultReader::groups() const {
  return ask(*child_, {Asked::groups, ""}).found.texts;
}

std::vector<std::string> ResultReader::datasets() const {
  return ask(*child_, {Asked::datasets, ""}).found.texts;
}

}  // namespace whirl::inline io
