#include "libdyn/studies/map.hpp"

#include <utility>

#include "libdyn/studies/point_runner.hpp"

namespace whirl::inline dyn {

namespace {

constexpr std::size_t most_points = 256;  ///< in the lanes of one batch

}  // namespace

MapResult map(const StudyModels& models, const MapOptions& options,
              const Monitor<MapResult>& monitor, MapResult earlier) {
  MapResult result = std::move(earlier);
  result.system = study_system(*models.member(options.grid.values_at(0)).scene, options.classify);
  result.points.resize(options.grid.points());
  const ClassifyOptions classify = stopped_by(monitor.stop_asked(), options.classify);
  PointWork<ClassifiedMotion> work{
      .most_together = most_points, .stripe = options.stripe, .threads = options.threads};
  work.compute = [&](const auto& piece, NothingGiven&) {
    std::vector<StudyMotion> motions;
    for (const std::size_t point : piece) {
      motions.push_back(begin_motion(models, options.grid.values_at(point)));
    }
    classify_together(motions, classify);
    std::vector<ClassifiedMotion> rows;
    for (const StudyMotion& motion : motions) rows.push_back(classified(motion));
    return rows;
  };
  run_points(work, result, monitor);
  return result;
}

}  // namespace whirl::inline dyn
