#include "libfe/parts/support.hpp"

#include <algorithm>

#include "libbase/numerics/dense.hpp"

namespace whirl::inline fe {

namespace {

constexpr double singular = 1e-14;  ///< of a reciprocal condition

bool is_same(const Mat& a, const Mat& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a.array() == b.array()).all();
}

Mat repeated_matrix(const Mat& A, int times) {
  Mat whole = Mat::Zero(times * A.rows(), times * A.cols());
  for (int k = 0; k < times; ++k) {
    whole.block(k * A.rows(), k * A.cols(), A.rows(), A.cols()) = A;
  }
  return whole;
}

}  // namespace

CMat StateSpace::stiffness_at(Complex s) const {
  CMat f = D.cast<Complex>();
  if (D_rate.size() > 0) f += s * D_rate.cast<Complex>();
  if (D_inertia.size() > 0) f += s * s * D_inertia.cast<Complex>();
  if (states() == 0) return f;
  const CMat resolvent = s * CMat::Identity(states(), states()) - A.cast<Complex>();
  return f + C.cast<Complex>() * DenseLu<CMat>(resolvent).solve(CMat(B.cast<Complex>()));
}

Mat StateSpace::static_stiffness() const {
  if (states() == 0) return D;
  const DenseLu<Mat> factor(A);
  return factor.rcond() > singular ? Mat(D - C * factor.solve(B)) : D;
}

StateSpace StateSpace::repeated(int times) const {
  return {repeated_matrix(A, times),      repeated_matrix(B, times),
          repeated_matrix(C, times),      repeated_matrix(D, times),
          repeated_matrix(D_rate, times), repeated_matrix(D_inertia, times)};
}

bool StateSpace::operator==(const StateSpace& other) const {
  return is_same(A, other.A) && is_same(B, other.B) && is_same(C, other.C) && is_same(D, other.D) &&
         is_same(D_rate, other.D_rate) && is_same(D_inertia, other.D_inertia);
}

bool StateCoordinates::operator==(const StateCoordinates& other) const {
  return is_same(K_w, other.K_w) && is_same(C_w, other.C_w) && is_same(B_0, other.B_0) &&
         is_same(B_1, other.B_1) && is_same(C_0, other.C_0) && is_same(C_1, other.C_1) &&
         is_same(D, other.D) && idle == other.idle;
}

bool SignalLimit::operator==(const SignalLimit& other) const {
  return name == other.name && limit == other.limit && force == other.force &&
         is_same(over_states, other.over_states) &&
         is_same(over_displacements, other.over_displacements) &&
         is_same(over_rates, other.over_rates) && is_same(to_states, other.to_states) &&
         is_same(to_forces, other.to_forces);
}

std::vector<const Station*> places_of(const Support& support) {
  std::vector<const Station*> places;
  for (const auto* coordinates : {&support.acts_on, &support.sees}) {
    for (const InterfaceCoordinate& c : *coordinates) {
      const auto is_it = [&](const Station* other) {
        return other->kind == c.at.kind && other->z == c.at.z && other->node == c.at.node &&
               other->body == c.at.body && other->rotor == c.at.rotor;
      };
      if (std::ranges::none_of(places, is_it)) places.push_back(&c.at);
    }
  }
  return places;
}

}  // namespace whirl::inline fe
