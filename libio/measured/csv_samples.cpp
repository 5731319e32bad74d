#include "libio/measured/csv_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline io {

bool is_remark(const Cell& cell) {
  return !begins_as_number(cell.text) && !is_missing(cell.text) && !is_no_reading(cell.text);
}

bool is_sample(const std::string& cell) {
  return sample_of(cell) || stamp_of(cell) || day_of(cell);
}

std::vector<Cell> csv_cells(std::string_view line, const CsvForm& form) {
  std::vector<Cell> cells = cells_of(line, form.delimiter);
  const bool has_end = form.ends_with_delimiter && cells.size() == form.columns + 1;
  if (has_end && is_remark(cells.back())) cells.pop_back();
  while (cells.size() > form.columns && cells.back().text.empty()) cells.pop_back();
  return cells;
}

CsvSamples::CsvSamples(RawRecord& raw, const CsvForm& form, bool has_names)
    : raw_(raw), form_(form), marks_{form.delimiter} {
  may_be_decimals_ =
      form.delimiter == Delimiter::comma && !has_names && raw.channels.size() % 2 == 0;
}

void CsvSamples::add(const CsvLine& line, int first_line) {
  const std::vector<Cell> cells = csv_cells(line.text, form_);
  const std::size_t count = raw_.channels.size();
  if (cells.size() != count) {
    throw ModelError({raw_.file, line.number, 1}, "",
                     fmt::format("found {} columns, expected {} as in line {}", cells.size(), count,
                                 first_line));
  }
  for (std::size_t c = 0; c < count; ++c) add(cells[c], line, c);
}

void CsvSamples::add(const Cell& cell, const CsvLine& line, std::size_t c) {
  RawChannel& channel = raw_.channels[c];
  auto value = sample_of(cell.text);
  const Where where{raw_.file, line.number, cell.place};
  if (!value) {
    value = stamp(cell.text, c);
    if (value) may_be_decimals_ = false;
  } else if (std::isfinite(*value) && stamps_.contains(c)) {
    throw ModelError(where, channel.name,
                     fmt::format("found {}, expected a date or a time of the day as above",
                                 in_quotes(cell.text)));
  }
  if (!value) {
    throw ModelError(where, channel.name,
                     fmt::format("found {}, expected a number{}; leave cells of missing samples "
                                 "empty or write nan",
                                 in_quotes(cell.text),
                                 begins_as_number(cell.text) ? " without marks of thousands" : ""));
  }
  channel.samples.push_back(*value);
  if (std::isnan(*value) && is_no_reading(cell.text)) no_readings_.add(cell.text, c, where);
  if (stamps_.contains(c)) return;
  if (const char mark = marks_.add(cell.text); mark != '\0') {
    Doubt& first = mark == ',' ? comma_ : point_;
    if (first.cell.empty()) first = {cell.text, channel.name, where};
  }
  if (may_be_decimals_) {
    const std::string_view digits =
        std::string_view(cell.text).substr(c % 2 == 0 && cell.text.starts_with('-') ? 1 : 0);
    may_be_decimals_ =
        !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
  }
}

std::optional<double> CsvSamples::stamp(const std::string& cell, std::size_t c) {
  const auto found = stamp_of(cell);
  const bool is_date = !found && day_of(cell);
  if (!found && !is_date) return std::nullopt;
  const std::vector<double>& above = raw_.channels[c].samples;
  const auto [known, is_new] = stamps_.try_emplace(c, Stamps{cell, found});
  Stamps& stamps = known->second;
  if (is_new) {
    const bool has_numbers =
        std::any_of(above.begin(), above.end(), [](double v) { return std::isfinite(v); });
    if (has_numbers) stamps_.erase(c);
    return has_numbers ? std::nullopt : std::optional(is_date ? nan : 0.0);
  }
  if (is_date != !stamps.last) return std::nullopt;
  if (is_date) return nan;
  stamps.since_first += seconds_between(*stamps.last, *found);
  stamps.passes_midnight |= found->time < stamps.last->time;
  stamps.last = *found;
  return stamps.since_first;
}

void CsvSamples::finish() {
  require_one_reading();
  no_readings_.tell(raw_);
  take_stamps();
}

void CsvSamples::require_one_reading() {
  for (const Doubt& doubt : {comma_, point_}) {
    if (doubt.cell.empty()) continue;
    const auto number = plain_number(doubt.cell, marks_);
    if (!number) throw ModelError(doubt.where, doubt.channel, number.problem);
  }
  if (!point_.cell.empty() && !marks_.has_decimal_points && form_.delimiter != Delimiter::comma) {
    raw_.notes.push_back(fmt::format(
        "points are taken as decimal ones ({}), and no number shows that they are none of "
        "thousands",
        point_.cell));
  }
  if (may_be_decimals_) {
    throw ModelError(
        raw_.channels.front().where, "",
        fmt::format("the commas may stand between {} columns of whole numbers, or be decimal "
                    "ones of {}, and no line names the columns: write such a line, or semicolons "
                    "between columns",
                    raw_.channels.size(), raw_.channels.size() / 2));
  }
}

void CsvSamples::take_stamps() {
  bool has_times = false;
  for (const auto& [c, stamps] : stamps_) {
    if (!stamps.last) continue;
    raw_.channels[c].unit = "s";
    if (!std::exchange(has_times, true)) {
      raw_.notes.push_back(fmt::format("times of the day count from the first sample, at {}{}",
                                       stamps.first,
                                       stamps.passes_midnight ? ", and go on past midnight" : ""));
    }
  }
  // dates, from the last column on
  for (auto at = stamps_.rbegin(); at != stamps_.rend(); ++at) {
    const auto& [c, stamps] = *at;
    if (stamps.last) continue;
    if (!has_times) {
      throw ModelError(raw_.channels[c].where, raw_.channels[c].name,
                       fmt::format("found {}, a date: expected times of the day beside it, or "
                                   "numbers",
                                   in_quotes(stamps.first)));
    }
    raw_.channels.erase(raw_.channels.begin() + static_cast<std::ptrdiff_t>(c));
  }
}

}  // namespace whirl::inline io
