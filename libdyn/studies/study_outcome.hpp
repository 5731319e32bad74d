#pragma once
/// The outcome of all points of a study together.

#include <functional>
#include <optional>
#include <string>

#include "libbase/failure.hpp"
#include "libbase/structs/column.hpp"
#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/point_rows.hpp"
#include "libdyn/studies/stripe.hpp"
#include "libdyn/system/hardest_touch.hpp"

namespace whirl::inline dyn {

/// Motions of a study that have not settled.
struct UnsettledMotions {
  long motions = 0;
  /// Revolutions of transient after which some motions would have settled; nothing: not known.
  std::optional<long> settles_after;
  long would_settle = 0;  ///< how many would have settled then

  static constexpr auto columns() {
    using M = UnsettledMotions;
    return ColumnList{
        column("motions", &M::motions, "", "motions that have not settled"),
        column("settle_after_revs", &M::settles_after, "", "revolutions of transient"),
        column("would_settle", &M::would_settle, "", "motions that would settle then")};
  }
};

struct StudyOutcome {
  std::size_t resumed = 0;  ///< points that were there already
  std::size_t done = 0, points = 0, failed = 0;
  Failure failure;  ///< how many points failed, and one of these as an example
  UnsettledMotions unsettled;
  HardestTouches hardest{};  ///< of all motions, by the numbers of their points

  bool is_whole() const { return done == points; }
  bool has_failed() const { return is_whole() && failed == points; }

  static constexpr auto columns() {
    using O = StudyOutcome;
    return ColumnList{column("resumed", &O::resumed, "", "points that were there already"),
                      column("not_settled", &O::unsettled, "", "motions that have not settled"),
                      column("failure", &O::failure, "", "how many points failed")
                          .only(Written::in_json)
                          .maybe()};
  }
};

/// The motion at a point of a study: a part of the row, or all of the row.
template <class Row>
auto& motion_of(Row& row) {
  if constexpr (requires { row.motion; }) {
    return row.motion;
  } else {
    return row;
  }
}

/// Takes one motion of a study after the other, and tells the outcome of all at the end.
class OutcomeCount {
 public:
  /// @param describe  names a point; must outlive this count
  explicit OutcomeCount(const std::function<std::string(std::size_t)>& describe)
      : describe_(describe) {}
  void add(std::size_t point, const ClassifiedMotion& motion);
  /// @param points  how many there are
  StudyOutcome outcome(std::size_t points, std::size_t resumed) const;

 private:
  const std::function<std::string(std::size_t)>& describe_;
  StudyOutcome sum_{};
  std::string example_{};  ///< a point that failed
};

/// @param describe  names a point
/// @param stripe    the points that count
template <class Row>
StudyOutcome study_outcome(const PointRows<Row>& points, std::size_t resumed,
                           const std::function<std::string(std::size_t)>& describe,
                           const Stripe& stripe = {}) {
  OutcomeCount count(describe);
  for (std::size_t i = stripe.number - 1; i < points.size(); i += stripe.of) {
    if (const auto row = points[i]) count.add(i, motion_of(*row));
  }
  return count.outcome(stripe.points(points.size()), resumed);
}

}  // namespace whirl::inline dyn
