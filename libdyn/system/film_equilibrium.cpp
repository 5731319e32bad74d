#include "libdyn/system/film_equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <optional>

#include "libbase/constants.hpp"
#include "libbase/error.hpp"
#include "libbase/newton.hpp"
#include "libbase/sparse_lu.hpp"
#include "libfe/eigen/symmetric.hpp"
#include "libfe/forces.hpp"

namespace whirl::inline dyn {

namespace {

/// The linear rotor as its journals feel it, at displacements u of all of them, (x, y) one after the
/// other: it takes the forces R + K u to hold them there, and the rotor is at q = rest + shapes u.
struct Ports {
  System system;
  Vec rest;
  Mat shapes;
  Vec R;  ///< [N]
  Mat K;  ///< [N/m]
};

/// Rows of the displacements of the journals from their bearings.
Sparse journal_rows(const std::vector<OilFilm>& films, const Assembler& assembler,
                    const DofMap& dofs) {
  std::vector<Triplet> entries;
  int row = 0;
  for (const OilFilm& film : films) {
    for (const Component component : {X, Y}) {
      const Vec of = dofs.row(assembler.point(film.at), component) -
                     dofs.row(assembler.point(film.against), component);
      for (int j = 0; j < of.size(); ++j) {
        if (of(j) != 0.0) entries.emplace_back(row, j, of(j));
      }
      ++row;
    }
  }
  Sparse U(row, dofs.size());
  U.setFromTriplets(entries.begin(), entries.end());
  return U;
}

/// [K  s U^T; s U  0], with s of the size of K.
Sparse held_matrix(const Sparse& K, const Sparse& U, double s) {
  const int n = static_cast<int>(K.rows());
  std::vector<Triplet> entries;
  for (int j = 0; j < n; ++j) {
    for (Sparse::InnerIterator it(K, j); it; ++it) entries.emplace_back(it.row(), j, it.value());
    for (Sparse::InnerIterator it(U, j); it; ++it) {
      const int row = n + static_cast<int>(it.row());
      entries.emplace_back(row, j, s * it.value());
      entries.emplace_back(j, row, s * it.value());
    }
  }
  const int size = n + static_cast<int>(U.rows());
  Sparse held(size, size);
  held.setFromTriplets(entries.begin(), entries.end());
  return held;
}

Ports ports_of(const std::vector<OilFilm>& films, const Assembler& assembler, double Omega) {
  Ports p{.system = assembler.uncondensed(Omega)};
  const Sparse U = journal_rows(films, assembler, p.system.dofs);
  const Eigen::Index n = p.system.size(), ports = U.rows();
  const double largest =
      p.system.K.coeffs().size() > 0 ? p.system.K.coeffs().abs().maxCoeff() : 0.0;
  const double s = largest > 0.0 ? largest : 1.0;
  const Sparse clamped = p.system.K + s * Sparse(U.transpose() * U);
  if (!is_supported(symmetric_part(clamped))) {
    throw ModelError({}, "",
                     "the rotor or a body is free to move, even where oil films hold the journals: "
                     "add a [[bearing]] or a [[link]] that holds it");
  }
  const SparseLu lu(held_matrix(p.system.K, U, s));
  if (!lu.is_regular()) throw NumericalError("the stiffness is singular at this speed");
  Mat wanted = Mat::Zero(n + ports, 1 + ports);
  wanted.col(0).head(n) = p.system.dofs.T.transpose() * static_load(assembler);
  wanted.bottomRightCorner(ports, ports).diagonal().setConstant(s);
  const Mat found = lu.solve(wanted);
  p.rest = found.col(0).head(n);
  p.shapes = found.topRightCorner(n, ports);
  p.R = -s * found.col(0).tail(ports);
  p.K = -s * found.bottomRightCorner(ports, ports);
  return p;
}

/// The balance of the journals, over displacements x from the middles of their bearings in clearances.
class JournalBalance {
 public:
  JournalBalance(const Ports& ports, const std::vector<OilFilm>& films, double Omega)
      : ports_(ports), scale_(ports.R.size()), middle_(ports.R.size()) {
    for (std::size_t i = 0; i < films.size(); ++i) {
      films_.push_back(at_speed(films[i], Omega));
      films_.back().offset.setZero();  // an offset would cost digits near the wall
      scale_.segment<2>(start(i)).setConstant(films_[i].clearance);
      middle_.segment<2>(start(i)) = films[i].offset;
    }
    load_ = ports.R + ports.K * middle_;
    const double size = load_.cwiseAbs().maxCoeff();
    size_ = size > 0.0 ? size : 1.0;
  }

  /// Displacements of the journals from their middles, and from their bearings [m].
  Vec places(const Vec& x) const { return scale_.cwiseProduct(x); }
  Vec displacement(const Vec& x) const { return middle_ + places(x); }

  /// Where every film alone carries the load that it has with all journals in the middle.
  std::optional<Vec> shared() const {
    Vec x(load_.size());
    for (std::size_t i = 0; i < films_.size(); ++i) {
      const auto u = place_under(films_[i], -load_.segment<2>(start(i)));
      if (!u) return std::nullopt;
      x.segment<2>(start(i)) = *u / films_[i].clearance;
    }
    return x;
  }

  /// Where all films together carry a share of the load, from a place nearby.
  std::optional<Vec> solve(const Vec& from, double share) const {
    At at = look(from, share);
    const auto step = [](const At& here) { return newton_step(here.J, here.r); };
    const auto moved = [&](const At& here, const Vec& dx) { return look(here.x - dx, share); };
    const NewtonSearch search = newton(
        at, step, moved, {.most_steps = 60, .accurate = 1e-12, .most_halvings = 20, .worse = 1.0});
    return search.has_converged() ? std::optional(at.x) : std::nullopt;
  }

  /// The load put on little by little.
  std::optional<Vec> loaded_slowly() const {
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

 private:
  struct At {
    Vec x;
    double residual = std::numeric_limits<double>::infinity();
    Vec r;
    Mat J;
  };
  static Eigen::Index start(std::size_t film) { return 2 * static_cast<Eigen::Index>(film); }

  At look(const Vec& x, double share) const {
    At at{.x = x};
    at.r = share * load_ + ports_.K * scale_.cwiseProduct(x);
    at.J = ports_.K * scale_.asDiagonal();
    for (std::size_t i = 0; i < films_.size(); ++i) {
      const Vec2 place = films_[i].clearance * x.segment<2>(start(i));
      const auto film = film_slopes(films_[i], place, Vec2::Zero());
      if (!film) return at;
      at.r.segment<2>(start(i)) -= film->force;
      at.J.block<2, 2>(start(i), start(i)) -= films_[i].clearance * film->by_u;
    }
    at.residual = at.r.cwiseAbs().maxCoeff() / size_;
    return at;
  }

  const Ports& ports_;
  std::vector<FilmAtSpeed> films_;
  Vec scale_, middle_, load_;
  double size_ = 1.0;
};

}  // namespace

struct FilmEquilibrium::State {
  Assembler assembler;
  std::vector<OilFilm> films;
  std::mutex mutex{};
  std::shared_ptr<const Ports> ports{};  ///< of the last speed, if they depend on that
  std::shared_ptr<const RotorOnFilms> last{};
  struct Known {
    std::vector<BearingCoefficients> films;
    std::exception_ptr failure;  ///< why there are none
  };
  std::map<double, Known> known{};  ///< by speed [rad/s]

  explicit State(const Model& model) : assembler(model.structure) {
    for (const OilFilm& film : model.films) {
      if (film.is_linearized) films.push_back(film);
    }
  }
  std::shared_ptr<const RotorOnFilms> found(double Omega);
};

std::shared_ptr<const RotorOnFilms> FilmEquilibrium::State::found(double Omega) {
  if (!ports || assembler.depends_on_speed()) {
    ports = std::make_shared<const Ports>(ports_of(films, assembler, Omega));
  }
  const JournalBalance balance(*ports, films, Omega);
  std::optional<Vec> x;
  if (const auto guess = balance.shared()) x = balance.solve(*guess, 1.0);
  if (!x) x = balance.loaded_slowly();
  if (!x) {
    throw NumericalError(
        fmt::format("the equilibrium of the rotor on its oil films was not found at {:.6g} rpm{}",
                    Omega / rpm, Omega == 0.0 ? ": without speed a film carries nothing" : ""));
  }
  const Vec u = balance.displacement(*x), places = balance.places(*x);
  RotorOnFilms rotor{.Omega = Omega,
                     .system = ports->system,
                     .q = ports->rest + ports->shapes * u,
                     .load = static_load(assembler)};
  rotor.system.Omega = Omega;
  for (std::size_t i = 0; i < films.size(); ++i) {
    const Vec2 place = places.segment<2>(2 * static_cast<Eigen::Index>(i));
    rotor.films.push_back(running_film(films[i], Omega, place));
    for (const int component : {X, Y}) {
      const double force = -rotor.films.back().load(component);
      const int at = rotor.system.dofs.full_index(assembler.point(films[i].at), component);
      const int against =
          rotor.system.dofs.full_index(assembler.point(films[i].against), component);
      if (at >= 0) rotor.load(at) += force;
      if (against >= 0) rotor.load(against) -= force;
    }
  }
  return std::make_shared<const RotorOnFilms>(std::move(rotor));
}

FilmEquilibrium::FilmEquilibrium(const Model& model) : state_(std::make_unique<State>(model)) {}
FilmEquilibrium::~FilmEquilibrium() = default;

std::shared_ptr<const RotorOnFilms> FilmEquilibrium::at(double Omega) const {
  const std::lock_guard lock(state_->mutex);
  if (!state_->last || state_->last->Omega != Omega) state_->last = state_->found(Omega);
  return state_->last;
}

const std::vector<BearingCoefficients>& FilmEquilibrium::coefficients(double Omega) const {
  const std::lock_guard lock(state_->mutex);
  const auto [at, is_new] = state_->known.try_emplace(Omega);
  State::Known& known = at->second;
  try {
    if (is_new && !(state_->last && state_->last->Omega == Omega)) {
      state_->last = state_->found(Omega);
    }
  } catch (const std::exception&) {
    known.failure = std::current_exception();
  } catch (...) {  // left at an interruption_point
    state_->known.erase(at);
    throw;
  }
  if (known.failure) std::rethrow_exception(known.failure);
  if (is_new) {
    for (const RunningFilm& film : state_->last->films) {
      known.films.push_back({.K = film.stiffness, .C = film.damping});
    }
  }
  return known.films;
}

bool has_linear_films(const Model& model) {
  return std::any_of(model.films.begin(), model.films.end(),
                     [](const OilFilm& film) { return film.is_linearized; });
}

Structure linear_structure(const Model& model) {
  Structure structure = model.structure;
  if (!has_linear_films(model)) return structure;
  const auto equilibrium = std::make_shared<const FilmEquilibrium>(model);
  for (const OilFilm& film : model.films) {
    if (!film.is_linearized) continue;
    const std::size_t number = structure.linearized.size();
    const auto at = [equilibrium, number](double Omega, double /*omega*/) {
      return equilibrium->coefficients(Omega)[number];
    };
    structure.linearized.push_back({film.name, film.at, film.against, at});
  }
  return structure;
}

System linear_system(const Model& model, const Scene& scene) {
  if (!has_linear_films(model)) return scene.system;
  return Assembler(linear_structure(model)).at(model.speed);
}

Modes linear_modes(const Model& model, const Scene& scene, int count) {
  if (!scene.assembler.depends_on_whirl()) return complex_modes(linear_system(model, scene), count);
  return complex_modes(Assembler(linear_structure(model)), model.speed, count);
}

}  // namespace whirl::inline dyn
