#include "libio/results/trial.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

constexpr rlim_t least_seconds = 10;                 ///< of processor time
constexpr std::uintmax_t slowest_bytes = 1'000'000;  ///< that a sound file is read at per second

/// Limits of a child that may do anything: no noise, no core file, an end.
void confine(std::uintmax_t bytes) {
  const rlim_t seconds = least_seconds + static_cast<rlim_t>(bytes / slowest_bytes);
  const rlimit time{seconds, seconds}, core{0, 0};
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDERR_FILENO);  // libraries tell of their ends
}

/// What a child did that did not come to its own end: a signal, or the exit of a sanitizer.
std::string how_it_ended(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("ends with status {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGKILL) return "does not end";
  return fmt::format("ends by signal {}", signal);
}

}  // namespace

void try_in_child(const fs::path& path, const char* format, const std::function<void()>& read) {
  std::error_code ignored;
  const std::uintmax_t bytes = fs::file_size(path, ignored);
  const pid_t child = ::fork();
  if (child < 0) {
    throw FileError(fmt::format("cannot check {}: {}", path.string(), std::strerror(errno)));
  }
  if (child == 0) {
    confine(ignored ? 0 : bytes);
    try {
      read();
    } catch (...) {
      // the parent meets and names it
    }
    ::_exit(0);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw FileError(fmt::format("cannot open {}: damaged {} file (reading it {})", path.string(),
                              format, how_it_ended(status)));
}

}  // namespace whirl::inline io
