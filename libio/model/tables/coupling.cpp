#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_connections.hpp"
#include "libio/model/read_parts.hpp"

namespace whirl::inline io {

namespace {

/// Each half of a coupling, a disk on its shaft.
struct Half {
  double m = 0.0, Id = 0.0, Ip = 0.0;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{optional("mass", &Half::m, "kg", nonnegative, "of each half, on its shaft"),
                      optional("diametral_inertia", &Half::Id, "kg.m^2", nonnegative, "likewise"),
                      optional("polar_inertia", &Half::Ip, "kg.m^2", nonnegative, "likewise")};
  }
};

/// How far one shaft is from the axis of the other one where the coupling is without force: that of
/// `from` less that of `to`.
struct Misfit {
  double offset = 0.0, angle = 0.0;     ///< displacement [m] and its direction from +x [rad]
  double tilt = 0.0, tilt_angle = 0.0;  ///< [rad] and the axis about which it is, from +x [rad]

  bool is_none() const { return offset == 0.0 && tilt == 0.0; }

  static constexpr auto fields() {
    using enum Range;
    using M = Misfit;
    return std::tuple{optional("offset", &M::offset, "m", nonnegative, "of the axes, across them"),
                      optional("angle", &M::angle, "rad", any, "of the offset, from +x to +y"),
                      optional("tilt", &M::tilt, "rad", nonnegative, "between the axes"),
                      optional("tilt_angle", &M::tilt_angle, "rad", any,
                               "of the axis that the tilt is about, from +x to +y")};
  }
};

/// Loads of a coupling: K d on `from` and its opposite on `to`.
class CouplingLoads {
 public:
  CouplingLoads(const Connection& coupling, double order, std::vector<Force>& to)
      : coupling_(coupling), order_(order), to_(to) {
    const BearingCoefficients c = coefficients(coupling.coefficients, 0.0);
    k_ = 0.5 * c.K.trace();
    kt_ = 0.5 * c.Kt.trace();
  }

  /// Of axes that do not meet: constant, in space.
  void add_constant(const Misfit& d) {
    add({.kind = ForceKind::force, .size = k_ * d.offset, .angle = d.angle});
    add({.kind = ForceKind::moment, .size = kt_ * d.tilt, .angle = d.tilt_angle});
  }
  /// Of bores that are off: they turn with the shafts.
  void add_turning(const Misfit& d) {
    add_orders(1.0, d.offset * k_, d.angle, d.tilt * kt_, d.tilt_angle);
  }
  /// Of axes that do not meet, by what of the stiffness turns with the shafts: K (d + e conj(d)
  /// e^(2 i phi)) in x + i y.
  void add_twice(const Misfit& d, double e) {
    add_orders(2.0, e * d.offset * k_, -d.angle, e * d.tilt * kt_, -d.tilt_angle);
  }

 private:
  void add_orders(double order, double force, double phase, double moment, double moment_phase) {
    const Turning turning = order_ < 0.0 ? Turning::backward : Turning::forward;
    const double orders = order * std::abs(order_);
    add({.kind = ForceKind::force,
         .size = force,
         .turning = turning,
         .order = orders,
         .phase = phase});
    add({.kind = ForceKind::moment,
         .size = moment,
         .turning = turning,
         .order = orders,
         .phase = moment_phase});
  }
  void add(Force force) {
    if (force.size == 0.0) return;
    const std::string what = fmt::format(
        "{} {}{}", coupling_.name, force.is_constant() ? "" : fmt::format("{:g}X ", force.order),
        force.kind == ForceKind::force ? "force" : "moment");
    force.at = coupling_.from;
    force.name = what + " 1";
    to_.push_back(force);
    force.at = coupling_.to;
    force.name = what + " 2";
    (force.is_constant() ? force.angle : force.phase) += std::numbers::pi;
    to_.push_back(force);
  }

  const Connection& coupling_;
  double order_;
  std::vector<Force>& to_;
  double k_ = 0.0, kt_ = 0.0;
};

/// Speed of what is at a station over that of the first shaft.
double ratio_at(const ModelReading& reading, const Station& station) {
  const Structure& s = reading.model.structure;
  const Body* body = reading.body_at(station);
  if (body && !body->spins) return 0.0;
  const auto shaft = s.shaft_named(body ? body->rotor : station.rotor);
  return shaft ? s.shafts()[static_cast<std::size_t>(*shaft)].ratio : 1.0;
}

/// What a coupling has beside its springs and dampers.
struct CouplingKeys {
  Half half;
  Misfit axes, bores;
  double turning_share = 0.0;  ///< of the stiffness
};

CouplingKeys read_keys(ModelReading& reading, TableReader& table, bool is_rigid) {
  CouplingKeys keys;
  table.read(keys.half);
  for (const auto& [key, misfit] :
       {std::pair("misalignment", &keys.axes), std::pair("runout", &keys.bores)}) {
    TableReader inner = reading.inner(table, key);
    inner.read(*misfit);
    inner.finish();
    if (!is_rigid || misfit->is_none()) continue;
    table.problem(key, "a rigid coupling has no stiffness that would say its loads");
    *misfit = {};
  }
  keys.turning_share = table.quantity("anisotropy", "", Range::nonnegative).value_or(0.0);
  if (keys.turning_share >= 1.0) table.problem("anisotropy", "expected less than 1");
  return keys;
}

/// Adds the halves as disks.
void add_halves(ModelReading& reading, TableReader& table, const Connection& coupling,
                const Half& half) {
  if (half.m == 0.0 && half.Id == 0.0 && half.Ip == 0.0) return;
  int number = 0;
  for (const Station* at : {&coupling.from, &coupling.to}) {
    if (at->kind == Station::Kind::body) {
      table.problem("mass", "a half is a disk on a shaft; give the body the mass instead");
      return;
    }
    reading.model.structure.disks.push_back(
        {.name = fmt::format("{} half {}", coupling.name, ++number),
         .at = *at,
         .m = half.m,
         .Id = half.Id,
         .Ip = half.Ip});
  }
}

void add_loads(ModelReading& reading, TableReader& table, const Connection& coupling,
               const CouplingKeys& keys) {
  const double ratio = ratio_at(reading, coupling.from), other = ratio_at(reading, coupling.to);
  if (std::isnan(ratio) || std::isnan(other)) {
    table.problem("to",
                  "one of the shafts has a speed of its own; expected ratios, as a coupling "
                  "makes them");
    return;
  }
  if (ratio != other) {
    table.problem("to",
                  fmt::format("the shafts turn with {:g} and {:g} times the speed of the first "
                              "shaft; expected the same speed, as a coupling makes it",
                              ratio, other));
    return;
  }
  for (const auto& [key, misfit] :
       {std::pair("misalignment", &keys.axes), std::pair("runout", &keys.bores)}) {
    if (misfit->tilt == 0.0) continue;
    for (const Station* at : {&coupling.from, &coupling.to}) need_tilts(reading, table, key, *at);
  }
  CouplingLoads loads(coupling, ratio, reading.model.structure.forces);
  loads.add_constant(keys.axes);
  loads.add_turning(keys.bores);
  loads.add_twice(keys.axes, keys.turning_share);
}

void read_couplings(ModelReading& reading) {
  reading.for_each("coupling", [&](TableReader& table, std::size_t i) {
    Connection c;
    c.where = table.where();
    c.name = table.string("name").value_or(fmt::format("coupling {}", i + 1));
    const auto from = station_at(reading, table, "from", false);
    const auto to = station_at(reading, table, "to", false);
    read_link_keys(reading, table, "coupling", c);
    const CouplingKeys keys = read_keys(reading, table, c.is_rigid);
    if (!from || !to) return;
    c.from = *from;
    c.to = *to;
    add_halves(reading, table, c, keys.half);
    add_loads(reading, table, c, keys);
    reading.model.structure.links.push_back(c);
  });
}

}  // namespace

ModelTable coupling_table() {
  return {
      .name = "coupling",
      .meaning = "couplings between two shafts, flexible or rigid, with their misalignment",
      .read = read_couplings,
      .example =
          "from = { at = 0 }\n"
          "to = \"b\"\n"
          "stiffness = 1\n",
      .bare = "misalignment = {}\nrunout = {}\n",
      .as_tables =
          "from = { at = 0 }\n"
          "to = { at = 1 }\n",
      .as_values =
          "from = \"b\"\n"
          "to = \"b\"\n",
      .notes = {{"from", "the end of one shaft: a table with a station, or the name of a body"},
                {"to", "that of the other shaft"},
                {"misalignment", "of the axes where the machines stand: it does not turn"},
                {"runout", "of the bores: it turns with the shafts"},
                {"anisotropy",
                 "share of the stiffness that turns with the shafts, for loads of twice the speed",
                 "0"}}};
}

}  // namespace whirl::inline io
