/// LabVIEW measurement files: text, with a header and segments of samples.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/measured/day_time.hpp"
#include "libio/measured/lvm_header.hpp"
#include "libio/measured/record_formats.hpp"
#include "libio/measured/sample_cell.hpp"
#include "libio/text/encoding.hpp"

namespace whirl::inline io {

namespace {

using X = LvmForm::XColumns;

/// What a segment says of the times of its channels, in numbers.
struct LvmTimes {
  double x0 = 0.0, step = nan;     ///< as written, in the unit of x
  std::optional<Stamp> written{};  ///< when it was measured
  std::size_t samples = 0;         ///< as the header says
};

/// The mark of decimals in X0 and Delta_X, of older files that do not say it; 0: they have none.
char decimal_in(const LvmSegment& segment) {
  for (const LvmChannel& c : segment.channels) {
    for (const std::string_view number : {c.x0, c.delta}) {
      const auto mark = number.find_first_of(".,");
      if (mark != std::string_view::npos) return number[mark];
    }
  }
  return '\0';
}

/// A number with a point, where the mark of decimals is another; one with a point is none then.
/// @param decimal  0: any
std::string with_points(std::string_view text, char decimal) {
  std::string plain(text);
  if (decimal == ',') {
    std::replace(plain.begin(), plain.end(), '.', '?');
    std::replace(plain.begin(), plain.end(), ',', '.');
  } else if (decimal == '.') {
    std::replace(plain.begin(), plain.end(), ',', '?');
  }
  return plain;
}

/// Numbers of the headers of segments.
struct LvmNumbers {
  std::string file;
  char decimal = '\0';

  /// A number of a header, whose point or comma is that of decimals.
  double number(std::string_view text, int line, const char* tag, std::string_view channel) const {
    const auto value = finite_sample_of(with_points(text, decimal));
    if (value) return *value;
    throw ModelError(
        Where{file, line, 1}, std::string(channel),
        fmt::format("{} is \"{}\" in the header of this segment, expected a number", tag, text));
  }

  LvmTimes times_of(const LvmChannel& c, int line) const {
    LvmTimes times;
    if (!c.dimension.empty() && c.dimension != "Time") {
      throw ModelError(Where{file, line, 1}, std::string(c.name),
                       fmt::format("X_Dimension is {}, expected Time: samples over anything else "
                                   "are no record of a motion",
                                   c.dimension));
    }
    if (!c.x0.empty()) times.x0 = number(c.x0, line, "X0", c.name);
    if (!c.delta.empty()) times.step = number(c.delta, line, "Delta_X", c.name);
    if (!(times.step > 0.0) && !c.delta.empty()) {
      throw ModelError(Where{file, line, 1}, std::string(c.name),
                       fmt::format("Delta_X is {}, expected a step above 0", c.delta));
    }
    if (!c.samples.empty()) {
      times.samples = static_cast<std::size_t>(
          std::clamp(number(c.samples, line, "Samples", c.name), 0.0, 1e15));
    }
    const auto day = day_of(c.date);
    const auto time = time_of_day(c.time);
    if (day && time) times.written = Stamp{day, *time};
    return times;
  }
};

/// Makes a record of the segments of a file.
class LvmRecord {
 public:
  LvmRecord(const LvmFile& lvm, const std::string& file)
      : lvm_(lvm), header_{file, lvm.form.decimal} {
    raw_.file = file;
  }

  RawRecord read() {
    if (lvm_.segments.empty()) {
      throw ModelError({raw_.file}, "", "has no samples: no header of a segment follows");
    }
    if (header_.decimal == '\0') header_.decimal = decimal_in(lvm_.segments.front());
    take_channels(lvm_.segments.front());
    for (std::size_t s = 0; s < lvm_.segments.size(); ++s) {
      const LvmSegment& segment = lvm_.segments[s];
      require_same_channels(segment);
      const std::size_t before = raw_.channels[reference_].samples.size();
      for (const CsvLine& row : segment.rows) add_row(row, segment);
      if (raw_.channels[reference_].samples.size() == before) {
        throw ModelError({raw_.file, segment.line, 1}, "", "a segment has no samples");
      }
      append_segment(s, before);
    }
    return finished();
  }

 private:
  Where at(int line, std::size_t column = 0) const {
    return {raw_.file, line, static_cast<int>(column) + 1};
  }

  /// The channels of the file: those of the first segment that have samples, at the same times as
  /// the first one with most samples.
  void take_channels(const LvmSegment& segment) {
    std::vector<LvmTimes> all;
    for (const LvmChannel& c : segment.channels) all.push_back(header_.times_of(c, segment.line));
    const auto most = std::max_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.samples < b.samples; });
    const auto first = static_cast<std::size_t>(most - all.begin());
    for (std::size_t k = 0; k < all.size(); ++k) {
      const LvmChannel& c = segment.channels[k];
      std::string why;
      if (k != first && !c.samples.empty() && all[k].samples == 0) {
        why = "it has no samples (Samples is 0)";
      } else if (k != first && !c.delta.empty() && all[k].step != most->step) {
        why = fmt::format("its Delta_X is {}, that of {} is {}", c.delta,
                          segment.channels[first].name, segment.channels[first].delta);
      } else if (std::abs(all[k].x0 - most->x0) > even_to * most->step) {
        why = fmt::format("its X0 is {}, that of {} is {}", c.x0, segment.channels[first].name,
                          segment.channels[first].x0);
      }
      if (!why.empty()) {
        raw_.notes.push_back(fmt::format("channel \"{}\" is left out: {}", c.name, why));
        raw_.left_out.push_back({std::string(c.name), why});
        continue;
      }
      if (k == first) reference_ = raw_.channels.size();
      taken_.push_back(k);
      is_short_.push_back(all[k].samples < most->samples);
      raw_.channels.push_back({std::string(c.name), std::string(c.unit), {}, at(segment.line)});
    }
    step_ = most->step;
    times_.name = "time";
    times_.unit = std::string(segment.channels[first].x_unit);
    times_.where = at(segment.line);
    const auto seconds = seconds_in(times_.unit);
    if (!seconds) throw ModelError(times_.where, "X_Unit_Label", seconds.problem);
    seconds_ = *seconds;
  }

  void require_same_channels(const LvmSegment& segment) const {
    const std::vector<LvmChannel>& first = lvm_.segments.front().channels;
    const bool are_same = std::equal(
        first.begin(), first.end(), segment.channels.begin(), segment.channels.end(),
        [](const LvmChannel& a, const LvmChannel& b) {
          return a.name == b.name && a.unit == b.unit && a.delta == b.delta && a.x_unit == b.x_unit;
        });
    if (are_same) return;
    throw ModelError(at(segment.line), "",
                     fmt::format("this segment has other channels, units or steps than that of "
                                 "line {}, and they are no one record: save each as a file",
                                 lvm_.segments.front().line));
  }

  void add_row(const CsvLine& row, const LvmSegment& segment) {
    const auto cells = lvm_cells(row.text, lvm_.form.separator);
    const bool is_blank =
        std::all_of(cells.begin(), cells.end(), [](auto cell) { return cell.empty(); });
    if (is_blank && cells.size() <= segment.channels.back().column) return;
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      const LvmChannel& c = segment.channels[taken_[i]];
      const std::string_view cell = c.column < cells.size() ? cells[c.column] : "";
      raw_.channels[i].samples.push_back(sample(cell, i, row, c.column));
    }
    if (lvm_.form.x == X::none) return;
    const auto x = [&](const LvmChannel& c) {
      const std::string_view cell = c.x_column < cells.size() ? cells[c.x_column] : "";
      return sample(cell, taken_.size(), row, c.x_column);
    };
    const double time = x(segment.channels[taken_[reference_]]);
    times_.samples.push_back(time);
    if (lvm_.form.x != X::each) return;
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      const LvmChannel& c = segment.channels[taken_[i]];
      const double own = x(c), apart = std::abs(own - time);
      if (std::isnan(own) || std::isnan(time)) continue;
      if (apart <= (std::isnan(step_) ? 0.0 : even_to * step_)) continue;
      throw ModelError(at(row.number), std::string(c.name),
                       fmt::format("is at {}, and {} is at {}: channels at other times are no one "
                                   "record, save each as a file",
                                   own, raw_.channels[reference_].name, time));
    }
  }

  double sample(std::string_view cell, std::size_t channel, const CsvLine& row,
                std::size_t column) {
    const auto value = sample_of(with_points(cell, header_.decimal));
    const bool is_time = channel == taken_.size();
    const std::string name = is_time ? "X_Value" : raw_.channels[channel].name;
    if (!value) {
      throw ModelError(
          at(row.number, 0), name,
          fmt::format("found \"{}\" in column {}, expected a number{}; leave cells of "
                      "missing samples empty",
                      cell, column + 1,
                      header_.decimal == '\0' ? ""
                                              : fmt::format(" with \"{}\" before its decimals, as "
                                                            "the header has them",
                                                            header_.decimal)));
    }
    if (!is_time && is_no_reading(cell)) no_readings_.add(cell, channel, at(row.number));
    return *value;
  }

  /// Puts a segment behind those before it, if it follows evenly.
  void append_segment(std::size_t s, std::size_t before) {
    const LvmSegment& segment = lvm_.segments[s];
    const LvmTimes times = header_.times_of(segment.channels[taken_[reference_]], segment.line);
    const std::size_t count = raw_.channels[reference_].samples.size() - before;
    const bool has_x = lvm_.form.x != X::none;
    const double first = has_x ? times_.samples[before] : times.x0;
    const double last =
        has_x ? times_.samples.back() : times.x0 + static_cast<double>(count - 1) * times.step;
    const double step =
        std::isnan(step_) && count > 1 ? (last - first) / static_cast<double>(count - 1) : step_;
    if (s == 0) {
      start_ = first;
    } else {
      const double expected = last_ + step;
      // times that begin anew in every segment count from its date and time
      const bool begins_anew = first == start_ && times.written && written_;
      const double shift =
          begins_anew ? seconds_between(*written_, *times.written) / seconds_ : 0.0;
      if (!(std::abs(first + shift - expected) <= even_to * step)) {
        throw ModelError(
            at(segment.line), "",
            fmt::format("segment {} begins at {:.9g}{}, expected {:.9g}, a step behind "
                        "the one before: there is a gap, or its times are its own; "
                        "save each segment as a file",
                        s + 1, first + shift, begins_anew ? " by its date and time" : "",
                        expected));
      }
      shift_ = shift;
    }
    if (!written_) written_ = times.written;
    for (std::size_t j = before; has_x && j < times_.samples.size(); ++j) {
      times_.samples[j] += shift_;
    }
    last_ = last + shift_;
  }

  RawRecord finished() {
    const LvmSegment& segment = lvm_.segments.front();
    const LvmTimes times = header_.times_of(segment.channels[taken_[reference_]], segment.line);
    const std::string_view delta = segment.channels[taken_[reference_]].delta;
    const bool has_x = lvm_.form.x != X::none;
    // cells below the last sample of a channel with fewer than others
    for (std::size_t i = 0; lvm_.segments.size() == 1 && i < raw_.channels.size(); ++i) {
      std::vector<double>& samples = raw_.channels[i].samples;
      while (is_short_[i] && !samples.empty() && std::isnan(samples.back())) samples.pop_back();
    }
    no_readings_.tell(raw_);
    const bool counts = !has_x || raw_.channels[reference_].samples.size() < 2 ||
                        times_.samples[1] - times_.samples[0] == times.step;
    if (times.step == 1.0 && counts) {
      raw_.no_rate_because =
          "Delta_X is 1, which LabVIEW writes where it does not know the rate, too";
      return std::move(raw_);
    }
    if (std::isfinite(times.step)) take_step(delta, times);
    if (has_x) {
      raw_.channels.push_back(std::move(times_));
    } else if (!raw_.rate) {
      raw_.no_rate_because = "there is no Delta_X";
    }
    return std::move(raw_);
  }

  /// Takes the rate of Delta_X, whose digits may be few: "0.000333" is 1/3000, rounded.
  void take_step(std::string_view delta, const LvmTimes& times) {
    raw_.rate = 1.0 / (seconds_ * times.step);
    raw_.start = seconds_ * start_;
    const auto mark = delta.find_first_of(".,");
    const auto exponent = std::min(delta.find_first_of("eE"), delta.size());
    if (mark == std::string_view::npos || exponent != delta.size()) return;
    const double last_digit = std::pow(10.0, -static_cast<double>(delta.size() - mark - 1));
    const double whole = std::round(1.0 / times.step);
    if (std::abs(whole * times.step - 1.0) < 1e-9) return;
    raw_.rate_within = 0.5 * last_digit / times.step;
    if (lvm_.form.x != X::none) return;
    raw_.notes.push_back(fmt::format(
        "Delta_X is {} in the header: its digits leave the rate open to {:.2g} %, and --rate says "
        "it with more",
        delta, 100.0 * raw_.rate_within));
  }

  const LvmFile& lvm_;
  LvmNumbers header_;
  RawRecord raw_;
  RawChannel times_;
  std::vector<std::size_t> taken_;  ///< columns of the channels of the record
  std::size_t reference_ = 0;       ///< of these, the one whose times count
  NoReadings no_readings_;
  double start_ = 0.0, last_ = 0.0, shift_ = 0.0;  ///< of times, as written
  double step_ = nan;                              ///< of the header, as written
  double seconds_ = 1.0;                           ///< of a unit of times
  std::vector<bool> is_short_;  ///< by the header, which of the channels have fewer samples
  std::optional<Stamp> written_{};
};

}  // namespace

RawRecord read_lvm_record(const std::filesystem::path& path) {
  const std::string file = path.string();
  const auto text = in_utf8(record_bytes(path));
  if (!text) throw ModelError({file}, "", text.problem);
  // LabVIEW also writes such files without any header: tables
  if (!is_lvm(*text)) return read_csv_text(*text, file);
  const LvmFile lvm = lvm_file(*text, file);
  return LvmRecord(lvm, file).read();
}

}  // namespace whirl::inline io
