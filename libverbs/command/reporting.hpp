#pragma once
/// How reports begin and end, and how files come to them.

#include <functional>
#include <string>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/stations.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/texts/model_text.hpp"
#include "libverbs/command/invocation.hpp"

namespace whirl::inline cli {

/// A report with the entries that all verbs have (model, version).
Report begin_report(const Invocation& call);
/// A report of a verb that takes a model, with the model's speed (speed_rpm) and the entries of a
/// result, too.
Report begin_report(const Invocation& call, const Model& model, const Record& result = {});

/// Adds notes on a model whose motions are computed: bearing tables that are held constant at its
/// speed, or at a speed that --over goes through; coefficients over whirl frequency, of which a
/// motion takes those of one frequency; a speed that the machine is not run at; and in what the
/// model of --from differs.
void note_model(const Invocation& call, const Model& model, Report& report);

/// Writes the report's notes into a result file, where there are any.
void write_notes(ResultWriter& file, const Report& report);
/// Says where the result is, with --out.
void tell_result(const Invocation& call, Report& report);
/// Writes the report's notes into a result file, if there is one, commits it, and says so.
void commit(const Invocation& call, ResultWriter* file, Report& report);
/// Writes the file that --out asks for, if it does, by `write`, and commits it as above.
void write_file(const Invocation& call, const Model& model, Report& report,
                const std::function<void(ResultWriter&)>& write);

/// A function that shows how far something long is, from its first call on.
std::function<void(long done, long total)> progress_of(const Invocation& call, std::string what);

}  // namespace whirl::inline cli
