// The program of several processes: mpirun -n 4 whirl-mpi map ...

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>

#include "apps/mpi/mpi_process.hpp"
#include "apps/program.hpp"
#include "apps/run_program.hpp"
#include "libbase/travel.hpp"
#include "libio/text/terminal.hpp"

namespace {

using namespace whirl;

/// What ranks must have in common, and where they run.
struct Identity {
  std::string host;
  std::string program_version;
  std::uint64_t program = 0;  ///< FNV-1a of the bytes of this program
};

template <class Bytes>
void travel(Bytes& bytes, Is<Identity> auto& identity) {
  auto& [host, program_version, program] = identity;
  bytes(host, program_version, program);
}

Identity own_identity() {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  Identity identity{host, version, 14695981039346656037u};
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::string block(1 << 16, '\0');
  while (program.read(block.data(), static_cast<std::streamsize>(block.size())),
         program.gcount() > 0) {
    for (std::streamsize i = 0; i < program.gcount(); ++i) {
      identity.program ^= static_cast<unsigned char>(block[static_cast<std::size_t>(i)]);
      identity.program *= 1099511628211u;
    }
  }
  return identity;
}

/// Why ranks cannot work together; empty: they can.
std::string mismatch(const std::vector<std::string>& identities) {
  std::vector<Identity> all(identities.size());
  for (std::size_t i = 0; i < all.size(); ++i) unpack(identities[i], all[i]);
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].program == all[0].program && all[i].program_version == all[0].program_version)
      continue;
    return fmt::format(
        "rank {} on {} runs another program (whirl-mpi {}) than rank 0 on {} (whirl-mpi {}); all "
        "must be copies of one file",
        i, all[i].host, all[i].program_version, all[0].host, all[0].program_version);
  }
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
  if (const std::string why = mismatch(process.gather(packed(own_identity()))); !why.empty()) {
    if (ranks.leads()) fmt::print(stderr, "whirl-mpi: {}\n", why);
    return exit_status::wrong_input;
  }
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
    MpiProcess process(argc, argv);
    try {
      return work(process, whirl_words(argc, argv));
    } catch (const std::exception& error) {
      fmt::print(stderr, "whirl-mpi: rank {}: {}\n", process.ranks().rank, error.what());
      MpiProcess::abort(exit_status::failed);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "whirl-mpi: {}\n", error.what());
    return exit_status::failed;
  }
}
