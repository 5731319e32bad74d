#include "libdyn/system/port_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/newton.hpp"
#include "libdyn/system/running_bearing.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double dependent = 1e-9;  ///< of a row, what the rows before it leave of it

/// About where the inner ring of a bearing is under a load: where the first element would be as
/// deep as all of them together carry, about a quarter of them.
Vec2 place_on_elements(const ReducedContact& element, const Vec2& load) {
  const geometry::RollingElements& row = *rolling_elements(element.geometry);
  if (!(load.norm() > 0.0)) return element.offset;
  const double most = 4.37 * load.norm() / row.elements;  // Stribeck's number, of an element
  double depth = 1e-9;
  while (normal_force(element.law, depth, 0.0) < most && depth < 1.0) depth *= 1.25;
  return element.offset + load.normalized() * std::max(depth + row.play, 0.0);
}

}  // namespace

IndependentRows independent_rows(const Mat& rows) {
  IndependentRows found;
  Mat Q(rows.cols(), 0);  // orthonormal columns that span the chosen rows
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    Vec left = rows.row(i).transpose();
    for (int twice = 0; twice < 2; ++twice) left -= Q * (Q.transpose() * left);
    if (!(left.norm() > dependent * rows.row(i).norm())) continue;
    found.chosen.push_back(i);
    Q.conservativeResize(Eigen::NoChange, Q.cols() + 1);
    Q.rightCols(1) = left.normalized();
  }
  const auto count = std::ssize(found.chosen);
  found.of = Mat::Zero(rows.rows(), count);
  Mat W(count, rows.cols());
  for (Eigen::Index k = 0; k < count; ++k) {
    W.row(k) = rows.row(found.chosen[static_cast<std::size_t>(k)]);
  }
  for (Eigen::Index i = 0, k = 0; i < rows.rows(); ++i) {
    if (k < count && found.chosen[static_cast<std::size_t>(k)] == i) {
      found.of(i, k++) = 1.0;
    } else if (count > 0) {
      found.of.row(i) = least_squares(W.transpose(), rows.row(i).transpose()).transpose();
    }
  }
  return found;
}

struct PortBalance::At {
  Vec x;
  double residual = std::numeric_limits<double>::infinity();
  Vec r;
  Mat J;
};

PortBalance::PortBalance(const HeldRotor& rotor, std::vector<FilmAtSpeed> films,
                         std::vector<ReducedContact> contacts)
    : rotor_(rotor),
      ports_(rotor.ports.of),
      films_(std::move(films)),
      contacts_(std::move(contacts)),
      scale_(rotor.R.size()),
      middle_(Vec::Zero(rotor.R.size())) {
  Vec clearance(ports_.rows()), offset(ports_.rows());
  Eigen::Index row = 0;
  for (FilmAtSpeed& film : films_) {
    clearance.segment<2>(row).setConstant(film.clearance);
    offset.segment<2>(row) = std::exchange(film.offset, Vec2::Zero());
    row += 2;
  }
  for (const ReducedContact& c : contacts_) {
    clearance.segment<2>(row).setConstant(c.clearance);
    offset.segment<2>(row) = c.offset;
    row += 2;
  }
  for (Eigen::Index k = 0; k < scale_.size(); ++k) {
    const Eigen::Index own = rotor.ports.chosen[static_cast<std::size_t>(k)];
    scale_(k) = clearance(own) > 0.0 ? clearance(own) : 1.0;
    if (own < 2 * std::ssize(films_)) middle_(k) = offset(own);
  }
  away_ = ports_ * middle_ - offset;
  load_ = rotor.R + rotor.K * middle_;
  const double size = load_.lpNorm<Eigen::Infinity>();  // 0 without ports
  size_ = size > 0.0 ? size : 1.0;
}

Vec2 PortBalance::port(std::size_t i, const Vec& x) const {
  const auto row = 2 * static_cast<Eigen::Index>(i);
  return away_.segment<2>(row) + ports_.middleRows<2>(row) * scale_.cwiseProduct(x);
}

PortBalance::Place PortBalance::place(const Vec& x) const {
  Place found{.w = middle_ + scale_.cwiseProduct(x), .journals = {}};
  for (std::size_t i = 0; i < films_.size(); ++i) found.journals.push_back(port(i, x));
  return found;
}

std::optional<PortBalance::Place> PortBalance::find() const {
  std::optional<Vec> x;
  if (const auto guess = shared()) x = solve(*guess, 1.0);
  if (!x) x = loaded_slowly();
  return x ? std::optional(place(*x)) : std::nullopt;
}

std::optional<PortBalance::Place> PortBalance::find(const Vec& w) const {
  std::optional<Vec> x = solve((w - middle_).cwiseQuotient(scale_), 1.0);
  if (!x) x = loaded_slowly();
  return x ? std::optional(place(*x)) : std::nullopt;
}

/// Where every film and every rolling bearing alone carries the load that it has with all journals
/// in the middle.
std::optional<Vec> PortBalance::shared() const {
  Vec x = Vec::Zero(load_.size());
  for (std::size_t k = 0; k < rotor_.ports.chosen.size(); ++k) {
    const auto own = static_cast<std::size_t>(rotor_.ports.chosen[k]), port = own / 2;
    const auto P = ports_.middleRows<2>(2 * static_cast<Eigen::Index>(port));
    std::optional<Vec2> u;
    if (port >= films_.size()) {
      const ReducedContact& contact = contacts_[port - films_.size()];
      if (!rolling_elements(contact.geometry)) continue;
      u = place_on_elements(contact, -(P * load_));
    } else {
      if (films_[port].spin == 0.0) continue;  // it carries nothing
      u = place_under(films_[port], -(P * load_));
    }
    if (!u) return std::nullopt;
    const auto at = static_cast<Eigen::Index>(k);
    x(at) = (*u)(static_cast<Eigen::Index>(own % 2)) / scale_(at);
  }
  return x;
}

/// Where all together carry a share of the load, from a place nearby.
std::optional<Vec> PortBalance::solve(const Vec& from, double share) const {
  At at = look(from, share);
  // a ball that carries alone lets the rotor move across it: the shortest step leaves it there
  const auto step = [](const At& here) -> std::optional<Vec> {
    if (auto found = newton_step(here.J, here.r)) return found;
    return least_squares(here.J, here.r);
  };
  const auto moved = [&](const At& here, const Vec& dx) { return look(here.x - dx, share); };
  const NewtonSearch search = newton(
      at, step, moved, {.most_steps = 60, .accurate = 1e-12, .most_halvings = 20, .worse = 1.0});
  return search.has_converged() ? std::optional(at.x) : std::nullopt;
}

std::optional<Vec> PortBalance::loaded_slowly() const {
  Vec x = Vec::Zero(load_.size());
  double share = 0.0;
  for (double step = 0.1; step > 1e-6;) {
    const double next = std::min(1.0, share + step);
    if (const auto found = solve(x, next)) {
      if (next == 1.0) return found;
      x = *found, share = next, step *= 2.0;
    } else {
      step *= 0.5;
    }
  }
  return std::nullopt;
}

void PortBalance::add(At& at, std::size_t port, const Vec2& force, const Mat2& by_u) const {
  const auto P = ports_.middleRows<2>(2 * static_cast<Eigen::Index>(port));
  at.r -= P.transpose() * force;
  at.J -= P.transpose() * by_u * P * scale_.asDiagonal();
}

PortBalance::At PortBalance::look(const Vec& x, double share) const {
  At at{.x = x, .r = {}, .J = {}};
  at.r = share * load_ + rotor_.K * scale_.cwiseProduct(x);
  at.J = rotor_.K * scale_.asDiagonal();
  for (std::size_t i = 0; i < films_.size(); ++i) {
    const auto film = film_slopes(films_[i], port(i, x), Vec2::Zero());
    if (!film) return at;
    add(at, i, film->force, film->by_u);
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const std::size_t number = films_.size() + i;
    const RestingPush push = resting_push(contacts_[i], port(number, x));
    add(at, number, push.force, push.by_u);
  }
  at.residual = at.r.size() > 0 ? at.r.cwiseAbs().maxCoeff() / size_ : 0.0;
  return at;
}

std::string not_found_on_films(double Omega) {
  return fmt::format(
      "the equilibrium of the rotor on its oil films or rolling bearings was not found at {:.6g} "
      "rpm{}",
      Omega / rpm, Omega == 0.0 ? ": without speed a film carries nothing" : "");
}

}  // namespace whirl::inline dyn
