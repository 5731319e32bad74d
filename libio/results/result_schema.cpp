#include "libio/results/result_schema.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace whirl {

namespace {

using enum ObjectKind;

constexpr double largest = std::numeric_limits<double>::max();
constexpr ValidValues any{};
constexpr ValidValues finite{-largest, largest, false};
constexpr ValidValues nonnegative{0.0, largest, false};
constexpr ValidValues positive{std::numeric_limits<double>::denorm_min(), largest, false};

constexpr ValidValues from_to(double least, double most) {
  return {least, most, false};
}
/// Numbers of the elements of a dimension, from 1.
constexpr ValidValues numbers_of(std::string_view dimension) {
  return {1.0, largest, false, dimension};
}

constexpr double most_samples = 1e9;      ///< of a revolution
constexpr double most_revolutions = 1e9;  ///< of a period
constexpr double most_order = 1e6;        ///< of a critical speed, of a resonance

/// Columns that every study of many points has; a point is -1 or NaN where it failed.
ResultSet classified(std::string_view group, std::vector<ResultEntry> more) {
  static std::vector<std::unique_ptr<std::string>> texts;  // paths outlive the views of them
  const auto path = [&](std::string_view name) -> std::string_view {
    return *texts.emplace_back(std::make_unique<std::string>(fmt::format("{}/{}", group, name)));
  };
  ResultSet set{{{path("motion"), integer, "point", from_to(-1.0, 5.0)},
                 {path("period"), integer, "point"},
                 {path("is_proven"), integer, "point", from_to(-1.0, 1.0)},
                 {path("transient"), integer, "point"},
                 {path("revolutions"), integer, "point"},
                 {path("resolution"), real, "point"},
                 {path("section_dimension"), real, "point"},
                 {path("settles_after"), integer, "point", any, true},
                 {path("exponent"), real, "point exponents+"},
                 {path("regime"), integer, "point contacts", from_to(-1.0, 2.0)},
                 {path("duty"), real, "point contacts"},
                 {path("impacts_per_rev"), real, "point contacts"},
                 {path("sticking"), real, "point contacts"},
                 {path("max_normal"), real, "point contacts"},
                 {path("max_tangential"), real, "point contacts"},
                 {path("contact"), text, "contacts", any, true},
                 {path("done"), integer, "point", from_to(0.0, 1.0), true}}};
  set.entries.insert(set.entries.end(), more.begin(), more.end());
  return set;
}

std::vector<ResultSet> make_schema() {
  return {
      {{{"/model", text, "1"}}},
      {{{"/arguments", text, "words+"}}},
      {{{"/call@verb", text, ""}, {"/call@file", text, ""}}},
      {{{"/call/word", text, "call_words"}}},
      {{{"/call/set", text, "call_sets"}}},
      {{{"/call/option", text, "call_options"}}},
      {{{"/from/displacement", real, "full", finite},
        {"/from/velocity", real, "full", finite},
        {"/from@phase", real, "", finite}}},
      {{{"/points/z", real, "nodes+", finite}, {"/points/node_name", text, "nodes"}}},
      {{{"/points/body_name", text, "bodies+"}}},
      // motions
      {{{"/trajectory/end_displacement", real, "full"},
        {"/trajectory/end_velocity", real, "full"},
        {"/trajectory@end_phase", real, "", finite}}},
      {{{"/trajectory@samples_per_revolution", real, "", from_to(1.0, most_samples)},
        {"/trajectory@revolutions", real, "", nonnegative},
        {"/trajectory@period", real, "", nonnegative},
        {"/trajectory@steps", real, ""},
        {"/trajectory@evaluations", real, ""},
        {"/trajectory@events", real, ""}}},
      {{{"/trajectory/time", real, "samples+", finite},
        {"/trajectory/coordinates", real, "reduced samples"},
        {"/trajectory/basis", real, "full reduced"}},
       {"/trajectory/end_displacement", "/trajectory@samples_per_revolution"}},
      {{{"/trajectory/station", text, "stations+"},
        {"/trajectory/x", real, "stations samples"},
        {"/trajectory/y", real, "stations samples"}},
       {"/trajectory/time"}},
      {{{"/trajectory/normal_force", real, "contacts samples"},
        {"/trajectory/friction_force", real, "contacts samples"}},
       {"/trajectory/time", "/contacts/name"}},
      {{{"/contacts/name", text, "contacts+"},
        {"/contacts/regime", text, "contacts"},
        {"/contacts/duty", real, "contacts"},
        {"/contacts/impacts_per_rev", real, "contacts"},
        {"/contacts/max_normal", real, "contacts"},
        {"/contacts/max_tangential", real, "contacts"},
        {"/contacts/sticking", real, "contacts"},
        {"/contacts/mean_slip", real, "contacts"}}},
      {{{"/spectra/frequency", real, "lines+", finite},
        {"/spectra/amplitude", real, "stations lines"}},
       {"/trajectory/station"}},
      {{{"/classify/exponent", real, "exponents"},
        {"/classify@motion", text, ""},
        {"/classify@period_revolutions", real, ""}}},
      // linear
      {{{"/modes/number", integer, "modes", numbers_of("modes")},
        {"/modes/eigenvalue", complex, "modes"},
        {"/modes/frequency", real, "modes"},
        {"/modes/damping_ratio", real, "modes"},
        {"/modes/log_decrement", real, "modes"},
        {"/modes/kappa", real, "modes"},
        {"/modes/whirl", text, "modes"},
        {"/modes/shape", complex, "full modes"}}},
      {{{"/mac/frequency", real, "peaks+"},
        {"/mac/amplitude", real, "peaks"},
        {"/mac/combination", text, "peaks", any, true},
        {"/mac/mac", real, "peaks modes"}},
       {"/modes/number"}},
      {{{"/campbell/speed", real, "speeds+", finite},
        {"/campbell/branch", integer, "branches", numbers_of("branches")},
        {"/campbell/frequency", real, "branches speeds"},
        {"/campbell/log_decrement", real, "branches speeds"},
        {"/campbell/whirl", text, "branches"}}},
      {{{"/campbell/critical_speed", real, "crossings"},
        {"/campbell/critical_branch", integer, "crossings", numbers_of("branches")}},
       {"/campbell/speed"}},
      {{{"/resonances/speed", real, "resonances"},
        {"/resonances/p", integer, "resonances", from_to(1.0, most_order)},
        {"/resonances/q", integer, "resonances", from_to(1.0, most_order)},
        {"/resonances/fast", integer, "resonances", numbers_of("branches")},
        {"/resonances/slow", integer, "resonances", numbers_of("branches")},
        {"/resonances/frequency", real, "resonances"},
        {"/resonances/bouncing_speed", real, "resonances"},
        {"/resonances/bouncing_period", real, "resonances"},
        {"/resonances/bouncing_stable", integer, "resonances", from_to(-1.0, 1.0)}},
       {"/campbell/speed"}},
      {{{"/critical/speed", real, "speeds"},
        {"/critical/damped_speed", real, "speeds"},
        {"/critical/damping_ratio", real, "speeds", any, true},
        {"/critical/whirl", text, "speeds"},
        {"/critical@order", real, "", from_to(positive.least, most_order)}}},
      {{{"/unbalance/speed", real, "speeds+", finite},
        {"/unbalance/station", text, "stations+"},
        {"/unbalance/x", complex, "stations speeds"},
        {"/unbalance/y", complex, "stations speeds"},
        {"/unbalance/major", real, "stations speeds"},
        {"/unbalance/minor", real, "stations speeds"}}},
      {{{"/unbalance/curve_speed", real, "curve+", finite},
        {"/unbalance/curve_x", complex, "stations curve"},
        {"/unbalance/curve_y", complex, "stations curve"},
        {"/unbalance/curve_major", real, "stations curve"}},
       {"/unbalance/speed"}},
      {{{"/unbalance/peak_speed", real, "response_peaks", finite},
        {"/unbalance/peak_station", integer, "response_peaks", numbers_of("stations")},
        {"/unbalance/peak_amplitude", real, "response_peaks"},
        {"/unbalance/peak_below", real, "response_peaks"},
        {"/unbalance/peak_above", real, "response_peaks"}},
       {"/unbalance/speed"}},
      {{{"/static/displacement", real, "full"}}},
      {{{"/static/z", real, "along+", finite},
        {"/static/deflection", real, "along 2", finite},
        {"/static/moment", real, "along 2", finite},
        {"/static/shear", real, "along 2", finite}}},
      {{{"/static/bearing", text, "bearings+"}, {"/static/bearing_load", real, "bearings 2"}}},
      // periodic motions
      {{{"/orbit/multiplier", complex, "multipliers"},
        {"/orbit@period_revolutions", real, "", any, true}}},
      {{{"/orbit/order", real, "orders"}, {"/orbit/amplitude", complex, "full orders"}}},
      {{{"/orbit/displacement", real, "full starts"}, {"/orbit/velocity", real, "full starts"}}},
      {{{"/branch/number", integer, "branches", numbers_of("branches")},
        {"/branch/period", integer, "branches", from_to(0.0, most_revolutions)},
        {"/branch/parent", integer, "branches", from_to(0.0, largest)},
        {"/branch/end", text, "branches"},
        {"/branch/end_kind", text, "branches", any, true},
        {"/branch/end_reason", text, "branches", any, true},
        {"/branch/value", real, "points", finite},
        {"/branch/branch", integer, "points", numbers_of("branches")},
        {"/branch/stable", integer, "points", from_to(-1.0, 1.0)},
        {"/branch/revolutions", real, "points", nonnegative},
        {"/branch/work", real, "points"},
        {"/branch/residual", real, "points"},
        {"/branch/state", real, "points states+"},
        {"/branch/multiplier", complex, "points states+"},
        {"/branch/walk", real, "packed"}}},
      {{{"/branch/station", text, "stations+"}, {"/branch/max_radius", real, "points stations"}},
       {"/branch/number"}},
      {{{"/branch/poincare_x", real, "points stations sections"},
        {"/branch/poincare_y", real, "points stations sections"}},
       {"/branch/station"}},
      {{{"/branch/contact", text, "contacts+"},
        {"/branch/duty", real, "points contacts"},
        {"/branch/impacts_per_rev", real, "points contacts"},
        {"/branch/max_normal", real, "points contacts"},
        {"/branch/max_tangential", real, "points contacts"}},
       {"/branch/number"}},
      {{{"/branch/bifurcation", real, "bifurcations", finite},
        {"/branch/bifurcation_kind", text, "bifurcations"},
        {"/branch/bifurcation_branch", integer, "bifurcations", numbers_of("branches")},
        {"/branch/bifurcation_after", integer, "bifurcations", numbers_of("points")},
        {"/branch/bifurcation_contact", text, "bifurcations"},
        {"/branch/bifurcation_change", real, "bifurcations"},
        {"/branch/bifurcation_multiplier", complex, "bifurcations"}},
       {"/branch/number"}},
      {{{"/border/number", integer, "curves", numbers_of("curves")},
        {"/border/kind", text, "curves"},
        {"/border/contact", text, "curves"},
        {"/border/period", integer, "curves"},
        {"/border/end", text, "curves"},
        {"/border/end_kind", text, "curves", any, true},
        {"/border/end_reason", text, "curves", any, true},
        {"/border/first", real, "places+", finite},
        {"/border/second", real, "places", finite},
        {"/border/curve", integer, "places", numbers_of("curves")},
        {"/border/stable", integer, "places", from_to(0.0, 1.0)},
        {"/border/walk", real, "packed_borders"}}},
      {{{"/torus/angle", real, "angles"}, {"/torus/displacement", real, "angles full"}}},
      {{{"/torus/value", real, "circles+", finite},
        {"/torus/rotation", real, "circles", finite},
        {"/torus/largest_exponent", real, "circles"},
        {"/torus/tail", real, "circles"}},
       {"/torus@period_revolutions"}},
      {{{"/torus@period_revolutions", real, "", from_to(1.0, most_revolutions)}}},
      {{{"/torus/walk", real, "packed_torus"},
        {"/torus@complete", real, "", from_to(0.0, 1.0)},
        {"/torus/end", text, "walks", any, true},
        {"/torus/end_kind", text, "walks", any, true},
        {"/torus/end_reason", text, "walks", any, true}}},
      // studies of many points
      classified("/sweep", {{"/sweep/axis_1", real, "values+", finite},
                            {"/sweep/direction", text, "ways+"},
                            {"/sweep/station", text, "stations+"},
                            {"/sweep/poincare_x", real, "point stations sections"},
                            {"/sweep/poincare_y", real, "point stations sections"},
                            {"/sweep/end_displacement", real, "point full"},
                            {"/sweep/end_velocity", real, "point full"},
                            {"/sweep/max_radius", real, "point stations", any, true},
                            {"/sweep/contact_angle", real, "point contacts sectors", any, true}}),
      {{{"/sweep/spectrum", real, "point stations orders"},
        {"/sweep/order", real, "orders+", finite},
        {"/sweep/sector", real, "sectors"}},
       {"/sweep/motion"}},
      classified("/map", {{"/map/axis_1", real, "first+", finite},
                          {"/map/axis_2", real, "second+", finite},
                          {"/map/axis_3", real, "third+", finite, true}}),
      classified("/basins", {{"/basins/start_displacement", real, "point full"},
                             {"/basins/start_velocity", real, "point full"},
                             {"/basins/section", real, "point sections states"},
                             {"/basins/start", integer, "starts+", any, true},
                             {"/basins/axis_1", real, "first+", finite, true},
                             {"/basins/axis_2", real, "second+", finite, true},
                             {"/basins/axis_3", real, "third+", finite, true}}),
      {{{"/basins/attractor", integer, "point", {-2.0, largest, false, "point"}}},
       {"/basins/motion"}},
      {{{"/bench/method", text, "methods+"},
        {"/bench/tolerance", real, "tolerances+", positive},
        {"/bench/error", real, "methods tolerances"},
        {"/bench/time", real, "methods tolerances"},
        {"/bench/steps", real, "methods tolerances"},
        {"/bench/evaluations", real, "methods tolerances"},
        {"/bench@revolutions", real, "", any},
        {"/bench@reference_error", real, "", any}}},
  };
}

}  // namespace

const std::vector<ResultSet>& result_schema() {
  static const std::vector<ResultSet> schema = make_schema();
  return schema;
}

}  // namespace whirl
