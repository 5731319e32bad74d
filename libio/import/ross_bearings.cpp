#include "libio/import/ross_bearings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

namespace whirl::inline io {

namespace {

/// Whether there are magnets. Those with a controller of their own have the class BearingElement
/// in files of ROSS 2.
bool has_magnets(const RossSection& s) {
  return s.has("g0") && s.has("i0") && s.has("ag") && s.has("nw");
}

/// How ROSS says at what its coefficients hold: since 3.0 `speed` and `frequency`, before that
/// `frequency` is the speed, but of squeeze film dampers and magnetic bearings, whose coefficients
/// are those at a frequency of the whirl in every version.
struct Axes {
  std::vector<double> speed, whirl;
};

Axes axes_of(const RossSection& s, bool is_before_3) {
  Axes axes{.speed = s.numbers("speed"), .whirl = s.numbers("frequency")};
  const std::string kind = s.class_name();
  const bool is_of_whirl = kind.find("Damper") != std::string::npos ||
                           kind.find("Magnetic") != std::string::npos || has_magnets(s);
  if (is_before_3 && !is_of_whirl && axes.speed.empty()) std::swap(axes.speed, axes.whirl);
  return axes;
}

/// Coefficients of one key, row after row: a list over the rows, or a list of lists, over the
/// frequencies of each speed.
std::vector<double> coefficients_of(const RossSection& s, std::string_view key) {
  const ConfigNode* value = s.find(key);
  const bool is_grid = value && value->kind == ConfigNode::Kind::array && !value->items.empty() &&
                       value->items.front().kind == ConfigNode::Kind::array;
  if (!is_grid) return s.numbers(key);
  std::vector<double> all;
  for (const ConfigNode& line : value->items) {
    if (line.kind != ConfigNode::Kind::array) {
      s.problem(line.where, key, "expected a list for every speed, as the first one is");
    }
    for (const ConfigNode& item : line.items) all.push_back(s.number_of(item, key));
  }
  return all;
}

/// Takes the coefficients, all but kxx.
void read_coefficients(const RossSection& s, const std::vector<double>& kxx, RossBearing& b) {
  const std::size_t rows = b.rows.size();
  for (std::size_t k = 0; k < ross_coefficients.size(); ++k) {
    const std::vector<double> values = k == 0 ? kxx : coefficients_of(s, ross_coefficients[k]);
    if (values.empty()) {  // along y: as along x
      for (RossBearing::Row& row : b.rows) row.values[k] = k % 4 == 3 ? row.values[k - 3] : 0.0;
      continue;
    }
    if (values.size() != rows && values.size() != 1) {
      s.problem(s.where(), ross_coefficients[k],
                fmt::format("has {} values, kxx has {}", values.size(), rows));
      continue;
    }
    for (std::size_t i = 0; i < rows; ++i) {
      b.rows[i].values[k] = values[std::min(i, values.size() - 1)];
    }
  }
}

/// A value that both axes have; nothing: they differ.
std::optional<double> of_both_axes(const RossSection& s, std::string_view key, double otherwise) {
  const std::vector<double> values = s.numbers(key);
  if (values.empty()) return otherwise;
  for (const double value : values) {
    if (value != values.front()) return std::nullopt;
  }
  return values.front();
}

/// Whether the coefficients are those of the magnets and their controller:
///
///   k + i w c = ki (P + I / (i w) + i w D / (1 + i w / w_D)) - ks
///
/// at each frequency w of their table; without a table P and D alone.
bool are_of_magnets(const RossBearing& b, const RossMagnets& m) {
  const double size = std::abs(m.current_stiffness * m.proportional) + m.negative_stiffness;
  if (b.has_speed || !std::isfinite(size)) return false;
  return std::all_of(b.rows.begin(), b.rows.end(), [&](const RossBearing::Row& row) {
    const std::complex<double> s(0.0, row.whirl);
    std::complex<double> action = m.proportional;
    double c = m.current_stiffness * m.derivative;
    if (row.whirl > 0.0) {
      const double lag = m.derivative_bandwidth > 0.0 ? 1.0 / m.derivative_bandwidth : 0.0;
      action += m.integral / s + m.derivative * s / (1.0 + s * lag);
      c = m.current_stiffness * action.imag() / row.whirl;
    }
    const double k = m.current_stiffness * action.real() - m.negative_stiffness;
    constexpr double tolerance = 1e-6;
    const auto& v = row.values;
    for (const std::size_t cross : {1U, 2U}) {
      if (std::abs(v[cross]) > tolerance * size) return false;
      if (std::abs(v[4 + cross]) > tolerance * std::abs(c)) return false;
    }
    const auto is_near = [](double found, double expected, double scale) {
      return std::abs(found - expected) <= tolerance * scale;
    };
    return is_near(v[0], k, size) && is_near(v[3], k, size) && is_near(v[4], c, std::abs(c)) &&
           is_near(v[7], c, std::abs(c));
  });
}

/// Magnets of four pairs of poles at an angle alpha, and their controller.
/// @source [SchweitzerMaslen2009]
void read_magnets(const RossSection& s, RossRotor& rotor, RossBearing& b) {
  constexpr double mu0 = 4e-7 * std::numbers::pi;
  const double g0 = s.number("g0"), ag = s.number("ag"), nw = s.number("nw");
  const double alpha = s.number_or("alpha", std::numbers::pi / 8.0);
  const auto i0 = of_both_axes(s, "i0", 0.0);
  const auto k_amp = of_both_axes(s, "k_amp", 1.0), k_sense = of_both_axes(s, "k_sense", 1.0);
  const auto P = of_both_axes(s, "kp_pid", 0.0), I = of_both_axes(s, "ki_pid", 0.0),
             D = of_both_axes(s, "kd_pid", 0.0);
  RossMagnets m{.derivative_bandwidth = std::max(0.0, s.number_or("n_f", 0.0)),
                .angle = s.number_or("sensors_axis_rotation", 0.0)};
  const auto keep = [&](std::string_view why) {
    rotor.taken_differently.push_back(
        fmt::format("the magnetic bearing \"{}\" has its coefficients alone: {}", s.tag(), why));
  };
  if (!i0 || !k_amp || !k_sense || !P || !I || !D) return keep("its two axes differ");
  const double gain = *k_amp * *k_sense;
  m.current_stiffness = mu0 * nw * nw * ag * *i0 * std::cos(alpha) / (g0 * g0);
  m.negative_stiffness = m.current_stiffness * *i0 / g0;
  m.proportional = gain * *P;
  m.integral = gain * *I;
  m.derivative = gain * *D;
  const bool is_valid = g0 > 0.0 && m.current_stiffness > 0.0 && m.negative_stiffness >= 0.0 &&
                        std::isfinite(m.negative_stiffness);
  if (!is_valid) return keep("its magnets have no force");
  if (m.proportional == 0.0 && m.integral == 0.0 && m.derivative == 0.0) {
    return keep("its controller is not in the file");
  }
  if (!are_of_magnets(b, m)) return keep("they are not those of its magnets and gains");
  b.magnets = m;
}

/// Says which bearing of whirl the geometry of a ball or roller bearing belongs to.
void read_rolling_elements(const RossSection& s, RossRotor& rotor) {
  const bool is_ball = s.has("n_balls");
  const double count = s.number(is_ball ? "n_balls" : "n_rollers");
  const double size = s.number_or(is_ball ? "d_balls" : "l_rollers", 0.0);
  const double load = s.number_or("fs", 0.0), angle = s.number_or("alpha", 0.0);
  rotor.taken_differently.push_back(fmt::format(
      "the {} bearing \"{}\" is linear, with ROSS's stiffness at {} N; a [[rolling_bearing]] with "
      "elements = {}, {} = {} and contact_angle = {}, and with what the file does not have ({}), "
      "presses each {} by itself",
      is_ball ? "ball" : "roller", s.tag(), load, count,
      is_ball ? "element_diameter" : "roller_length", size, angle,
      is_ball ? "pitch_diameter, inner_groove and outer_groove, clearance"
              : "pitch_diameter and element_diameter, clearance",
      is_ball ? "ball" : "roller"));
}

}  // namespace

void leave_out(const RossSection& s, std::string_view key, std::string_view why, RossRotor& rotor) {
  const std::vector<double> values = coefficients_of(s, key);
  if (std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; })) {
    rotor.left_out.push_back(fmt::format("{} of \"{}\": {}", key, s.tag(), why));
  }
}

void read_ross_bearing(const RossSection& s, RossRotor& rotor, bool is_before_3,
                       UnreadKeys& unread) {
  RossBearing b{.where = s.where(),
                .name = s.tag(),
                .is_seal = s.class_name().find("Seal") != std::string::npos,
                .node = s.node("n")};
  if (s.find("n_link")) b.link = s.node("n_link");
  const Axes axes = axes_of(s, is_before_3);
  b.has_speed = !axes.speed.empty();
  b.has_whirl = !axes.whirl.empty();
  const std::vector<double> kxx = coefficients_of(s, "kxx");
  const std::size_t rows = kxx.size();
  const std::size_t speeds = std::max<std::size_t>(1, axes.speed.size()),
                    frequencies = std::max<std::size_t>(1, axes.whirl.size());
  const bool is_grid = rows == speeds * frequencies,
             is_list = speeds == frequencies && rows == speeds;
  if (!is_grid && !is_list) {
    s.problem(s.where(), "kxx",
              fmt::format("has {} values for {} speeds and {} frequencies", rows, axes.speed.size(),
                          axes.whirl.size()));
    return;
  }
  b.rows.resize(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    if (b.has_speed) b.rows[i].speed = axes.speed[is_grid ? i / frequencies : i];
    if (b.has_whirl) b.rows[i].whirl = axes.whirl[is_grid ? i % frequencies : i];
  }
  read_coefficients(s, kxx, b);
  for (const std::string_view axial : {"kzz", "czz", "mzz"}) {
    leave_out(s, axial, "motion along the axis", rotor);
  }
  if (has_magnets(s)) read_magnets(s, rotor, b);
  if (s.has("n_balls") || s.has("n_rollers")) read_rolling_elements(s, rotor);
  const std::string kind = s.class_name();
  if (kind != "BearingElement" && kind != "SealElement") unread.computed.insert(kind);
  rotor.bearings.push_back(std::move(b));
}

}  // namespace whirl::inline io
