#include "libio/results/hdf5/trial.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "libio/results/hdf5.hpp"

namespace whirl::inline io::hdf5 {

namespace fs = std::filesystem;

namespace {

constexpr rlim_t least_seconds = 10;                 ///< of processor time
constexpr std::uintmax_t slowest_bytes = 1'000'000;  ///< that a sound file is read at per second

void read_all(const ResultReader& file, const std::string& group) {
  for (const std::string& name : file.list(group.empty() ? "/" : group)) {
    const std::string path = group + '/' + name;
    try {
      switch (file.kind(path)) {
        case ObjectKind::group:
          read_all(file, path);
          break;
        case ObjectKind::real:
        case ObjectKind::integer:
          file.each_block(path, [](auto) {});
          break;
        case ObjectKind::complex:
          file.shape(path).size() == 1 ? void(file.complex_vector(path))
                                       : void(file.complex_matrix(path));
          break;
        case ObjectKind::text:
          file.strings(path);
          break;
        case ObjectKind::other:
          continue;
      }
      if (file.kind(path) != ObjectKind::group) file.axes(path);
    } catch (const FileError&) {
      // whoever wants this dataset is told so
    }
  }
}

/// Limits of a child that may do anything: no noise, no core file, an end.
void confine(std::uintmax_t bytes) {
  const rlim_t seconds = least_seconds + static_cast<rlim_t>(bytes / slowest_bytes);
  const rlimit time{seconds, seconds}, core{0, 0};
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDERR_FILENO);  // the C library and HDF5 tell of their ends
}

/// What a child did that did not come to its own end: a signal, or the exit of a sanitizer.
std::string how_it_ended(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("ends with status {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGKILL) return "does not end";
  return fmt::format("ends by signal {}", signal);
}

}  // namespace

void try_in_child(const fs::path& path) {
  std::error_code ignored;
  const std::uintmax_t bytes = fs::file_size(path, ignored);
  const pid_t child = ::fork();
  if (child < 0) {
    throw FileError(fmt::format("cannot check {}: {}", path.string(), std::strerror(errno)));
  }
  if (child == 0) {
    confine(ignored ? 0 : bytes);
    try {
      read_all(ResultReader(path, Trust::all), "");
    } catch (...) {
      // the parent meets and names it
    }
    ::_exit(0);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw FileError(fmt::format("cannot open {}: damaged HDF5 file (reading it {})", path.string(),
                              how_it_ended(status)));
}

}  // namespace whirl::inline io::hdf5
