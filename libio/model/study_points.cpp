#include "libio/model/study_points.hpp"

#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::inline io {

StudyPoints::StudyPoints(Model model, std::vector<ParameterAxis> axes,
                         std::optional<EarlierEnd> earlier)
    : model_(std::move(model)),
      axes_(std::move(axes)),
      family_(model_, axes_),
      earlier_(std::move(earlier)) {
  ParameterGrid ends;
  for (const ParameterAxis& a : axes_) {
    grid_.axes.push_back(a.values);
    ends.axes.push_back({a.values.front(), a.values.back()});
  }
  // what is wrong at the ends is said before the work
  for (std::size_t i = 0; i < ends.points(); ++i) require_speed(family_.model(ends.values_at(i)));
}

StudyModels StudyPoints::models() const {
  return {.member =
              [this](std::span<const double> values) {
                StudyMember member{.model = family_.model(values), .scene = nullptr};
                member.scene = family_.scene(member.model);
                return member;
              },
          .start =
              [this](const StudyMember& member, const FullState* from) {
                const FullState* start = from ? from : earlier_ ? &earlier_->state : nullptr;
                if (!start) return family_.start(member.model, *member.scene, nullptr);
                Model model = member.model;
                model.start.from = StartFrom::file;
                model.start.whirl.clear();
                MotionState state = family_.start(model, *member.scene, start);
                if (from) return state;
                state.phase = earlier_->phase;
                const bool is_same_again = member.scene->contacts.repeats_after() == 1;
                if (!is_same_again) state.revolution = earlier_->revolution;
                return state;
              }};
}

StudyMember StudyPoints::first() const {
  try {
    return models().member(grid_.values_at(0));
  } catch (const NumericalError& error) {
    throw NumericalError((axes_.empty() ? "" : describe(0) + ": ") + error.what());
  }
}

Model StudyPoints::model_at(std::size_t point) const {
  return axes_.empty() ? model_ : family_.model(grid_.values_at(point % grid_.points()));
}

std::string StudyPoints::describe(std::size_t point) const {
  const std::vector<std::size_t> indices = grid_.indices_of(point);
  std::string text;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    text +=
        fmt::format("{}{} = {:.10g}{}{}", text.empty() ? "" : ", ", axes_[i].path,
                    axes_[i].values[indices[i]], axes_[i].unit.empty() ? "" : " ", axes_[i].unit);
  }
  return text;
}

}  // namespace whirl::inline io
