// The program of several processes: mpirun -n 4 whirl-mpi map ...

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>

#include "apps/mpi/mpi_process.hpp"
#include "apps/run_program.hpp"
#include "libbase/structs/digest.hpp"
#include "libbase/structs/travel.hpp"
#include "libbase/system/arithmetic.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/text/passing_file.hpp"
#include "libio/text/terminal.hpp"
#include "libverbs/command/arithmetic.hpp"
#include "libverbs/command/exit_status.hpp"
#include "libverbs/command/version.hpp"

namespace {

using namespace whirl;

/// What ranks must have in common, and where they run.
struct Identity {
  std::string host;
  std::string program_version;
  std::uint64_t program = 0;  ///< FNV-1a of the bytes of this program
  std::string mathematics;
  std::vector<std::string> sets;  ///< instruction sets that it may compute with, the best first
};

template <class Bytes>
void travel(Bytes& bytes, Is<Identity> auto& identity) {
  auto& [host, program_version, program, mathematics, sets] = identity;
  bytes(host, program_version, program, mathematics, sets);
}

/// The last value of --isa in the words of a process; empty: there is none.
std::string asked_set(const std::vector<std::string>& words) {
  std::string asked;
  for (std::size_t i = 0; i < words.size(); ++i) {
    constexpr std::string_view option = "--isa";
    if (words[i] == option && i + 1 < words.size()) asked = words[i + 1];
    if (words[i].starts_with("--isa=")) asked = words[i].substr(option.size() + 1);
  }
  return asked;
}

/// The bytes of this program in short.
std::uint64_t program_digest() {
  std::uint64_t digest = digest_of("");
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::string block(1 << 16, '\0');
  while (program.read(block.data(), static_cast<std::streamsize>(block.size())),
         program.gcount() > 0) {
    digest = digest_of({block.data(), static_cast<std::size_t>(program.gcount())}, digest);
  }
  return digest;
}

/// @param asked  instruction set that it is to compute with at best; empty: the best that it has
Identity own_identity(const std::string& asked) {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  std::vector<std::string> sets = instruction_sets();
  sets.erase(sets.begin(),
             asked.empty() ? sets.begin() : std::find(sets.begin(), sets.end(), asked));
  return {host, version, program_digest(), mathematics(), sets};
}

/// The best instruction set that all ranks have; empty: there is none.
std::string common_set(const std::vector<Identity>& all) {
  for (const std::string& set : all[0].sets) {
    const auto has_it = [&](const Identity& rank) {
      return std::find(rank.sets.begin(), rank.sets.end(), set) != rank.sets.end();
    };
    if (std::all_of(all.begin(), all.end(), has_it)) return set;
  }
  return "";
}

/// Why ranks cannot work together; empty: they can.
std::string mismatch(const std::vector<Identity>& all) {
  const Identity& first = all[0];
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Identity& other = all[i];
    if (other.program != first.program || other.program_version != first.program_version) {
      return fmt::format(
          "rank {} on {} runs another program (whirl-mpi {}) than rank 0 on {} (whirl-mpi {}); all "
          "must be copies of one file",
          i, other.host, other.program_version, first.host, first.program_version);
    }
    if (other.mathematics != first.mathematics) {
      return fmt::format(
          "rank {} on {} has other mathematical functions ({}) than rank 0 on {} ({}), whose last "
          "digits differ; --isa baseline takes those that all processors have, and one image of "
          "the system for all ranks the same library",
          i, other.host, other.mathematics, first.host, first.mathematics);
    }
  }
  if (common_set(all).empty()) return "--isa: the ranks have no such instruction set in common";
  return "";
}

/// The words of the line as whirl has them: results do not tell which of the programs made them.
std::vector<std::string> whirl_words(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  constexpr std::string_view more = "-mpi";
  if (words[0].ends_with(more)) words[0].resize(words[0].size() - more.size());
  return words;
}

/// What this process does among the others; its exit status.
int work(MpiProcess& process, const std::vector<std::string>& words) {
  const Ranks& ranks = process.ranks();
  std::vector<Identity> all;
  for (const std::string& bytes : process.gather(packed(own_identity(asked_set(words))))) {
    unpack(bytes, all.emplace_back());
  }
  if (const std::string why = mismatch(all); !why.empty()) {
    if (ranks.leads()) say(stderr, fmt::format("whirl-mpi: {}\n", why));
    return exit_status::wrong_input;
  }
  use_instruction_set(common_set(all));
  if (!ranks.leads()) {
    serve_program(ranks);
    process.end();
    return exit_status::done;
  }
  const int status = run_program(words, ranks.count > 1 ? &ranks : nullptr);
  std::fflush(stdout);  // before an end at once
  using std::chrono::seconds;
  process.end_others(status, status == exit_status::done ? seconds(60) : seconds(10));
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  fill_standard_streams();
  try {
    // for which the program may start again: not once MPI has begun
    if (asked_set({argv, argv + argc}) == baseline_set) adopt_arithmetic(std::string(baseline_set));
    MpiProcess process(argc, argv);
    remove_passing_files_at_signals(exit_status::stopped);  // where MPI does nothing itself
    try {
      return work(process, whirl_words(argc, argv));
    } catch (const std::exception& error) {
      say(stderr, fmt::format("whirl-mpi: rank {}: {}\n", process.ranks().rank, error.what()));
      MpiProcess::abort(exit_status::failed);
    }
  } catch (const std::exception& error) {
    say(stderr, fmt::format("whirl-mpi: {}\n", error.what()));
    return exit_status::failed;
  }
}
