#include "libio/figures/mac_panel.hpp"

#include <fmt/format.h>

#include "libdyn/motions/identify.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io::figures {

std::optional<Panel> mac_panel(const ResultView& result) {
  const std::vector<IdentifiedPeak>& peaks = result_of<Identification>(result).peaks;
  const std::vector<Mode>& modes = result_of<ModesAtPoints>(result).oscillatory;
  const std::size_t columns = peaks.empty() ? 0 : peaks.front().mac.size();
  if (columns == 0) return std::nullopt;
  Panel p;
  p.x.title = with_unit("mode, its frequency", result.frequency);
  p.y.title = with_unit("peak", result.frequency);
  Cells& c = p.cells;
  c.title = "MAC";
  c.prints_values = true;
  for (std::size_t j = 0; j < columns; ++j) {
    c.x.push_back(static_cast<double>(j + 1));
    const Mode& mode = modes.at(j);
    c.x_names.push_back(fmt::format("{}{} {:.1f}", j + 1, whirl_style(mode.whirl).letter,
                                    mode.frequency() * result.frequency.factor));
  }
  for (std::size_t i = peaks.size(); i-- > 0;) {  // the strongest peak on top
    c.y.push_back(static_cast<double>(peaks.size() - i));
    c.y_names.push_back(
        with_minus(fmt::format("{:+.2f}", peaks[i].frequency * result.frequency.factor)));
    c.values.insert(c.values.end(), peaks[i].mac.begin(), peaks[i].mac.end());
  }
  return p;
}

}  // namespace whirl::inline io::figures
