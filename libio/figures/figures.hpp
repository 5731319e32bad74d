#pragma once
/// The figures that a result file can be drawn as: one place knows what each looks like.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeindex>
#include <unordered_map>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libio/drawing/figure.hpp"
#include "libio/figures/motion_view.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/motion_window.hpp"

namespace whirl::inline io {

/// An open result file with the model that is stored in it.
struct ResultView {
  /// @throws FileError  if it cannot be read, or was not written by this program
  explicit ResultView(const std::filesystem::path& path);

  std::string path;
  ResultReader file;
  std::string title;                   ///< of the model, or the file's name
  std::string model_path;              ///< where the model came from
  std::optional<Model> model;          ///< none: see problem
  std::optional<Assembler> assembler;  ///< of its linear_structure, as linear results are
  std::string problem;  ///< why there is no model, such as a bearing table that is gone
  DisplayUnit frequency{"Hz", 1.0 / hertz};  ///< of frequency axes; speeds are in speed_unit()
  MotionWindow window;  ///< of motions that are drawn in time; left open: their end
  MotionView view;      ///< what figures of motions show; left open: they choose
  std::string probe{};  ///< name of the only probe whose readings are drawn; empty: all
  /// Results that were read of the file, by their types: see result_of.hpp.
  mutable std::unordered_map<std::type_index, std::shared_ptr<const void>> known{};
};

/// A unit for frequency axes: "Hz", "cpm" or "rad/s"; nothing for other names.
std::optional<DisplayUnit> frequency_unit(std::string_view name);

/// A kind of figure; it is described in the file that draws it.
struct FigureKind {
  std::string_view name;
  std::string_view title;  ///< "Bode", above its card on a page
  std::string_view summary;
  Subject subject = Subject::numbers;
  std::vector<std::string> needs{};      ///< datasets, all of which are needed, see dataset_of()
  std::vector<std::string> needs_one{};  ///< datasets, one of which is needed; empty: none of such
  bool needs_model = false;
  std::vector<Figure> (*make)(const ResultView&) =
      nullptr;                            ///< the most telling one first; may be none
  bool takes_window = false;              ///< whether ResultView::window says what is drawn
  std::vector<std::string_view> takes{};  ///< options of ResultView::view that it takes
  /// Of kinds that a model is drawn as without a result.
  std::vector<Figure> (*of_model)(const Model&, const Assembler&) = nullptr;

  /// A dataset that its results have; empty: there is none.
  std::string first_need() const {
    return !needs.empty() ? needs.front() : !needs_one.empty() ? needs_one.front() : "";
  }
};

/// All kinds, in the order of a report. A new kind is a file in figures/ and a line in figures.cpp.
const std::vector<FigureKind>& figure_kinds();

/// Whether a result holds what a kind needs.
bool is_in(const FigureKind& kind, const ResultView& result);

/// The figures of a kind, with kind and title filled in.
std::vector<Figure> figures_of(const FigureKind& kind, const ResultView& result);

/// Lays what `whirl continue` followed over figures of a study: branches over the bifurcation
/// diagram of a sweep along the same value, bifurcation curves over maps of the same two values,
/// either way round.
///
/// @param figures  of one kind of the study; left as they are where the other result does not fit
/// @param name     of the other result, in a note
/// @return         why it does not fit; empty: it does
std::string lay_over(std::vector<Figure>& figures, const ResultView& study, const ResultView& over,
                     const std::string& name);

/// Paths of the values in which the models of two results differ, without those that are varied.
std::vector<std::string> other_values(const ResultView& study, const ResultView& over);

}  // namespace whirl::inline io
