#pragma once
/// What all collocation steps of one size share.

#include <memory>
#include <vector>

#include "libdyn/flow/linear_flow.hpp"

namespace whirl::inline dyn {

/// A step size of the ladder longest, longest / 2^(1/2), longest / 2, ...: matrices are shared by
/// all steps of one size.
struct Rung {
  int number = 0;  ///< from the longest
  int family() const { return number % 2; }
  int level() const { return number / 2; }
};

/// Places in a step, and the matrices that make polynomials of values there.
struct StepPlaces {
  Vec s;
  Mat to_legendre, to_powers;
};

/// Motion of the contacts at nodes of a step.
struct StepNodes {
  std::vector<Mat> free;    ///< per contact: (d_x, d_y, w_x, w_y) x nodes from (y, load)
  std::vector<Mat> kernel;  ///< [contact * contacts + other]: the same from the other's forces
};

/// Tables of the ladder of step sizes, made when first used.
class StepTables {
 public:
  static constexpr int terms = 8;     ///< of a force polynomial
  static constexpr int samples = 14;  ///< of free motion: Chebyshev points
  static constexpr int rows = 4;      ///< d_x, d_y, w_x, w_y of a contact

  /// With modes much faster than the contacts, forces are evaluated at more points than they have
  /// coefficients: the projection of forces leaves out what a fast mode adds to a displacement,
  /// which few points would mistake for something slow.
  ///
  /// @param longest  step size of rung 0 [s]
  StepTables(const ContactSystem& system, double longest);
  // parts of a step refer to it
  StepTables(const StepTables&) = delete;
  StepTables& operator=(const StepTables&) = delete;

  double size(Rung rung) const;
  /// The shortest rung that is not below a duration.
  Rung rung_for(double h) const;
  LinearFlow& flow(Rung rung) { return family_of(rung).flow; }
  const StepNodes& nodes_of(Rung rung, bool is_touching);
  /// States at Chebyshev points of a step of a level from (y, load, forces).
  const Mat& dense(Rung of_family, int level);
  const StepPlaces& places(bool is_touching) const {
    return is_touching ? touch_places_ : flight_places_;
  }

  int nodes() const { return nodes_; }             ///< where forces are evaluated: Gauss points
  const Mat& project() const { return project_; }  ///< coefficients from forces, terms x nodes
  /// Forces from coefficients at the places, and at the nodes.
  const Mat& at_places() const { return at_places_; }
  const Mat& at_nodes() const { return at_nodes_; }

 private:
  struct Family {
    LinearFlow flow;
    std::vector<StepNodes> touch, flight;
    std::vector<Mat> dense;
  };
  Family& family_of(Rung rung);
  void fill(StepNodes& table, LinearFlow& flow, int level, const Vec& s, bool has_force) const;

  const ContactSystem& system_;
  double longest_;
  int nodes_;
  std::vector<std::unique_ptr<Family>> families_;
  StepPlaces touch_places_, flight_places_;
  Mat project_, at_places_, at_nodes_;
};

}  // namespace whirl::inline dyn
