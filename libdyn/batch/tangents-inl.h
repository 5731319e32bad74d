// What the engine keeps of its tangents.

#if defined(WHIRL_TANGENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_TANGENTS_INL_H
#undef WHIRL_TANGENTS_INL_H
#else
#define WHIRL_TANGENTS_INL_H
#endif

#include <vector>

#include "libdyn/batch/contact_slopes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl {
namespace HWY_NAMESPACE {

/// Memory of the tangents: nothing unless they are asked for.
template <class P>
struct Tangents {
  std::vector<P> columns;   ///< 2 n columns of 2 n rows, one after another
  std::vector<P> log_sums;  ///< log of the growth of every column
  std::vector<P> weights;   ///< 1 / scale^2 of the state
  P fastest2{0.0};          ///< square of the fastest rate of the linear part [1/s^2]
  P trace{0.0};             ///< divergence of the flow without contacts [1/s]
  P divergence{0.0};        ///< its integral with contacts
  double reach = 0.0;       ///< rate times step at which a tangent is as exact as the tolerance
  std::vector<ContactSlopes<P>> slopes;
  std::vector<P> gain;   ///< per contact, largest eigenvalue of U B [1/kg]
  std::vector<P> terms;  ///< of one column, as Engine::term
  /// A contact as one column moves it: displacement, distance, acceleration, friction.
  struct Column {
    P dx[P::most_terms], dy[P::most_terms], vx[P::most_terms], vy[P::most_terms];
    P r[P::most_terms], ax[P::most_terms], ay[P::most_terms], tau[P::most_terms];
  };
  std::vector<Column> contacts;
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl
HWY_AFTER_NAMESPACE();

#endif  // guard
