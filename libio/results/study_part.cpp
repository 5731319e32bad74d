#include "libio/results/study_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include "libbase/error.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/study_columns.hpp"
#include "libio/text/option_values.hpp"

namespace whirl::inline io {

namespace {

/// A whole number from one; nothing if a text is none.
std::optional<std::size_t> number_in(std::string_view text) {
  constexpr std::size_t most = 1'000'000;  // each part has one point at least
  std::size_t number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc{} || end != text.data() + text.size() || number == 0 || number > most) {
    return std::nullopt;
  }
  return number;
}

}  // namespace

Parsed<Stripe> parse_stripe(std::string_view text) {
  const auto slash = text.find('/');
  const auto number = number_in(text.substr(0, slash));
  const auto of = slash == text.npos ? std::nullopt : number_in(text.substr(slash + 1));
  if (!number || !of || *number > *of) {
    return Parsed<Stripe>::failed(
        "expected the number of a part and how many there are, up to a million, such as 3/40");
  }
  return Stripe{*number, *of};
}

Stripe stripe_named(const std::string& part) {
  if (part.empty()) return {};
  const auto stripe = parse_stripe(part);
  if (!stripe) throw wrong_option("part", part, stripe.problem);
  return *stripe;
}

Stripe stripe_of(const Call& call) {
  const auto given = options_named(call.options, {"part"});
  return stripe_named(given.empty() ? "" : given.back().substr(std::string("--part=").size()));
}

Call without_part(Call call) {
  call.options = options_without(call.options, {"part"});
  return call;
}

std::filesystem::path part_place(const std::filesystem::path& whole, const Stripe& stripe) {
  if (stripe.is_all()) return whole;
  std::filesystem::path place = whole;
  return place.replace_filename(fmt::format("{}.part{}of{}{}", whole.stem().string(), stripe.number,
                                            stripe.of, whole.extension().string()));
}

std::vector<std::string> missing_parts(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> missing;
  std::set<std::size_t> parts, given;
  for (const auto& file : files) {
    const ResultReader result(file);
    const Call call = read_call(result);
    const Stripe stripe = stripe_of(call);
    parts.insert(stripe.of);
    given.insert(stripe.number);
    const std::string group = '/' + call.verb;
    const std::size_t points = study_columns::stored_points(result, group);
    const std::vector<bool> done = study_columns::read_done(result, group, points);
    const auto count = static_cast<std::size_t>(std::count(done.begin(), done.end(), true));
    const std::size_t wanted = stripe.points(points);
    if (count >= wanted) continue;
    missing.push_back(fmt::format("part {}/{} ({} of {} points)", stripe.number, stripe.of,
                                  wanted - count, wanted));
  }
  if (parts.size() != 1) return missing;  // of several cuts: what nobody has is not told by parts
  for (std::size_t number = 1; number <= *parts.begin(); ++number) {
    if (!given.contains(number)) {
      missing.push_back(fmt::format("part {}/{} (all)", number, *parts.begin()));
    }
  }
  return missing;
}

}  // namespace whirl::inline io
