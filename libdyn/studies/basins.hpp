#pragma once
/// Coexisting motions: which starts end in the same motion.

#include <cstdint>
#include <vector>

#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/parameter_grid.hpp"
#include "libdyn/studies/point_rows.hpp"
#include "libdyn/studies/row_travel.hpp"
#include "libdyn/studies/study_models.hpp"

namespace whirl::inline dyn {

/// What is known of a motion that a start ended in.
struct Ending {
  MotionKind kind = MotionKind::periodic;
  int period = 0;
  bool is_proven = false;
  std::vector<Regime> regimes;   ///< of the contacts
  std::vector<double> sections;  ///< last states at phase 0; NaN behind the last one
};

/// Motions that are the same have one number, from 0 in the order of their first appearance.
///
/// Proven orbits are the same where their sections are, to 1e-5 length scales; other motions are
/// told apart by their kind, their period and the regimes of the contacts only: two chaotic
/// attractors with the same regimes count as one.
class AttractorNumbers {
 public:
  /// @param system  must outlive these numbers
  explicit AttractorNumbers(const ContactSystem& system) : system_(system) {}
  int number_of(const Ending& ending);

 private:
  const ContactSystem& system_;
  std::vector<Ending> found_{};
};

/// A start near another one: every coordinate moved by -size to size length scales, every velocity
/// by as much times the rate of the phase; drawn again where a journal would be outside its oil
/// film. The same numbers give the same start on every machine.
MotionState random_start(const ContactSystem& system, const MotionState& around, double size,
                         std::uint64_t seed, std::uint64_t number);

struct BasinsOptions {
  ParameterGrid grid;      ///< of values of the model's start; no axes: random starts
  std::size_t starts = 1;  ///< the model's own start, and random ones around it
  double size = 0.5;       ///< how far random starts are away [length scales]
  std::uint64_t seed = 1;
  ClassifyOptions classify{};  ///< all sections of an orbit are kept, whatever its `sections`
  int threads = 1;
  Stripe stripe{};  ///< the points that are computed

  bool is_random() const { return grid.axes.empty(); }
  std::size_t points() const { return is_random() ? starts : grid.points(); }
};

/// A start, and what became of it.
struct BasinsPoint {
  ClassifiedMotion motion{};
  FullState start{};  ///< empty if there is no start
  /// Last reduced states at phase 0, one after the other; NaN behind the last one.
  std::vector<double> sections{};

  static constexpr auto columns() {
    return ColumnList{
        column(
            "start_displacement", [](auto& p) -> auto& { return p.start.displacement; }, "m, rad",
            "displacement at the start")
            .along("full"),
        column(
            "start_velocity", [](auto& p) -> auto& { return p.start.velocity; }, "m/s, rad/s",
            "velocity at the start")
            .along("full"),
        column("section", &BasinsPoint::sections, "",
               "reduced states (eta, eta') at phase 0, the last ones")
            .along("sections states")};
  }
};

template <class Bytes>
void travel(Bytes& bytes, Is<BasinsPoint> auto& point) {
  auto& [motion, start, sections] = point;
  bytes(motion, start, sections);
}

/// Starts that ended in the same motion.
struct Basin {
  std::size_t first = 0, count = 0;
};

/// In place of the number of an attractor.
constexpr int failed_start = -1, unsettled_start = -2;

struct BasinsResult {
  static constexpr std::string_view group = "/basins";
  /// Dimension of the points if their starts are random.
  static constexpr std::string_view leads = "starts";
  StudySystem system{};
  bool is_random = false;
  long sections = 0;  ///< of a start at most
  PointRows<BasinsPoint> points{};
  std::vector<Basin> basins{};  ///< in the order of their first starts; set at the end
  /// Per start the number of its basin, or why it has none; empty until all starts are known.
  std::vector<int> attractor{};

  /// Numbers of random starts.
  std::vector<int> starts() const;
  ColumnSizes sizes() const;
  static constexpr auto columns() {
    using C = BasinsResult;
    return ColumnList{
        column("start", &C::starts, "", "start").axis("starts+").maybe(), contact_names<C>(),
        rows(&C::points, "point"),
        column("attractor", &C::attractor, "",
               "number of the motion that a start ends in, from 0; -1: failed, -2: not settled")
            .along("point")
            .within({-2.0, valid::largest, false, "point"})
            .maybe()};
  }
};

/// The first start that ended in a motion.
struct FirstStart {
  long number = 0;  ///< from 1
  FullState state{};

  static constexpr auto columns() {
    using S = FirstStart;
    constexpr auto displacement = [](const S& s) { return s.state.displacement; };
    constexpr auto velocity = [](const S& s) { return s.state.velocity; };
    return ColumnList{
        column("number", &S::number, "", "number of the start"),
        column("displacement", displacement, "m, rad", "displacement there").as("displacement"),
        column("velocity", velocity, "m/s, rad/s", "velocity there").as("velocity")};
  }
};

/// A motion that starts ended in, and the share of these starts.
struct Attractor : MotionSummary {
  long number = 0;     ///< from 0, in the order of first starts
  double share = 0.0;  ///< of the starts that did not fail
  double impacts_per_rev = 0.0;
  std::vector<Regime> regimes{};  ///< of the contacts
  FirstStart start{};

  static constexpr auto columns() {
    using A = Attractor;
    return ColumnList{column("number", &A::number, "", "number of the motion"),
                      column("motion", &A::motion, "", "kind of motion"),
                      column("share", &A::share, "", "of the starts that did not fail"),
                      column("period_revs", &A::period, "", "period [revolutions]"),
                      column("regime", &A::regime, "", "the strongest of all contacts"),
                      column("impacts_per_rev", &A::impacts_per_rev, "", "impacts per revolution"),
                      column("lyapunov_max", &A::largest_exponent, "", "largest exponent"),
                      column("start", &A::start, "", "the first one that ended there")};
  }
};

/// Starts whose motions have not settled, grouped by the regimes of their contacts, which are
/// known.
struct UnsettledStarts {
  std::vector<Regime> regimes{};  ///< of the contacts
  double share = 0.0;             ///< of the starts that did not fail

  static constexpr auto columns() {
    using U = UnsettledStarts;
    return ColumnList{column("regimes", &U::regimes, "", "of the contacts, in their order"),
                      column("share", &U::share, "", "of the starts that did not fail")};
  }
};

/// What the starts of a study ended in.
struct BasinShares {
  long starts = 0;
  std::vector<Attractor> attractors;       ///< the largest share first
  std::vector<UnsettledStarts> unsettled;  ///< the largest share first

  static constexpr auto columns() {
    return ColumnList{column("starts", &BasinShares::starts, "", "starts"),
                      rows(&BasinShares::attractors, "attractors"),
                      rows(&BasinShares::unsettled, "unsettled")};
  }
};
BasinShares basin_shares(const BasinsResult& result);

/// Finds the motions that many starts of one model end in.
///
/// @param earlier  what another call with the same models and options has found: its points stay as
///                 they are; empty: none
/// @return  with fewer points if the monitor stopped it
/// @throws ModelError      as models
/// @throws NumericalError  if the first point cannot be computed, or nothing moves
BasinsResult basins(const StudyModels& models, const BasinsOptions& options,
                    const Monitor<BasinsResult>& monitor = {}, BasinsResult earlier = {});

}  // namespace whirl::inline dyn
