#include "libdyn/linear/unbalance_over.hpp"

#include <exception>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libdyn/system/film_equilibrium.hpp"

namespace whirl::inline dyn {

namespace {

/// The response of one model at its operating speed, at some points; empty without a speed.
UnbalanceResponse at_operation(const Model& model, const Assembler& assembler,
                               const std::vector<Point>& points) {
  if (!model.has_speed || !(model.speed > 0.0)) return {};
  return unbalance_response(assembler, {model.speed}, points);
}

void add_value(const Model& model, const Assembler& assembler,
               const std::vector<NamedPoint>& stations, const std::vector<double>& speeds,
               Eigen::Index k, UnbalanceOver& result) {
  const UnbalanceStudy study = unbalance_study(
      model, assembler, {.speeds = speeds, .stations = stations, .tells_all = false});
  const std::vector<Probe>& probes = assembler.structure().probes;
  std::vector<Point> points;
  for (const NamedPoint& p : stations) points.push_back(p.point);
  for (const Probe& probe : probes) points.push_back(assembler.point(probe.at));
  const UnbalanceResponse there = at_operation(model, assembler, points);
  const auto is_told = there.x.cols() > 0;
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < stations.size(); ++i, ++row) {
    UnbalanceOverStation& of = result.stations[i];
    of.largest(k) = study.largest[i].amplitude;
    of.largest_speed(k) = study.largest[i].speed;
    if (is_told) of.at_operation(k) = Orbit(there.x(row, 0), there.y(row, 0)).major();
  }
  for (std::size_t i = 0; i < result.probes.size(); ++i, ++row) {
    UnbalanceOverProbe& of = result.probes[i];
    of.largest(k) = study.probes[i].largest.peak_to_peak();
    of.largest_speed(k) = study.probes[i].largest.speed;
    if (is_told) {
      of.at_operation(k) =
          2.0 * std::abs(probes[i].reading([&](int c) { return there.at(c)(row, 0); }));
    }
  }
  for (const StationPeak& peak : study.peaks) {
    result.peaks.push_back({peak, result.values[static_cast<std::size_t>(k)]});
  }
}

}  // namespace

UnbalanceOver unbalance_over(const ModelAt& model_at, ParameterName parameter,
                             const std::vector<double>& values,
                             const UnbalanceOverOptions& options) {
  UnbalanceOver result;
  result.parameter = std::move(parameter);
  result.values = values;
  const Vec none = Vec::Constant(std::ssize(values), nan);
  {
    const Model first = model_at(values.front());
    const Assembler assembler(linear_structure(first));
    for (const NamedPoint& p : select_points(first, assembler, options.stations)) {
      result.stations.push_back({p.label(), none, none, none});
    }
    for (const Probe& probe : first.structure.probes) {
      result.probes.push_back({probe, none, none, none});
    }
  }
  std::exception_ptr first;
  const auto add_gap = [&](std::size_t i, const char* why) {
    if (!first) first = std::current_exception();
    result.gaps.push_back({values[i], why});
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    try {
      const Model model = model_at(values[i]);
      const Assembler assembler(linear_structure(model));
      const auto stations = select_points(model, assembler, options.stations);
      if (stations.size() != result.stations.size() ||
          model.structure.probes.size() != result.probes.size()) {
        throw ModelError({}, "", "the value changes which stations there are");
      }
      add_value(model, assembler, stations, options.speeds(model), static_cast<Eigen::Index>(i),
                result);
    } catch (const NumericalError& error) {
      add_gap(i, error.what());
    } catch (const ModelError& error) {
      add_gap(i, error.what());
    }
  }
  if (result.gaps.size() == values.size()) std::rethrow_exception(first);
  return result;
}

}  // namespace whirl::inline dyn
