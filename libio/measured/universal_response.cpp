/// Universal files: datasets 58 and 58b of frequency responses.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/structs/names.hpp"
#include "libio/measured/law_parts.hpp"
#include "libio/measured/record_formats.hpp"
#include "libio/measured/universal_dataset.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/file_bytes.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/text/vendor_units.hpp"

namespace whirl::inline io {

namespace {

using namespace universal;

/// What the values of a function are: a motion over a force, or a force over a motion.
struct ResponseMeaning {
  bool is_known = false;   ///< the file says it
  bool is_inverse = true;  ///< a motion over a force
  int rate = 0;            ///< 0, 1, 2: the motion is a displacement, velocity or acceleration

  /// What the model calls it; nothing: it has no name there.
  std::optional<TransferForm> form() const {
    if (!is_known || rate > 1) return std::nullopt;
    if (is_inverse) return rate == 0 ? TransferForm::receptance : TransferForm::mobility;
    return rate == 0 ? TransferForm::dynamic_stiffness : TransferForm::impedance;
  }
};

/// A dataset 58 of a frequency response.
struct ResponseFunction {
  long number = 0;                  ///< of the functions of the file, from 1
  std::string response, reference;  ///< node and direction, "12+x"
  ResponseMeaning meaning;
  bool has_unit = true;
  Vec omega;  ///< [rad/s]
  CVec H;     ///< [SI]
};

constexpr double standard_gravity = 9.80665;  ///< [m/s^2]

bool is_force(long kind) {
  return kind == RecordCode::reaction_force || kind == RecordCode::excitation_force;
}

/// 0, 1, 2 of a displacement, velocity and acceleration; -1: it is none of them.
int rate_of(long kind) {
  constexpr long kinds[] = {RecordCode::displacement, RecordCode::velocity,
                            RecordCode::acceleration};
  const auto* at = std::ranges::find(kinds, kind);
  return at == std::end(kinds) ? -1 : static_cast<int>(at - std::begin(kinds));
}

ResponseMeaning meaning_of(const UniversalDataset& data) {
  const long of = data.whole(8, 0, 10, "kind of ordinate"),
             by = data.whole(9, 0, 10, "kind of denominator");
  if (rate_of(of) >= 0 && is_force(by)) return {true, true, rate_of(of)};
  if (is_force(of) && rate_of(by) >= 0) return {true, false, rate_of(by)};
  if (of > RecordCode::any_quantity && by > RecordCode::any_quantity) {
    data.fail(
        fmt::format("is of kind {} over {}, expected a displacement (8), velocity (11) or "
                    "acceleration (12) over a force (9 or 13), or a force over these",
                    of, by));
  }
  return {};
}

/// The factor to SI of an axis that says a unit; nothing: it says none.
std::optional<double> factor_of(const UniversalDataset& data, std::size_t record,
                                const char* si_unit) {
  const std::string written = data.columns(record, 47, 20);
  if (written.empty() || written == "NONE") return std::nullopt;
  if (written == "g" && std::string_view(si_unit) == "m/s^2") return standard_gravity;
  const auto unit = unit_in_table(written, si_unit);
  if (!unit) data.fail("its unit: " + unit.problem);
  return *parse_as("1 " + *unit, si_unit);
}

/// From the units of the values to SI, by what the axes say, or else a dataset 164.
double factor_of(const UniversalDataset& data, const std::optional<UniversalFactors>& factors,
                 ResponseFunction& function) {
  constexpr const char* motion_units[] = {"m", "m/s", "m/s^2"};
  const ResponseMeaning& meaning = function.meaning;
  if (!meaning.is_known) return 1.0;
  const char* motion = motion_units[meaning.rate];
  const auto upper = factor_of(data, 8, meaning.is_inverse ? motion : "N");
  const auto lower = factor_of(data, 9, meaning.is_inverse ? "N" : motion);
  function.has_unit = factors.has_value() || (upper && lower);
  const double length = factors ? 1.0 / factors->length : 1.0,
               force = factors ? 1.0 / factors->force : 1.0;
  return upper.value_or(meaning.is_inverse ? length : force) /
         lower.value_or(meaning.is_inverse ? force : length);
}

void read_values(UniversalDataset& data, double factor, ResponseFunction& function) {
  const std::string written = data.columns(7, 47, 20);
  const auto unit = unit_in_table(written.empty() || written == "NONE" ? "Hz" : written, "rad/s");
  if (!unit) data.fail("its unit of frequency: " + unit.problem);
  const double to_rad = *parse_as("1 " + *unit, "rad/s");
  const double first = data.real(6, 30, "first frequency"), step = data.real(6, 43, "step");
  const std::vector<double> numbers = data.numbers();
  require_law_size(data.where().file, "response", {static_cast<std::size_t>(data.count())});
  const Eigen::Index n = data.count();
  function.omega.resize(n);
  function.H.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t at = static_cast<std::size_t>(k) * data.wide();
    const std::size_t part = at + (data.is_even() ? 0 : 1);
    const double f = data.is_even() ? first + static_cast<double>(k) * step : numbers[at];
    function.omega(k) = to_rad * f;
    function.H(k) = factor * Complex(numbers[part], numbers[part + 1]);
  }
}

std::string plain_end(std::string text) {
  std::erase(text, ' ');
  return text;
}

/// All frequency responses of a file; of others their kinds are kept in words.
std::vector<ResponseFunction> functions_of(const std::string& bytes, const std::string& file,
                                           std::string& others) {
  UniversalText text(bytes, file);
  std::optional<UniversalFactors> factors;
  std::vector<ResponseFunction> found;
  long number = 0;
  while (!text.is_at_end()) {
    if (!is_mark(text.line())) continue;
    if (text.is_at_end()) break;
    const std::string_view head = text.line();
    const std::string kind = columns_of(head, 0, 6);
    ++number;
    bool is_response = false;
    if (kind == "164") factors = factors_in(text);
    if (kind == "58") {
      UniversalDataset data(text, head, number);
      const long function_kind = data.whole(5, 0, 5, "kind of function");
      is_response = data.is_complex() && (function_kind == RecordCode::frequency_response ||
                                          function_kind == RecordCode::general);
      if (is_response) {
        ResponseFunction f{.number = std::ssize(found) + 1,
                           .response = plain_end(data.end(41, 51)),
                           .reference = plain_end(data.end(66, 76)),
                           .meaning = meaning_of(data)};
        read_values(data, factor_of(data, factors, f), f);
        found.push_back(std::move(f));
      }
    }
    if (!is_response) {
      others += fmt::format("{}dataset {} ({})", others.empty() ? "" : ", ", number, kind);
    }
    skip_dataset(text);
  }
  return found;
}

/// Chooses the functions that make a matrix.
class FunctionChoice {
 public:
  FunctionChoice(const std::vector<ResponseFunction>& all, std::string file)
      : all_(all), file_(std::move(file)) {}

  /// Row by row of the matrix.
  /// @param part  as in law_table
  std::vector<const ResponseFunction*> chosen(const std::string& part, int ports) const {
    if (!part.empty() && part.find_first_not_of("0123456789") == std::string::npos) {
      const auto at = std::ranges::find_if(
          all_, [&](const ResponseFunction& f) { return fmt::format("{}", f.number) == part; });
      if (at == all_.end()) fail(fmt::format("has no function {}", part));
      return {&*at};
    }
    std::vector<std::string> rows, columns;
    for (const std::string& name : part.empty() ? std::vector<std::string>() : split(part, ',')) {
      const auto slash = name.find('/');
      add(rows, plain_end(name.substr(0, slash)));
      add(columns, plain_end(slash == std::string::npos ? name : name.substr(slash + 1)));
    }
    if (rows.empty()) {
      for (const ResponseFunction& f : all_) {
        add(rows, f.response);
        add(columns, f.reference);
      }
      // in one order, where a matrix of drive points may be meant
      if (std::ranges::is_permutation(rows, columns)) columns = rows;
    }
    if (std::ssize(rows) != ports || std::ssize(columns) != ports) {
      fail(
          fmt::format("has {} responses and {} references, expected {} of both: the coordinates "
                      "of the support; say which behind the name of the file, as in {}#{}",
                      rows.size(), columns.size(), ports,
                      std::filesystem::path(file_).filename().string(), example()));
    }
    std::vector<const ResponseFunction*> found;
    for (const std::string& row : rows) {
      for (const std::string& column : columns) found.push_back(&function(row, column));
    }
    return found;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    std::vector<std::string> names;
    constexpr std::size_t most = 12;
    for (const ResponseFunction& f : all_) {
      if (names.size() < most) {
        names.push_back(fmt::format("{}: {}/{}", f.number, f.response, f.reference));
      }
    }
    throw ModelError({file_}, "",
                     fmt::format("{}. Its functions: {}{}", why, fmt::join(names, ", "),
                                 all_.size() > most ? ", ..." : ""));
  }
  static void add(std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  std::string example() const {
    return fmt::format("{}/{}", all_.front().response, all_.front().reference);
  }
  /// Of functions of displacements, velocities and accelerations the one of least rate.
  const ResponseFunction& function(const std::string& row, const std::string& column) const {
    const ResponseFunction* best = nullptr;
    bool is_only = true;
    const auto rank = [](const ResponseFunction& f) {
      return f.meaning.rate + (f.meaning.is_inverse ? 0 : 3);
    };
    for (const ResponseFunction& f : all_) {
      if (f.response != row || f.reference != column) continue;
      if (best && rank(f) == rank(*best)) is_only = false;
      if (best && rank(f) >= rank(*best)) continue;
      best = &f;
      is_only = true;
    }
    if (!best) fail(fmt::format("has no function {}/{}", row, column));
    if (!is_only) {
      fail(fmt::format("has several functions {}/{}, expected the number of one", row, column));
    }
    return *best;
  }

  const std::vector<ResponseFunction>& all_;
  std::string file_;
};

/// A row of entries of H at a frequency as those of a dynamic stiffness.
CMat stiffness_of(const CMat& H, const ResponseMeaning& meaning, double omega,
                  const std::string& file) {
  const Complex by = std::pow(Complex(0.0, omega), meaning.rate);
  if (!meaning.is_inverse) return by * H;
  const DenseLu<CMat> factor(H);
  if (!(factor.rcond() > 1e-14)) {
    throw ModelError({file}, "response", fmt::format("has no inverse at {:g} rad/s", omega));
  }
  return by * factor.solve(CMat::Identity(H.rows(), H.cols()));
}

/// Checks that functions are of one kind and of the same frequencies.
void require_alike(const std::vector<const ResponseFunction*>& chosen, const std::string& file) {
  const ResponseFunction& first = *chosen.front();
  for (const ResponseFunction* f : chosen) {
    const std::string both = fmt::format("functions {} and {}", first.number, f->number);
    const bool is_same_kind = f->meaning.is_known == first.meaning.is_known &&
                              f->meaning.is_inverse == first.meaning.is_inverse &&
                              f->meaning.rate == first.meaning.rate;
    if (!is_same_kind) throw ModelError({file}, "", both + " are of different kinds");
    if (f->omega.size() != first.omega.size() || f->omega != first.omega) {
      throw ModelError({file}, "", both + " have other frequencies");
    }
    const bool has_tilt =
        f->response.find('r') != std::string::npos || f->reference.find('r') != std::string::npos;
    if (has_tilt) {
      throw ModelError({file}, "",
                       fmt::format("function {} is of rotations, expected "
                                   "displacements and forces",
                                   f->number));
    }
  }
}

}  // namespace

ConvertedTable universal_response(const std::filesystem::path& path, const std::string& part,
                                  const ForeignTable& wanted) {
  const std::string file = path.string();
  const auto bytes = file_bytes(path, FileKind::regular, most_text_bytes);
  if (!bytes) throw ModelError({file}, "", bytes.problem);
  std::string others;
  const std::vector<ResponseFunction> all = functions_of(*bytes, file, others);
  if (all.empty()) {
    throw ModelError({file}, "",
                     fmt::format("has no dataset 58 of a complex frequency response; it has {}",
                                 others.empty() ? "none at all" : others));
  }
  const auto chosen = FunctionChoice(all, file).chosen(part, wanted.ports);
  require_alike(chosen, file);
  const ResponseFunction& first = *chosen.front();
  const ResponseMeaning& meaning = first.meaning;
  const Eigen::Index n = first.omega.size(), ports = wanted.ports;
  if (std::ssize(chosen) != ports * ports) {
    throw ModelError({file}, "",
                     fmt::format("one function is named, expected those of {} coordinates", ports));
  }
  if (!meaning.is_known && !wanted.form) {
    throw ModelError({file}, "", "does not say of what its values are: add form to the support");
  }
  if (meaning.is_known && wanted.form && meaning.form() != wanted.form) {
    throw ModelError(
        {file}, "",
        fmt::format("its values are no {}: leave form out, the file says what they are",
                    name_of(*wanted.form)));
  }
  CMat H(n, ports * ports);
  for (Eigen::Index e = 0; e < H.cols(); ++e) H.col(e) = chosen[static_cast<std::size_t>(e)]->H;
  if (!wanted.form) {
    for (Eigen::Index k = 0; k < n; ++k) {
      if (!(first.omega(k) > 0.0) || !H.row(k).allFinite()) continue;  // left out, or told
      const CMat at = H.row(k).reshaped(ports, ports).transpose();
      const CMat K = stiffness_of(at, meaning, first.omega(k), file);
      H.row(k) = K.transpose().reshaped().transpose();
    }
  }
  ConvertedTable made;
  made.table = {part.empty() ? file : fmt::format("{}#{}", file, part),
                response_text(file, first.omega, H, wanted.ports)};
  if (meaning.is_known && !first.has_unit) {
    made.doubts.push_back(
        "the universal file says no units, and has no dataset 164: its numbers "
        "are taken in SI units");
  }
  return made;
}

}  // namespace whirl::inline io
