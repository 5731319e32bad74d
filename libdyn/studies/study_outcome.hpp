#pragma once
/// What there is to say of all points of a study together.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "libbase/column.hpp"
#include "libbase/failure.hpp"
#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/point_runner.hpp"
#include "libdyn/studies/stripe.hpp"

namespace whirl::inline dyn {

/// Motions of a study that have not settled.
struct UnsettledMotions {
  long motions = 0;
  std::optional<long> settles_after;  ///< revolutions of transient after which some would have
  long would_settle = 0;              ///< how many these are

  static constexpr auto columns() {
    using M = UnsettledMotions;
    return std::tuple{
        column("motions", &M::motions, "", "motions that have not settled"),
        column("settle_after_revs", &M::settles_after, "", "revolutions of transient"),
        column("would_settle", &M::would_settle, "", "motions that would settle then")};
  }
};

struct StudyOutcome {
  std::size_t resumed = 0;  ///< points that were there already
  std::size_t done = 0, points = 0, failed = 0;
  Failure failure;  ///< how many points failed, and one of them
  UnsettledMotions unsettled;

  bool is_whole() const { return done == points; }
  bool has_failed() const { return is_whole() && failed == points; }

  static constexpr auto columns() {
    using O = StudyOutcome;
    return std::tuple{column("resumed", &O::resumed, "", "points that were there already"),
                      column("not_settled", &O::unsettled, "", "motions that have not settled"),
                      column("failure", &O::failure, "", "how many points failed")
                          .only(Written::in_json)
                          .maybe()};
  }
};

/// @param motions   those of all points; null where none is known
/// @param describe  names a point
/// @param stripe    the points that count
StudyOutcome study_outcome(const std::vector<const ClassifiedMotion*>& motions, std::size_t resumed,
                           const std::function<std::string(std::size_t)>& describe,
                           const Stripe& stripe = {});

/// The motion at a point of a study: a part of its row, or all of it.
template <class Row>
auto& motion_of(Row& row) {
  if constexpr (requires { row.motion; }) {
    return row.motion;
  } else {
    return row;
  }
}

/// The motions of a study's points; null where none is known.
template <class Row>
std::vector<const ClassifiedMotion*> motions_of(const PointRows<Row>& points) {
  std::vector<const ClassifiedMotion*> motions;
  for (const auto& p : points) motions.push_back(p ? &motion_of(*p) : nullptr);
  return motions;
}

}  // namespace whirl::inline dyn
