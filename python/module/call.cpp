#include "python/module/call.hpp"

#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <thread>

#include "libbase/system/interruption.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/files_in_use.hpp"
#include "libverbs/command/command.hpp"

namespace whirl::inline python {

namespace py = pybind11;

namespace {

using clock = std::chrono::steady_clock;

/// What Python wants of a verb that runs without its lock: to be told how far it is, and to stop
/// it. Python is asked in the calling thread only, and not more often than people notice.
class Watch {
 public:
  struct Interrupted {};  ///< no std::exception, which somebody might take for a failure

  explicit Watch(const py::object& progress) : progress_(progress) {}

  /// Of verbs that stop by themselves with what they have.
  bool stops() {
    is_asked_ = true;
    look_at_signals();
    return stops_;
  }
  /// Of those that do not, between their steps.
  void interrupt() {
    if (is_asked_) return;
    look_at_signals();
    if (stops_) throw Interrupted();
  }
  void show(const std::string& what, long done, long total) {
    if (progress_.is_none() || !(done >= total || is_due(shown_))) return;
    ask([&] { progress_(what, done, total); });
  }
  bool has_error() const { return error_.has_value(); }
  /// With Python's lock held: its exception leaves.
  [[noreturn]] void leave(std::unique_ptr<Found> found) {
    if (found) error_->value().attr("found") = py::cast(std::move(found));
    throw py::error_already_set(std::move(*error_));
  }

 private:
  static constexpr std::chrono::milliseconds patience{50};

  static bool is_due(clock::time_point& next) {
    const auto now = clock::now();
    if (now < next) return false;
    next = now + patience;
    return true;
  }
  void look_at_signals() {
    if (std::this_thread::get_id() != caller_ || !is_due(signals_)) return;
    ask([] {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    });
  }
  template <class F>
  void ask(const F& f) {
    const py::gil_scoped_acquire with_python;
    try {
      if (!error_) f();
    } catch (py::error_already_set& error) {
      error_.emplace(std::move(error));
      stops_ = true;
    }
  }

  const py::object& progress_;
  std::thread::id caller_ = std::this_thread::get_id();
  clock::time_point signals_ = clock::now() + patience, shown_ = clock::now() + patience;
  std::atomic<bool> stops_ = false, is_asked_ = false;
  std::optional<py::error_already_set> error_{};
};

/// The line of a shell that asks for the same.
std::vector<std::string> line_of(const Call& call) {
  std::vector<std::string> line{"whirl", call.verb, call.file};
  for (const std::string& set : call.sets) line.push_back("--set=" + set);
  line.insert(line.end(), call.options.begin(), call.options.end());
  return line;
}

Invocation call_of(const Verb& verb, const Subject& subject, const GivenValues& given) {
  Invocation call;
  call.verb = verb.name;
  call.file = subject.file;
  call.motion = subject.motion;
  call.sets_before = subject.sets_before;
  if (const ModelText* model = subject.model) {
    call.file = model->file();
    call.model_text = model->text();
    call.made = model->made();
    call.sets = model->sets();
  }
  call.given = given;
  call.line = line_of(call.parts());
  call.prepare();
  return call;
}

}  // namespace

py::list verb_table() {
  py::list table;
  for (const Verb& verb : verbs()) {
    const bool takes_model = verb.takes == "MODEL";
    const bool takes_result = verb.takes == "FILE" && verb.group == "Results";
    if (!(takes_model || takes_result) || !verb.run.with || !verb.takes_more.empty()) continue;
    py::list options;
    for (const OptionSpec& option : options_of(verb)) {
      options.append(
          py::make_tuple(option.name, option.value, option.help, option.otherwise, option.is_list));
    }
    table.append(py::make_tuple(verb.name, verb.alias, verb.group, verb.summary, verb.example,
                                takes_result, options));
  }
  return table;
}

std::unique_ptr<Found> run_verb(const std::string& name, const Subject& subject,
                                const GivenValues& given, const py::object& progress) {
  const Verb& verb = *verb_named(name);
  auto found = std::make_unique<Found>();
  Watch watch(progress);
  const FilesInUse files;
  try {
    Invocation call = call_of(verb, subject, given);
    call.kept = found->kept.get();
    call.is_stopped = [&] { return watch.stops(); };
    call.progress = [&](const std::string& what, long done, long total) {
      watch.show(what, done, total);
    };
    const py::gil_scoped_release others_run;
    const Interruptible while_it_runs([&] { watch.interrupt(); });
    const auto begin = clock::now();
    found->report = verb.run.with(call);
    found->seconds = std::chrono::duration<double>(clock::now() - begin).count();
  } catch (const Watch::Interrupted&) {
    found = nullptr;
  }
  if (watch.has_error()) watch.leave(std::move(found));
  return found;
}

}  // namespace whirl::inline python
