// Ranks that work together: what all must know, errors of others, and how long one waits.

#include "libbase/processes/ranks.hpp"

#include <new>

#include "libbase/error.hpp"
#include "tests/support/post.hpp"

namespace whirl::ranks_test {

TEST(Ranks, AllGetWhatTheLeaderMakes) {
  test::Post post(3);
  std::vector<std::string> got(3);
  {
    std::vector<std::jthread> others;
    for (const int rank : {1, 2}) {
      others.emplace_back([&, rank] {
        const Ranks ranks = post.ranks(rank);
        got[static_cast<std::size_t>(rank)] = ranks.share([] { return std::string("mine"); });
        EXPECT_THROW(ranks.share({}), WorkIsDone);
      });
    }
    const Ranks leader = post.ranks(0);
    got[0] = leader.share([] { return std::string("the text"); });
    for (const int rank : {1, 2}) leader.send({rank, LetterKind::end});
  }
  EXPECT_EQ(got, std::vector<std::string>(3, "the text"));
}

/// What an error is in another process.
template <class Error>
void throw_again(const Error& error) {
  throw_packed(packed_error(std::make_exception_ptr(error)), 3);
}

TEST(Ranks, ErrorsKeepTheirKindAndPlace) {
  try {
    throw_again(ModelError({{{"a.toml", 3, 7}, "body.mass", "is negative"}, {{}, "x", "too"}}));
    FAIL();
  } catch (const ModelError& error) {
    ASSERT_EQ(error.problems().size(), 2u);
    EXPECT_EQ(error.problems()[0].where, (Where{"a.toml", 3, 7}));
    EXPECT_EQ(error.problems()[0].key, "body.mass");
    EXPECT_EQ(error.problems()[1].message, "too");
  }
  EXPECT_THROW(throw_again(std::bad_alloc()), std::bad_alloc);
  try {
    throw_again(NumericalError("no orbit"));
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_STREQ(error.what(), "no orbit");
  }
  try {
    throw_again(std::runtime_error("cannot open"));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "rank 3: cannot open");
  }
}

// It looks again at once for a while, then ever later, but never later than seven milliseconds.
TEST(Ranks, WhoWaitsLooksEverLater) {
  Patience patience;
  std::chrono::microseconds last{0};
  for (int look = 0; look < 200; ++look) {
    const auto next = patience.next();
    EXPECT_GE(next, last);
    if (look < 60) {
      EXPECT_EQ(next.count(), 0);
    }
    last = next;
  }
  EXPECT_GE(last, std::chrono::milliseconds(4));
  EXPECT_LE(last, std::chrono::milliseconds(7));
  patience.begin_anew();
  EXPECT_EQ(patience.next().count(), 0);
}

// Time in which nobody looked is no silence, but for a second of it.
TEST(Ranks, SilenceIsTheTimeOfLooking) {
  Silence silence;
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  const auto lasts = silence.look();
  EXPECT_EQ(lasts, std::chrono::seconds(1));
  silence.hear();
  EXPECT_LT(silence.look(), std::chrono::seconds(1));
}

}  // namespace whirl::ranks_test
