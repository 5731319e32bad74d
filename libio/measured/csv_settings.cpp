#include "libio/measured/csv_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libio/measured/raw_record.hpp"
#include "libio/measured/sample_cell.hpp"
#include "libio/text/encoding.hpp"

namespace whirl::inline io {

namespace {

constexpr double same_setting = 0.01;  ///< to which a rate and a step agree

enum class Setting { none, rate, step, start, time_unit, units, length };

/// What a line says, as it is written.
struct SettingLine {
  Setting kind = Setting::none;
  std::string name;
  std::string number;                ///< of rate, step, start, length
  std::string unit;                  ///< behind the number, or in the brackets of the name
  std::vector<std::string> texts{};  ///< all cells behind the name
  int line = 0;
};

struct KnownSetting {
  std::string_view name;  ///< as plain_name has it
  Setting kind;
};

constexpr std::array<KnownSetting, 36> known_settings{{
    {"sampleinterval", Setting::step},
    {"samplinginterval", Setting::step},
    {"deltax", Setting::step},
    {"deltat", Setting::step},
    {"dt", Setting::step},
    {"xincrement", Setting::step},
    {"xincr", Setting::step},
    {"xinc", Setting::step},
    {"timeincrement", Setting::step},
    {"timestep", Setting::step},
    {"tinc", Setting::step},
    {"sampletime", Setting::step},
    {"sampleperiod", Setting::step},
    {"samplingperiod", Setting::step},
    {"abtastintervall", Setting::step},
    {"abtastzeit", Setting::step},
    {"abtastrate", Setting::rate},
    {"abtastfrequenz", Setting::rate},
    {"messrate", Setting::rate},
    {"scanrate", Setting::rate},
    {"acquisitionrate", Setting::rate},
    {"samplefreq", Setting::rate},
    {"samplingfreq", Setting::rate},
    {"x0", Setting::start},
    {"xzero", Setting::start},
    {"xorigin", Setting::start},
    {"t0", Setting::start},
    {"horizontalunits", Setting::time_unit},
    {"horizontalunit", Setting::time_unit},
    {"xunits", Setting::time_unit},
    {"xunitlabel", Setting::time_unit},
    {"verticalunits", Setting::units},
    {"verticalunit", Setting::units},
    {"yunits", Setting::units},
    {"yunitlabel", Setting::units},
    {"recordlength", Setting::length},
}};

Setting kind_of(const std::string& name) {
  if (names_rate(name)) return Setting::rate;
  const std::string plain = plain_name(name);
  const auto known = std::find_if(known_settings.begin(), known_settings.end(),
                                  [&](const KnownSetting& s) { return s.name == plain; });
  return known == known_settings.end() ? Setting::none : known->kind;
}

/// Cells behind the mark that ends the name; what stands behind a colon is one.
std::vector<std::string> cells_behind(std::string_view text, char mark) {
  std::vector<std::string> cells;
  while (true) {
    const auto end = mark == ':' || mark == '=' ? std::string_view::npos : text.find(mark);
    cells.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  return cells;
}

/// A line as a setting; kind none: it is not one.
SettingLine setting_in(std::string_view line) {
  constexpr std::string_view comments = "#%!/\" \t*";
  const auto first = line.find_first_not_of(comments);
  if (first == std::string_view::npos) return {};
  std::string_view text = line.substr(first);
  auto end = text.find_first_of(":=,;\t|");
  if (end == std::string_view::npos) end = text.find(' ');  // "Delta_X 0.001"
  if (end == std::string_view::npos || end == 0) return {};
  SettingLine said;
  const NameAndUnit name =
      name_and_unit(trimmed(text.substr(0, end)), [](auto&&, auto&&) { return false; });
  said.name = name.name;
  said.unit = name.unit;
  said.texts = cells_behind(text.substr(end + 1), text[end]);
  const Setting kind = kind_of(said.name);
  if (kind == Setting::none || said.texts.empty()) return {};
  if (kind == Setting::time_unit || kind == Setting::units) {
    said.kind = begins_as_number(said.texts.front()) ? Setting::none : kind;
    return said;
  }
  const auto value = std::find_if(said.texts.begin(), said.texts.end(),
                                  [](const std::string& cell) { return !cell.empty(); });
  const std::string& cell = *value;
  auto letter = std::min(cell.find_first_not_of("+-.,0123456789eE"), cell.size());
  while (letter > 0 && (cell[letter - 1] == 'e' || cell[letter - 1] == 'E')) --letter;
  said.number = trimmed(cell.substr(0, letter));
  if (!begins_as_number(said.number)) return {};
  const std::string behind = trimmed(cell.substr(letter));
  if (!behind.empty()) {
    said.unit = behind;
  } else if (value + 1 != said.texts.end() && !(value + 1)->empty() && said.unit.empty()) {
    said.unit = *(value + 1);
  }
  if (said.unit.starts_with('[') || said.unit.starts_with('(')) {
    said.unit = trimmed(std::string_view(said.unit).substr(1, said.unit.find_first_of("])") - 1));
  }
  said.kind = kind;
  return said;
}

/// Samples per second of a unit of rates, in whatever way it is written; nothing: it is none.
std::optional<double> per_second_in(const std::string& unit) {
  static constexpr std::array<std::string_view, 14> bases{"hz",
                                                          "s/s",
                                                          "sa/s",
                                                          "sps",
                                                          "1/s",
                                                          "/s",
                                                          "s^-1",
                                                          "samples/s",
                                                          "sample/s",
                                                          "samples/sec",
                                                          "samples/second",
                                                          "persecond",
                                                          "pts/s",
                                                          "samplespersecond"};
  std::string plain = lower_case(unit);
  std::erase(plain, ' ');
  const auto is_base = [](std::string_view text) {
    return std::find(bases.begin(), bases.end(), text) != bases.end();
  };
  if (is_base(plain)) return 1.0;
  if (plain.empty() || !is_base(std::string_view(plain).substr(1))) return std::nullopt;
  if (plain[0] == 'k') return 1e3;
  if (unit[unit.find_first_not_of(' ')] == 'M') return 1e6;
  if (plain[0] == 'g') return 1e9;
  return std::nullopt;
}

class SettingsReader {
 public:
  explicit SettingsReader(const std::string& file) : file_(file) {}

  void take(const SettingLine& said) {
    if (said.kind == Setting::rate) rate_ = said;
    if (said.kind == Setting::step) step_ = said;
    if (said.kind == Setting::start) start_ = said;
    if (said.kind == Setting::length) found_.length = number(said);
    if (said.kind == Setting::units) found_.units = said.texts;
    if (said.kind == Setting::time_unit) {
      // oscilloscopes write seconds as S, too
      found_.time_unit = said.texts.front() == "S" ? "s" : said.texts.front();
    }
  }

  CsvSettings finished() {
    const auto rate = rate_ ? rate_of_line() : std::nullopt;
    const auto step = step_ ? step_of_line() : std::nullopt;
    if (rate && step && !(std::abs(*rate * *step - 1.0) <= same_setting)) {
      throw ModelError({file_, step_->line, 1}, step_->name,
                       fmt::format("says {:.6g} samples per second, line {} says {:.6g}: one of "
                                   "them is wrong, or in another unit",
                                   1.0 / *step, rate_->line, *rate));
    }
    found_.rate = step ? std::optional(1.0 / *step) : rate;
    if (rate) found_.rate = rate;
    if (found_.rate) found_.doubt.clear();
    if (start_) found_.start = number(*start_) * seconds(*start_);
    return std::move(found_);
  }

 private:
  double number(const SettingLine& said) const {
    const auto wrong = [&](const std::string& why) {
      return ModelError({file_, said.line, 1}, said.name, why);
    };
    const auto comma = said.number.find(',');
    const std::string_view digits = said.number;
    const bool may_be_thousands =
        comma != std::string::npos && comma > 0 && comma <= 3 && digits.size() == comma + 4 &&
        digits.front() != '0' &&
        digits.substr(comma + 1).find_first_not_of("0123456789") == std::string_view::npos;
    if (may_be_thousands) {
      throw wrong(
          fmt::format("the comma in \"{}\" may be that of thousands or of decimals: write "
                      "{}{} or {}.{}",
                      digits, digits.substr(0, comma), digits.substr(comma + 1),
                      digits.substr(0, comma), digits.substr(comma + 1)));
    }
    const auto value = finite_sample_of(digits);
    if (!value) {
      throw wrong(
          fmt::format("found \"{}\", expected a number without marks of thousands", digits));
    }
    return *value;
  }

  double seconds(const SettingLine& said) const {
    const std::string& unit = said.unit.empty() ? found_.time_unit : said.unit;
    const auto factor = seconds_in(unit);
    if (factor) return *factor;
    throw ModelError({file_, said.line, 1}, said.name,
                     fmt::format("is in \"{}\", expected a unit of time, such as s or ms", unit));
  }

  std::optional<double> rate_of_line() {
    const double value = number(*rate_);
    if (!(value > 0.0)) return std::nullopt;
    if (!rate_->unit.empty()) {
      const auto factor = per_second_in(rate_->unit);
      if (factor) return value * *factor;
      throw ModelError(
          {file_, rate_->line, 1}, rate_->name,
          fmt::format("is in \"{}\", expected a unit of rates, such as Hz or kHz", rate_->unit));
    }
    constexpr double usual = 1000.0;  // below, kHz may be meant
    if (value * longest_step >= 1.0) {
      if (value < usual) {
        found_.notes.push_back(
            fmt::format("{} {} in line {} has no unit: taken as samples per "
                        "second",
                        rate_->name, rate_->number, rate_->line));
      }
      return value;
    }
    found_.doubt = fmt::format(
        "line {} says {} {} without unit, which are so many per second, or "
        "{:.6g} in kHz: write the unit",
        rate_->line, rate_->name, rate_->number, 1e3 * value);
    return std::nullopt;
  }

  std::optional<double> step_of_line() {
    const double value = number(*step_);
    if (!(value > 0.0)) return std::nullopt;
    const double step = value * seconds(*step_);
    if (!step_->unit.empty() || !found_.time_unit.empty()) return step;
    if (value > longest_step) {
      found_.doubt = fmt::format(
          "line {} says {} {} without unit, which are seconds, or {:.6g} s "
          "in ms: write the unit",
          step_->line, step_->name, step_->number, 1e-3 * value);
      return std::nullopt;
    }
    found_.notes.push_back(fmt::format("{} {} in line {} has no unit: taken as seconds",
                                       step_->name, step_->number, step_->line));
    return step;
  }

  const std::string& file_;
  CsvSettings found_;
  std::optional<SettingLine> rate_{}, step_{}, start_{};
};

}  // namespace

bool is_csv_setting(std::string_view line) {
  return setting_in(line).kind != Setting::none;
}

CsvSettings csv_settings(const std::vector<CsvLine>& lines, const std::string& file) {
  SettingsReader reader(file);
  for (const CsvLine& line : lines) {
    SettingLine said = setting_in(line.text);
    said.line = line.number;
    reader.take(said);
  }
  return reader.finished();
}

}  // namespace whirl::inline io
