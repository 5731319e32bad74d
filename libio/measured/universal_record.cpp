/// Universal files: datasets 58 (text) and 58b (numbers as a processor has them) of responses over
/// time.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>

#include "libio/measured/record_formats.hpp"
#include "libio/measured/universal_format.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/units.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

namespace {

using namespace universal;

/// Goes through the lines of a file.
class UniversalText {
 public:
  UniversalText(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool is_at_end() const { return at_ >= text_.size(); }
  Where where() const { return {file_, line_, 1}; }
  /// The next line, without its end.
  std::string_view line() {
    const auto end = std::min(text_.find('\n', at_), text_.size());
    std::string_view found = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++line_;
    if (found.ends_with('\r')) found.remove_suffix(1);
    return found;
  }
  /// Bytes as they are; fewer at the end of the file.
  std::string_view bytes(std::size_t count) {
    const std::string_view found = text_.substr(at_, count);
    at_ += found.size();
    return found;
  }
  std::size_t left() const { return text_.size() - at_; }
  [[noreturn]] void fail(const std::string& key, const std::string& message) const {
    throw ModelError(where(), key, message);
  }

 private:
  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 0;
};

/// Columns of a record, without blanks around them.
std::string columns_of(std::string_view record, std::size_t from, std::size_t size) {
  return from < record.size() ? trimmed(record.substr(from, size)) : "";
}

bool is_mark(std::string_view line) {
  return trimmed(line) == "-1" && line.size() <= 80;
}

/// Names of a channel beside its first line.
struct ResponseNames {
  std::string response;  ///< entity, node and direction
  std::string label;     ///< of its axis
};

/// One dataset 58.
class ResponseDataset {
 public:
  /// @param length_factor  of a dataset 164; nothing: there is none
  ResponseDataset(UniversalText& text, std::string_view head, long number,
                  std::optional<double> length_factor)
      : text_(text), key_(fmt::format("dataset {}", number)) {
    is_binary_ = head.size() > 6 && (head[6] == 'b' || head[6] == 'B');
    if (is_binary_) {
      is_little_ = whole(head, 7, 6, "byte order") == RecordCode::little_endian;
      if (whole(head, 13, 6, "form of numbers") != RecordCode::ieee) {
        text_.fail(key_, "its numbers are those of DEC or IBM, expected IEEE 754 (2)");
      }
      byte_count_ = whole(head, 31, 12, "number of bytes");
    }
    for (std::string_view& record : records_) {
      if (text_.is_at_end()) text_.fail(key_, "is cut off, expected 11 records before its values");
      record = text_.line();
    }
    read_records(length_factor);
  }

  /// Reads its values.
  RawChannel channel(RawRecord& raw) {
    RawChannel found{id_or_response(), unit_, {}, text_.where()};
    const std::size_t wide = is_even_ ? 1 : 2;
    require_size(wide);
    std::vector<double> values = is_binary_ ? binary_values(wide) : text_values(wide);
    if (is_even_) {
      found.samples = std::move(values);
    } else {
      std::vector<double> times;
      for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
        times.push_back(values[i]);
        found.samples.push_back(values[i + 1]);
      }
      take_step(times);
    }
    for (double& sample : found.samples) sample *= factor_;
    take_times(raw);
    return found;
  }
  bool is_over_time() const { return is_over_time_; }
  /// Whether its values are displacements, and nothing says in which unit.
  bool has_no_unit() const { return has_no_unit_; }
  /// Of the axis of its values.
  std::string label() const { return columns_of(records_[8], 26, 20); }
  /// Name, node and direction of its response.
  std::string response() const {
    std::string entity = columns_of(records_[5], 31, 10);
    if (entity == "NONE") entity.clear();
    static constexpr std::array<const char*, 7> directions{"",     " +x",  " +y", " +z",
                                                           " +rx", " +ry", " +rz"};
    const double direction = number_in(columns_of(records_[5], 51, 4)).value_or(0.0);
    std::string way;
    if (std::abs(direction) < static_cast<double>(directions.size())) {
      way = directions[static_cast<std::size_t>(std::abs(direction))];
    }
    if (direction < 0.0 && !way.empty()) way[1] = '-';
    return fmt::format("{}{}{}{}", entity, entity.empty() ? "" : " ",
                       columns_of(records_[5], 41, 10), way);
  }

 private:
  /// Cells that are blank are 0, as in Fortran.
  long whole(std::string_view record, std::size_t from, std::size_t size, const char* what) const {
    const std::string cell = columns_of(record, from, size);
    if (cell.empty()) return 0;
    const auto value = parse_as(cell, "");
    if (!value || *value != std::floor(*value) || std::abs(*value) > 1e12) {
      text_.fail(key_,
                 fmt::format("found {}, expected a whole number: its {}", in_quotes(cell), what));
    }
    return static_cast<long>(*value);
  }
  double real(std::string_view record, std::size_t from, const char* what) const {
    const std::string cell = columns_of(record, from, 13);
    if (cell.empty()) return 0.0;
    const auto value = number_in(cell);
    if (!value) {
      text_.fail(key_, fmt::format("found {}, expected a number: its {}", in_quotes(cell), what));
    }
    return *value;
  }
  /// A number as Fortran may write it.
  static std::optional<double> number_in(std::string cell) {
    for (char& c : cell) {
      if (c == 'D' || c == 'd') c = 'E';
    }
    const auto value = parse_as(cell, "");
    if (value) return *value;
    return std::nullopt;
  }

  void read_records(std::optional<double> length_factor) {
    const std::string_view form = records_[6], time = records_[7], response = records_[8];
    const long kind = whole(records_[5], 0, 5, "kind of function");
    const long abscissa = whole(time, 0, 10, "kind of abscissa");
    const bool is_response = kind == RecordCode::time_response;
    is_over_time_ = abscissa == RecordCode::time
                        ? is_response || kind == RecordCode::general
                        : is_response && abscissa <= RecordCode::any_quantity;
    type_ = whole(form, 0, 10, "type of values");
    count_ = whole(form, 10, 10, "number of values");
    is_even_ = whole(form, 20, 10, "spacing of values") != 0;
    start_ = real(form, 30, "first time");
    step_ = real(form, 43, "step of time");
    take_rate_line();
    is_over_time_ = is_over_time_ && count_ != 1;  // one value is a mean or a setting
    if (!is_over_time_) return;
    take_unit_of_time(columns_of(time, 47, 20));
    if (type_ == RecordCode::complex_single || type_ == RecordCode::complex_double) {
      text_.fail(key_, "has complex values, expected samples over time");
    }
    if (type_ != RecordCode::real_single && type_ != RecordCode::real_double) {
      text_.fail(key_,
                 fmt::format("has values of type {}, expected 2 (single) or 4 (double)", type_));
    }
    if (count_ < 1) text_.fail(key_, fmt::format("has {} values, expected two or more", count_));
    unit_ = columns_of(response, 47, 20);
    if (unit_ == "NONE") unit_.clear();
    if (!unit_.empty()) return;
    const long ordinate = whole(response, 0, 10, "kind of ordinate");
    if (ordinate == RecordCode::velocity) unit_ = "m/s";
    if (ordinate == RecordCode::acceleration) unit_ = "m/s^2";
    if (ordinate != RecordCode::displacement) return;
    if (length_factor) {
      unit_ = "m";
      factor_ = 1.0 / *length_factor;
    }
    has_no_unit_ = !length_factor;
  }

  void take_unit_of_time(const std::string& written) {
    if (written.empty() || written == "NONE") return;
    const auto unit = unit_in_table(written, "s");
    if (!unit) text_.fail(key_, "its unit of time: " + unit.problem);
    time_factor_ = *parse_as("1 " + *unit, "s");
  }

  /// A rate in the second line has all digits of what the step is.
  void take_rate_line() {
    const std::string line = trimmed(records_[1]);
    if (!line.starts_with(rate_mark)) return;
    const auto rate = number_in(line.substr(rate_mark.size()));
    if (rate && std::abs(*rate * step_ - 1.0) < step_digits) step_ = 1.0 / *rate;
  }

  /// Its first identification line; the response where that is empty.
  std::string id_or_response() const {
    const std::string id = trimmed(records_[0]);
    return id.empty() || id == "NONE" ? response() : id;
  }

  std::size_t number_size() const { return type_ == RecordCode::real_double ? 8 : 4; }

  /// Nothing is made room for that the file cannot hold.
  void require_size(std::size_t wide) const {
    const auto count = static_cast<std::size_t>(count_);
    constexpr std::size_t least_text = 2;
    const std::size_t least = !is_binary_ ? least_text * wide
                              : wide == 2 ? 4 + number_size()
                                          : number_size();
    if (count > text_.left() / least) {
      text_.fail(key_,
                 fmt::format("is cut off: its {} values do not fit into the {} bytes that are "
                             "left",
                             count, text_.left()));
    }
    if (is_binary_ && (byte_count_ < 0 || static_cast<std::size_t>(byte_count_) < count * least)) {
      text_.fail(key_, fmt::format("says that its {} values take {} bytes", count, byte_count_));
    }
  }

  std::vector<double> binary_values(std::size_t wide) {
    const std::string_view bytes = text_.bytes(static_cast<std::size_t>(byte_count_));
    const std::size_t numbers = static_cast<std::size_t>(count_) * wide;
    // times of values of type double may be single
    const bool has_single_times = wide == 2 && bytes.size() < numbers * number_size();
    std::vector<double> values;
    values.reserve(numbers);
    std::size_t at = 0;
    for (std::size_t i = 0; i < numbers; ++i) {
      const std::size_t size = has_single_times && i % 2 == 0 ? 4 : number_size();
      if (at + size > bytes.size()) text_.fail(key_, "is cut off within its values");
      values.push_back(binary_value(bytes.substr(at, size)));
      at += size;
    }
    return values;
  }
  double binary_value(std::string_view bytes) const {
    std::array<char, 8> turned{};
    const bool is_native = is_little_ == (std::endian::native == std::endian::little);
    if (is_native) {
      std::copy(bytes.begin(), bytes.end(), turned.begin());
    } else {
      std::reverse_copy(bytes.begin(), bytes.end(), turned.begin());
    }
    if (bytes.size() == 4) {
      float single = 0.0F;
      std::memcpy(&single, turned.data(), sizeof single);
      return single;
    }
    double value = 0.0;
    std::memcpy(&value, turned.data(), sizeof value);
    return value;
  }

  /// Values in columns of 13 or 20 characters: 20 for those of type double, not for times.
  std::vector<double> text_values(std::size_t wide) {
    const std::size_t numbers = static_cast<std::size_t>(count_) * wide;
    std::vector<double> values;
    values.reserve(numbers);
    while (values.size() < numbers) {
      if (text_.is_at_end()) text_.fail(key_, "is cut off within its values");
      const std::string_view line = text_.line();
      if (is_mark(line)) {
        text_.fail(key_, fmt::format("ends after {} numbers, expected {}", values.size(), numbers));
      }
      std::size_t at = 0;
      while (at < line.size() && values.size() < numbers) {
        const bool is_time = wide == 2 && values.size() % 2 == 0;
        const std::size_t size = type_ == RecordCode::real_double && !is_time ? 20 : 13;
        const std::string cell = columns_of(line, at, size);
        at += size;
        if (cell.empty()) break;
        values.push_back(text_value(cell));
      }
    }
    return values;
  }
  double text_value(const std::string& cell) const {
    if (const auto value = number_in(cell)) return *value;
    if (plain_name(cell) == "nan") return std::nan("");
    text_.fail(key_, fmt::format("found {}, expected a number in columns of {}", in_quotes(cell),
                                 type_ == RecordCode::real_double ? 20 : 13));
  }

  /// Gives the record its times, which are those of the datasets before.
  void take_times(RawRecord& raw) {
    start_ *= time_factor_;
    step_ *= time_factor_;
    if (!(step_ > 0.0)) text_.fail(key_, fmt::format("has steps of {} s of time", step_));
    if (raw.rate && std::abs(*raw.rate * step_ - 1.0) > step_digits) {
      text_.fail(key_, fmt::format("has {} samples per second, those before have {}", 1.0 / step_,
                                   *raw.rate));
    }
    if (raw.rate && std::abs(raw.start - start_) > even_to * step_) {
      text_.fail(key_, fmt::format("begins at {} s, those before at {} s", start_, raw.start));
    }
    raw.rate = 1.0 / step_;
    raw.start = start_;
  }

  void take_step(const std::vector<double>& times) {
    const std::size_t n = times.size();
    start_ = times.front();
    step_ = (times.back() - times.front()) / static_cast<double>(n - 1);
    for (std::size_t i = 0; i < n; ++i) {
      if (std::abs(times[i] - start_ - step_ * static_cast<double>(i)) <= even_to * step_) continue;
      text_.fail(key_,
                 fmt::format("value {} is at {} s: steps of time must be even", i + 1, times[i]));
    }
  }

  UniversalText& text_;
  std::string key_, unit_;
  std::array<std::string_view, 11> records_;
  bool is_binary_ = false, is_little_ = true, is_even_ = true, is_over_time_ = false;
  bool has_no_unit_ = false;
  long type_ = 0, count_ = 0, byte_count_ = 0;
  double start_ = 0.0, step_ = 0.0, factor_ = 1.0, time_factor_ = 1.0;
};

/// Skips what is left of a dataset.
void skip_dataset(UniversalText& text) {
  while (!text.is_at_end() && !is_mark(text.line())) {
  }
}

/// How many of a file's lengths are a metre, by a dataset 164; nothing: it does not say.
std::optional<double> length_factor_in(UniversalText& text) {
  text.line();
  std::string factors(text.line());
  for (char& c : factors) {
    if (c == 'D' || c == 'd') c = 'E';
  }
  const auto length = parse_as(columns_of(factors, 0, 25), "");
  if (!length || !(*length > 0.0)) return std::nullopt;
  return *length;
}

/// Names of channels: their first lines; of those that have one in common, for instance what kind
/// of function they are, the responses or else the labels, where these differ.
void tell_apart(std::vector<RawChannel>& channels, const std::vector<ResponseNames>& names) {
  std::map<std::string, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < channels.size(); ++i) alike[channels[i].name].push_back(i);
  for (const auto& [first_line, members] : alike) {
    if (members.size() == 1) continue;
    for (const auto name : {&ResponseNames::response, &ResponseNames::label}) {
      std::set<std::string> different;
      for (const std::size_t i : members) different.insert(names[i].*name);
      if (different.size() < members.size()) continue;
      for (const std::size_t i : members) channels[i].name = names[i].*name;
      break;
    }
  }
}

}  // namespace

RawRecord read_universal_record(const std::filesystem::path& path) {
  const std::string bytes = record_bytes(path);
  RawRecord raw{.file = path.string(), .has_own_times = true};
  UniversalText text(bytes, raw.file);
  std::optional<double> length_factor;
  long number = 0;
  std::string others, without_unit;
  std::vector<ResponseNames> names;  // of the channels
  while (!text.is_at_end()) {
    if (!is_mark(text.line())) continue;
    if (text.is_at_end()) break;
    const std::string_view head = text.line();
    const std::string kind = columns_of(head, 0, 6);
    ++number;
    if (kind == "164") {
      length_factor = length_factor_in(text);
    } else if (kind == "58") {
      ResponseDataset dataset(text, head, number, length_factor);
      if (dataset.is_over_time()) {
        raw.channels.push_back(dataset.channel(raw));
        names.push_back({dataset.response(), dataset.label()});
        if (dataset.has_no_unit()) {
          without_unit += fmt::format("{}{}", without_unit.empty() ? "" : ", ", number);
        }
      } else {
        others += fmt::format("{}dataset {} (58, no record over time)", others.empty() ? "" : ", ",
                              number);
      }
    } else {
      others += fmt::format("{}dataset {} ({})", others.empty() ? "" : ", ", number, kind);
    }
    skip_dataset(text);
  }
  if (raw.channels.empty()) {
    throw ModelError({raw.file}, "",
                     fmt::format("has no dataset 58 of a response over time; it has {}",
                                 others.empty() ? "none at all" : others));
  }
  tell_apart(raw.channels, names);
  if (!without_unit.empty()) {
    raw.notes.push_back(fmt::format(
        "the universal file says no unit of the displacements in dataset {}, and has no "
        "dataset 164: they are taken in the unit of the probe",
        without_unit));
  }
  return raw;
}

}  // namespace whirl::inline io
