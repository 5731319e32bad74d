#include "libdata/measured/order_model.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/interpolation.hpp"
#include "libdata/measured/measured_identification.hpp"
#include "libdyn/motions/motion_lines.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/unbalance.hpp"

namespace whirl::inline data {

namespace {

constexpr Eigen::Index most_speeds = 400;

/// The curve of the first order of each probe; null: it has none.
std::vector<OrderCurve*> first_orders(OrderTracking& tracking) {
  std::vector<OrderCurve*> curves;
  for (OrderCurve& curve : tracking.curves) {
    if (curve.order == 1.0) curves.push_back(&curve);
  }
  return curves;
}

/// Speeds at which the model is solved, ascending.
std::vector<double> solved_speeds(const Vec& speed) {
  std::vector<double> speeds(speed.begin(), speed.end());
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  if (std::ssize(speeds) <= most_speeds) return speeds;
  const double first = speeds.front(), last = speeds.back();
  speeds.clear();
  for (Eigen::Index k = 0; k < most_speeds; ++k) {
    speeds.push_back(first + (last - first) * static_cast<double>(k) / (most_speeds - 1));
  }
  return speeds;
}

}  // namespace

void add_model_curve(OrderTracking& tracking, const Assembler& assembler,
                     const std::vector<Probe>& probes, ModelScale scale) {
  const std::vector<OrderCurve*> curves = first_orders(tracking);
  if (curves.size() != probes.size()) {
    throw OptionError("model-curve", "is of the order 1, which is not tracked");
  }
  const std::vector<double> speeds = solved_speeds(tracking.speed);
  UnbalanceSolver solver(assembler);
  CMat solved(std::ssize(probes), std::ssize(speeds));
  solved.setConstant(Complex(nan, nan));
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    const auto full = solver.at(speeds[k]);
    if (!full) continue;  // unbounded
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const Point point = assembler.point(probes[i].at);
      solved(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = probes[i].reading(
          [&](int c) -> Complex { return (*full)(solver.dofs().full_index(point, c)); });
    }
  }
  Complex product;
  double square = 0.0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    OrderCurve& curve = *curves[i];
    curve.model.resize(tracking.speed.size());
    std::vector<double> real, imaginary;
    for (Eigen::Index k = 0; k < solved.cols(); ++k) {
      real.push_back(solved(static_cast<Eigen::Index>(i), k).real());
      imaginary.push_back(solved(static_cast<Eigen::Index>(i), k).imag());
    }
    const auto at = [&](const std::vector<double>& values, double speed) {
      return interpolated(std::span<const double>(speeds), std::span<const double>(values), speed,
                          Interpolation::linear);
    };
    for (Eigen::Index k = 0; k < tracking.speed.size(); ++k) {
      const double speed = tracking.speed(k);
      curve.model(k) = {at(real, speed), at(imaginary, speed)};
      if (!std::isfinite(curve.model(k).real())) continue;
      product += std::conj(curve.model(k)) * curve.response(k);
      square += std::norm(curve.model(k));
    }
  }
  if (!(square > 0.0)) {
    throw OptionError("model-curve", "the model has no unbalance that moves the probes");
  }
  const Complex factor = scale == ModelScale::fit ? product / square : Complex(1.0);
  tracking.model_factor = std::abs(factor);
  tracking.model_turn = std::arg(factor);
  for (OrderCurve* curve : curves) curve->model *= factor;
}

void add_shapes(OrderTracking& tracking, const Model& model, const std::vector<Probe>& probes,
                const IdentifyOptions& options) {
  const std::vector<OrderCurve*> curves = first_orders(tracking);
  if (curves.size() != probes.size() || probes.empty()) return;
  Vec squares = Vec::Zero(tracking.speed.size());
  for (const OrderCurve* curve : curves) squares += curve->response.cwiseAbs2();
  const CVec together = squares.cwiseSqrt().cast<Complex>();
  for (const OrderPeak& peak : order_peaks(tracking.speed, together, 0)) {
    Eigen::Index nearest = 0;
    (tracking.speed.array() - peak.speed).abs().minCoeff(&nearest);
    CVec shape(std::ssize(curves));
    for (std::size_t i = 0; i < curves.size(); ++i) {
      shape(static_cast<Eigen::Index>(i)) = curves[i]->response(nearest);
    }
    Model there = model;
    there.speed = peak.speed;
    there.has_speed = true;
    const Scene scene = make_scene(there, ReductionEstimate::no);
    const std::vector<Mode> modes = compared_modes(there, scene, options);
    const CMat read = readings_of(modes, probes, scene);
    Sparse weights(read.rows(), read.rows());
    weights.setIdentity();
    OrderShape found{.speed = peak.speed};
    for (Eigen::Index m = 0; m < read.cols(); ++m) {
      if (read.col(m).cwiseAbs().maxCoeff() < unseen_reading) continue;
      const double alike = mac(shape, read.col(m), weights);
      if (alike <= found.mac) {
        found.second = std::max(found.second, alike);
        continue;
      }
      const Mode& mode = modes[static_cast<std::size_t>(m)];
      found.second = found.mac;
      found.mac = alike;
      found.mode = static_cast<int>(m) + 1;
      found.frequency = mode.frequency();
      found.whirl = name_of(mode.whirl);
    }
    tracking.shapes.push_back(std::move(found));
  }
}

}  // namespace whirl::inline data
