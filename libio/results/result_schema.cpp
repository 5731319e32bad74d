#include "libio/results/result_schema.hpp"

#include <string>

#include "libdata/balancing/balancing.hpp"
#include "libdata/fit/measured_fit.hpp"
#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/order_tracking.hpp"
#include "libdata/measured/running_modes.hpp"
#include "libdata/measured/station_motion.hpp"
#include "libdata/measured/trend.hpp"
#include "libdata/measured/zones.hpp"
#include "libdyn/linear/critical_over.hpp"
#include "libdyn/linear/frequency_response.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libdyn/linear/modes_over.hpp"
#include "libdyn/linear/sensitivity.hpp"
#include "libdyn/linear/step_response.hpp"
#include "libdyn/linear/support_fits.hpp"
#include "libdyn/linear/unbalance_over.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libdyn/motions/identify.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/branch_result.hpp"
#include "libdyn/studies/classification_result.hpp"
#include "libdyn/studies/curve_result.hpp"
#include "libdyn/studies/map.hpp"
#include "libdyn/studies/orbit_result.hpp"
#include "libdyn/studies/resonance_study.hpp"
#include "libdyn/studies/sweep.hpp"
#include "libdyn/studies/torus_result.hpp"
#include "libdyn/studies/work_precision_study.hpp"
#include "libdyn/system/running_film.hpp"
#include "libdyn/system/stations.hpp"
#include "libfe/analyses/bending.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/critical_map.hpp"
#include "libfe/analyses/static.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/study_columns.hpp"

namespace whirl::inline io {

namespace {

using enum ObjectKind;

using namespace valid;

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
  add(schema_of<MeasuredIdentification>());
  add(schema_of<OrderTracking>());
  add(schema_of<Trend>());
  add(schema_of<ZoneReport>());
  add(schema_of<StationRecord>());
  add(schema_of<RunningModes>());
  add(schema_of<MeasuredFit>());
  add(schema_of<Balancing>());
  add(schema_of<StaticEquilibrium>());
  add(schema_of<RunningFilms>());
  add(schema_of<BendingLine>());
  add(schema_of<ModesAtPoints>());
  add(schema_of<Campbell>());
  add(schema_of<ResonanceStudy>());
  add(schema_of<WorkPrecisionStudy>());
  add(schema_of<OrbitResult>());
  add(schema_of<MotionLoads>());
  add(schema_of<OrbitSeries>());
  add(schema_of<ClassificationResult>());
  add(schema_of<CriticalSpeeds>());
  add(schema_of<CriticalMap>());
  add(schema_of<UnbalanceStudy>());
  add(schema_of<ModesOver>());
  add(schema_of<CriticalOver>());
  add(schema_of<UnbalanceOver>());
  add(schema_of<FrequencyResponse>());
  add(schema_of<Sensitivity>());
  add(schema_of<SupportFits>());
  add(schema_of<StepResponse>());
  add(schema_of<LateralReport>());
  add(schema_of<LateralParts>());
  add(schema_of<BranchResult>());
  add(schema_of<CurveResult>());
  add(schema_of<TorusResult>());
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
    for (const auto& more : {call_schema(), studies_schema()}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }();
  return schema;
}

}  // namespace whirl::inline io
