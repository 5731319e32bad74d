#pragma once
/// KINSOL of SUNDIALS: roots of nonlinear equations.

#include <functional>
#include <optional>

#include "libbase/linalg.hpp"

namespace whirl::inline dyn {

/// A root of f near a guess, by Newton's method with line search and differences for the Jacobian.
///
/// @param f      writes f(x), of the size of x
/// @param scale  of each x: steps below 1e-14 of it end the search
/// @param size   of f: the root is found where it is below 1e-13 of this
/// @return       nothing, if it does not converge
/// @source [Hindmarsh2005]
std::optional<Vec> find_root(const std::function<void(const Vec& x, Vec& f)>& f, const Vec& guess,
                             const Vec& scale, double size);

}  // namespace whirl::inline dyn
