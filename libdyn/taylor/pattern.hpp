#pragma once
/// The structure that all systems of a batch share: which coefficients are not zero anywhere.

#include <span>
#include <vector>

#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

/// Where the nonzero coefficients of the equations of motion are.
struct Pattern {
  /// Rows of K and D with coefficients beside their diagonals: one, or several whose sums are made
  /// side by side.
  struct CoupledRows {
    static constexpr int side_by_side = 4;
    std::vector<int> rows;
    std::vector<int> of_x, of_rate;  ///< columns of K, of D, in which any of the rows has one
    /// Of their coefficients among all of them: column by column, one for every row, K before D.
    int begin = 0;

    int coefficients() const {
      return static_cast<int>(rows.size() * (of_x.size() + of_rate.size()));
    }
  };
  struct ContactRows {
    int coordinates = 0;                        ///< of the system
    std::vector<int> of_x, of_y;                ///< coordinates that move the contact in x, in y
    std::vector<int> pushed_by_x, pushed_by_y;  ///< coordinates that its force accelerates
    /// Where friction acts elsewhere: coordinates whose rates are in the slip, that it accelerates.
    std::vector<int> slips_by_x, slips_by_y, rubbed_x, rubbed_y;
    bool rubs_apart = false;
    bool is_plane = false;    ///< it is met in one direction, which does not change
    bool is_wall = false;     ///< it is met on a curve that is no circle
    bool is_rolling = false;  ///< it is an element of a rolling bearing
    bool is_limit = false;    ///< of a signal: a plane that `slips` close, too
    int group = -1;           ///< of places that turn, in turning
    bool has_rate = false;    ///< the law depends on the rate of the depth
    bool has_friction = false;
    bool has_smooth_friction = false;  ///< tanh of the slip
    std::size_t law = 0;               ///< index in AnyContactLaw
    AnyGeometry geometry;              ///< that of the first system: its kind counts
    bool is_analytic = true;           ///< the law has a Taylor series at the surface

    /// Whether the lanes keep its normal and its depth, and no distance from a center.
    bool has_normal() const { return is_plane || is_wall || is_rolling; }
    /// Whether the lanes keep the velocity of the slip beside the distance.
    bool slips_apart() const { return rubs_apart || is_plane || is_wall; }
  };
  struct FilmRows {
    std::vector<int> of_x, of_y;                ///< coordinates that move the journal in x, in y
    std::vector<int> pushed_by_x, pushed_by_y;  ///< coordinates that the oil accelerates
    AnyFilmLaw law;
  };

  int n = 0;
  std::vector<int> forced;           ///< coordinates with a load that changes
  std::size_t other_loads = 0;       ///< loads of other frequencies, the most of any system
  std::vector<CoupledRows> coupled;  ///< all rows that have such coefficients
  int off_diagonals = 0;             ///< coefficients in `coupled`
  std::vector<ContactRows> contacts;
  std::vector<FilmRows> films;

  /// Contacts of the model whose places turn: which of `contacts` these are.
  struct TurningGroup {
    std::size_t first = 0, count = 0;
  };
  std::vector<TurningGroup> turning;

  /// Two contacts that slip alike in any of the systems (see ReducedContact::slip_group).
  struct Alike {
    std::size_t first = 0, second = 0;  ///< first < second
    bool operator==(const Alike&) const = default;
  };
  std::vector<Alike> alike;

  /// How many bodies there are, where the coordinates are their (x, y) and nothing couples them but
  /// a contact that all are in, whose law does not know the rate of the depth, and there is no
  /// film; else 0.
  int bodies = 0;
  bool is_isotropic = false;  ///< bodies whose coefficients are the same in x and in y

  /// @throws NumericalError  if the systems differ in coordinates, contacts, films or kinds of laws
  static Pattern of(std::span<const ContactSystem* const> systems);
};

/// Joins rows whose coefficients are in much the same columns: every value is then loaded once for
/// all of them, and no sum waits for another one. What a row lacks in a column is zero, which
/// changes no sum. Rows without coefficients are left out.
///
/// @param rows  one by one, in order
std::vector<Pattern::CoupledRows> side_by_side(const std::vector<Pattern::CoupledRows>& rows);

/// Pattern of the systems of trajectories.
Pattern pattern_of(std::span<const Trajectory> trajectories);

}  // namespace whirl::inline dyn
