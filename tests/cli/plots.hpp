#pragma once
// Figures of results that verbs have made.

#include "libio/figures/figures.hpp"
#include "libio/results/hdf5.hpp"
#include "tests/cli/pictures.hpp"

namespace whirl::test {
namespace plot_test {

class Plot : public Pictures {
 protected:
  /// Kinds of figures that a result holds.
  std::vector<std::string> kinds(const std::string& file) const {
    std::vector<std::string> names;
    const json list = result({"plot", file});
    for (const json& k : list["kinds"]) names.push_back(k["kind"]);
    return names;
  }

  /// A result of a torus with circles at rotations from 0.3 to 0.45, after each of `period`
  /// revolutions; `complete` 0: it was stopped.
  void write_torus(const std::string& file, int period, int complete = 1) const {
    ResultWriter to(folder / file, Replaces::anything);
    to.dataset("/model", std::vector<std::string>{rubbing}, {"", "model", {""}});
    to.attribute("/model", "path", "rub.toml");
    to.dataset("/arguments", std::vector<std::string>{"whirl"}, {"", "command line", {""}});
    to.dataset("/torus/angle", std::vector<double>{0.0}, {"rad", "angle", {""}});
    to.dataset("/torus/displacement", Mat(Mat::Zero(1, 4)), {"m, rad", "displacement", {"", ""}});
    to.dataset("/torus/value", std::vector<double>{100.0, 110.0, 120.0},
               {"rad/s", "operation.speed", {""}});
    for (const auto& [name, values] :
         {std::pair<const char*, std::vector<double>>{"rotation", {0.3, 0.37, 0.45}},
          {"largest_exponent", {-0.2, -0.1, 0.1}},
          {"tail", {1e-9, 1e-9, 1e-9}}}) {
      to.dataset(std::string("/torus/") + name, values, {"", name, {"/torus/value"}});
    }
    to.attribute("/torus", "period_revolutions", period);
    to.attribute("/torus", "complete", complete);
    to.commit();
  }

  /// Words that follow the first period doubling of a stator's rub in friction and stiffness.
  const std::vector<std::string> borders{
      "continue", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml",
      "--speed",  "138.4rad/s",
      "--over",   "contact.ring.friction=0.1:0.15:0.002",
      "--over",   "contact.ring.stiffness=50:80:0.5MN/m",
      "--at",     "0.15,64MN/m"};

  /// A report's figures of a kind, of its first result.
  json in_report(const std::string& file, const std::string& kind) const {
    const json data = page_data(content(folder / file));
    for (const json& f : data["results"][0]["figures"]) {
      if (f["kind"] == kind) return f;
    }
    return {};
  }
};

/// Curves of a name.
inline std::vector<Curve> named(const Panel& panel, const std::string& name) {
  std::vector<Curve> curves;
  for (const Curve& c : panel.curves) {
    if (c.name == name) curves.push_back(c);
  }
  return curves;
}

/// Figures of a kind.
inline std::vector<Figure> figures_in(std::string_view name, const ResultView& view) {
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name == name) return figures_of(kind, view);
  }
  return {};
}

inline long count(const std::string& text, const std::string& part) {
  long n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// The first panel of the first figure of a kind.
inline Panel panel_of(std::string_view name, const ResultView& view) {
  return figures_in(name, view).at(0).panels.at(0);
}

}  // namespace plot_test
}  // namespace whirl::test
