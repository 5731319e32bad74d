#pragma once
/// This process among those that mpirun or srun has started.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "libbase/processes/ranks.hpp"

namespace whirl::inline cli {

/// MPI, from its beginning to its end. One thread calls it.
class MpiProcess {
 public:
  /// @throws std::runtime_error  if there is no MPI to be had
  MpiProcess(int& argc, char**& argv);
  ~MpiProcess();
  MpiProcess(const MpiProcess&) = delete;
  MpiProcess& operator=(const MpiProcess&) = delete;

  /// Letters go by MPI; these live no longer than this.
  const Ranks& ranks() const { return ranks_; }
  /// A text of every rank, in all of them.
  std::vector<std::string> gather(const std::string& own) const;

  /// Tells all other ranks that the work has ended, and waits until they know.
  /// @param status    ends all of them at once if one does not answer
  /// @param patience  until then
  void end_others(int status, std::chrono::milliseconds patience);
  /// Tells the leader that this rank has ended.
  void end();
  /// Ends all processes at once.
  [[noreturn]] static void abort(int status);

 private:
  struct Letters;
  std::unique_ptr<Letters> letters_;
  Ranks ranks_;
};

}  // namespace whirl::inline cli
