#include "libdyn/linear/modes_over.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Branches over the values, as they are shown.
struct LocusView {
  explicit LocusView(const ResultView& result)
      : found(result_of<ModesOver>(result)),
        axis(shown_axis(result, dataset_of<ModesOver>(&OverValues::values))),
        unit(result.frequency) {}
  const ModesOver& found;
  ShownAxis axis;
  DisplayUnit unit;  ///< of frequencies

  std::string name(std::size_t i) const {
    return fmt::format("{}{}", i + 1, whirl_style(found.branches[i].whirl).letter);
  }
  /// A curve of a branch whose points are still to be given.
  Curve curve(std::size_t i) const {
    const ModesOverBranch& branch = found.branches[i];
    if (branch.frequency.size() != std::ssize(axis.values) ||
        branch.log_decrement.size() != branch.frequency.size() ||
        branch.eigenvalue.size() != branch.frequency.size()) {
      throw FileError("the modes are not of their values");
    }
    const WhirlStyle style = whirl_style(branch.whirl);
    Curve c{.name = style.name, .end_name = name(i), .paint = style.paint};
    c.width = 1.8;
    c.dash = style.dash;
    for (std::size_t j = 0; j < axis.values.size(); ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      c.hover.push_back(fmt::format("mode {} at {:.5g}: {:.5g} {}, log decrement {:.4g}", name(i),
                                    axis.values[j], branch.frequency(k) * unit.factor, unit.name,
                                    branch.log_decrement(k)));
    }
    return c;
  }
};

std::vector<Figure> modes_over_figures(const ResultView& result) {
  const LocusView v(result);
  Figure f{.height = 600.0};
  f.subtitle = "Natural frequencies and logarithmic decrements over " + v.axis.path;
  Panel frequency, decrement;
  for (Panel* p : {&frequency, &decrement}) {
    p->x = {.title = v.axis.title, .first = v.axis.values.front(), .last = v.axis.values.back()};
    p->cursor = "parameter";
  }
  frequency.y = {.title = with_unit("natural frequency", v.unit), .first = 0.0};
  decrement.y.title = "log decrement";
  for (std::size_t i = 0; i < v.found.branches.size(); ++i) {
    const ModesOverBranch& branch = v.found.branches[i];
    Curve c = v.curve(i);
    c.x = v.axis.values;
    c.has_marker = true;
    c.marker = whirl_style(branch.whirl).marker;
    c.marker_every = std::max<std::size_t>(1, c.x.size() / 8);
    Curve d = c;
    c.y = scaled(numbers(branch.frequency), v.unit.factor);
    d.y = numbers(branch.log_decrement);
    frequency.curves.push_back(std::move(c));
    decrement.curves.push_back(std::move(d));
  }
  if (std::string note = show_decrements(decrement); !note.empty()) {
    f.notes.push_back(std::move(note));
  }
  decrement.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::ink, Dash::solid});
  for (const ModesOverThreshold& t : v.found.thresholds) {
    const double at = t.value / v.axis.factor;
    decrement.rules.push_back(
        {Rule::Kind::vertical, at,
         fmt::format("{} limit {:.4g}{}{}", v.name(static_cast<std::size_t>(t.branch)), at,
                     v.axis.unit.empty() ? "" : " ", v.axis.unit),
         Paint::alarm, Dash::dashed});
  }
  f.panels = {std::move(frequency), std::move(decrement)};
  return {f};
}

std::vector<Figure> root_locus_figures(const ResultView& result) {
  const LocusView v(result);
  Figure f{.height = 520.0};
  f.subtitle = "Eigenvalues over " + v.axis.path;
  Panel p;
  p.x.title = "growth [1/s]";
  p.y.title = with_unit("frequency", v.unit);
  Curve starts{.name = fmt::format("{:.4g}, the first value", v.axis.values.front()),
               .paint = Paint::ink,
               .has_line = false};
  starts.has_marker = true;
  starts.size = 6.0;
  for (std::size_t i = 0; i < v.found.branches.size(); ++i) {
    const CVec& lambda = v.found.branches[i].eigenvalue;
    Curve c = v.curve(i);
    for (const Complex& value : lambda) {
      c.x.push_back(value.real());
      c.y.push_back(value.imag() * v.unit.factor);
    }
    c.along = v.axis.values;
    c.along_title = v.axis.title;
    // heavily damped ones would press the others together
    c.is_key = largest_of(numbers(v.found.branches[i].log_decrement)) <= most_decrement;
    c.end_name.clear();  // a branch may end anywhere, not at the right
    p.labels.push_back({c.x.back(), c.y.back(), v.name(i), Anchor::start, 6.0, -4.0, c.paint});
    starts.x.push_back(c.x.front());
    starts.y.push_back(c.y.front());
    p.curves.push_back(std::move(c));
  }
  starts.is_key = false;
  p.curves.push_back(std::move(starts));
  p.rules.push_back({Rule::Kind::vertical, 0.0, "grows to the right", Paint::ink, Dash::solid});
  f.panels = {std::move(p)};
  return {f};
}

}  // namespace

FigureKind modes_over_kind() {
  return {
      .name = "modes_over",
      .title = "Modes over a value",
      .summary = "natural frequencies and logarithmic decrements over a value of the model",
      .needs = {dataset_of<ModesOver>(&ModesOverBranch::frequency)},
      .make = modes_over_figures,
  };
}

FigureKind root_locus_kind() {
  return {
      .name = "root_locus",
      .title = "Root locus",
      .summary = "eigenvalues over a value of the model",
      .needs = {dataset_of<ModesOver>(&ModesOverBranch::eigenvalue)},
      .make = root_locus_figures,
  };
}

}  // namespace whirl::inline io
