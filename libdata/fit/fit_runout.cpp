#include "libdata/fit/fit_runout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline data {

void RunoutTerms::assign(const std::vector<Probe>& probes, FitRecord& record) {
  record.runout_orders = orders_;
  for (const Probe& probe : probes) {
    auto at = std::ranges::find(probes_, probe.name);
    if (at == probes_.end()) at = probes_.insert(at, probe.name);
    record.runout_of.push_back(at - probes_.begin());
  }
}

std::vector<FreeParameter> RunoutTerms::parameters(double size) const {
  std::vector<FreeParameter> all;
  for (const std::string& probe : probes_) {
    for (int order = 1; order <= orders_; ++order) {
      for (const char* part : {"cosine", "sine"}) {
        all.push_back({.path = fmt::format("runout of {} at {}X, {}", probe, order, part),
                       .unit = "m",
                       .size = size});
      }
    }
  }
  return all;
}

std::vector<FittedRunout> RunoutTerms::vectors(const Vec& values, const Vec& deviations) const {
  std::vector<FittedRunout> all;
  Eigen::Index at = 0;
  for (const std::string& probe : probes_) {
    for (int order = 1; order <= orders_; ++order, at += 2) {
      const double cosine = values(at), sine = values(at + 1);
      all.push_back({.probe = probe,
                     .order = order,
                     .amplitude = std::hypot(cosine, sine),
                     .phase = std::atan2(-sine, cosine),
                     .standard_deviation = deviations.segment<2>(at).norm() / std::sqrt(2.0)});
    }
  }
  return all;
}

Eigen::RowVectorXd runout_functions(const FitRecord& record, double angle) {
  Eigen::RowVectorXd functions(2 * record.runout_orders);
  for (int order = 1; order <= record.runout_orders; ++order) {
    functions(2 * order - 2) = std::cos(order * angle);
    functions(2 * order - 1) = std::sin(order * angle);
  }
  return functions;
}

Eigen::Index first_runout(const FitRecord& record, Eigen::Index probe) {
  return 2 * record.runout_orders * record.runout_of[static_cast<std::size_t>(probe)];
}

double runout_at(const FitRecord& record, const Vec& runout, Eigen::Index probe, double angle) {
  if (record.runout_orders == 0) return 0.0;
  const Eigen::RowVectorXd functions = runout_functions(record, angle);
  return functions * runout.segment(first_runout(record, probe), functions.size());
}

}  // namespace whirl::inline data
