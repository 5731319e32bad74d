#include "libbase/processes/ranks.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <new>
#include <thread>

#include "libbase/error.hpp"
#include "libbase/structs/travel.hpp"

namespace whirl::inline base {

namespace {

enum class ErrorKind { model, numerical, memory, other };

}  // namespace

std::string Ranks::share(const std::function<std::string()>& make) const {
  if (leads()) {
    std::string text = make();
    for (int other = 1; other < count; ++other) send({other, LetterKind::share, text});
    return text;
  }
  for (Patience waiting;;) {
    std::optional<Letter> letter = receive();
    if (!letter) {
      std::this_thread::sleep_for(waiting.next());
      continue;
    }
    if (letter->kind == LetterKind::share) return std::move(letter->bytes);
    if (letter->kind == LetterKind::end) throw WorkIsDone{};
  }
}

LostRank::LostRank(int rank, std::chrono::milliseconds silence)
    : std::runtime_error(
          fmt::format("rank {} has been silent for {} s: it is lost; the same line goes on from "
                      "what is saved",
                      rank, silence.count() / 1000)) {}

std::chrono::microseconds Patience::next() {
  using std::chrono::microseconds;
  constexpr int at_once = 64, doublings = 7;  // 50 us to 6.4 ms
  if (looks_++ < at_once) {
    sched_yield();
    return microseconds(0);
  }
  return microseconds(50) * (1 << std::min(looks_ - at_once, doublings));
}

std::chrono::milliseconds Silence::look() {
  const auto now = clock::now();
  lasts_ += std::min<clock::duration>(now - last_, std::chrono::seconds(1));
  last_ = now;
  return std::chrono::duration_cast<std::chrono::milliseconds>(lasts_);
}

std::string packed_error(const std::exception_ptr& error) {
  const std::vector<Problem> none;
  try {
    std::rethrow_exception(error);
  } catch (const ModelError& wrong) {
    return packed(ErrorKind::model, std::string(wrong.what()), wrong.problems());
  } catch (const NumericalError& failed) {
    return packed(ErrorKind::numerical, std::string(failed.what()), none);
  } catch (const std::bad_alloc&) {
    return packed(ErrorKind::memory, std::string(), none);
  } catch (const std::exception& other) {
    return packed(ErrorKind::other, std::string(other.what()), none);
  }
}

void throw_packed(std::string_view error, int rank) {
  ErrorKind kind{};
  std::string text;
  std::vector<Problem> problems;
  unpack(error, kind, text, problems);
  switch (kind) {
    case ErrorKind::model:
      throw ModelError(std::move(problems));
    case ErrorKind::numerical:
      throw NumericalError(text);
    case ErrorKind::memory:
      throw std::bad_alloc();
    default:
      throw std::runtime_error(fmt::format("rank {}: {}", rank, text));
  }
}

}  // namespace whirl::inline base
