#include "libdyn/system/film_equilibrium.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>

#include "libbase/error.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/port_balance.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline dyn {

namespace {

/// The linear rotor as its journals feel it.
struct Ports {
  System system;
  HeldRotor held;  ///< by displacements of journals
};

/// Two places that a bearing holds together.
struct Held {
  Station at, against;
};

/// Rows of the displacements of the journals from their bearings.
Sparse journal_rows(const std::vector<Held>& bearings, const Assembler& assembler,
                    const DofMap& dofs) {
  std::vector<Triplet> entries;
  int row = 0;
  for (const Held& bearing : bearings) {
    for (const Component component : {X, Y}) {
      const Vec of = dofs.row(assembler.point(bearing.at), component) -
                     dofs.row(assembler.point(bearing.against), component);
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

Sparse chosen_rows(const Sparse& all, const std::vector<Eigen::Index>& chosen) {
  std::vector<Triplet> entries;
  for (std::size_t k = 0; k < chosen.size(); ++k) entries.emplace_back(k, chosen[k], 1.0);
  Sparse pick(std::ssize(chosen), all.rows());
  pick.setFromTriplets(entries.begin(), entries.end());
  return pick * all;
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

Ports ports_of(const std::vector<Held>& bearings, const Assembler& assembler, double Omega) {
  Ports p{.system = assembler.uncondensed(Omega, 0.0), .held = {}};
  const Sparse all = journal_rows(bearings, assembler, p.system.dofs);
  p.held.ports = independent_rows(Mat(all));  // two films may be at one station
  const Sparse U = chosen_rows(all, p.held.ports.chosen);
  const Eigen::Index n = p.system.size(), ports = U.rows();
  const Sparse K = p.system.stiffness();
  const double largest = K.coeffs().size() > 0 ? K.coeffs().abs().maxCoeff() : 0.0;
  const double s = largest > 0.0 ? largest : 1.0;
  const Sparse clamped = K + s * Sparse(U.transpose() * U);
  if (!is_supported(symmetric_part(clamped))) {
    throw ModelError(
        {}, "",
        "the rotor or a body is free to move, even where oil films and rolling bearings "
        "hold the journals: add a [[bearing]] or a [[link]] that holds it");
  }
  const SparseLu lu(held_matrix(K, U, s));
  if (!lu.is_regular()) throw NumericalError("the stiffness is singular at this speed");
  Mat wanted = Mat::Zero(n + ports, 1 + ports);
  wanted.col(0).head(n) = p.system.dofs.T.transpose() * static_load(assembler, Omega);
  wanted.bottomRightCorner(ports, ports).diagonal().setConstant(s);
  const Mat found = lu.solve(wanted);
  p.held.rest = found.col(0).head(n);
  p.held.shapes = found.topRightCorner(n, ports);
  p.held.R = -s * found.col(0).tail(ports);
  p.held.K = -s * found.bottomRightCorner(ports, ports);
  return p;
}

}  // namespace

struct FilmEquilibrium::State {
  Assembler assembler;
  bool is_load_steady;  ///< the static load is the same at all speeds
  std::vector<OilFilm> films;
  std::vector<Contact> rolling;  ///< bearings
  std::vector<Held> held;        ///< both, an element of a rolling bearing each
  std::mutex mutex{};
  std::shared_ptr<const Ports> ports{};  ///< of the last speed, if they depend on that
  std::shared_ptr<const RotorOnFilms> last{};
  struct Known {
    std::vector<BearingCoefficients> bearings;
    std::exception_ptr failure;  ///< why there are none
  };
  std::map<double, Known> known{};  ///< by speed [rad/s]

  explicit State(const Model& model)
      : assembler(model.structure), is_load_steady(is_static_load_steady(assembler)) {
    for (const OilFilm& film : model.films) {
      if (film.is_linearized) films.push_back(film);
    }
    for (const OilFilm& film : films) held.push_back({film.at, film.against});
    rolling = rolling_bearings(model.contacts);
    for (const Contact& bearing : rolling) {
      const auto elements = static_cast<std::size_t>(places_of(bearing.geometry));
      held.insert(held.end(), elements, {bearing.at, bearing.against});
    }
  }
  std::shared_ptr<const RotorOnFilms> found(double Omega);
};

std::shared_ptr<const RotorOnFilms> FilmEquilibrium::State::found(double Omega) {
  if (!ports || assembler.depends_on_speed() || !is_load_steady) {
    ports = std::make_shared<const Ports>(ports_of(held, assembler, Omega));
  }
  std::vector<FilmAtSpeed> at_this_speed;
  for (const OilFilm& film : films) {
    at_this_speed.push_back(at_speed(film, Omega, drag_speed(film, assembler, Omega)));
  }
  std::vector<ReducedContact> elements;
  for (const Contact& bearing : rolling) {
    for (ReducedContact& e : elements_of(bearing, part_speeds(bearing, assembler, Omega))) {
      elements.push_back(std::move(e));
    }
  }
  const auto place = PortBalance(ports->held, std::move(at_this_speed), std::move(elements)).find();
  if (!place) throw NumericalError(not_found_on_films(Omega));
  RotorOnFilms rotor{.Omega = Omega,
                     .system = ports->system,
                     .q = ports->held.rest + ports->held.shapes * place->w,
                     .load = static_load(assembler, Omega)};
  rotor.system.Omega = Omega;
  const auto carry = [&](const auto& bearing, const Vec2& load) {
    for (const int component : {X, Y}) {
      const int at = rotor.system.dofs.full_index(assembler.point(bearing.at), component);
      const int against = rotor.system.dofs.full_index(assembler.point(bearing.against), component);
      if (at >= 0) rotor.load(at) -= load(component);
      if (against >= 0) rotor.load(against) += load(component);
    }
  };
  for (std::size_t i = 0; i < films.size(); ++i) {
    rotor.films.push_back(
        running_film(films[i], Omega, place->journals[i], drag_speed(films[i], assembler, Omega)));
    carry(films[i], rotor.films.back().load);
  }
  std::size_t port = films.size();
  for (const Contact& bearing : rolling) {
    const Eigen::Index row = 2 * static_cast<Eigen::Index>(port);
    const Vec2 u = ports->held.ports.of.middleRows<2>(row) * place->w;
    rotor.rolling.push_back(running_bearing(bearing, u, part_speeds(bearing, assembler, Omega)));
    carry(bearing, rotor.rolling.back().load);
    port += static_cast<std::size_t>(places_of(bearing.geometry));
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
      known.bearings.push_back({.K = film.stiffness, .C = film.damping});
    }
    for (const RunningBearing& bearing : state_->last->rolling) {
      known.bearings.push_back({.K = bearing.stiffness, .C = Mat2::Zero()});
    }
  }
  return known.bearings;
}

bool has_linear_films(const Model& model) {
  return std::any_of(model.films.begin(), model.films.end(),
                     [](const OilFilm& film) { return film.is_linearized; });
}

bool has_working_point(const Model& model) {
  return has_linear_films(model) ||
         std::any_of(model.contacts.begin(), model.contacts.end(), is_rolling_bearing);
}

Structure linear_structure(const Model& model) {
  Structure structure = model.structure;
  if (!has_working_point(model)) return structure;
  const auto equilibrium = std::make_shared<const FilmEquilibrium>(model);
  const auto add = [&](std::string_view kind, const auto& bearing) {
    const std::size_t number = structure.linearized.size();
    const auto at = [equilibrium, number](double Omega, double /*omega*/) {
      return equilibrium->coefficients(Omega)[number];
    };
    structure.linearized.push_back({bearing.name, bearing.at, bearing.against, at, kind});
  };
  for (const OilFilm& film : model.films) {
    if (film.is_linearized) add("oil film", film);
  }
  for (const Contact& bearing : rolling_bearings(model.contacts)) add("rolling bearing", bearing);
  return structure;
}

System linear_system(const Model& model, const Scene& scene) {
  if (!has_working_point(model)) return scene.system;
  return Assembler(linear_structure(model)).at(model.speed);
}

Modes linear_modes(const Model& model, const Scene& scene, int count) {
  if (!scene.assembler.depends_on_whirl()) return complex_modes(linear_system(model, scene), count);
  return complex_modes(Assembler(linear_structure(model)), model.speed, count);
}

}  // namespace whirl::inline dyn
