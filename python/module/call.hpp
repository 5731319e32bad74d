#pragma once
/// Verbs of the command line, called from Python.

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "libverbs/command/invocation.hpp"
#include "libverbs/command/verb.hpp"
#include "python/module/model_text.hpp"

namespace whirl::inline python {

/// What a verb found.
struct Found {
  Report report;
  std::shared_ptr<KeptResult> kept = std::make_shared<KeptResult>();
  double seconds = 0.0;  ///< that the verb itself took
};

/// What a call is about.
struct Subject {
  const ModelText* model = nullptr;        ///< null: a result
  std::string file{};                      ///< that result
  std::string motion{};                    ///< as Invocation has it
  std::vector<std::string> sets_before{};  ///< likewise
};

/// All verbs that take a model, or a model or a result, and run; with their options.
pybind11::list verb_table();

/// Runs a verb as the command line does, with the same options. Python's other threads run
/// meanwhile; signals are looked at now and then, and an exception of their handlers, or of
/// `progress`, stops it: it then leaves, with what was found until then, if that is something, as
/// its attribute `found`.
///
/// @param given     texts of options by their names, as the command line has them
/// @param progress  called with (what, done, total) now and then, or None
/// @throws ModelError, NumericalError, FileError
std::unique_ptr<Found> run_verb(const std::string& verb, const Subject& subject,
                                const GivenValues& given, const pybind11::object& progress);

}  // namespace whirl::inline python
