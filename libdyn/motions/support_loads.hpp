#pragma once
/// Forces of a rotor in motion on its bearings, seals, links and oil films.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

struct Model;

/// Forces on all of these parts at an instant of a motion of the reduced rotor.
///
/// Elastic parts and films have the forces of their laws at the motion of their stations. Forces on
/// rigid parts balance the loads, contacts, films and inertia of the whole rotor, each by the
/// static shape that a displacement of the part makes, see RigidRows::static_shape: the modes that
/// the reduction leaves out are then missed in inertia alone.
class SupportLoads {
 public:
  struct Part {
    std::string kind;  ///< "bearing", "seal", "link", "oil film", "rolling bearing"
    std::string name;
  };

  /// What carries a rotor: bearings, seals, links, oil films, rolling bearings.
  static std::vector<Part> parts_of(const Model& model, const Assembler& assembler);

  /// @param scene  of the model at its speed
  SupportLoads(const Model& model, const Scene& scene);

  const std::vector<Part>& parts() const { return parts_; }
  bool needs_acceleration() const { return needs_acceleration_; }

  /// @param y             state, as the layout of the scene's contacts has it
  /// @param acceleration  of the coordinates; may be anything if it is not needed
  /// @param states, forces  of the contacts
  /// @param out           receives x and y of the force on each part in turn [N]
  void at(const ContactSystem& system, const Instant& instant, const double* y,
          const Vec& acceleration, const ContactStates& states,
          std::span<const ContactForces> forces, Eigen::Ref<Vec> out) const;

 private:
  /// What forces at a place add to the forces on rigid parts, 2 parts x 2.
  using Share = Eigen::Matrix<double, Eigen::Dynamic, 2>;
  struct ContactShares {
    Share closing, rubbing;  ///< of forces that close the contact, of friction that acts elsewhere
  };

  ContactShares shares_of_limit(const LimitOfSupport& of, const Assembler& assembler,
                                const Sparse& rigid) const;
  void add_loads(const Assembler& assembler, const ContactSystem& system, const Sparse& rigid);

  std::vector<Part> parts_;
  Mat K_, C_, M_;                               // 2 parts x coordinates
  std::vector<ReducedExcitation> loads_;        // on rigid parts
  std::vector<ContactShares> of_contacts_;      // of the model; empty: none is asked for
  std::vector<Share> of_films_;                 // likewise
  Eigen::Index first_film_ = 0;                 // row
  std::vector<Eigen::Index> rows_of_bearings_;  // of all contacts; -1: of one with a stator
  bool has_rigid_ = false, needs_acceleration_ = false;
};

/// Forces on one part over a recorded motion, in short.
struct SupportLoad {
  std::string kind;  ///< "bearing", "seal", "link", "oil film", "rolling bearing"
  std::string name;
  double mean_fx = 0.0, mean_fy = 0.0;                  ///< [N]
  double largest = 0.0;                                 ///< largest force, with its mean [N]
  double largest_at = 0.0;                              ///< time of it since the start [s]
  double peak_to_peak_fx = 0.0, peak_to_peak_fy = 0.0;  ///< [N]
  /// Where loads begin on the way: largest force before the first of them, and over the last
  /// revolutions, eight at most [N].
  std::optional<double> before{}, after{};

  static constexpr auto columns() {
    using S = SupportLoad;
    return ColumnList{
        column("kind", &S::kind, "", "bearing, seal, link, oil film or rolling bearing"),
        column("name", &S::name, "", "its name"),
        column("mean_fx", &S::mean_fx, "N", "mean force of the rotor on it along x"),
        column("mean_fy", &S::mean_fy, "N", "mean force of the rotor on it along y"),
        column("largest", &S::largest, "N", "largest force, with its mean"),
        column("largest_at", &S::largest_at, "s", "time of the largest force since the start"),
        column("peak_to_peak_fx", &S::peak_to_peak_fx, "N", "of the force along x"),
        column("peak_to_peak_fy", &S::peak_to_peak_fy, "N", "of the force along y"),
        column("before", &S::before, "N", "largest force before a load begins").maybe(),
        column("after", &S::after, "N", "largest force of the last revolutions").maybe()};
  }
};

}  // namespace whirl::inline dyn
