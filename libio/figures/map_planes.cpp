#include "libio/figures/map_planes.hpp"

namespace whirl::inline io::figures {

namespace {

Paint paint_of(MotionKind kind) {
  switch (kind) {
    case MotionKind::equilibrium:
      return Paint::rest;
    case MotionKind::periodic:
      return Paint::longer;
    case MotionKind::quasi_periodic:
      return Paint::quasi_periodic;
    case MotionKind::chaotic:
      return Paint::chaotic;
    case MotionKind::hyperchaotic:
      return Paint::hyperchaotic;
    case MotionKind::not_settled:
      return Paint::not_settled;
  }
  return Paint::failed;
}

constexpr int told_periods = 8;  ///< that have a color of their own

}  // namespace

const std::vector<Category>& motions() {
  static const std::vector<Category> all = [] {
    std::vector<Category> list;
    for (const auto& [name, kind] : choices(MotionKind{})) {
      if (kind != MotionKind::periodic) {
        list.push_back({std::string(name), paint_of(kind)});
        continue;
      }
      for (int p = 1; p <= told_periods; ++p) {
        const int paint = static_cast<int>(Paint::period_1) + p - 1;
        list.push_back({fmt::format("period {}", p), static_cast<Paint>(paint)});
      }
      list.push_back({"longer period", Paint::longer});
    }
    list.push_back({"failed", Paint::failed});
    return list;
  }();
  return all;
}

double motion_number(std::optional<MotionKind> kind, int period) {
  if (!kind) return static_cast<double>(motions().size() - 1);
  const auto number = static_cast<int>(*kind), periodic = static_cast<int>(MotionKind::periodic);
  if (number < periodic) return number;
  if (number > periodic) return number + told_periods;
  return periodic + (period >= 1 && period <= told_periods ? period - 1 : told_periods);
}

}  // namespace whirl::inline io::figures
