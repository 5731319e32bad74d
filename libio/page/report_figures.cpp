#include "libio/page/report_figures.hpp"

#include <algorithm>
#include <filesystem>

#include "libio/figures/comparison.hpp"

namespace whirl::inline io {

std::vector<Figure> figures_with_others(const FigureKind& kind, const ResultView& result,
                                        const std::vector<std::unique_ptr<ResultView>>& results) {
  std::vector<Figure> of_kind = figures_of(kind, result);
  for (const auto& other : results) {  // what fits is laid over it
    if (other.get() == &result || !other_values(result, *other).empty()) continue;
    lay_over(of_kind, result, *other, std::filesystem::path(other->path).filename());
  }
  return of_kind;
}

std::vector<Figure> compared_figures(const std::vector<std::vector<Figure>>& figures,
                                     const std::vector<std::string>& names) {
  std::vector<Figure> compared;
  for (const Figure& f : figures.front()) {
    std::vector<const Figure*> alike{&f};
    for (std::size_t n = 1; n < figures.size(); ++n) {
      const auto same = std::find_if(
          figures[n].begin(), figures[n].end(),
          [&](const Figure& other) { return other.kind == f.kind && other.variant == f.variant; });
      if (same != figures[n].end()) alike.push_back(&*same);
    }
    if (alike.size() != figures.size()) continue;
    if (auto both = overlay(alike, names)) compared.push_back(std::move(*both));
  }
  return compared;
}

}  // namespace whirl::inline io
