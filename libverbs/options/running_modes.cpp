#include "libverbs/options/running_modes.hpp"

namespace whirl::inline cli {

std::optional<RunningModes> find_running_modes(RunningModesVerbOptions asked,
                                               const Measurement& measurement,
                                               const MeasuredIdentification& measured,
                                               const Assembler& assembler) {
  if (!asked.running_modes) {
    for_each_option(asked, [](const auto& option) {
      if (option.is_given) throw option.wrong("is for --running-modes");
    });
    return std::nullopt;
  }
  RunningModes found =
      running_modes(measurement.readings, {.most_frequency = asked.highest.value_or(0.0),
                                           .block_rows = asked.block_rows.value_or(0),
                                           .most_order = asked.order.value_or(0),
                                           .speed = measurement.model.speed,
                                           .harmonics = *asked.speed_harmonics,
                                           .removes_harmonics = !asked.keep_harmonics});
  compare(found, measured, measurement.readings, assembler);
  return found;
}

}  // namespace whirl::inline cli
