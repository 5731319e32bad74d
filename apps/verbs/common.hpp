#pragma once
/// What several verbs say in the same words.

#include <string>
#include <vector>

#include "apps/invocation.hpp"
#include "libbase/constants.hpp"
#include "libdyn/system/stations.hpp"
#include "libfe/modes.hpp"
#include "libio/results/motion_window.hpp"

namespace whirl::inline io {
struct ResultView;
}

namespace whirl::inline cli {

/// Record with the entries that all verbs have: model, version, speed_rpm.
Record begin_record(const Invocation& call, const Model& model);

/// Table of modes for people.
std::string modes_table(const Modes& modes);

/// Group /points of a result file: nodes and bodies with their positions and names.
void write_points(ResultWriter& file, const Model& model, const Assembler& assembler);

/// A number with so many digits behind the point, zero without a sign.
std::string fixed(double value, int digits);

/// Shows frequencies in the unit of --frequency, if it is given.
void set_frequency_unit(const Invocation& call, ResultView& result);

/// The stretch of a motion that --from-revolution, --revolutions or --times ask for.
MotionWindow window_of(const Invocation& call);

/// Writes the report's notes into a result file, where there are any.
void write_notes(ResultWriter& file, const Report& report);

/// Writes the report's notes into a result file, if there is one, commits it, and says so.
void commit(const Invocation& call, ResultWriter* file, Report& report);

}  // namespace whirl::inline cli
