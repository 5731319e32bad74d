#pragma once
/// Files and folders that are there for a while only. They go whatever ends the process: an
/// exception, or a signal, but for SIGKILL.

#include <signal.h>

#include <filesystem>
#include <string>

namespace whirl::inline io {

/// Holds signals up as long as it lives, so that a file that is made is also in the list of what
/// signals remove.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_{};
};

/// One of them, removed at the end.
class PassingFile {
 public:
  PassingFile() = default;
  /// Removes it, if there is one.
  ~PassingFile();
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;

  /// Makes a new, empty file: never takes one that is there, nor what a link of that name leads to.
  /// @return 0 or the number of the error; EEXIST where something has that name
  int make(const std::filesystem::path& name);
  /// Makes a new folder.
  /// @param name  its last six letters are "XXXXXX", for which others are put
  /// @return 0 or the number of the error
  int make_folder(const std::string& name);
  /// Takes over a file that this process alone has. Signals have to wait from before the file is
  /// made.
  void adopt(const std::filesystem::path& name);
  /// Removes it.
  void remove();
  /// It has another name now, and stays.
  void forget();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_{};
  int slot_ = -1;  ///< in the list of what signals remove; -1: none was free
};

/// From now on signals that end this process remove such files first; SIGTERM and SIGUSR1 end it
/// with a status, and a file that grows too large (SIGXFSZ) ends nothing: writing it is an error.
/// Signals that something else is done at stay as they are.
/// @param status  of SIGTERM and SIGUSR1; 0: they end it as signals do
void remove_passing_files_at_signals(int status = 0);

/// What those signals do, for a handler that ends the process: it may be called in one.
void end_by_signal(int signal);

}  // namespace whirl::inline io
