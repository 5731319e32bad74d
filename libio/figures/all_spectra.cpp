#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/spectrum.hpp"
#include "libdyn/motions/identify.hpp"
#include "libdyn/system/stations.hpp"
#include "libio/figures/mac_panel.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/sampled_motion.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr Eigen::Index most_columns =
    300;  ///< of cells, each wider than a pixel: the largest of several lines is one

/// Spectra of all reduced coordinates; those of any degree of freedom follow by summation.
struct CoordinateSpectra {
  CMat lines;     ///< coordinates x lines, in ascending frequency
  Vec frequency;  ///< signed [rad/s]

  explicit CoordinateSpectra(const Motion& m) {
    const Mat& eta = m.record.coordinates;
    const Eigen::Index count = spectrum_samples(m);
    if (count < 3) return;
    lines.resize(eta.rows(), count);
    for (Eigen::Index i = 0; i < eta.rows(); ++i) {
      const Vec samples = eta.row(i).tail(count).transpose();
      const Spectrum s = hann_spectrum((samples.array() - samples.mean()).matrix().cast<Complex>(),
                                       m.period / static_cast<double>(m.per_revolution));
      lines.row(i) = s.ascending().transpose();
      frequency = signed_frequencies(count, s.bin);
    }
  }
};

/// A name that fits beside a panel.
std::string short_name(const std::string& name) {
  constexpr std::size_t longest = 14;
  return name.size() <= longest ? name : name.substr(0, longest - 1) + "…";
}

/// Radii of circles [m or rad] of all points (rows), x + i y or the slopes theta_y - i theta_x.
Mat radii(const CoordinateSpectra& spectra, const MotionRecord& record, const DofMap& dofs,
          const std::vector<NamedPoint>& points, bool is_slope) {
  Mat all = Mat::Zero(std::ssize(points), spectra.lines.cols());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int x = dofs.full_index(points[i].point, is_slope ? 3 : 0),
              y = dofs.full_index(points[i].point, is_slope ? 2 : 1);
    if (x < 0 || y < 0) continue;
    const Eigen::RowVectorXcd row =
        record.basis.row(x).cast<Complex>() + Complex(0, is_slope ? -1 : 1) * record.basis.row(y);
    all.row(static_cast<Eigen::Index>(i)) = (row * spectra.lines).cwiseAbs();
  }
  return all;
}

/// @param reach  of the frequencies that are drawn [rad/s]
Panel spectra_panel(const ResultView& result, const Mat& all, const Vec& frequency,
                    const std::vector<NamedPoint>& points, double reach, bool is_slope) {
  const DisplayUnit unit = is_slope ? tilt_unit(all.maxCoeff()) : unit_for(all.maxCoeff(), "m");
  Panel p;
  p.title = is_slope ? "tilts, θy − i θx" : "lateral, x + i y";
  p.x.title = with_unit("whirl frequency", result.frequency);
  p.y.title = "point";
  // frequencies ascend: those that are drawn are neighbors
  const auto first =
      std::find_if(frequency.begin(), frequency.end(), [&](double f) { return f >= -reach; });
  const auto end = std::find_if(first, frequency.end(), [&](double f) { return f > reach; });
  const Eigen::Index from = first - frequency.begin(), count = end - first;
  const Eigen::Index group = std::max<Eigen::Index>(1, (count + most_columns - 1) / most_columns);
  Cells& c = p.cells;
  for (Eigen::Index k = from; k + group <= from + count; k += group) {
    c.x.push_back(result.frequency.factor * 0.5 * (frequency(k) + frequency(k + group - 1)));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    c.y.push_back(static_cast<double>(i + 1));
    c.y_names.push_back(short_name(points[i].label()));
    for (Eigen::Index k = from; k + group <= from + count; k += group) {
      const double top = all.row(static_cast<Eigen::Index>(i)).segment(k, group).maxCoeff();
      c.values.push_back(top > 0.0 ? std::log10(unit.factor * top) : std::nan(""));
    }
  }
  c.title = fmt::format("log10 of the radius [{}]", unit.name);
  c.last = std::ceil(2.0 * std::log10(unit.factor * all.maxCoeff())) / 2.0;
  c.first = c.last - 4.0;
  p.rules.push_back({Rule::Kind::vertical, 0.0, "", Paint::ink, Dash::dotted});
  return p;
}

std::vector<Figure> all_spectra_figures(const ResultView& result) {
  const Motion m(result);
  const DofMap& dofs = dofs_of(result, m.record);
  const std::vector<NamedPoint> points = named_points(*result.model, *result.assembler);
  const CoordinateSpectra spectra(m);
  if (spectra.frequency.size() < 3) return {};
  const Mat lateral = radii(spectra, m.record, dofs, points, false),
            slopes = radii(spectra, m.record, dofs, points, true);
  const Vec top = lateral.colwise().maxCoeff();
  if (!(top.maxCoeff() > 0.0)) return {};
  // as far as lines of a thousandth of the largest, and the speed twice
  double reach = m.spins ? 2.2 * speed_of(result) : 0.0;
  const double least = 1e-3 * top.maxCoeff();
  for (Eigen::Index k = 0; k < top.size(); ++k) {
    if (top(k) > least) reach = std::max(reach, 1.1 * std::abs(spectra.frequency(k)));
  }
  Figure f{.width = 1000.0};
  f.subtitle = "Spectra of all points" + at_speed(result) + ", backward left, forward right";
  f.columns = 2;
  f.panels.push_back(spectra_panel(result, lateral, spectra.frequency, points, reach, false));
  if (slopes.maxCoeff() > 0.0) {
    f.panels.push_back(spectra_panel(result, slopes, spectra.frequency, points, reach, true));
  }
  if (result.file.has(dataset_of<Identification>(&IdentifiedPeak::mac))) {
    if (std::optional<Panel> mac = mac_panel(result)) f.panels.push_back(std::move(*mac));
  }
  if (f.panels.size() == 1) f.columns = 1, f.width = 640.0;
  const std::size_t rows = (f.panels.size() + 1) / 2;
  f.height = 80.0 + static_cast<double>(rows) *
                        std::clamp(22.0 * static_cast<double>(points.size()), 260.0, 560.0);
  return {f};
}

}  // namespace

FigureKind all_spectra_kind() {
  return {
      .name = "all_spectra",
      .title = "Spectra of all points",
      .summary = "spectra of all degrees of freedom in one picture, beside the MAC table",
      .needs = {dataset_of<MotionRecord>(&MotionRecord::coordinates)},
      .needs_model = true,
      .make = all_spectra_figures,
  };
}

}  // namespace whirl::inline io
