#pragma once
/// Equations of motion of a reduced rotor with its contacts, ready for integration.

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libcontact/contact.hpp"
#include "libcontact/oil_film.hpp"
#include "libdyn/system/excitation.hpp"
#include "libdyn/system/film.hpp"
#include "libdyn/system/layout.hpp"
#include "libfe/analyses/reduce.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline dyn {

/// What a contact is doing.
enum class Touch : unsigned char {
  apart,     ///< the rotor is inside the clearance
  receding,  ///< still beyond it, but the force would pull: there is none (damped laws)
  sliding,   ///< in touch; friction is mu N times a share that is known
  sticking   ///< in touch; friction is what keeps the slip velocity zero
};

/// State of a contact between events.
struct ContactState {
  Touch touch = Touch::apart;
  double sign = 1.0;  ///< of the slip while sliding, if friction switches exactly

  bool in_touch() const { return touch == Touch::sliding || touch == Touch::sticking; }
  bool operator==(const ContactState&) const = default;
};
using ContactStates = std::vector<ContactState>;

using PlaneRows = Eigen::Matrix<double, 2, Eigen::Dynamic>;
using PlaneColumns = Eigen::Matrix<double, Eigen::Dynamic, 2>;

/// A contact in reduced coordinates eta.
///
/// One contact of the model is one of these, or as many as its geometry has places.
struct ReducedContact {
  std::string name;
  PlaneRows U;     ///< motion u = U eta that closes the clearance, times its arm [m]
  PlaneColumns B;  ///< acceleration eta'' = -B (force on the stator)
  Vec2 offset;
  double clearance;  ///< [m]
  double rim_speed;  ///< Omega R [m/s]
  Friction friction;
  AnyContactLaw<> law;
  AnyGeometry geometry;
  int owner = 0;  ///< number of the model's contact, from 0
  int place = 0;  ///< number of its place, from 0
  /// Contacts of equal number slip alike at every instant and stick together: between the same
  /// stations, about one center, at one radius, with friction that switches exactly.
  int slip_group = 0;
  PlaneRows V{};       ///< where friction acts elsewhere: displacement whose rate is in the slip
  PlaneColumns B_t{};  ///< and the same as B of the friction force; else both are empty

  /// Whether friction acts elsewhere than the normal force.
  bool rubs_apart() const { return V.cols() > 0; }
  /// Whether it is a limit of a signal, whose displacements are in U and rates in V.
  bool is_limit() const { return reads_rates(geometry); }
  /// Whether it is one of many places that turn, some of which are apart.
  bool turns() const { return whirl::turns(geometry); }
  ContactSpace space() const { return {clearance, rim_speed}; }
};

/// What holds contacts that slip alike.
struct Hold {
  double force = 0.0;  ///< the friction that keeps them from sliding, of all together, along t [N]
  double limit = 0.0;  ///< the most that theirs can be, the sum of mu N [N]

  bool is_enough() const { return std::abs(force) <= limit; }
};

/// Kinematics and forces of one contact at one instant.
struct ContactForces {
  Vec2 n = Vec2::Zero();  ///< normal, from the rotor to the stator
  double r = 0.0;         ///< distance from that center, infinite of a plane [m]
  double depth = 0.0;     ///< beyond the surface [m]
  double rate = 0.0;      ///< of the depth [m/s]
  double slip = 0.0;      ///< slip velocity v_t [m/s]
  double normal = 0.0;    ///< N of the law, whether or not in touch [N]
  double friction = 0.0;  ///< T along t = (-n_y, n_x): force on the rotor is -N n - T t [N]

  Vec2 t() const { return {-n(1), n(0)}; }
};

/// Reduced equations of motion with contacts and oil films.
///
///   eta'' = sum_l f_l(alpha_l) - K eta - D eta' - sum_j B_j (N_j n_j + T_j t_j) + sum_i B_i F_i
///
/// M is multiplied out. The state of an integration is (eta, eta'), as its layout() has it;
/// phase = Omega t. A value: copy it, one per thread.
class ContactSystem {
 public:
  /// @throws ModelError  for contacts at stations without inertia
  ContactSystem(const Assembler& assembler, const ReducedSystem& reduced,
                const std::vector<Contact>& contacts, const std::vector<OilFilm>& films = {});

  int coordinates() const { return static_cast<int>(K_.rows()); }
  StateLayout layout() const { return StateLayout(K_.rows()); }
  int size() const { return layout().size(); }
  const Clock& clock() const { return clock_; }
  double Omega() const { return clock_.speed(); }
  double period() const { return clock_.period(); }
  double phase_rate() const { return clock_.rate(); }

  const Mat& K() const { return K_; }
  const Mat& D() const { return D_; }
  /// All loads: the constant one, the synchronous one, which has the angle of the rotor, then those
  /// of other frequencies. The first two are there even where they are zero.
  const std::vector<ReducedExcitation>& excitations() const { return excitations_; }
  const Vec& constant_load() const { return excitations_[0].cosine; }
  const ReducedExcitation& synchronous_load() const { return excitations_[1]; }
  std::span<const ReducedExcitation> other_loads() const {
    return std::span(excitations_).subspan(2);
  }
  /// After how many revolutions all loads repeat, the least number; 0: never, as of a frequency of
  /// its own that is in no simple ratio to the speed.
  long repeats_after() const;
  const std::vector<ReducedContact>& contacts() const { return contacts_; }
  const std::vector<ReducedFilm>& films() const { return films_; }
  /// The first film whose journal is not inside its bearing; null if there is none.
  const ReducedFilm* left_bearing(const double* y) const;
  /// Contacts of the model; each owns one or several of contacts(), which follow one another.
  int owners() const { return contacts_.empty() ? 0 : contacts_.back().owner + 1; }

  /// Scale of displacements for tolerances: the smallest clearance of a contact or film, or the
  /// motion of the loads [m].
  double length_scale() const { return length_scale_; }
  /// Error weights of the state: a displacement of one length scale in each coordinate.
  const Vec& state_scale() const { return scale_; }

  /// eta'' for given states of the contacts.
  /// @param y  state, as layout() has it
  /// @param a  receives n accelerations
  void acceleration(const Instant& at, const double* y, const ContactStates& states,
                    double* a) const;

  /// The same without a memory of events, as classify would have it: contacts touch where the state
  /// lies beyond the clearance, friction takes the sign of the slip, nothing sticks.
  void acceleration(const Instant& at, const double* y, double* a) const;

  /// Normal force, slip and friction of every contact; friction of sticking ones is solved for.
  /// Contacts of one slip group share theirs in proportion to mu N: only its sum is determined, and
  /// so they all slip at the same instant. Of turning places that are apart nothing is said.
  void forces(const Instant& at, const double* y, const ContactStates& states,
              std::vector<ContactForces>& out) const;

  /// What would hold contact i and those in touch that slip with it, the others as they are.
  Hold hold(const Instant& at, const double* y, const ContactStates& states, int i) const;

  /// Whether contact i and another slip alike.
  bool slip_alike(std::size_t i, std::size_t j) const {
    return contacts_[i].slip_group == contacts_[j].slip_group;
  }
  /// Whether contact i is the first that sticks of its slip group: its condition of no slip is that
  /// of all.
  bool leads(const ContactStates& states, std::size_t i) const;
  /// Lets all contacts in touch of the group of contact i stick, or slide with a sign.
  void set_group(ContactStates& states, int i, const ContactState& to) const;

  /// States that a motion has at an instant if nothing is known of its past.
  ContactStates classify(const Instant& at, const double* y) const;

  /// Removes the slip that rounding leaves in sticking contacts, by an impulse of friction.
  void remove_slip(double* y, const ContactStates& states) const;

 private:
  struct Reduction;
  void add_loads(const Reduction& by);
  /// Adds a contact at every place of its geometry.
  /// @param owner  number of the contact in the model, from 0
  void add_contact(const Reduction& by, const Contact& contact, int owner);
  void add_film(const Reduction& by, const OilFilm& film);
  /// How far the loads move a rotor without contacts and films [m], or a millimeter if they do not.
  double size_of_motion(const Reduction& by) const;
  void find_scales(const Reduction& by);
  void find_slip_groups();
  /// Shares what the leaders of slip groups hold among all that stick.
  void share_friction(const ContactStates& states, std::vector<ContactForces>& forces) const;
  /// Without contacts.
  void smooth_acceleration(const Instant& at, const double* y, double* a) const;

  Mat K_, D_;
  std::vector<ReducedExcitation> excitations_;
  std::vector<ReducedContact> contacts_;
  std::vector<ReducedFilm> films_;
  Clock clock_;
  double length_scale_ = 1.0;
  Vec scale_;
};

/// Largest difference of two states: displacements by the length scale (the clearance), velocities
/// by it times the rate of the phase (clearance times speed).
double distance(const ContactSystem& system, const Vec& a, const Vec& b);

/// Kinematics and normal force of one contact; friction is left zero.
ContactForces kinematics(const ReducedContact& contact, const Instant& at, const double* y,
                         StateLayout layout);

/// The same of a contact that does not turn and so does not ask when it is.
ContactForces kinematics(const ReducedContact& contact, const double* y, StateLayout layout);

/// The same from the motion of the gap.
ContactForces kinematics(const ReducedContact& contact, const Instant& at,
                         const GapMotion<double>& motion);

/// How far beyond its surface a contact is, of order one; above zero in touch.
double beyond_surface(const ReducedContact& contact, const ContactForces& f);

/// The same along a path of d = U eta - offset over the clearance, polynomials of s; nothing where
/// it is none.
std::optional<Polynomial> beyond_surface(const ReducedContact& contact, const PathPowers& x,
                                         const PathPowers& y);

/// Rows of the motion that closes a contact, times its arm [m], over the coordinates of a system.
PlaneRows closing_rows(const Contact& contact, const Assembler& assembler, const DofMap& dofs);

/// How fast both parts of a contact turn: two surfaces that turn alike rub without slip.
PartSpeeds part_speeds(const Contact& contact, const Assembler& assembler, double Omega);

/// Takes what the force -N n - T t of a contact adds to the accelerations from them.
void push(const ReducedContact& contact, const ContactForces& f, double T, Eigen::Ref<Vec> a);

/// Friction T of a sliding contact [N], along t.
double sliding_friction(const ReducedContact& contact, const ContactState& state,
                        const ContactForces& f);

}  // namespace whirl::inline dyn
