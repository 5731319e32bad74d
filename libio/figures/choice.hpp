#pragma once
/// The figures that a result can be drawn as, and the choice of one.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libio/drawing/figure_svg.hpp"
#include "libio/figures/figures.hpp"

namespace whirl::inline io {

/// A kind of figure that a result can be drawn as.
struct DrawableKind {
  std::string name, summary;
  std::vector<std::string> variants;  ///< stations, contacts or planes; empty: there is one figure

  static constexpr auto columns() {
    return ColumnList{column("kind", &DrawableKind::name, "", "kind"),
                      column("variants", &DrawableKind::variants, "", "of several of a kind")};
  }
};

/// All that a result can be drawn as.
struct DrawableKinds {
  std::vector<DrawableKind> kinds;
  std::vector<std::string> problems;  ///< of kinds that cannot be drawn, a sentence each

  static constexpr auto columns() { return ColumnList{rows(&DrawableKinds::kinds, "kinds")}; }
};
DrawableKinds drawable_kinds(const ResultView& result);
/// A line for each kind, then the command that draws a figure.
/// @param file  of the result
std::string text_of(const DrawableKinds& all, const std::string& file);

/// A figure of a result that was asked for.
struct FigureChoice {
  std::string kind;
  /// Name of the variant or a part of it, or a probe that it shows or that is at its station;
  /// empty: the first variant.
  std::string variant{};
  std::string with{};  ///< a result to be laid over the figure; empty: none
};

/// The name, if it is that of a probe, so that ResultView::probe draws its readings alone; else
/// empty.
std::string probe_named(const ResultView& result, const std::string& name);

/// The chosen figure; of a motion it shows the stretch in ResultView::window.
/// @throws ModelError  naming what there is, if the result cannot be drawn so
Figure chosen_figure(const ResultView& result, const FigureChoice& choice);

/// Whether there is a kind of this name that models are drawn as, without a result.
bool is_of_models(const std::string& kind);
/// The figure of a model, of a kind for which is_of_models().
/// @param file         its title where the model has none
/// @throws ModelError  if the model has nothing that is drawn
Figure figure_of_model(const Model& model, const std::string& kind, const std::string& file);

/// The verb whose results can be drawn as a kind; of a name that is no kind, "simulate".
std::string verb_for(std::string_view kind);

}  // namespace whirl::inline io
