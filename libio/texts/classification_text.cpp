#include "libio/texts/classification_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libio/texts/motion_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

constexpr long longer = 4;  ///< times the revolutions, that halve what chance leaves of a mean

std::string plural(long n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// What would tell a motion that has not settled.
std::string what_settles(const Classification& c) {
  std::string text = fmt::format(
      "  means over sections still change by {:.2g} of their spread from one half of them to the "
      "other\n",
      c.drift.change);
  if (c.settles_after > 0) {
    return text + fmt::format("  would settle in about {} revolutions: --discard {}\n",
                              c.settles_after, c.settles_after);
  }
  return text + fmt::format("  without a steady decay: --revolutions {} would tell more\n",
                            longer * c.revolutions);
}

/// Why it is so.
std::string evidence(const Classification& c, double revolution) {
  const double largest = c.exponents(0);
  if (c.is_free) {
    return fmt::format(
        "  no contact can happen any more: the orbit is the linear rotor's; its largest multiplier "
        "is {:.6f} a revolution\n",
        std::exp(largest));
  }
  if (c.is_proven) {
    return fmt::format(
        "  Newton's method found the orbit, to {:.0e} length scales; its largest multiplier is "
        "{:.6f} a revolution\n",
        c.residual, std::exp(largest));
  }
  std::string text = fmt::format(
      "  largest exponent {:+.4f} a revolution ({:+.3f} 1/s), mean of {}; known to {:.4f} (99 of "
      "100), within {:.4f} it would count as zero\n",
      largest, largest / revolution, c.revolutions, c.resolution, c.zero);
  if (c.kind == MotionKind::not_settled) text += what_settles(c);
  if (c.section_dimension < 1e9) {
    text += fmt::format("  sections at phase 0 lie on a set of dimension {:.2f}{}\n",
                        c.section_dimension,
                        std::abs(c.section_dimension - 1.0) < 0.1 ? ", a closed curve" : "");
  }
  return text;
}

std::string kind_text(const Classification& c) {
  std::string text = fmt::format("  {}", name_of(c.kind));
  if (c.period > 0 && c.kind != MotionKind::equilibrium) {
    text += fmt::format(", repeats after {}", plural(c.period, "revolution"));
  }
  if (c.period_time > 0.0) {
    text += fmt::format("{} after {:.6g} s", c.period > 0 ? ", and" : ", repeats", c.period_time);
  }
  if (!c.contacts.empty()) {
    text += fmt::format("; {} in {}", plural(static_cast<long>(c.impacts()), "impact"),
                        plural(c.revolutions, "revolution"));
  }
  if (c.contacts.size() > 1) {  // p/n of each, as the literature has it
    for (const ContactMeasure& m : c.contacts) {
      text += fmt::format(", {} {:.0f}/{}", m.name, m.impacts, c.revolutions);
    }
  }
  return text + "\n";
}

}  // namespace

std::string text_of(const ClassificationResult& result) {
  const Classification& c = result.of;
  if (c.outcome == Outcome::stopped_by_observer) {
    return fmt::format("  stopped after {}, before the kind was known\n",
                       plural(c.revolutions, "averaged revolution"));
  }
  if (!result.is_known()) return "";
  const std::vector<double> exponents(c.exponents.begin(), c.exponents.end());
  std::string text =
      kind_text(c) + evidence(c, result.revolution) + "\n" +
      table_of(
          exponents,
          {row_number("exponent"),
           {"per revolution", [](double e) { return fmt::format("{:+.6f}", e); }},
           {"[1/s]", [&](double e) { return fmt::format("{:+.4f}", e / result.revolution); }}});
  if (!c.contacts.empty()) text += "\n" + contacts_table(c.contacts, c.revolutions);
  return text;
}

}  // namespace whirl::inline io
