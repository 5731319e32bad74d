#pragma once
/// Which poles of models of growing order are modes: those that stay where they are.

#include <vector>

#include "libbase/structs/column.hpp"
#include "libdata/measured/pole.hpp"

namespace whirl::inline data {

/// How much a pole may differ from its like in the model of the order before.
struct StabilityLimits {
  double frequency = 0.01;    ///< relative
  double damping = 0.05;      ///< relative, of damping ratios
  double mac = 0.98;          ///< of shapes, at least
  double most_damping = 0.3;  ///< damping ratio of a mode, at most
};

/// A pole of the model of one order.
struct OrderPole : Pole {
  int order = 0;
  bool is_stable_frequency = false, is_stable_damping = false, is_stable_shape = false;
  int harmonic = 0;  ///< harmonic of the speed that the pole is; 0: none
  int mode = -1;     ///< mode that the pole is an estimate of, from 0; -1: none

  bool is_stable() const { return is_stable_frequency && is_stable_damping && is_stable_shape; }

  static constexpr auto columns() {
    return ColumnList{
        column("order", &OrderPole::order, "", "model order"),
        column("eigenvalue", &OrderPole::lambda, "rad/s", "eigenvalue").as("eigenvalue"),
        column("frequency", &OrderPole::frequency, "rad/s", "damped natural frequency"),
        column("damping_ratio", &OrderPole::damping_ratio, "", "damping ratio"),
        column("stable_frequency", &OrderPole::is_stable_frequency, "",
               "1: frequency as in the order before"),
        column("stable_damping", &OrderPole::is_stable_damping, "",
               "1: damping ratio as in the order before"),
        column("stable_shape", &OrderPole::is_stable_shape, "", "1: shape as in the order before"),
        column("harmonic", &OrderPole::harmonic, "", "harmonic of the speed that it is; 0: none"),
        column("mode", &OrderPole::mode, "", "running mode that it is an estimate of; 0: none")
            .from_one()};
  }
};

/// Compares poles with those of the order before.
///
/// The like of a pole is the one of the order before with the least pole_distance(). Each limit is
/// a flag of its own; poles of the lowest order have none.
///
/// @param orders  poles of each order, ascending
void find_stable(std::vector<std::vector<OrderPole>>& orders, const StabilityLimits& limits);

/// Groups of poles that are one mode.
///
/// Stable poles that are no harmonic are joined while the mean pole_distance() of two groups is at
/// most what the limits allow between neighboring orders, (limit of frequency) + 1 - (limit of
/// MAC); the nearest two first. Of several poles of one order a group keeps the one nearest to the
/// group's median. A group is a mode if it has poles of at least a share of all orders. Shapes need
/// not be real: those of rotors are not.
///
/// @param share  of the orders, 0 to 1
/// @return       numbers of the poles in each mode, by ascending median frequency
/// @source [Magalhaes2009], hierarchical clustering, here with average linkage
std::vector<std::vector<std::size_t>> clustered_modes(const std::vector<OrderPole>& poles,
                                                      const StabilityLimits& limits, int orders,
                                                      double share);

}  // namespace whirl::inline data
