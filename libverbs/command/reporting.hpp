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
/// The same of verbs that take a model, whose speed it says (speed_rpm), with the entries of a
/// result.
Report begin_report(const Invocation& call, const Model& model, const Record& result = {});

/// Notes what is to be known of a model whose motions are computed: bearing tables that are held
/// constant at its speed, or at one that --over goes through, those of whose whirl frequencies a
/// motion takes one, a speed that the machine is not run at, and in what the model of --from
/// differs.
void note_model(const Invocation& call, const Model& model, Report& report);

/// Writes the report's notes into a result file, where there are any.
void write_notes(ResultWriter& file, const Report& report);
/// Says where the result is, with --out.
void tell_result(const Invocation& call, Report& report);
/// Writes the report's notes into a result file, if there is one, commits it, and says so.
void commit(const Invocation& call, ResultWriter* file, Report& report);
/// The same of a file of its own, if --out asks for one, with what is written into it.
void write_file(const Invocation& call, const Model& model, Report& report,
                const std::function<void(ResultWriter&)>& write);

/// Shows how far something long is, from the first number on.
std::function<void(long done, long total)> progress_of(const Invocation& call, std::string what);

}  // namespace whirl::inline cli
