#include "libverbs/options/motion_view.hpp"

namespace whirl::inline cli {

MotionView view_of(const MotionViewVerbOptions& options) {
  MotionView view{.at = options.at.value_or({}),
                  .orders = options.order.value_or({}),
                  .band = options.band.value,
                  .is_averaged = options.average,
                  .slow_roll = options.slow_roll.value,
                  .clearance = options.clearance.value};
  const auto name = [&](const auto& option) {
    if (option.is_given) view.given.emplace_back(option.name, option.text);
  };
  name(options.at);
  name(options.order);
  name(options.band);
  name(options.slow_roll);
  name(options.clearance);
  if (options.average) view.given.emplace_back(options.average.name, "");
  return view;
}

}  // namespace whirl::inline cli
