// What handing out pieces costs: mpirun -n 2 build/release/bin/whirl_ranks BYTES PIECES
//
// Pieces of one point that cost nothing, with a row of so many bytes, all computed in the other
// ranks; prints how many come back to the leader in a second.

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "apps/mpi/mpi_process.hpp"
#include "libdyn/studies/point_runner.hpp"

namespace {

using namespace whirl;

struct Result {
  PointRows<std::vector<double>> points;
};

Result run(const Ranks& ranks, std::size_t bytes, std::size_t pieces) {
  Result result{.points = PointRows<std::vector<double>>(pieces)};
  PointWork<std::vector<double>> work{.pieces = {}, .most_together = 1};
  for (std::size_t i = 0; i < pieces; ++i) work.pieces.push_back({i});
  work.prepare = [](const auto&) { return NothingGiven{}; };  // by the one thread of the leader
  work.compute = [&](const auto& piece, NothingGiven&) {
    return std::vector(piece.size(), std::vector<double>(bytes / sizeof(double), 1.0));
  };
  run_points(work, result, Monitor<Result>{.ranks = &ranks});
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  MpiProcess process(argc, argv);
  const Ranks& ranks = process.ranks();
  const std::size_t bytes = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 192;
  const std::size_t pieces = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 100'000;
  try {
    const auto begin = std::chrono::steady_clock::now();
    run(ranks, bytes, pieces);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    fmt::print("{} ranks, rows of {} bytes: {:.0f} pieces/s\n", ranks.count, bytes,
               static_cast<double>(pieces) / taken.count());
    process.end_others(0, std::chrono::seconds(10));
  } catch (const WorkIsDone&) {
    process.end();
  }
  return 0;
}
