#include "libio/import/ross_differences.hpp"

#include <algorithm>

namespace whirl::inline io {

namespace {

void tell_tables(const RossRotor& rotor, std::vector<std::string>& told) {
  const bool has_tables = std::any_of(rotor.bearings.begin(), rotor.bearings.end(),
                                      [](const RossBearing& b) { return b.rows.size() > 1; });
  if (!has_tables) return;
  if (rotor.tables == RossTables::smoothing_spline) {
    told.emplace_back(
        "tables have \"pchip\" between their rows, and pass through these; ROSS before 3.0 lays "
        "smoothing splines through them: frequencies differ by some 1e-5 at the rows of a smooth "
        "table, and by far more between rows that jump, where splines swing");
  }
  told.emplace_back("beyond the ends of a table its coefficients stay as they are there");
}

}  // namespace

std::vector<std::string> differences_of(const RossRotor& rotor) {
  std::vector<std::string> told;
  tell_tables(rotor, told);
  const auto any = [&](const auto& is_so) {
    return std::any_of(rotor.elements.begin(), rotor.elements.end(), is_so);
  };
  if (any([](const RossElement& e) { return e.shears && e.is_hutchinson; })) {
    told.emplace_back(
        "ROSS's shear coefficient of Hutchinson lacks the square of 1 + nu: its numbers are "
        "written; \"hutchinson\" would be right and changes frequencies by about 1e-3");
  }
  if (any([](const RossElement& e) { return e.torque != 0.0; })) {
    told.emplace_back("a torque follows the shaft's ends in ROSS; here it keeps its direction");
  }
  if (any([](const RossElement& e) {
        return e.outer[0] != e.outer[1] || e.inner[0] != e.inner[1];
      })) {
    told.emplace_back("sections of cones are integrated along each element");
  }
  if (any([](const RossElement& e) {
        const bool is_known = (e.tilts && e.turns) || (!e.shears && !e.tilts && !e.turns);
        return !is_known;
      })) {
    told.emplace_back(
        "elements with only one of shear, rotary inertia and gyroscopics have the nearest "
        "theory");
  }
  if (std::any_of(rotor.bearings.begin(), rotor.bearings.end(),
                  [](const RossBearing& b) { return b.magnets.has_value(); })) {
    told.emplace_back(
        "the controllers of magnetic bearings have states of their own, which damped modes see at "
        "their complex frequency, where ROSS has stiffness and damping at a real one");
  }
  if (!rotor.couplings.empty()) {
    told.emplace_back(
        "a coupling lies between two nodes of one shaft; what is between them bears next to "
        "nothing");
  }
  return told;
}

}  // namespace whirl::inline io
