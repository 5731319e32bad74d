#include "tests/support/random_rotors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>
#include <vector>

namespace whirl::test {

namespace {

/// Numbers from a seed, the same on every machine.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * share(); }
  /// Every decade as likely as another.
  double decades(double low, double high) { return low * std::pow(high / low, share()); }
  int integer(int low, int high) {
    return low + static_cast<int>(share() * static_cast<double>(high - low + 1));
  }
  bool one_in(double n) { return share() * n < 1.0; }

 private:
  std::mt19937_64 random_;
};

/// One SI unit in another one of its dimension.
struct OtherUnit {
  std::string_view si, other;
  double si_per_other;
};
constexpr double rpm = std::numbers::pi / 30.0;
constexpr OtherUnit other_units[] = {
    {"m", "mm", 1e-3},         {"kg", "g", 1e-3},           {"kg/m^3", "g/cm^3", 1e3},
    {"Pa", "GPa", 1e9},        {"N/m", "kN/mm", 1e6},       {"N.s/m", "kN.s/m", 1e3},
    {"N.m/rad", "kN.m", 1e3},  {"kg.m^2", "kg.mm^2", 1e-6}, {"s", "ms", 1e-3},
    {"rad/s", "rpm", rpm},     {"kg.m", "g.mm", 1e-6},      {"m/s^2", "mm/s^2", 1e-3},
    {"1/s", "1/min", 1.0 / 60}};

/// Writes quantities in the units that were asked for.
class Words {
 public:
  explicit Words(bool has_other_units) : has_other_units_(has_other_units) {}

  std::string operator()(double value, std::string_view unit) const {
    if (!has_other_units_) return fmt::format("{}", value);
    const auto& [si, other, factor] =
        *std::find_if(std::begin(other_units), std::end(other_units),
                      [&](const OtherUnit& u) { return u.si == unit; });
    return fmt::format("\"{} {}\"", value / factor, other);
  }
  /// The same inside a table of a bearing.
  std::string cell(double value, std::string_view unit) const {
    std::string text = (*this)(value, unit);
    std::erase(text, '"');
    return text;
  }

 private:
  bool has_other_units_;
};

/// xx, xy, yx, yy.
struct Four {
  double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;

  std::string text(const Words& words, std::string_view unit) const {
    if (xy == 0.0 && yx == 0.0 && xx == yy) return words(xx, unit);
    return fmt::format("{{ xx = {}, xy = {}, yx = {}, yy = {} }}", words(xx, unit), words(xy, unit),
                       words(yx, unit), words(yy, unit));
  }
};

enum class Kind { isotropic, orthotropic, cross_coupled };

class Rotor {
 public:
  Rotor(const RotorDraw& how, const Wording& wording)
      : draw_(how.seed), words_(wording.has_other_units), wording_(wording) {
    material();
    shaft(how.most_elements);
    disks();
    if (!draw_.one_in(30.0)) bearings();
    if (draw_.one_in(8.0)) link();
    damping();
  }

  std::string text() {
    if (wording_.order != 0) {
      Draw order(wording_.order);
      for (std::size_t i = parts_.size(); i > 1; --i) {
        std::swap(parts_[i - 1],
                  parts_[static_cast<std::size_t>(order.integer(0, static_cast<int>(i) - 1))]);
      }
    }
    std::string all = head_;
    for (const std::string& part : parts_) all += part;
    return all;
  }

 private:
  void material() {
    const double speed = draw_.one_in(6.0) ? 0.0 : draw_.between(1.0, 1500.0);
    head_ = fmt::format("format = 1\ngravity = {}\n[operation]\nspeed = {}\n",
                        words_(9.81, "m/s^2"), words_(speed, "rad/s"));
    const double internal = draw_.one_in(8.0) ? draw_.decades(1e-7, 1e-4) : 0.0;
    head_ += fmt::format(
        "[material.steel]\ndensity = {}\nyoungs_modulus = {}\npoisson_ratio = 0.3\n"
        "internal_damping = {}\n[material.light]\ndensity = 0\nyoungs_modulus = {}\n"
        "poisson_ratio = 0.3\n",
        words_(7800.0, "kg/m^3"), words_(2.1e11, "Pa"), words_(internal, "s"),
        words_(2.1e11, "Pa"));
  }

  void shaft(int most_elements) {
    elements_ = static_cast<int>(std::lround(draw_.decades(1.0, most_elements)));
    const int segments = std::min(elements_, draw_.integer(1, 4));
    const double diameter = draw_.decades(0.01, 0.3);
    // slender or short, but no element is longer than some twenty diameters or a thin slice
    const double slenderness = draw_.decades(4.0, 40.0);
    const bool has_light_segment = segments > 1 && draw_.one_in(8.0);
    for (int i = 0; i < segments; ++i) {
      const int own = elements_ / segments + (i < elements_ % segments ? 1 : 0);
      const double d = diameter * draw_.between(0.6, 1.4);
      const double length = diameter * slenderness * draw_.between(0.5, 1.5) / segments;
      head_ += fmt::format(
          "[[shaft]]\nmaterial = \"{}\"\nlength = {}\nouter_diameter = {}\nelements = {}\n",
          has_light_segment && i == segments - 1 ? "light" : "steel", words_(length, "m"),
          words_(d, "m"), own);
    }
    mass_ = 7800.0 * 0.785 * diameter * diameter * diameter * slenderness;
  }

  void disks() {
    const int count = draw_.integer(1, 4);
    for (int i = 0; i < count; ++i) {
      const double m = mass_ * draw_.decades(0.05, 3.0), radius = draw_.decades(0.03, 0.4);
      const double thickness = radius * draw_.decades(0.05, 3.0);
      const double Ip = 0.5 * m * radius * radius, Id = 0.5 * Ip + m * thickness * thickness / 12.0;
      std::string part = fmt::format(
          "[[disk]]\nname = \"disk {}\"\nnode = {}\nmass = {}\ndiametral_inertia = {}\n"
          "polar_inertia = {}\n",
          i + 1, any_node(), words_(m, "kg"), words_(Id, "kg.m^2"), words_(Ip, "kg.m^2"));
      part += fmt::format("unbalance = {{ moment = {}, phase = {} }}\n", words_(1e-5 * m, "kg.m"),
                          draw_.between(0.0, 6.0));
      parts_.push_back(std::move(part));
    }
  }

  void bearings() {
    const int count = draw_.one_in(4.0) ? 3 : 2;
    const Kind kind = static_cast<Kind>(draw_.integer(0, 2));
    const bool are_equal = draw_.one_in(3.0);
    const bool has_pedestals = draw_.one_in(4.0);
    double k = 0.0, c = 0.0;
    for (int i = 0; i < count; ++i) {
      if (i == 0 || !are_equal) {
        k = draw_.decades(1e5, 1e11);
        c = draw_.one_in(5.0) ? 0.0 : draw_.decades(1.0, 1e7);
      }
      const int node = i == 0 ? 1 : i == 1 ? elements_ + 1 : any_node();
      std::string part =
          fmt::format("[[bearing]]\nname = \"bearing {}\"\nnode = {}\n", i + 1, node);
      if (has_pedestals) part += fmt::format("to = \"pedestal {}\"\n", i + 1);
      const bool is_rigid = !has_pedestals && draw_.one_in(12.0);
      if (is_rigid) {
        part += "rigid = true\n";
      } else if (draw_.one_in(5.0)) {
        part += table(kind, k, c);
      } else {
        part += fmt::format("stiffness = {}\ndamping = {}\n", four(kind, k).text(words_, "N/m"),
                            four(kind, c).text(words_, "N.s/m"));
        if (draw_.one_in(6.0)) {
          part += fmt::format("tilt_stiffness = {}\n", words_(k * 1e-3, "N.m/rad"));
        }
      }
      parts_.push_back(std::move(part));
      if (has_pedestals) pedestal(i);
    }
  }

  void pedestal(int i) {
    const double m = draw_.one_in(3.0) ? 0.0 : mass_ * draw_.decades(0.05, 2.0);
    parts_.push_back(
        fmt::format("[[body]]\nname = \"pedestal {}\"\nmass = {}\n", i + 1, words_(m, "kg")));
    const double k = draw_.decades(1e5, 1e11),
                 c = draw_.one_in(3.0) ? 0.0 : draw_.decades(1.0, 1e7);
    parts_.push_back(
        fmt::format("[[bearing]]\nname = \"foundation {}\"\nbody = \"pedestal {}\"\n"
                    "stiffness = {}\ndamping = {}\n",
                    i + 1, i + 1, words_(k, "N/m"), words_(c, "N.s/m")));
  }

  void link() {
    parts_.push_back(fmt::format(
        "[[link]]\nname = \"strut\"\nfrom = {{ node = {} }}\nto = \"ground\"\nstiffness = {}\n"
        "damping = {}\n",
        any_node(), words_(draw_.decades(1e4, 1e7), "N/m"),
        words_(draw_.decades(1.0, 1e4), "N.s/m")));
  }

  void damping() {
    const double stiffness = draw_.one_in(2.5) ? 0.0 : draw_.decades(1e-7, 1e-2);
    const double mass = draw_.one_in(2.0) ? 0.0 : draw_.between(0.0, 50.0);
    parts_.push_back(fmt::format("[damping]\nrayleigh = {{ mass = {}, stiffness = {} }}\n",
                                 words_(mass, "1/s"), words_(stiffness, "s")));
  }

  int any_node() { return draw_.integer(1, elements_ + 1); }

  Four four(Kind kind, double size) {
    if (kind == Kind::isotropic) return {size, 0.0, 0.0, size};
    const double ratio = draw_.decades(0.1, 10.0);
    if (kind == Kind::orthotropic) return {size, 0.0, 0.0, ratio * size};
    const double cross = size * draw_.between(0.0, 0.8);
    return {size, cross, -cross * draw_.between(0.5, 1.0), ratio * size};
  }

  /// Coefficients over speed, with their text in the model.
  std::string table(Kind kind, double k, double c) {
    std::string text = "table = \"\"\"\nspeed,kxx,kxy,kyx,kyy,cxx,cxy,cyx,cyy\n";
    for (const double speed : {50.0, 300.0, 900.0}) {
      const Four K = four(kind, k * draw_.between(0.5, 2.0)),
                 C = four(kind, c * draw_.between(0.5, 2.0));
      text += words_.cell(speed, "rad/s");
      for (const double x : {K.xx, K.xy, K.yx, K.yy}) text += "," + words_.cell(x, "N/m");
      for (const double x : {C.xx, C.xy, C.yx, C.yy}) text += "," + words_.cell(x, "N.s/m");
      text += "\n";
    }
    return text + "\"\"\"\n";
  }

  Draw draw_;
  Words words_;
  Wording wording_;
  std::string head_;                ///< has an order
  std::vector<std::string> parts_;  ///< tables that have none
  int elements_ = 1;
  double mass_ = 1.0;  ///< of the shaft, about [kg]
};

}  // namespace

std::string random_rotor_text(const RotorDraw& draw, const Wording& wording) {
  return Rotor(draw, wording).text();
}

}  // namespace whirl::test
