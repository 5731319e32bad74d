#include "libio/export/universal_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/stations.hpp"

namespace whirl::inline io {

namespace {

constexpr std::string_view universal_delimiter = "    -1";
constexpr std::string_view universal_head = "    -1\n   164\n         1whirl: SI (m, N)";
constexpr double even_to = 1e-6;  ///< of the step: as far as E13.5 says it

/// Numbers of the format.
struct UniversalCode {
  static constexpr int frequency_response_function = 4, complex_double = 6;
  static constexpr int displacement = 8, velocity = 11, acceleration = 12, excitation_force = 13,
                       frequency = 18, rpm = 19;  // what an axis is
};

/// One end of a response, as the format has it.
struct UniversalEnd {
  long node = 0;
  int direction = 0;  ///< 1, 2: x, y; 4, 5: about them; 0: a scalar
  std::string name;

  bool is_tilt() const { return direction > 3; }
};

/// A record of 80 columns.
void add_universal_record(std::string& text, const std::string& record) {
  text += fmt::format("{:<80.80}\n", record);
}

/// A name of ten characters without blanks.
std::string entity_name(std::string name) {
  for (char& c : name) {
    if (c == ' ' || c < ' ' || c > '~') c = '_';
  }
  return name.empty() ? "NONE" : name.substr(0, 10);
}

/// Where a label is, such as "7 seal x" or the name of a probe.
class UniversalEnds {
 public:
  UniversalEnds(const Model& model, const Assembler& assembler)
      : points_(named_points(model, assembler)), nodes_(assembler.mesh().nodes()) {
    for (const Probe& probe : model.structure.probes) {
      probes_.push_back({assembler.point(probe.at), probe.name});
    }
  }

  UniversalEnd of(const std::string& label) const {
    for (const NamedPoint& probe : probes_) {
      if (probe.name == label) return {number_of(probe), 0, entity_name(label)};
    }
    const auto blank = label.rfind(' ');
    const std::string place = label.substr(0, blank), direction = label.substr(blank + 1);
    UniversalEnd end{.name = "NONE"};
    for (const NamedPoint& p : points_) {
      if (p.label() != place) continue;
      end.node = number_of(p);
      if (!p.name.empty()) end.name = entity_name(p.name);
    }
    constexpr std::array<std::pair<std::string_view, int>, 4> known{
        {{"x", 1}, {"y", 2}, {"theta_x", 4}, {"theta_y", 5}}};
    for (const auto& [name, number] : known) {
      if (name == direction) end.direction = number;
    }
    if (end.direction == 0) end.name = entity_name(direction);
    return end;
  }

 private:
  /// Bodies stand behind the nodes.
  long number_of(const NamedPoint& p) const {
    return p.node() > 0 ? p.node() : nodes_ + p.point.index + 1;
  }

  std::vector<NamedPoint> points_, probes_;
  long nodes_;
};

std::string axis_record(int type, const char* label, const char* unit) {
  return fmt::format("{:10}{:5}{:5}{:5} {:<20.20} {:<20.20}", type, 0, 0, 0, label, unit);
}

/// The step of even frequencies; 0: they are not.
double even_step(const std::vector<double>& hz) {
  if (hz.size() < 2) return 0.0;
  const double step = (hz.back() - hz.front()) / static_cast<double>(hz.size() - 1);
  for (std::size_t i = 0; i < hz.size(); ++i) {
    if (std::abs(hz[i] - hz.front() - step * static_cast<double>(i)) > even_to * step) return 0.0;
  }
  // first and step are written with six digits: these must be all that they have
  for (const double v : {hz.front(), step}) {
    if (std::abs(std::stod(fmt::format("{:.5E}", v)) - v) > 1e-12 * hz.back()) return 0.0;
  }
  return step;
}

/// One of the three forms of a response.
struct UniversalForm {
  const char* name;
  CVec ResponsePair::*values;
  int data;
  const char *unit, *tilt_unit;
};

void add_values(std::string& text, const std::vector<double>& hz, const std::vector<Complex>& H,
                bool is_even) {
  std::string record;
  for (std::size_t i = 0; i < H.size(); ++i) {
    if (!is_even) record += fmt::format("{:13.5E}", hz[i]);
    record += fmt::format("{:20.12E}{:20.12E}", H[i].real(), H[i].imag());
    if (is_even && i % 2 == 0 && i + 1 < H.size()) continue;
    add_universal_record(text, record);
    record.clear();
  }
}

void add_response(std::string& text, const FrequencyResponse& found, const ResponsePair& pair,
                  const UniversalForm& form, const UniversalEnds& ends, long number) {
  std::vector<double> hz;
  std::vector<Complex> H;
  for (std::size_t i = 0; i < found.frequencies.size(); ++i) {
    const Complex value = (pair.*form.values)(static_cast<Eigen::Index>(i));
    if (!std::isfinite(value.real()) || !std::isfinite(value.imag())) continue;
    hz.push_back(found.frequencies[i] / hertz);
    H.push_back(value);
  }
  const double step = even_step(hz);
  const bool is_even = step > 0.0;
  const UniversalEnd to = ends.of(pair.to), from = ends.of(pair.from);
  text += fmt::format("{}\n{:6}\n", universal_delimiter, 58);
  add_universal_record(text, fmt::format("{} of {} by {}", form.name, pair.to, pair.from));
  for (int i = 0; i < 4; ++i) add_universal_record(text, "NONE");
  add_universal_record(
      text, fmt::format("{:5}{:10}{:5}{:10} {:<10}{:10}{:4} {:<10}{:10}{:4}",
                        UniversalCode::frequency_response_function, number, 0, 0, to.name, to.node,
                        to.direction, from.name, from.node, from.direction));
  add_universal_record(text, fmt::format("{:10}{:10}{:10}{:13.5E}{:13.5E}{:13.5E}",
                                         UniversalCode::complex_double, H.size(), is_even ? 1 : 0,
                                         is_even ? hz.front() : 0.0, step, found.speed / rpm));
  add_universal_record(text, axis_record(UniversalCode::frequency, "Frequency", "Hz"));
  add_universal_record(
      text, axis_record(form.data, form.name, to.is_tilt() ? form.tilt_unit : form.unit));
  add_universal_record(text, axis_record(UniversalCode::excitation_force, "Excitation",
                                         from.is_tilt() ? "N.m" : "N"));
  add_universal_record(text, axis_record(UniversalCode::rpm, "Speed", "rpm"));
  add_values(text, hz, H, is_even);
  text += fmt::format("{}\n", universal_delimiter);
}

}  // namespace

std::string universal_text(const FrequencyResponse& found, const Model& model,
                           const Assembler& assembler) {
  std::string text(universal_head);
  text += fmt::format("{:>14}\n", 2);  // the description has 20 columns, the mode of temperature 10
  add_universal_record(text, fmt::format("{:25.17E}{:25.17E}{:25.17E}", 1.0, 1.0, 1.0));
  add_universal_record(text, fmt::format("{:25.17E}", 273.15));
  text += fmt::format("{}\n", universal_delimiter);
  const UniversalEnds ends(model, assembler);
  long number = 0;
  for (const ResponsePair& pair : found.pairs) {
    for (const UniversalForm& form :
         {UniversalForm{"receptance", &ResponsePair::receptance, UniversalCode::displacement, "m",
                        "rad"},
          UniversalForm{"mobility", &ResponsePair::mobility, UniversalCode::velocity, "m/s",
                        "rad/s"},
          UniversalForm{"accelerance", &ResponsePair::accelerance, UniversalCode::acceleration,
                        "m/s^2", "rad/s^2"}}) {
      add_response(text, found, pair, form, ends, ++number);
    }
  }
  return text;
}

void write_universal(const std::filesystem::path& place, const FrequencyResponse& found,
                     const Model& model, const Assembler& assembler, Replaces replaces) {
  replace_file(place, universal_text(found, model, assembler),
               replaces_own(place, universal_head, replaces));
}

}  // namespace whirl::inline io
