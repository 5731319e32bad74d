#include "libio/text/passing_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

/// A name as a handler of signals can read it at every moment.
struct Slot {
  enum State : int { free, being_written, file, folder };
  std::atomic<int> state = free;
  pid_t owner = 0;  ///< whose file it is: children have this list, too
  std::array<char, PATH_MAX> name{};
};

std::array<Slot, 64> slots;
std::atomic<int> status_of_end = 0;

constexpr std::array ends{SIGINT,  SIGTERM, SIGHUP,  SIGQUIT, SIGUSR1, SIGUSR2, SIGPIPE,
                          SIGALRM, SIGXCPU, SIGABRT, SIGSEGV, SIGBUS,  SIGFPE,  SIGILL};

/// Puts a name into the list.
/// @return where; -1: nowhere, as the list is full or the name long
int listed(const fs::path& path, Slot::State what) {
  std::error_code ignored;
  const std::string name = fs::absolute(path, ignored).string();
  for (std::size_t i = 0; i < slots.size() && name.size() < slots[i].name.size(); ++i) {
    int expected = Slot::free;
    if (!slots[i].state.compare_exchange_strong(expected, Slot::being_written)) continue;
    *std::copy(name.begin(), name.end(), slots[i].name.begin()) = '\0';
    slots[i].owner = ::getpid();
    slots[i].state = what;
    return static_cast<int>(i);
  }
  return -1;
}

/// Removes a folder with all that is in it, by functions that a handler may call.
void remove_folder(const char* name) {
  const char* const words[] = {"/bin/rm", "-rf", "--", name, nullptr};
  const pid_t child = ::vfork();
  if (child == 0) {
    ::execve(words[0], const_cast<char* const*>(words), environ);
    ::_exit(127);
  }
  if (child > 0) ::waitpid(child, nullptr, 0);
}

void remove_all_listed() {
  const pid_t own = ::getpid();
  for (Slot& slot : slots) {
    const int state = slot.state;
    if (slot.owner != own) continue;
    if (state == Slot::file) ::unlink(slot.name.data());
    if (state == Slot::folder) remove_folder(slot.name.data());
  }
}

}  // namespace

SignalsWait::SignalsWait() {
  sigset_t all;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before_);
}

SignalsWait::~SignalsWait() {
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

PassingFile::~PassingFile() {
  remove();
}

void PassingFile::adopt(const fs::path& name) {
  path_ = name;
  slot_ = listed(path_, Slot::file);
}

void PassingFile::remove() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  forget();
}

int PassingFile::make(const fs::path& name) {
  remove_passing_files_at_signals(status_of_end);
  const SignalsWait waiting;
  const int made = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (made < 0) return errno;
  ::close(made);
  adopt(name);
  return 0;
}

int PassingFile::make_folder(const std::string& name) {
  remove_passing_files_at_signals(status_of_end);
  const SignalsWait waiting;
  std::string made = name;
  if (!::mkdtemp(made.data())) return errno;
  path_ = made;
  slot_ = listed(path_, Slot::folder);
  return 0;
}

void PassingFile::forget() {
  path_.clear();
  if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state = Slot::free;
  slot_ = -1;
}

void end_by_signal(int signal) {
  remove_all_listed();
  if (status_of_end != 0 && (signal == SIGTERM || signal == SIGUSR1)) ::_exit(status_of_end);
  ::signal(signal, SIG_DFL);
  ::raise(signal);  // which waits for the end of this handler
}

void remove_passing_files_at_signals(int status) {
  status_of_end = status;
  const auto set = [](int signal, void (*handler)(int)) {
    struct sigaction now {};
    if (::sigaction(signal, nullptr, &now) != 0 || (now.sa_flags & SA_SIGINFO) != 0) return;
    if (now.sa_handler != SIG_DFL) return;
    now.sa_handler = handler;
    now.sa_flags = 0;
    sigfillset(&now.sa_mask);
    ::sigaction(signal, &now, nullptr);
  };
  for (const int signal : ends) set(signal, end_by_signal);
  set(SIGXFSZ, SIG_IGN);
}

}  // namespace whirl::inline io
