#include "libio/model/model_slopes.hpp"

namespace whirl::inline io {

std::vector<SystemSlope> slopes_of(const ModelFamily& family, std::span<const ParameterAxis> axes,
                                   const Scene& scene, std::span<const double> values) {
  std::vector<SystemSlope> slopes;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    slopes.push_back(slope_of(axes[i].path, scene, values[i], 0.0, [&](double value) {
      std::vector<double> changed(values.begin(), values.end());
      changed[i] = value;
      return family.model(changed);
    }));
  }
  return slopes;
}

}  // namespace whirl::inline io
