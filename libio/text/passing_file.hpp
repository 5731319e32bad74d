#pragma once
/// Files and folders that are there for a while only. They are removed whatever ends the process,
/// an exception or a signal, except SIGKILL.

#include <signal.h>

#include <filesystem>
#include <string>

namespace whirl::inline io {

/// Holds signals up as long as it lives, so that no signal comes between the making of a file and
/// its entry in the list of what signals remove.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_{};
};

/// A file or folder that is there for a while only, removed at the end.
class PassingFile {
 public:
  PassingFile() = default;
  /// Removes the file or folder, if there is one.
  ~PassingFile();
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;

  /// Makes a new, empty file: never takes a file that is there, nor what a link of that name leads
  /// to.
  /// @return 0 or the number of the error; EEXIST where something has that name
  int make(const std::filesystem::path& name);
  /// Makes a new folder.
  /// @param name  its last six letters are "XXXXXX", which are replaced by others
  /// @return 0 or the number of the error
  int make_folder(const std::string& name);
  /// Takes over a file that this process alone has. Signals have to wait (SignalsWait) from before
  /// the file is made.
  void adopt(const std::filesystem::path& name);
  /// Removes the file or folder.
  void remove();
  /// The file or folder has another name now, and stays.
  void forget();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_{};
  int slot_ = -1;  ///< in the list of what signals remove; -1: none was free
};

/// From now on signals that end this process remove such files first; SIGTERM and SIGUSR1 end it
/// with a status, and a file that grows too large (SIGXFSZ) ends nothing: writing it is an error.
/// Signals that have another handler, or are ignored, stay as they are.
/// @param status  of SIGTERM and SIGUSR1; 0: they end it as signals do
void remove_passing_files_at_signals(int status = 0);

/// Does what those signals do; for a handler of signals that ends the process, and may be called in
/// one.
void end_by_signal(int signal);

}  // namespace whirl::inline io
