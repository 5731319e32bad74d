// Derivatives of a contact's force by displacement and velocity, as series along the motion.

#if defined(WHIRL_CONTACT_SLOPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_CONTACT_SLOPES_INL_H
#undef WHIRL_CONTACT_SLOPES_INL_H
#else
#define WHIRL_CONTACT_SLOPES_INL_H
#endif

#include "libdyn/taylor/contact_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// A 2 x 2 matrix of series.
template <class P>
struct SeriesMatrix {
  P xx[P::most_terms], xy[P::most_terms], yx[P::most_terms], yy[P::most_terms];

  /// Adds (ax, ay) (bx, by)^T.
  HWY_ATTR void add(const P* ax, const P* ay, const P* bx, const P* by, int N) {
    for (int k = 0; k <= N; ++k) {
      xx[k] = xx[k] + product_term(ax, bx, k);
      xy[k] = xy[k] + product_term(ax, by, k);
      yx[k] = yx[k] + product_term(ay, bx, k);
      yy[k] = yy[k] + product_term(ay, by, k);
    }
  }
  /// Adds a (ax, ay) (bx, by)^T to coefficient k.
  HWY_ATTR void add_dyad(int k, const P& a, const P& ax, const P& ay, const P& bx, const P& by) {
    xx[k] = fma(a * ax, bx, xx[k]);
    xy[k] = fma(a * ax, by, xy[k]);
    yx[k] = fma(a * ay, bx, yx[k]);
    yy[k] = fma(a * ay, by, yy[k]);
  }
  /// Largest entry of coefficient k.
  HWY_ATTR P size(int k) const {
    return max(max(abs(xx[k]), abs(xy[k])), max(abs(yx[k]), abs(yy[k])));
  }
  HWY_ATTR void clear(int N) {
    for (int k = 0; k <= N; ++k) xx[k] = xy[k] = yx[k] = yy[k] = P(0.0);
  }
};

/// J and H in  d(force) = J d(displacement) + H d(velocity)  of  force = q d + tau rot d.
///
///   J = q 1 + alpha d d^T + beta d d'^T,   H = beta d d^T,
///   beta = N_v / s,   alpha = (N_d - q) / s - beta r' / r,   s = r^2,
///
/// with N_d, N_v the derivatives of the law by depth and rate; friction adds tau's part. The forced
/// change of tau while sticking is not in them (Sticking::add_to_column).
template <class P>
struct ContactSlopes {
  SeriesMatrix<P> J, H;
  P normal_by_depth[P::most_terms], normal_by_rate[P::most_terms];
  bool has_H = false;
  std::unique_ptr<SeriesMatrix<P>>
      J_t;  ///< J of friction that acts elsewhere; then H is all friction's

  HWY_ATTR void find(const ContactLanes<P>& c, int N) {
    derivatives_of_law(c, N);
    const auto& in_touch = c.in_touch;
    has_H = c.rows.has_rate || c.rows.has_smooth_friction;
    if (c.rows.is_plane) return find_of_plane(c, N);
    if (c.wall) return find_of_wall(c, N);
    if (c.rows.is_rolling) return find_of_element(c, N);
    P alpha[P::most_terms], beta[P::most_terms], work[P::most_terms], ex[P::most_terms],
        ey[P::most_terms];
    for (int k = 0; k <= N; ++k) work[k] = normal_by_depth[k] - c.q[k];
    divide(work, c.s, alpha, N, in_touch);
    J.clear(N);
    if (has_H) H.clear(N);
    if (c.rows.has_rate) {
      P rate[P::most_terms], ratio[P::most_terms], vx[P::most_terms], vy[P::most_terms];
      divide(normal_by_rate, c.s, beta, N, in_touch);
      for (int k = 0; k <= N; ++k) rate[k] = c.rate(k);
      divide(rate, c.r, ratio, N, in_touch);
      for (int k = 0; k <= N; ++k) alpha[k] = alpha[k] - product_term(beta, ratio, k);
      multiply(beta, c.dx, ex, N);
      multiply(beta, c.dy, ey, N);
      velocity(c, vx, vy, N);
      J.add(ex, ey, vx, vy, N);
      H.add(ex, ey, c.dx, c.dy, N);
    }
    multiply(alpha, c.dx, ex, N);
    multiply(alpha, c.dy, ey, N);
    J.add(ex, ey, c.dx, c.dy, N);
    for (int k = 0; k <= N; ++k) {
      J.xx[k] = J.xx[k] + c.q[k];
      J.yy[k] = J.yy[k] + c.q[k];
    }
    if (c.rows.has_friction && !c.rub) add_friction(c, N);
    if (c.rows.has_friction && c.rub) find_friction_apart(c, N);
  }

 private:
  HWY_ATTR void derivatives_of_law(const ContactLanes<P>& c, int N) {
    with_force(c.law, c.rows.has_rate, [&](const auto& force) HWY_ATTR {
      auto by_depth = derivative<0>(force);
      auto by_rate = derivative<1>(force);
      for (int k = 0; k <= N; ++k) {
        normal_by_depth[k] = by_depth.at(k, c.depth(k), c.rate(k));
        normal_by_rate[k] = by_rate.at(k, c.depth(k), c.rate(k));
      }
    });
  }

  /// J = N_d n n^T, H = N_v n n^T with a normal n that does not change; friction adds phi times the
  /// same along t = rot n, and chi t t^T to H as in add_slip.
  HWY_ATTR void find_of_plane(const ContactLanes<P>& c, int N) {
    const P x = c.dx[0], y = c.dy[0], nothing(0.0);
    J.clear(N);
    if (has_H) H.clear(N);
    for (int k = 0; k <= N; ++k) {
      normal_by_depth[k] = select(c.in_touch, normal_by_depth[k], nothing);
      normal_by_rate[k] = select(c.in_touch, normal_by_rate[k], nothing);
      J.add_dyad(k, normal_by_depth[k], x, y, x, y);
      if (has_H) H.add_dyad(k, normal_by_rate[k], x, y, x, y);
    }
    if (!c.rows.has_friction) return;
    if (!J_t) J_t = std::make_unique<SeriesMatrix<P>>();
    J_t->clear(N);
    P phi[P::most_terms];
    share_of_normal(c, phi, N);
    P chi[P::most_terms];
    if (c.smooth != 0) slope_over_slip(c, chi, N);
    for (int k = 0; k <= N; ++k) {
      J_t->add_dyad(k, product_term(phi, normal_by_depth, k), -y, x, x, y);
      if (!has_H) continue;
      H.add_dyad(k, product_term(phi, normal_by_rate, k), -y, x, x, y);
      if (c.smooth != 0) H.add_dyad(k, chi[k], -y, x, -y, x);
    }
  }

  /// J = N_d n n^T + N_v n n'^T, H = N_v n n^T with a normal n that turns.
  HWY_ATTR void find_of_element(const ContactLanes<P>& c, int N) {
    P ax[P::most_terms], ay[P::most_terms], vx[P::most_terms], vy[P::most_terms];
    J.clear(N);
    if (has_H) H.clear(N);
    add_pressed(c, ax, ay, vx, vy, N);
  }

  /// Adds what all forces along a normal n that changes have:  J += N_d n n^T + N_v n n'^T,
  /// H += N_v n n^T.
  HWY_ATTR void add_pressed(const ContactLanes<P>& c, P* ax, P* ay, P* vx, P* vy, int N) {
    const P nothing(0.0);
    for (int k = 0; k <= N; ++k) {
      normal_by_depth[k] = select(c.in_touch, normal_by_depth[k], nothing);
      normal_by_rate[k] = select(c.in_touch, normal_by_rate[k], nothing);
    }
    multiply(normal_by_depth, c.dx, ax, N);
    multiply(normal_by_depth, c.dy, ay, N);
    J.add(ax, ay, c.dx, c.dy, N);
    if (!c.rows.has_rate) return;
    multiply(normal_by_rate, c.dx, ax, N);
    multiply(normal_by_rate, c.dy, ay, N);
    velocity(c, vx, vy, N);
    J.add(ax, ay, vx, vy, N);
    H.add(ax, ay, c.dx, c.dy, N);
  }

  /// With the slope n of the depth:
  ///
  ///   J = N_d n n^T + N_v n n'^T + N dn/du,   H = N_v n n^T
  ///
  /// friction adds phi times the same along t = rot n, and q d(phi) t of the slip n x w:
  ///
  ///   q d(phi) = chi (dn/du du x w + n x dw)
  HWY_ATTR void find_of_wall(const ContactLanes<P>& c, int N) {
    P ax[P::most_terms], ay[P::most_terms], vx[P::most_terms], vy[P::most_terms];
    J.clear(N);
    if (has_H) H.clear(N);
    add_pressed(c, ax, ay, vx, vy, N);
    const auto by = [&](const std::vector<Recorded<P>>& of, size_t input)
                        HWY_ATTR { return c.wall->beyond.series(of[input]); };
    const auto &of_x = c.wall->slopes_of_nx, &of_y = c.wall->slopes_of_ny;
    const P *xx = by(of_x, 0), *xy = by(of_x, 1), *yx = by(of_y, 0), *yy = by(of_y, 1);
    for (int k = 0; k <= N; ++k) {
      J.xx[k] = J.xx[k] + product_term(c.q, xx, k);
      J.xy[k] = J.xy[k] + product_term(c.q, xy, k);
      J.yx[k] = J.yx[k] + product_term(c.q, yx, k);
      J.yy[k] = J.yy[k] + product_term(c.q, yy, k);
    }
    if (!c.rows.has_friction) return;
    P phi[P::most_terms];
    share_of_normal(c, phi, N);
    turn_by(J, phi, N);
    if (has_H) turn_by(H, phi, N);
    if (c.smooth == 0) return;
    P chi[P::most_terms], back[P::most_terms], px[P::most_terms], py[P::most_terms];
    slope_over_slip(c, chi, N);
    for (int k = 0; k <= N; ++k) {
      back[k] = -c.dy[k];
      px[k] = product_term(xx, c.rub->wy, k) - product_term(yx, c.rub->wx, k);
      py[k] = product_term(xy, c.rub->wy, k) - product_term(yy, c.rub->wx, k);
    }
    multiply(chi, back, ax, N);
    multiply(chi, c.dx, ay, N);
    J.add(ax, ay, px, py, N);
    H.add(ax, ay, back, c.dx, N);
  }

  /// phi of tau = phi q where it slides; zero where it sticks.
  static HWY_ATTR void share_of_normal(const ContactLanes<P>& c, P* phi, int N) {
    const auto smooth = mask_of<P>(c.smooth & c.touching);
    const P share = select(mask_of<P>(c.sticking), P(0.0), c.share);
    for (int k = 0; k <= N; ++k) {
      phi[k] = k == 0 ? share : P(0.0);
      if (c.smooth != 0) phi[k] = select(smooth, c.mu * c.sine[k], phi[k]);
    }
  }

  /// chi = mu q (1 - tanh^2 u) / w, what smoothed friction over r changes by with the slip; zero in
  /// other lanes.
  static HWY_ATTR void slope_over_slip(const ContactLanes<P>& c, P* chi, int N) {
    const auto smooth = mask_of<P>(c.smooth & c.touching);
    const P factor = c.mu * c.inverse_width;
    for (int k = 0; k <= N; ++k) {
      chi[k] = select(smooth, factor * product_term(c.q, c.cosine2, k), P(0.0));
    }
  }

  static HWY_ATTR void velocity(const ContactLanes<P>& c, P* vx, P* vy, int N) {
    for (int k = 0; k <= N; ++k) {
      vx[k] = P(k + 1.0) * c.dx[k + 1];
      vy[k] = P(k + 1.0) * c.dy[k + 1];
    }
  }

  /// tau = phi q:  tau rot d changes by phi rot (J d(d) + H d(d')) and by q d(phi) rot d.
  HWY_ATTR void add_friction(const ContactLanes<P>& c, int N) {
    const auto sticks = mask_of<P>(c.sticking);
    const P share = select(sticks, P(0.0), c.share);
    if (c.smooth == 0) {
      turn_by(J, share, N);
      if (has_H) turn_by(H, share, N);
    } else {
      const auto smooth = mask_of<P>(c.smooth & c.touching);
      P phi[P::most_terms];
      share_of_normal(c, phi, N);
      turn_by(J, phi, N);
      turn_by(H, phi, N);
      add_slip(c, smooth, N, J);
    }
    if (c.sticking == 0) return;
    for (int k = 0; k <= N; ++k) {
      const P tau = select(sticks, c.tau[k], P(0.0));
      J.xy[k] = J.xy[k] - tau;
      J.yx[k] = J.yx[k] + tau;
    }
  }

  /// phi rot J and the part of the slip, which does not act where the normal force does.
  HWY_ATTR void find_friction_apart(const ContactLanes<P>& c, int N) {
    if (!J_t) J_t = std::make_unique<SeriesMatrix<P>>();
    const auto smooth = mask_of<P>(c.smooth & c.touching);
    P phi[P::most_terms], back_x[P::most_terms], back_y[P::most_terms];
    share_of_normal(c, phi, N);
    const auto turned = [&](const P* x, const P* y, P* to_x, P* to_y) HWY_ATTR {
      multiply(phi, y, back_x, N);
      multiply(phi, x, back_y, N);
      for (int k = 0; k <= N; ++k) {
        to_x[k] = -back_x[k];
        to_y[k] = back_y[k];
      }
    };
    turned(J.xx, J.yx, J_t->xx, J_t->yx);
    turned(J.xy, J.yy, J_t->xy, J_t->yy);
    if (c.smooth != 0) add_slip(c, smooth, N, *J_t);
  }

  /// m += share rot m, that is rows (x, y) += share (-y, x).
  static HWY_ATTR void turn_by(SeriesMatrix<P>& m, const P& share, int N) {
    for (int k = 0; k <= N; ++k) {
      const P xx = m.xx[k], xy = m.xy[k];
      m.xx[k] = fnma(share, m.yx[k], xx);
      m.xy[k] = fnma(share, m.yy[k], xy);
      m.yx[k] = fma(share, xx, m.yx[k]);
      m.yy[k] = fma(share, xy, m.yy[k]);
    }
  }
  /// The same with a share that changes. The first term comes last, as with one that does not: it
  /// is all there is in lanes of exact friction.
  static HWY_ATTR void turn_by(SeriesMatrix<P>& m, const P* share, int N) {
    const auto older = [&](const P* a, int k) HWY_ATTR {
      P sum(0.0);
      for (int i = 1; i <= k; ++i) sum = fma(share[i], a[k - i], sum);
      return sum;
    };
    for (int k = N; k >= 0; --k) {  // downward: coefficient k needs those below as they were
      const P xx = m.xx[k], xy = m.xy[k];
      const P of_xx = older(m.xx, k), of_xy = older(m.xy, k);
      m.xx[k] = fnma(share[0], m.yx[k], xx - older(m.yx, k));
      m.xy[k] = fnma(share[0], m.yy[k], xy - older(m.yy, k));
      m.yx[k] = fma(share[0], xx, m.yx[k] + of_xx);
      m.yy[k] = fma(share[0], xy, m.yy[k] + of_xy);
    }
  }

  /// The part of the slip in smoothed friction, phi = mu tanh u, u = (Omega R + (d x d') / r) / w:
  ///
  ///   q d(phi) = chi ((d(d) x d' + d x d(d')) / r - (d x d') / r^3 d . d(d)),  chi = mu q (1 -
  ///   tanh^2 u) / w
  HWY_ATTR void add_slip(const ContactLanes<P>& c, const typename P::Mask& smooth, int N,
                         SeriesMatrix<P>& to_J) {
    P chi[P::most_terms], a[P::most_terms], b[P::most_terms], px[P::most_terms], py[P::most_terms];
    P vx[P::most_terms], vy[P::most_terms], back[P::most_terms];
    slope_over_slip(c, chi, N);
    for (int k = 0; k <= N; ++k) back[k] = -c.dy[k];
    multiply(chi, c.turn_rate, a, N);
    divide(a, c.s, b, N, smooth);  // chi (d x d') / r^3
    divide(chi, c.r, a, N, smooth);
    velocity(c, vx, vy, N);
    if (c.rub) {
      std::copy(c.rub->wx, c.rub->wx + N + 1, vx);
      std::copy(c.rub->wy, c.rub->wy + N + 1, vy);
    }
    for (int k = 0; k <= N; ++k) {
      px[k] = product_term(a, vy, k) - product_term(b, c.dx, k);
      py[k] = -product_term(a, vx, k) - product_term(b, c.dy, k);
    }
    to_J.add(back, c.dx, px, py, N);
    multiply(a, back, px, N);
    multiply(a, c.dx, py, N);
    H.add(back, c.dx, px, py, N);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
