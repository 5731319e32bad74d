#include "libdyn/system/sloped_contact.hpp"

#include <numbers>
#include <tuple>
#include <type_traits>

namespace whirl::inline dyn {

namespace {

ByParameter dual(double value, double slope) {
  return {value, ByParameter::Slopes(slope)};
}

/// A law over numbers with derivatives.
/// @param slope_of  of a member of the law
template <template <class> class Law, class SlopeOf>
Law<ByParameter> sloped_law(const Law<double>& law, const SlopeOf& slope_of) {
  Law<ByParameter> to;
  const auto set = [&](auto Law<double>::*from, auto Law<ByParameter>::*member) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(to.*member)>, ByParameter>) {
      to.*member = dual(law.*from, slope_of(from));
    } else {
      to.*member = law.*from;
    }
  };
  std::apply(
      [&](const auto&... single) {
        std::apply([&](const auto&... sloped) { (set(single.member, sloped.member), ...); },
                   Law<ByParameter>::fields());
      },
      Law<double>::fields());
  if constexpr (requires { Law<double>::derived(); }) {
    std::apply(
        [&](const auto&... single) {
          std::apply([&](const auto&... sloped) { (set(single, sloped), ...); },
                     Law<ByParameter>::derived());
        },
        Law<double>::derived());
  }
  return to;
}

}  // namespace

ContactGap<ByParameter> SlopedContact::gap(const Instant& at, GapMotion<ByParameter> m) const {
  for (std::size_t i = 0; i < 2; ++i) m.d[i] = m.d[i] - offset[i];
  if (is_wall(contact.geometry)) {
    return with_wall(contact.geometry, ContactGap<ByParameter>{}, [&](const auto& w) {
      return gap_to_wall<std::remove_cvref_t<decltype(w)>>(m, wall, clearance, rim_speed);
    });
  }
  // at a fixed phase, what changes the ratio of a speed turns what has it
  const double whole = at.phase + 2.0 * std::numbers::pi * static_cast<double>(at.revolution);
  const auto angle_of = [&](const ByParameter& of) {
    return dual(angle_at(of.value, at), whole * of.slopes(0));
  };
  const ByParameter gone = angle_of(ratio);
  if (rolling_elements(contact.geometry)) {
    ContactGap<ByParameter> g = geometry::gap_to_element(m, gone + start, turning, play);
    for (const Shape& s : shapes) {
      geometry::add_shape(g, s.height, s.start + angle_of(s.ratio), s.speed, s.sharpness);
    }
    return g;
  }
  if (const auto* blade = std::get_if<geometry::BladeRow>(&contact.geometry)) {
    const Vec2 e = blade->axis(at), along(-e(1), e(0));
    for (std::size_t i = 0; i < 2; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      m.d[i].slopes += e(k) * tip.slopes + along(k) * tip.value * gone.slopes;
      m.w[i].slopes += along(k) * tip_speed.slopes - e(k) * tip_speed.value * gone.slopes;
    }
  }
  ContactGap<ByParameter> g = std::visit(
      [&](const auto& geometry) { return geometry.gap(contact.space(), at, m); }, contact.geometry);
  g.depth.slopes -= clearance.slopes + tip.slopes;  // tips touch at clearance + tip
  g.slip.slopes += rim_speed.slopes;
  const Vec2 turned(-turned_normal(1), turned_normal(0));  // of t
  for (std::size_t i = 0; i < 2; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    g.n[i].slopes(0) += turned_normal(k);
    g.depth.slopes(0) += turned_normal(k) * m.d[i].value;
    g.rate.slopes(0) += turned_normal(k) * m.w[i].value;
    g.slip.slopes(0) += turned(k) * m.v[i].value;
  }
  return g;
}

SlopedContact sloped_contact(const ContactSystem& system, std::size_t i,
                             const NumberSlopes& slopes) {
  const auto number = [&](const auto& of) {
    return dual(of(system.contacts()[i]),
                slopes.of([&](const ContactSystem& s) { return of(s.contacts()[i]); }));
  };
  using C = ReducedContact;
  SlopedContact to;
  to.contact = system.contacts()[i];
  for (const int k : {0, 1}) {
    to.offset[static_cast<std::size_t>(k)] = number([k](const C& c) { return c.offset(k); });
  }
  to.clearance = number([](const C& c) { return c.clearance; });
  to.rim_speed = number([](const C& c) { return c.rim_speed; });
  to.mu = number([](const C& c) { return c.friction.mu; });
  const ByParameter sharpness = number(
      [](const C& c) { return c.friction.tolerance > 0.0 ? 1.0 / c.friction.tolerance : 0.0; });
  to.tolerance = sharpness.value > 0.0 ? 1.0 / sharpness : ByParameter(0.0);
  to.tip = number([](const C& c) { return tip_radius_of(c.geometry); });
  to.ratio = number([](const C& c) { return turning_ratio_of(c.geometry); });
  const auto turning = [i](const ContactSystem& s) {
    return turning_ratio_of(s.contacts()[i].geometry) * s.phase_rate();
  };
  to.turning = dual(turning(system), slopes.of(turning));
  to.tip_speed = to.turning * to.tip;
  if (const auto* row = rolling_elements(to.contact.geometry)) {
    const auto of_row = [&](const auto& of) {
      return number([&](const C& c) { return of(*rolling_elements(c.geometry)); });
    };
    to.play = of_row([](const auto& r) { return r.play; });
    to.start = of_row([](const auto& r) { return r.angle; });
    for (std::size_t k = 0; k < row->shapes.size(); ++k) {
      const auto of_shape = [&](double geometry::RaceShape::*member) {
        return of_row([=](const auto& r) { return r.shapes[k].*member; });
      };
      to.shapes.push_back(
          {of_shape(&geometry::RaceShape::height), of_shape(&geometry::RaceShape::start),
           of_shape(&geometry::RaceShape::ratio), of_shape(&geometry::RaceShape::speed),
           of_shape(&geometry::RaceShape::sharpness)});
    }
  }
  to.turned_normal = slopes.of([i](const ContactSystem& s) -> Vec2 {
    return direction_of(s.contacts()[i].geometry).value_or(Vec2::Zero());
  });
  for (std::size_t k = 0; k < to.wall.size(); ++k) {
    to.wall[k] = number([k](const C& c) { return wall_numbers_of(c.geometry, c.clearance)[k]; });
  }
  to.law = std::visit(
      [&](const auto& law) -> AnyContactLaw<ByParameter> {
        using Law = std::remove_cvref_t<decltype(law)>;
        return sloped_law(law, [&](auto member) {
          return slopes.of(
              [&](const ContactSystem& s) { return std::get<Law>(s.contacts()[i].law).*member; });
        });
      },
      to.contact.law);
  return to;
}

std::optional<std::array<ByParameter, 2>> SlopedFilm::force(
    const std::array<ByParameter, 2>& u, const std::array<ByParameter, 2>& u_rate) const {
  using D = ByParameter;
  std::array<D, 2> d, v;
  for (std::size_t i = 0; i < 2; ++i) {
    d[i] = (u[i] - offset[i]) * inverse;
    v[i] = u_rate[i] * inverse_rate;
  }
  if (!(d[0].value * d[0].value + d[1].value * d[1].value < 1.0)) return std::nullopt;
  const std::pair<D, D> over_factor = std::visit(
      [&](const auto& l) {
        return std::pair<D, D>(
            l.force(d[0], d[1], D(spin * d[0] - 2.0 * v[1]), D(spin * d[1] + 2.0 * v[0])));
      },
      law);
  return std::array{factor * over_factor.first, factor * over_factor.second};
}

SlopedFilm sloped_film(const ContactSystem& system, std::size_t i, const NumberSlopes& slopes) {
  const auto number = [&](const auto& of) {
    return dual(of(system.films()[i]),
                slopes.of([&](const ContactSystem& s) { return of(s.films()[i]); }));
  };
  using F = ReducedFilm;
  SlopedFilm to;
  to.law = system.films()[i].law;
  for (const int k : {0, 1}) {
    to.offset[static_cast<std::size_t>(k)] = number([k](const F& f) { return f.offset(k); });
  }
  // the numbers that are polynomials of a parameter where others are, as in numbers_of
  to.inverse = number([](const F& f) { return 1.0 / f.clearance; });
  to.inverse_rate = number([](const F& f) { return 1.0 / f.clearance / f.rate; });
  to.factor = number([](const F& f) { return f.factor * f.rate; });
  to.spin = number([](const F& f) { return f.spin; });
  return to;
}

}  // namespace whirl::inline dyn
