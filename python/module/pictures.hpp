#pragma once
/// Figures and pages of result files.

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace whirl::inline python {

/// A result file that is drawn; it is read once.
class Drawn {
 public:
  /// @throws FileError  as ResultView
  explicit Drawn(const std::string& file);
  ~Drawn();

  /// (kind, summary, variants, the verb whose results it is of) of all that it can be drawn as.
  pybind11::list kinds() const;
  /// A figure as SVG.
  /// @param variant  of several of a kind; empty: the first
  /// @throws ModelError  naming what there is
  std::string svg(const std::string& kind, const std::string& variant) const;
  /// Its panels, for other programs that draw: dicts of the members of libio/drawing/figure.hpp.
  pybind11::dict figure(const std::string& kind, const std::string& variant) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The page of `whirl report` of some result files.
std::string report_html(const std::vector<std::string>& files);

}  // namespace whirl::inline python
