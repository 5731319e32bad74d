#include "libio/measured/model_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "libbase/error.hpp"
#include "libdata/measured/record_doubts.hpp"
#include "libdyn/system/corrected_scene.hpp"
#include "libdyn/system/system_slope.hpp"
#include "libio/model/model_family.hpp"

namespace whirl::inline io {

namespace {

std::vector<double> starts_of(const FreeParameters& free) {
  std::vector<double> starts;
  for (const FreeParameter& p : free.parameters) starts.push_back(p.start);
  return starts;
}

/// At the starts, with shapes that follow the parameters.
std::shared_ptr<const Scene> scene_for(const ModelFamily& family, const FreeParameters& free) {
  const std::vector<double> starts = starts_of(free);
  std::vector<Model> others;
  for (std::size_t p = 0; p < starts.size(); ++p) {
    std::vector<double> other = starts;
    other[p] += largest_step * free.parameters[p].size;
    others.push_back(family.model(other));
  }
  return std::make_shared<const Scene>(
      corrected_scene(*family.scene(starts), family.model(starts), others));
}

/// @throws OptionError  where a record sets what is to be found
void require_free(const RecordSource& source, const FreeParameters& free) {
  for (const std::string& set : source.sets) {
    const std::string path = set.substr(0, set.find('='));
    for (const ParameterAxis& axis : free.axes) {
      if (!axis.has(path)) continue;
      throw OptionError(fmt::format(
          "sets {}, which is to be found: expected it to be free, or set by records, not both",
          path));
    }
  }
}

FitMeasurement fit_measurement(const Model& model, const FreeParameters& free,
                               const SourcedRecord& record, const FitWindow& window,
                               std::vector<std::string>& notes) {
  const RecordSource& source = record.source;
  require_free(source, free);
  Measurement m = measurement_of(model_for(model, source), record);
  if (m.readings.probes.empty()) {
    throw OptionError("no probes read it: give --probes FILE.toml, or the model a [[probe]]");
  }
  FitMeasurement found;
  found.name = std::filesystem::path(source.file).filename().string();
  notes.insert(notes.end(), m.readings.notes.begin(), m.readings.notes.end());
  found.span = fit_span(m.readings, m.model.speed, window.from, window.revolutions, notes);
  found.readings = std::move(m.readings);
  const std::string speed = fmt::format("operation.speed={:.17g} rad/s", found.span.speed);
  const auto family = std::make_shared<const ModelFamily>(with_values(m.model, {speed}), free.axes);
  found.scene = scene_for(*family, free);
  const ProbeReadings fitted{
      .rate = found.readings.rate,
      .probes = found.readings.probes,
      .displacement = found.readings.displacement.middleRows(found.span.first, found.span.samples),
      .clock = found.readings.clock};
  add_doubts(fitted, found.scene->assembler, found.span.speed, notes);
  found.model_at = [family](const Vec& values) {
    return family->model({values.data(), static_cast<std::size_t>(values.size())});
  };
  return found;
}

/// @param notes  receives what is odd about the records
std::vector<FitMeasurement> fit_measurements(const Model& model, const FreeParameters& free,
                                             const std::vector<SourcedRecord>& records,
                                             const FitWindow& window,
                                             std::vector<std::string>& notes) {
  std::vector<FitMeasurement> all;
  for (const SourcedRecord& record : records) {
    std::vector<std::string> own;
    try {
      all.push_back(fit_measurement(model, free, record, window, own));
    } catch (const OptionError& error) {
      throw OptionError(record.source.file + ": " + error.what());
    }
    for (std::string& note : own) {
      if (records.size() > 1) note = all.back().name + ": " + note;
      if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    }
  }
  return all;
}

/// As their records begin, in the shapes of the fit.
std::vector<FittedMotion> motions_of(const MeasuredFit& found,
                                     const std::vector<FitMeasurement>& measurements) {
  Vec values(std::ssize(found.parameters));
  for (Eigen::Index p = 0; p < values.size(); ++p) {
    values(p) = found.parameters[static_cast<std::size_t>(p)].value;
  }
  std::vector<FittedMotion> motions;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const FitMeasurement& m = measurements[i];
    Model model = m.model_at(values);
    Scene scene = *m.scene;
    scene.contacts = in_shapes_of(*m.scene, model);
    motions.push_back({m.name, std::move(model), std::move(scene), found.records[i].start});
  }
  return motions;
}

}  // namespace

ModelFit fit_model(const Model& model, const FreeParameters& free,
                   const std::vector<SourcedRecord>& records, const FitWindow& window,
                   const MeasuredFitOptions& options) {
  std::vector<std::string> notes;
  const auto measurements = fit_measurements(model, free, records, window, notes);
  MeasuredFit found = fit(measurements, free.parameters, options);
  found.notes.insert(found.notes.begin(), notes.begin(), notes.end());
  std::vector<FittedMotion> motions = motions_of(found, measurements);
  return {std::move(found), std::move(motions)};
}

}  // namespace whirl::inline io
