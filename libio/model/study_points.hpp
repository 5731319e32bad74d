#pragma once
/// The points of a study of a model file: its models, and their names.

#include <optional>
#include <string>
#include <vector>

#include "libdyn/motions/start.hpp"
#include "libdyn/studies/parameter_grid.hpp"
#include "libdyn/studies/study_models.hpp"
#include "libio/model/model_family.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

class StudyPoints {
 public:
  /// @param earlier  end of an earlier motion, from which all motions go on; nothing: motions begin
  ///                 at the start of their models
  /// @throws ModelError  if there is no model, or none with a speed, at the ends of the axes
  StudyPoints(Model model, std::vector<ParameterAxis> axes, std::optional<EarlierEnd> earlier);

  const Model& model() const { return model_; }
  const std::vector<ParameterAxis>& axes() const { return axes_; }
  const ParameterGrid& grid() const { return grid_; }
  const std::optional<EarlierEnd>& earlier() const { return earlier_; }

  /// Models at the points; they live no longer than this object.
  StudyModels models() const;
  /// The model at the first point.
  /// @throws NumericalError  that names the point, if the model cannot be computed with
  StudyMember first() const;
  /// The model at a point; points beyond the last one begin again, as those of a sweep's way back.
  Model model_at(std::size_t point) const;
  /// "operation.speed = 136 rad/s, contact.ring.friction = 0.1" of a point.
  std::string describe(std::size_t point) const;

 private:
  Model model_;
  std::vector<ParameterAxis> axes_;
  ParameterGrid grid_;
  ModelFamily family_;
  std::optional<EarlierEnd> earlier_;
};

}  // namespace whirl::inline io
