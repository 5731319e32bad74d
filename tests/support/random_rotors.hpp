#pragma once
/// Models of rotors drawn at random, as text: what a stranger may write, within wide limits.

#include <string>

namespace whirl::test {

/// How a model is put into words; it is the same rotor.
struct Wording {
  bool has_other_units = false;  ///< mm, MN/m, GPa, rpm, ... for plain SI numbers
  unsigned order = 0;            ///< tables that have no order come in another one; 0: as drawn
};

struct RotorDraw {
  unsigned seed = 1;
  int most_elements = 99;  ///< of the shaft; it has 4 dofs per node
};

/// A model with a stepped shaft of one to 99 elements, disks, two or three bearings, now and then
/// pedestals, links, tables of coefficients over speed, parts without mass.
///
/// Bearings have 1e5 to 1e11 N/m and up to 1e7 N.s/m, isotropic, orthotropic or cross-coupled;
/// Rayleigh damping goes to 1e-2 s and 50 1/s; one rotor in thirty is free. The same seed always
/// gives the same rotor; generators of the standard library do, its distributions need not.
std::string random_rotor_text(const RotorDraw& draw, const Wording& wording = {});

}  // namespace whirl::test
