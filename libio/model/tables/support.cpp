#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "libbase/numerics/dense.hpp"
#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"
#include "libio/model/read_laws.hpp"
#include "libio/model/read_matrices.hpp"
#include "libio/model/read_parts.hpp"
#include "libio/model/response_table.hpp"

namespace whirl::inline io {

namespace {

/// Springs, dampers and masses beside the law, and what this is.
struct SupportKeys {
  TransferForm form = TransferForm::dynamic_stiffness;
  double stiffness = 0.0, damping = 0.0, mass = 0.0;

  static constexpr auto fields() {
    using enum Range;
    using S = SupportKeys;
    return std::tuple{
        optional("form", &S::form, "", any,
                 "what numerator and denominator, or poles and residues, are"),
        optional("stiffness", &S::stiffness, "N/m", any, "beside the law, of every coordinate"),
        optional("damping", &S::damping, "N.s/m", any, "beside the law, of every coordinate"),
        optional("mass", &S::mass, "kg", any, "beside the law, of every coordinate")};
  }
};

/// A list of coordinates, each with a station and a direction.
/// @param rows  receives the rows of matrices that they are; null: not asked for
std::vector<InterfaceCoordinate> coordinates_at(ModelReading& reading, TableReader& table,
                                                const char* key, std::vector<long>* rows) {
  std::vector<InterfaceCoordinate> coordinates;
  reading.for_each_item(table, key, "a list of { at = ..., angle = ... }", [&](TableReader& item) {
    const auto at = reading.station(item);
    const Station to = other_side(reading, item, at);
    const auto angle = item.quantity("angle", "rad", Range::any, true);
    const auto row = rows ? item.integer("row", Range::positive) : std::nullopt;
    if (rows) rows->push_back(row.value_or(0));
    if (at && angle) coordinates.push_back(interface_along(*at, to, *angle));
  });
  return coordinates;
}

/// The coordinates that a support acts on; both of its station where no angle is told.
std::vector<InterfaceCoordinate> read_interface(ModelReading& reading, TableReader& table,
                                                std::vector<long>& rows) {
  const auto coordinates = coordinates_at(reading, table, "interface", &rows);
  if (const ConfigNode* list = table.node("interface")) {
    if (list->items.empty()) table.problem("interface", "expected one coordinate or more");
    for (const char* key : {"at", "node", "body", "to", "angle"}) {
      if (table.node(key)) table.problem(key, "belongs into the entries of interface");
    }
    return coordinates;
  }
  const auto at = reading.station(table, {"interface"});
  const Station to = other_side(reading, table, at);
  const auto angle = table.quantity("angle", "rad", Range::any);
  if (!at) return {};
  if (angle) return {interface_along(*at, to, *angle)};
  return {interface_along(*at, to, 0.0), interface_along(*at, to, 0.5 * std::numbers::pi)};
}

/// The law that is fitted to a table of a response.
std::optional<StateSpace> law_of_response(ModelReading& reading, TableReader& table,
                                          std::size_t item, const SupportKeys& keys,
                                          Support& support) {
  FitOptions how;
  if (const auto order = table.integer("order", Range::positive)) {
    how.order = static_cast<int>(*order);
    table.at_most("order", *order, most_fit_order);
  }
  how.tolerance = table.quantity("tolerance", "", Range::positive).value_or(how.tolerance);
  // a law of one displacement is that of both directions
  const int ports = table.has("interface") ? static_cast<int>(support.sees.size()) : 1;
  const ForeignTable wanted{
      ForeignTable::Kind::response, ports,
      table.has("form") ? std::optional(keys.form) : std::optional<TransferForm>()};
  const auto from =
      reading.text_of(table, "response", "support", item, response_columns_named_in, &wanted);
  if (!from) {
    for (const char* key : {"order", "tolerance"}) {
      if (table.has(key) && !table.has("response"))
        table.problem(key, "belongs to a response, which is missing");
    }
    return std::nullopt;
  }
  if (has_law(table)) return std::nullopt;  // which is reported
  std::vector<Problem> wrong;
  const MeasuredStiffness response =
      parse_response_table(from->text, from->name, keys.form, ports, wrong, &reading.doubts);
  reading.add_problems(wrong);
  if (!wrong.empty()) return std::nullopt;
  try {
    LawFit fit;
    const StateSpace law = fitted_law(response, how, fit);
    if (how.order == 0 && fit.error > how.tolerance) {
      reading.doubts.push_back(
          {table.where("response"), table.path("response"),
           fmt::format("no law of up to {} poles fits it to {:g}: the best one leaves {:.2g}",
                       fit.poles, how.tolerance, fit.error)});
    }
    support.fit = fit;
    reading.file_tables.back().fitted = FittedLaw{support.name, response, law, fit};
    return law;
  } catch (const NumericalError& error) {
    table.problem("response", error.what());
    return std::nullopt;
  }
}

/// What the law of one displacement is for all coordinates; the law itself where it has several.
/// Whether it goes with the coordinates; if not, this is reported.
bool spread(StateSpace& law, const Support& support, TableReader& table) {
  const auto takes = static_cast<int>(support.sees.size());
  const auto gives = static_cast<int>(support.acts_on.size());
  if (law.inputs() == 1 && law.outputs() == 1 && takes == gives) law = law.repeated(gives);
  if (law.inputs() == takes && law.outputs() == gives) return true;
  table.problem(table.has("A")             ? "A"
                : table.has("state_space") ? "state_space"
                : table.has("poles")       ? "residues"
                                           : "numerator",
                fmt::format("the law has {} displacements and {} forces, expected {} and {}: the "
                            "coordinates of the support",
                            law.inputs(), law.outputs(), takes, gives));
  return false;
}

/// Adds springs, dampers and masses beside a law.
void add_beside(StateSpace& law, const SupportKeys& keys) {
  const auto add = [&](Mat& D, double value) {
    if (value == 0.0) return;
    if (D.size() == 0) D = Mat::Zero(law.outputs(), law.inputs());
    D.diagonal().array() += value;
  };
  add(law.D, keys.stiffness);
  add(law.D_rate, keys.damping);
  add(law.D_inertia, keys.mass);
}

/// Reports a support without a law, or with two.
void check_one_law(TableReader& table) {
  const bool has_matrices = table.has("stiffness_matrix") || table.has("mass_matrix");
  const int laws = has_law(table) + table.has("response") + has_matrices;
  if (laws > 1) {
    table.problem(table.has("response") ? "response" : "stiffness_matrix",
                  "found two laws, expected one");
  } else if (laws == 0) {
    table.missing(
        "numerator",
        "a law: numerator and denominator, poles and residues, A, B, C and D, a state_space, "
        "a response, or matrices",
        {"poles", "A", "D", "state_space", "response", "stiffness_matrix"});
  }
  const bool takes_form = table.has("numerator") || table.has("poles") || table.has("response");
  if (table.has("form") && laws == 1 && !takes_form) {
    table.problem("form", "belongs to numerator and denominator, poles and residues or a response");
  }
  if (table.has("sensors") && has_matrices) {
    table.problem("sensors", "belongs to a controller: a casing is moved where it stands");
  }
}

void read_dynamic_supports(ModelReading& reading) {
  reading.for_each("support", [&](TableReader& table, std::size_t i) {
    Support support;
    support.where = table.where();
    support.name = table.string("name").value_or(fmt::format("support {}", i + 1));
    std::vector<long> matrix_rows;
    support.sees = support.acts_on = read_interface(reading, table, matrix_rows);
    const auto sensors = coordinates_at(reading, table, "sensors", nullptr);
    if (!sensors.empty()) {
      support.sees = sensors;
      support.sensors = static_cast<int>(sensors.size());
    }
    SupportKeys keys;
    table.read(keys);
    auto law = read_law(reading, table, {"support", i}, keys.form);
    if (const auto fitted = law_of_response(reading, table, i, keys, support)) law = fitted;
    const auto casing = read_matrices(reading, table, i, matrix_rows);
    check_one_law(table);
    if (support.sees.empty() || support.acts_on.empty()) return;
    if (casing) {
      set_law(support, *casing);
      add_beside(support.law, keys);
      support.coordinates->D.diagonal().array() += keys.stiffness;
      reading.model.structure.supports.push_back(std::move(support));
      return;
    }
    if (!law) return;
    if (!spread(*law, support, table)) return;
    if (support.sensors == 0 && law->states() > 0 && eigenvalues(law->A).real().maxCoeff() > 0.0) {
      reading.doubts.push_back({table.where(), table.path("poles"),
                                "a pole has a real part above zero: a support that feeds energy "
                                "to what it carries"});
    }
    add_beside(*law, keys);
    support.law = std::move(*law);
    reading.model.structure.supports.push_back(std::move(support));
  });
}

}  // namespace

ModelTable support_table() {
  return {
      .name = "support",
      .meaning = "supports with a dynamic stiffness: pedestals, foundations, casings",
      .read = read_dynamic_supports,
      .example =
          "body = \"b\"\n"
          "numerator = [4e6, 5e8, 4e12]\n"
          "denominator = [4, 500, 5e6]\n",
      .as_tables = "interface = [{}]\nsensors = [{}]\n",
      .notes = {
          {"interface", "the coordinates, where the law is one of several"},
          {"interface.[].angle", "direction of the coordinate, from +x to +y"},
          {"interface.[].row", "of matrices: which coordinate of theirs it is, from 1"},
          {"mass_matrix", "file in MatrixMarket's form, beside the model: of a casing, symmetric"},
          {"stiffness_matrix", "likewise"},
          {"damping_matrix", "likewise; left out: none"},
          {"modes", "of the casing with its interface held, the lowest ones; left out: 20"},
          {"sensors",
           "displacements that the law takes, where they are not the coordinates it "
           "acts on: of a controller"},
          {"sensors.[].angle", "direction of the displacement, from +x to +y"},
          {"angle", "direction of the only coordinate, from +x to +y; left out: x and y"},
          {"numerator", "coefficients of powers of s in rad/s, of the highest one first"},
          {"denominator", "likewise"},
          {"poles", "rows [real part, imaginary part] in rad/s, one of every conjugate pair"},
          {"residues",
           "a row [real part, imaginary part] for each pole; of several coordinates "
           "with both parts of every entry of the matrix, row by row"},
          {"A", "z' = A z + B u, with the displacements u of the coordinates"},
          {"B", "of the states, a column for each coordinate"},
          {"C", "f = C z + D u, forces that the support sets against the motion"},
          {"D", "left out: zero"},
          {"state_space", "file with the matrices A, B, C and D, beside the model"},
          {"response", "file with a frequency response, beside the model, that a law is fitted to"},
          {"order", "number of poles of the fitted law; left out: as many as the tolerance needs"},
          {"tolerance", "of the fit: root mean square, relative", "0.001"}}};
}

}  // namespace whirl::inline io
