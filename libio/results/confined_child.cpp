#include "libio/results/confined_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>

#include "libbase/structs/travel.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/files_in_use.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

constexpr rlim_t least_seconds = 10;            ///< of processor time for an answer
constexpr std::size_t slowest_bytes = 1000000;  ///< that a sound file is read at per second
constexpr std::size_t least_memory = std::size_t{1} << 30u;  ///< bytes
constexpr rlim_t few_files = 8;                              ///< that opening one takes

bool is_child = false;  ///< whether this process is one

using Letter = ConfinedChild::Letter;

enum class Outcome { answered, file_error, model_error };

std::size_t memory_for_child() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  return std::max(least_memory, static_cast<std::size_t>(std::max(0L, pages / 2)) *
                                    static_cast<std::size_t>(std::max(0L, page)));
}

/// Sends all bytes; whether somebody took them.
bool send_all(int socket, const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t sent = ::send(socket, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, void* bytes, std::size_t size) {
  char* at = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t got = ::recv(socket, at, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool send_letter(int socket, const Letter& letter) {
  const std::array<std::size_t, 2> sizes{letter.bytes.size(), letter.numbers.size()};
  return send_all(socket, sizes.data(), sizeof sizes) &&
         send_all(socket, letter.bytes.data(), sizes[0]) &&
         send_all(socket, letter.numbers.data(), sizes[1] * sizeof(double));
}

/// @param most  bytes that a letter can have
bool receive_letter(int socket, Letter& letter, std::size_t most) {
  std::array<std::size_t, 2> sizes{};
  if (!receive_all(socket, sizes.data(), sizeof sizes)) return false;
  if (sizes[0] > most || sizes[1] > most / sizeof(double)) return false;
  letter.bytes.resize(sizes[0]);
  letter.numbers.resize(sizes[1]);
  return receive_all(socket, letter.bytes.data(), sizes[0]) &&
         receive_all(socket, letter.numbers.data(), sizes[1] * sizeof(double));
}

void limit(__rlimit_resource_t what, rlim_t most) {
  rlimit now{};
  ::getrlimit(what, &now);
  now.rlim_cur = std::min(most, now.rlim_max);
  ::setrlimit(what, &now);
}

/// Bytes of addresses that this process has.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// A child that may do anything: no noise, no core file, no file but these two, an end.
void confine(int file, int socket) {
  limit(RLIMIT_AS, address_space() + memory_for_child());
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  // the parent says when this ends, by its own end or before
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) ::signal(signal, SIG_IGN);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGXFSZ}) {
    ::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  const auto [low, high] = std::minmax(file, socket);
  const auto close_between = [](int first, int last) {
    if (first <= last) ::close_range(static_cast<unsigned>(first), static_cast<unsigned>(last), 0);
  };
  close_between(STDERR_FILENO + 1, low - 1);
  close_between(std::max(STDERR_FILENO, low) + 1, high - 1);
  ::close_range(static_cast<unsigned>(high) + 1, ~0u, 0);
  limit(RLIMIT_NOFILE, static_cast<rlim_t>(high) + few_files);
}

/// Gives the next answer so much time [s].
void allow_seconds(rlim_t seconds) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  limit(RLIMIT_CPU, static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1 + seconds);
}

Letter answer_to(const std::string& question, const ConfinedChild::Answer& answer) {
  const std::vector<Problem> none;
  try {
    Letter letter = answer(question);
    letter.bytes = packed(Outcome::answered, letter.bytes, none);
    return letter;
  } catch (const ModelError& error) {
    return {packed(Outcome::model_error, std::string(error.what()), error.problems())};
  } catch (const std::bad_alloc&) {
    return {packed(Outcome::file_error, std::string(), none)};
  } catch (const std::exception& error) {
    return {packed(Outcome::file_error, std::string(error.what()), none)};
  }
}

[[noreturn]] void serve(int file, int socket, std::size_t bytes,
                        const ConfinedChild::Answer& answer) {
  is_child = true;
  confine(file, socket);
  Letter question;
  while (receive_letter(socket, question, least_memory)) {
    allow_seconds(least_seconds + static_cast<rlim_t>(bytes / slowest_bytes));
    if (!send_letter(socket, answer_to(question.bytes, answer))) break;
  }
  ::_exit(0);
}

/// What a child did that did not come to its own end: a signal, or the exit of a sanitizer.
std::string how_it_ended(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("ends with status {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return "does not end";
  return fmt::format("ends by signal {}", signal);
}

}  // namespace

OpenedFile::OpenedFile(const fs::path& file) {
  const auto fail = [&](std::string_view why) {
    throw FileError(fmt::format("cannot open {}: {}", file.string(), why));
  };
  const std::string lost = problem_of_reading(file);
  if (!lost.empty()) fail(lost);
  // not to wait for who writes into a pipe
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) fail(errno == ENOENT ? "there is no such file" : std::strerror(errno));
  struct stat is {};
  if (::fstat(descriptor_, &is) == 0 && S_ISREG(is.st_mode)) {
    size_ = static_cast<std::size_t>(is.st_size);
    return;
  }
  ::close(descriptor_);
  fail(S_ISDIR(is.st_mode) ? "it is a directory" : "it is a device or a pipe, expected a file");
}

OpenedFile::~OpenedFile() {
  ::close(descriptor_);
}

std::string OpenedFile::place() const {
  return fmt::format("/proc/self/fd/{}", descriptor_);
}

std::recursive_mutex& library_lock() {
  static std::recursive_mutex lock, of_child;  // which cannot give back what its maker holds
  return is_child ? of_child : lock;
}

void open_nothing_more() {
  if (is_child) limit(RLIMIT_NOFILE, 0);
}

ConfinedChild::ConfinedChild(const OpenedFile& file, std::string name, std::string format,
                             Answer answer)
    : name_(std::move(name)), format_(std::move(format)), most_bytes_(2 * memory_for_child()) {
  std::array<int, 2> ends{-1, -1};
  const std::lock_guard alone(library_lock());
  child_ = ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0 ? ::fork() : -1;
  if (child_ == 0) serve(file.descriptor(), ends[1], file.size(), answer);
  const int problem = errno;
  if (ends[1] >= 0) ::close(ends[1]);
  socket_ = ends[0];
  if (child_ > 0) return;
  if (socket_ >= 0) ::close(socket_);
  throw FileError(fmt::format("cannot open {}: {}", name_, std::strerror(problem)));
}

ConfinedChild::~ConfinedChild() {
  ::close(socket_);
  if (!end_.empty()) return;
  ::kill(child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void ConfinedChild::tell_end() const {
  throw FileError(
      fmt::format("cannot open {}: damaged {} file (reading it {})", name_, format_, end_));
}

ConfinedChild::Letter ConfinedChild::ask(const std::string& question) const {
  const std::lock_guard alone(asking_);
  if (!end_.empty()) tell_end();
  Letter letter;
  Outcome outcome{};
  std::string text;
  std::vector<Problem> problems;
  bool is_whole = send_letter(socket_, {question}) && receive_letter(socket_, letter, most_bytes_);
  try {
    if (is_whole) unpack(letter.bytes, outcome, text, problems);
  } catch (const NumericalError&) {
    is_whole = false;
  }
  if (!is_whole) {
    int status = 0;
    ::kill(child_, SIGKILL);  // one that has ended already stays what it is
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    end_ = how_it_ended(status);
    tell_end();
  }
  if (outcome == Outcome::model_error) throw ModelError(std::move(problems));
  if (outcome == Outcome::file_error) {
    throw FileError(text.empty() ? fmt::format("cannot read {}: not enough memory for this", name_)
                                 : text);
  }
  letter.bytes = std::move(text);
  return letter;
}

}  // namespace whirl::inline io
