/// Universal files: datasets 58 (text) and 58b (numbers as a processor has them) of responses over
/// time.

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "libio/measured/record_formats.hpp"
#include "libio/measured/universal_dataset.hpp"
#include "libio/text/units.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

namespace {

using namespace universal;

/// Names of a channel beside its first line.
struct ResponseNames {
  std::string response;  ///< entity, node and direction
  std::string label;     ///< of its axis
};

/// One dataset 58 as a channel.
class ResponseDataset {
 public:
  /// @param factors  of a dataset 164; nothing: there is none
  ResponseDataset(UniversalText& text, std::string_view head, long number,
                  const std::optional<UniversalFactors>& factors)
      : data_(text, head, number) {
    read_records(factors);
  }

  /// Reads its values.
  RawChannel channel(RawRecord& raw) {
    RawChannel found{id_or_response(), unit_, {}, data_.where()};
    std::vector<double> values = data_.numbers();
    if (data_.is_even()) {
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
  std::string label() const { return data_.columns(8, 26, 20); }
  /// Name, node and direction of its response.
  std::string response() const {
    std::string entity = data_.columns(5, 31, 10);
    if (entity == "NONE") entity.clear();
    return fmt::format("{}{}{}", entity, entity.empty() ? "" : " ", data_.end(41, 51));
  }

 private:
  void read_records(const std::optional<UniversalFactors>& factors) {
    const long kind = data_.whole(5, 0, 5, "kind of function");
    const long abscissa = data_.whole(7, 0, 10, "kind of abscissa");
    const bool is_response = kind == RecordCode::time_response;
    is_over_time_ = abscissa == RecordCode::time
                        ? is_response || kind == RecordCode::general
                        : is_response && abscissa <= RecordCode::any_quantity;
    start_ = data_.real(6, 30, "first time");
    step_ = data_.real(6, 43, "step of time");
    take_rate_line();
    is_over_time_ = is_over_time_ && data_.count() != 1;  // one value is a mean or a setting
    if (!is_over_time_) return;
    take_unit_of_time(data_.columns(7, 47, 20));
    if (data_.is_complex()) data_.fail("has complex values, expected samples over time");
    unit_ = data_.columns(8, 47, 20);
    if (unit_ == "NONE") unit_.clear();
    if (!unit_.empty()) return;
    const long ordinate = data_.whole(8, 0, 10, "kind of ordinate");
    if (ordinate == RecordCode::velocity) unit_ = "m/s";
    if (ordinate == RecordCode::acceleration) unit_ = "m/s^2";
    if (ordinate != RecordCode::displacement) return;
    if (factors) {
      unit_ = "m";
      factor_ = 1.0 / factors->length;
    }
    has_no_unit_ = !factors;
  }

  void take_unit_of_time(const std::string& written) {
    if (written.empty() || written == "NONE") return;
    const auto unit = unit_in_table(written, "s");
    if (!unit) data_.fail("its unit of time: " + unit.problem);
    time_factor_ = *parse_as("1 " + *unit, "s");
  }

  /// A rate in the second line has all digits of what the step is.
  void take_rate_line() {
    const std::string line = data_.columns(1, 0, std::string::npos);
    if (!line.starts_with(rate_mark)) return;
    const auto rate = number_in(line.substr(rate_mark.size()));
    if (rate && std::abs(*rate * step_ - 1.0) < step_digits) step_ = 1.0 / *rate;
  }

  /// Its first identification line; the response where that is empty.
  std::string id_or_response() const {
    const std::string id = data_.columns(0, 0, std::string::npos);
    return id.empty() || id == "NONE" ? response() : id;
  }

  /// Gives the record its times, which are those of the datasets before.
  void take_times(RawRecord& raw) {
    start_ *= time_factor_;
    step_ *= time_factor_;
    if (!(step_ > 0.0)) data_.fail(fmt::format("has steps of {} s of time", step_));
    if (raw.rate && std::abs(*raw.rate * step_ - 1.0) > step_digits) {
      data_.fail(
          fmt::format("has {} samples per second, those before have {}", 1.0 / step_, *raw.rate));
    }
    if (raw.rate && std::abs(raw.start - start_) > even_to * step_) {
      data_.fail(fmt::format("begins at {} s, those before at {} s", start_, raw.start));
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
      data_.fail(fmt::format("value {} is at {} s: steps of time must be even", i + 1, times[i]));
    }
  }

  UniversalDataset data_;
  std::string unit_;
  bool is_over_time_ = false, has_no_unit_ = false;
  double start_ = 0.0, step_ = 0.0, factor_ = 1.0, time_factor_ = 1.0;
};

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
  std::optional<UniversalFactors> factors;
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
      factors = factors_in(text);
    } else if (kind == "58") {
      ResponseDataset dataset(text, head, number, factors);
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
