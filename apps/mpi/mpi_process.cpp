// The only file that sees MPI.

#include "apps/mpi/mpi_process.hpp"

#include <mpi.h>

#include <climits>
#include <cstdlib>
#include <list>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace whirl::inline cli {

namespace {

void require(int outcome, const char* what) {
  if (outcome == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING];
  int size = 0;
  MPI_Error_string(outcome, text, &size);
  throw std::runtime_error(std::string("MPI cannot ") + what + ": " +
                           std::string(text, text + size));
}

int size_of(const std::string& bytes) {
  if (bytes.size() > INT_MAX) throw std::runtime_error("MPI sends no letter above 2 GB");
  return static_cast<int>(bytes.size());
}

}  // namespace

/// Letters are tagged by their kinds. Those on their way are kept until MPI has them: sending never
/// waits, so that two ranks whose letters are long cannot wait for each other.
struct MpiProcess::Letters {
  struct Sent {
    MPI_Request request = MPI_REQUEST_NULL;
    std::string bytes;
  };
  MPI_Comm world = MPI_COMM_NULL;
  std::list<Sent> sent;

  void send(Letter letter) {
    sweep();
    Sent& next = sent.emplace_back();
    next.bytes = std::move(letter.bytes);
    require(MPI_Isend(next.bytes.data(), size_of(next.bytes), MPI_BYTE, letter.rank,
                      static_cast<int>(letter.kind), world, &next.request),
            "send");
  }

  std::optional<Letter> receive() {
    sweep();
    int is_there = 0, size = 0;
    MPI_Status status;
    require(MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, world, &is_there, &status), "look for letters");
    if (!is_there) return std::nullopt;
    Letter letter{status.MPI_SOURCE, static_cast<LetterKind>(status.MPI_TAG)};
    require(MPI_Get_count(&status, MPI_BYTE, &size), "measure a letter");
    letter.bytes.resize(static_cast<std::size_t>(size));
    require(MPI_Recv(letter.bytes.data(), size, MPI_BYTE, letter.rank, status.MPI_TAG, world,
                     MPI_STATUS_IGNORE),
            "receive");
    return letter;
  }

  /// Forgets what has been taken over.
  void sweep() {
    for (auto i = sent.begin(); i != sent.end();) {
      int is_done = 0;
      require(MPI_Test(&i->request, &is_done, MPI_STATUS_IGNORE), "send");
      i = is_done ? sent.erase(i) : std::next(i);
    }
  }
};

MpiProcess::MpiProcess(int& argc, char**& argv) : letters_(std::make_unique<Letters>()) {
  int provided = 0;
  require(MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided), "begin");
  if (provided < MPI_THREAD_FUNNELED) {
    throw std::runtime_error("this MPI does not go with threads");
  }
  require(MPI_Comm_dup(MPI_COMM_WORLD, &letters_->world), "begin");
  MPI_Comm_set_errhandler(letters_->world, MPI_ERRORS_RETURN);
  MPI_Comm_rank(letters_->world, &ranks_.rank);
  MPI_Comm_size(letters_->world, &ranks_.count);
  ranks_.send = [this](Letter letter) { letters_->send(std::move(letter)); };
  ranks_.receive = [this] { return letters_->receive(); };
}

MpiProcess::~MpiProcess() {
  MPI_Comm_free(&letters_->world);
  MPI_Finalize();
}

std::vector<std::string> MpiProcess::gather(const std::string& own) const {
  const int size = size_of(own), count = ranks_.count;
  std::vector<int> sizes(static_cast<std::size_t>(count)), begins(sizes.size());
  const MPI_Comm world = letters_->world;
  require(MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, world), "gather");
  std::exclusive_scan(sizes.begin(), sizes.end(), begins.begin(), 0);
  std::string all(static_cast<std::size_t>(begins.back() + sizes.back()), '\0');
  require(MPI_Allgatherv(own.data(), size, MPI_CHAR, all.data(), sizes.data(), begins.data(),
                         MPI_CHAR, world),
          "gather");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    texts.push_back(
        all.substr(static_cast<std::size_t>(begins[i]), static_cast<std::size_t>(sizes[i])));
  }
  return texts;
}

void MpiProcess::end_others(int status, std::chrono::milliseconds patience) {
  for (int other = 1; other < ranks_.count; ++other) ranks_.send({other, LetterKind::end});
  const auto enough = std::chrono::steady_clock::now() + patience;
  Patience waiting;
  for (int left = ranks_.count - 1; left > 0 || !letters_->sent.empty();) {
    const auto letter = ranks_.receive();
    if (letter && letter->kind == LetterKind::end) --left;
    if (letter) continue;
    if (std::chrono::steady_clock::now() > enough) abort(status);
    std::this_thread::sleep_for(waiting.next());
  }
}

void MpiProcess::end() {
  ranks_.send({0, LetterKind::end});
  for (Patience waiting; !letters_->sent.empty(); letters_->sweep()) {
    std::this_thread::sleep_for(waiting.next());
  }
}

void MpiProcess::abort(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::abort();
}

}  // namespace whirl::inline cli
