#pragma once
/// From a structure to its sparse global matrices.

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "libfe/eigen/equations_of_motion.hpp"
#include "libfe/mesh/dofs.hpp"
#include "libfe/mesh/mesh.hpp"

namespace whirl::inline fe {

struct BearingCoefficients;
struct Connection;
struct Rotor;
struct Structure;

/// The equations of motion of a structure at a speed, n x n.
struct System : EquationsOfMotion<Sparse> {
  DofMap dofs;
};

/// Assembles one structure at any number of speeds.
class Assembler {
 public:
  /// @throws ModelError  as make_mesh, and for connections that cannot be (clamping a body without
  ///                     tilts, a rigid bearing whose ends are held already, ...) or hold
  ///                     everything, and for modal damping where the modes at rest cannot be
  ///                     computed
  explicit Assembler(Structure structure);

  /// The same for a structure that differs in its loads (unbalances, bow, gravity, forces) and in
  /// what probes read, but neither in where these are nor in anything else; nothing for another
  /// structure.
  std::optional<Assembler> with_loads_of(const Structure& structure) const;

  const Structure& structure() const { return *structure_; }
  const Mesh& mesh() const { return assembled_->mesh; }
  /// Of the coordinates that supports leave, nothing condensed.
  const DofMap& dofs() const { return assembled_->dofs; }
  Point point(const Station& station) const { return resolve(station, *structure_, mesh()); }
  /// Speeds where the first shaft has a speed [rad/s], see mesh.hpp.
  double shaft_speed(const Point& point, double Omega) const {
    return whirl::shaft_speed(point, *structure_, mesh(), Omega);
  }
  double spin_speed(const Point& point, double Omega) const {
    return whirl::spin_speed(point, *structure_, mesh(), Omega);
  }
  /// Coefficients of a bearing, seal or link, at the speed of the shaft that it is on.
  BearingCoefficients coefficients_of(const Connection& connection, double Omega,
                                      double omega) const;

  /// Whether M, C or K change with speed (tables, films).
  bool tables_depend_on_speed() const { return assembled_->tables_depend_on_speed; }
  /// Whether the equations do beyond Omega G, by these or by damping that rotates.
  bool depends_on_speed() const {
    return tables_depend_on_speed() || assembled_->fixed.circulates();
  }
  /// Whether they change with the frequency of a motion, too.
  bool depends_on_whirl() const { return assembled_->depends_on_whirl; }

  /// Matrices at a speed [rad/s] for motions of a frequency omega >= 0 [rad/s], dofs without
  /// inertia condensed.
  ///
  /// Condensed exactly are those without mass whose damping is none or proportional to stiffness;
  /// a massless freedom with a damper of its own stays, and makes M singular. So do those on which
  /// coefficients act that depend on omega: coordinates are the same at every frequency.
  ///
  /// @throws NumericalError  if a freedom has neither inertia nor stiffness, if none has inertia,
  ///                         or if a linearized connection has no coefficients at this speed
  System at(double Omega, double omega) const;
  /// The same for motions whose frequency is the speed, as unbalance lets them be.
  System at(double Omega) const { return at(Omega, Omega); }

  /// The same with every freedom that supports leave; M is singular where there is no inertia.
  System uncondensed(double Omega, double omega) const;
  System uncondensed(double Omega) const { return uncondensed(Omega, Omega); }

  /// Weight of everything, a full vector of forces and moments [N, N.m], internal ones included.
  /// Added mass has none.
  Vec gravity_load() const;
  /// The same of an acceleration (x, y) of everything [m/s^2].
  Vec inertia_load(const Vec2& acceleration) const;

  /// Complex amplitude of the unbalance force over Omega^2, a full vector [kg.m]:
  /// f(t) = Omega^2 Re(u exp(i Omega t)), u_x = U e^(i phase), u_y = -i u_x.
  ///
  /// @param ratio  of the speed of the shafts whose unbalance counts to that of the first one; f(t)
  ///               goes with ratio Omega in place of Omega
  CVec unbalance(double ratio = 1.0) const;
  /// The same of a shaft whose speed is its own; f(t) goes with that speed.
  CVec unbalance_of(const Rotor& rotor) const;

  /// Complex amplitude of the force that holds a straight shaft in its bow, a full vector
  /// [N, N.m]: f(t) = Re(f exp(i Omega t)), f = K_shaft bow, with the elastic stiffness of segments
  /// and layers. A bow in a shaft without forces is what it does under this force; rigid parts of
  /// it need none. Between nodes the bow is the line that the shape functions make of its
  /// deflections and slopes there.
  ///
  /// @param shaft  number of the shaft whose bow it is, from 0; f(t) goes with the angle of that
  ///               shaft in place of Omega t
  /// @source [Nicholas1976]
  CVec bow(int shaft = 0) const;

  using FullEquations = EquationsOfMotion<Sparse>;
  /// Equations of the full vector, as if rigid parts were not there, for motions of a frequency
  /// [rad/s].
  FullEquations full(double Omega, double omega) const;

 private:
  /// What loads do not change: structures that differ in loads alone share it.
  struct Assembled {
    Mesh mesh;
    DofMap dofs;          // supports eliminated, nothing condensed
    FullEquations fixed;  // all that does not depend on speed
    /// What shafts whose own speeds change add to it, with their numbers among the rotors.
    std::vector<std::pair<std::size_t, SpinPart<Sparse>>> own_spins;
    FullEquations supports;  // what their states add; empty: none have any
    Sparse modal;            // damping of modes at rest; empty: none
    Sparse weighing;         // inertia that has weight, of the full vector
    bool tables_depend_on_speed = false;
    bool depends_on_whirl = false;
  };
  std::vector<bool> touched_by_whirl() const;
  /// @param counts  of each shaft, whether its unbalance does
  CVec unbalance_of_shafts(const std::vector<bool>& counts) const;
  System system_of(const FullEquations& f, const Sparse& T) const;

  std::shared_ptr<const Structure> structure_;
  std::shared_ptr<const Assembled> assembled_;
};

/// Matrices of a structure at a speed [rad/s]; see Assembler::at.
System assemble(const Structure& structure, double Omega);

}  // namespace whirl::inline fe
