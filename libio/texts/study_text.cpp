#include "libio/texts/study_text.hpp"

#include <fmt/format.h>

namespace whirl::inline io {

namespace {

std::string unsettled_text(const UnsettledMotions& m) {
  const bool is_one = m.motions == 1;
  const std::string text =
      fmt::format("\n  {} motion{} not settled", m.motions, is_one ? " has" : "s have");
  if (m.would_settle == 0) return text + "; more --revolutions would tell what they become\n";
  const std::string after = fmt::format("; --discard {} would settle ", *m.settles_after);
  if (m.would_settle == m.motions) return text + after + (is_one ? "it\n" : "them\n");
  return text + after +
         fmt::format("{}, of others more --revolutions would tell\n", m.would_settle);
}

}  // namespace

std::string text_of(const StudyOutcome& outcome, bool has_file) {
  std::string text;
  if (outcome.unsettled.motions > 0) text += unsettled_text(outcome.unsettled);
  if (outcome.resumed > 0) {
    text +=
        fmt::format("\n  {} of {} points were there already\n", outcome.resumed, outcome.points);
  }
  if (!outcome.is_whole()) {
    text += fmt::format("\n  stopped with {} of {} points{}\n", outcome.done, outcome.points,
                        has_file ? "; the same line goes on from there" : "");
  }
  if (outcome.failure) text += fmt::format("\n  failed: {}\n", outcome.failure.text());
  return text;
}

}  // namespace whirl::inline io
