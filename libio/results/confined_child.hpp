#pragma once
/// A process of its own that reads a file from outside, by a library that a damaged file may crash.

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace whirl::inline io {

/// A regular file that is open for reading, whatever its name will mean later.
class OpenedFile {
 public:
  /// @throws FileError  if there is none, if it may not be read, or if it is something else, such
  ///                    as a directory, a device or a pipe
  explicit OpenedFile(const std::filesystem::path& file);
  ~OpenedFile();
  OpenedFile(const OpenedFile&) = delete;
  OpenedFile& operator=(const OpenedFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::size_t size() const { return size_; }  ///< bytes
  /// Another name of this very file, for libraries that open files by name.
  std::string place() const;

 private:
  int descriptor_ = -1;
  std::size_t size_ = 0;
};

/// Held by whoever uses a library that a child uses, too: a child that is made meanwhile would wait
/// for a lock of that library without end.
std::recursive_mutex& library_lock();

/// In a child: from now on the child can open no file. To be called as soon as its own file is
/// open.
void open_nothing_more();

/// Reads a file in a child process: whatever the file does to the library that reads it happens to
/// the child, and is an error here.
///
/// The child has nothing open but the file and the way back, cannot write to files, and has a limit
/// of memory (half of the machine's, 1 GB or more) and one of processor time for every answer (10
/// s, and 1 s for every MB of the file).
class ConfinedChild {
 public:
  /// What goes between this process and the child.
  struct Letter {
    std::string bytes{};
    std::vector<double> numbers{};
  };
  using Answer = std::function<Letter(const std::string& question)>;

  /// @param name    of the file, for messages
  /// @param format  likewise: "HDF5"
  /// @param answer  runs in the child, question by question; what it throws is thrown by ask()
  /// @throws FileError  if there can be no child
  ConfinedChild(const OpenedFile& file, std::string name, std::string format, Answer answer);
  ~ConfinedChild();
  ConfinedChild(const ConfinedChild&) = delete;
  ConfinedChild& operator=(const ConfinedChild&) = delete;

  /// The answer of the child. Several threads may ask.
  /// @throws FileError, ModelError  that the answer threw
  /// @throws FileError  if the child was ended by a signal or by a limit, now or before
  Letter ask(const std::string& question) const;

 private:
  [[noreturn]] void tell_end() const;

  std::string name_, format_;
  pid_t child_ = -1;
  int socket_ = -1;
  std::size_t most_bytes_ = 0;  ///< that the child can answer
  mutable std::mutex asking_{};
  mutable std::string end_{};  ///< how the child ended; empty: it goes on
};

}  // namespace whirl::inline io
