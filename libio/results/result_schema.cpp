#include "libio/results/result_schema.hpp"

#include <string>

#include "libdyn/motions/identify.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/motions/unbalance_study.hpp"
#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/classification_result.hpp"
#include "libdyn/studies/map.hpp"
#include "libdyn/studies/orbit_result.hpp"
#include "libdyn/studies/resonance_study.hpp"
#include "libdyn/studies/sweep.hpp"
#include "libdyn/studies/work_precision_study.hpp"
#include "libdyn/system/stations.hpp"
#include "libfe/bending.hpp"
#include "libfe/campbell.hpp"
#include "libfe/critical.hpp"
#include "libfe/static.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/study_columns.hpp"

namespace whirl::inline io {

namespace {

using enum ObjectKind;

using namespace valid;

constexpr double most_revolutions = 1e9;  ///< of a period

/// What is stated by the columns of results.
std::vector<ResultSet> stated_schema() {
  std::vector<ResultSet> all;
  const auto add = [&](const std::vector<ResultSet>& sets) {
    all.insert(all.end(), sets.begin(), sets.end());
  };
  add(schema_of<PointNames>());
  add(schema_of<StudyStart>());
  add(schema_of<MotionEnd>());
  add(schema_of<RunFacts>());
  add(schema_of<ContactShares>());
  add(schema_of<MotionRecord>());
  add(schema_of<StationSpectra>());
  add(schema_of<Identification>());
  add(schema_of<StaticEquilibrium>());
  add(schema_of<BendingLine>());
  add(schema_of<ModesAtPoints>());
  add(schema_of<Campbell>());
  add(schema_of<ResonanceStudy>());
  add(schema_of<WorkPrecisionStudy>());
  add(schema_of<OrbitResult>());
  add(schema_of<OrbitSeries>());
  add(schema_of<ClassificationResult>());
  add(schema_of<CriticalSpeeds>());
  add(schema_of<UnbalanceStudy>());
  return all;
}

/// The call and the model, which all files have.
std::vector<ResultSet> call_schema() {
  return {
      {{{"/model", text, "1"}}},
      {{{"/arguments", text, "words+"}}},
      {{{"/call@verb", text, ""}, {"/call@file", text, ""}}},
      {{{"/call/word", text, "call_words"}}},
      {{{"/call/set", text, "call_sets"}}},
      {{{"/call/option", text, "call_options"}}},
  };
}

/// Branches, curves of bifurcations, circles: units of their parameters are known at run time only.
std::vector<ResultSet> branch_schema() {
  return {
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
  };
}

/// Studies of many points.
std::vector<ResultSet> studies_schema() {
  return {
      study_schema<SweepResult>({{"/sweep/axis_1", real, "values+", finite}}),
      study_schema<MapResult>({{"/map/axis_1", real, "first+", finite},
                               {"/map/axis_2", real, "second+", finite},
                               {"/map/axis_3", real, "third+", finite, true}}),
      study_schema<BasinsResult>({{"/basins/axis_1", real, "first+", finite, true},
                                  {"/basins/axis_2", real, "second+", finite, true},
                                  {"/basins/axis_3", real, "third+", finite, true}}),
  };
}

}  // namespace

const std::vector<ResultSet>& result_schema() {
  static const std::vector<ResultSet> schema = [] {
    std::vector<ResultSet> all = stated_schema();
    for (const auto& more : {call_schema(), branch_schema(), studies_schema()}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }();
  return schema;
}

}  // namespace whirl::inline io
