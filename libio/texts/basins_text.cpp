#include "libio/texts/basins_text.hpp"

#include <fmt/format.h>

#include "libbase/numerics/constants.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

std::string regimes_text(const Attractor& a) {
  std::string regimes;
  for (const Regime r : a.regimes) {
    regimes += (regimes.empty() ? "" : ", ") + std::string(name_of(r));
  }
  return regimes.empty() ? "-" : regimes;
}

}  // namespace

std::string text_of(const BasinShares& shares) {
  std::vector<Attractor> rows = shares.attractors;
  for (const UnsettledStarts& unsettled : shares.unsettled) {
    Attractor open{{.motion = MotionKind::not_settled}};
    open.share = unsettled.share;
    open.regimes = unsettled.regimes;
    open.impacts_per_rev = nan;
    rows.push_back(std::move(open));
  }
  return table_of(rows,
                  {shown("motion"),
                   {"share of starts",
                    [](const Attractor& a) { return fmt::format("{:.2f} %", 100.0 * a.share); }},
                   shown("period_revs").as("period"),
                   {"contacts", regimes_text},
                   shown("impacts_per_rev", "", ".4g").as("impacts per revolution"),
                   shown("lyapunov_max", "", "+.4f").as("largest exponent per revolution"),
                   {"first start", [](const Attractor& a) {
                      return a.start.number > 0 ? std::to_string(a.start.number) : "-";
                    }}});
}

}  // namespace whirl::inline io
