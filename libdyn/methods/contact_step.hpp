#pragma once
/// One step of the collocation method: contact forces as polynomials of time.

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "libdyn/flow/linear_flow.hpp"
#include "libdyn/system/events.hpp"

namespace whirl::inline dyn {

/// A step size of the ladder longest, longest / 2^(1/2), longest / 2, ...: matrices are shared by
/// all steps of one size.
struct Rung {
  int number = 0;  ///< from the longest
  int family() const { return number % 2; }
  int level() const { return number / 2; }
};

/// Solves for the contact forces of a step and watches what the contacts do within the step.
///
/// The displacement of a contact at a node is that of the exact linear motion,
///
///   u_i = free_i (y, 1, cos phase, sin phase) + sum_b kernel_ib a_b,
///
/// with a the Legendre coefficients of all forces. These are the coefficients of the forces that
/// the laws give at the nodes: a = projection f(u), solved by Picard iteration, or by Newton's
/// method where Picard iteration does not contract. A contact that sticks has the condition of no
/// slip in place of its friction law; of several contacts that slip alike the first one has this
/// condition, and carries the friction of all.
class ContactStep {
 public:
  static constexpr int terms = 8;       ///< of a force polynomial
  static constexpr int samples = 14;    ///< of free motion: Chebyshev points
  static constexpr double grown = 1e3;  ///< scales, beyond which errors are over a state's size
  static constexpr int rows = 4;        ///< d_x, d_y, w_x, w_y of a contact

  /// With modes much faster than the contacts, forces are evaluated at more points than they have
  /// coefficients: the projection of forces leaves out what a fast mode adds to a displacement,
  /// which few points would mistake for something slow.
  ///
  /// @param longest  step size of rung 0 [s]
  ContactStep(const ContactSystem& system, double longest, double tolerance);

  double size(Rung rung) const;
  /// The shortest rung that is not below a duration.
  Rung rung_for(double h) const;

  /// Finds the forces of the contacts in touch over a step from a state. False if the forces were
  /// not found, or the motion is not finite.
  bool solve(Rung rung, const MotionState& from);

  /// Error of the step that was solved last, over the tolerance; by the scale of the state, or by
  /// the size of a state that has grown.
  double error() const { return error_; }
  /// Error of the contacts' displacements between samples, by the clearance.
  double path_error() const { return path_error_; }
  long evaluations() const { return evaluations_; }

  /// The first event before a fraction of the step, its place as a fraction of the whole step.
  /// @param is_sure  false if the paths are too coarse to tell whether there is an event
  std::optional<Event> first_event(const EventWatcher& watcher, double limit,
                                   const MotionState& from, bool& is_sure);

  /// Slope of the last event's function at this event, per step.
  double event_slope() const { return event_slope_; }

  /// The state after a fraction of the step.
  void advance(double fraction, const MotionState& from, Vec& y);

  /// States at fractions of a part of the step, as polynomials (see Step), with the step's end at
  /// `limit`; pieces as short as the fastest motion that is alive asks for.
  /// @param give  receives pieces in order, with the state at their end; false stops
  bool dense(const MotionState& from, double limit,
             const std::function<bool(const Step&, const Vec&)>& give);

 private:
  struct Nodes {              ///< of one rung, made when first used
    std::vector<Mat> free;    ///< per contact: (d_x, d_y, w_x, w_y) x nodes from (y, load)
    std::vector<Mat> kernel;  ///< [contact * contacts + other]: the same from the other's a
  };
  struct Family {
    LinearFlow flow;
    std::vector<Nodes> touch, flight;
    std::vector<Mat> dense;  ///< states at Chebyshev points from (y, load, a)
  };
  struct Path {
    Mat values;  ///< d_x, d_y, w_x, w_y at places of the step, both ends included
    Mat powers;  ///< of s: d_x, d_y over the clearance

    ContactForces forces(const ReducedContact& contact, Eigen::Index place) const {
      const auto at = values.row(place);
      return forces_at(contact, Vec2(at(0), at(1)), Vec2(at(2), at(3)));
    }
  };
  /// Places in a step, and the matrices that make polynomials of values there.
  struct Places {
    Vec s;
    Mat to_legendre, to_powers;
  };

  /// Kinematics of a contact that neither turns nor rubs apart.
  static ContactForces forces_at(const ReducedContact& contact, const Vec2& d, const Vec2& w) {
    return kinematics(contact, 0.0, {{d(0), d(1)}, {w(0), w(1)}, {w(0), w(1)}});
  }
  const Nodes& nodes_of(Rung rung, bool is_touching);
  void fill(Nodes& table, LinearFlow& flow, int level, const Vec& s, bool has_force) const;
  void evaluate_nodes(bool with_rates);
  Vec2 node_force(int contact, const ContactState& state, const double* node, int stride);
  bool picard(const MotionState& from);
  bool newton(const MotionState& from);
  /// Adds the derivatives of the residual of touching contact p at node k by all forces.
  void add_slopes(const MotionState& from, const Nodes& table, Eigen::Index p, int k,
                  const Vec2& force, const Vec2& value, Mat& J);
  void residual(const MotionState& from, int contact, const double* dw, const Vec2& force,
                Vec2& out);
  /// False if a contact moves out of what numbers can hold.
  bool make_paths(const MotionState& from);
  void estimate();
  Polynomial polynomial(const EventWatcher& watcher, int contact, EventKind kind, double limit,
                        const ContactStates& states) const;
  /// What holds the contacts that slip like a given one, at a place of the step.
  Hold hold_at(Eigen::Index place, int contact, const ContactStates& states) const;
  struct Part {  ///< of the step, in fractions of the step
    int level;   ///< of the size of the part
    double start, width;
  };
  bool dense_piece(const MotionState& from, const Part& part, double limit, const Vec& y,
                   const Vec& a, const std::function<bool(const Step&, const Vec&)>& give);
  const Mat& dense_table(int level);

  auto forces_of(int contact) { return a_.segment(2 * contact * terms, 2 * terms); }

  const ContactSystem& system_;
  double longest_, tolerance_;
  int nodes_;  ///< where forces are evaluated: Gauss points
  std::vector<std::unique_ptr<Family>> families_;
  Places touch_places_, flight_places_;
  Mat project_;    ///< terms x nodes
  Mat at_places_;  ///< forces at the places from coefficients
  Mat at_nodes_;   ///< the same at the nodes
  std::vector<char> rate_matters_;
  std::vector<double> weight_;  ///< velocity per force and time, in units of the tolerance
  double size_ = 1.0;           ///< of the state where the step starts, over `grown`; 1 or more

  // of the last solve
  Rung rung_;
  std::vector<int> touching_;
  Eigen::Vector3d load_;
  Vec extended_, a_, end_;
  std::vector<Mat> free_, at_;  ///< per contact: nodes x 4
  std::vector<Path> paths_;
  Mat node_forces_, path_legendre_;
  double error_ = 0.0, path_error_ = 0.0, event_slope_ = 0.0;
  long evaluations_ = 0;
  double longest_piece_ = std::numeric_limits<double>::infinity();  ///< of dense output [s]
};

}  // namespace whirl::inline dyn
