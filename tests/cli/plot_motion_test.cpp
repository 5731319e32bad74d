// plot: what authors draw of motions beside orbits: phase planes, tilts, motion relative to a
// stator.

#include <algorithm>
#include <cmath>
#include <set>

#include "libbase/numerics/constants.hpp"
#include "libcontact/laws.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/studies/map.hpp"
#include "libio/figures/map_planes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/sweep_view.hpp"
#include "libio/results/columns.hpp"
#include "tests/cli/plots.hpp"

namespace whirl::test {
namespace plot_motion_test {

using plot_test::figures_in;
using plot_test::named;

class PlotMotion : public plot_test::Plot {};

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

// Without contact the rotor of rub.toml goes round a circle at its speed Omega: x' is Omega x but
// for the differences of 64 samples, which take sin(h) / h of it, h = 2 pi / 64.
TEST_F(PlotMotion, APhasePlaneOfACircleIsAnEllipseOfTheSpeed) {
  make({"simulate", "rub.toml", "--set", "contact.ring.clearance=1", "--discard", "200"}, "s.h5");
  const Panel p = figures_in("phase_plane", ResultView(folder / "s.h5")).at(0).panels.at(0);
  EXPECT_TRUE(named(p, "touch begins").empty());
  const Curve path = named(p, "path").at(0);
  EXPECT_EQ(p.x.title, "x [mm]");
  EXPECT_EQ(p.y.title, "rate of x [m/s]");
  const double h = 2.0 * std::numbers::pi / 64, expected = 100.0 * std::sin(h) / h;
  constexpr double between_samples = 2e-3;  // of a cosine, sampled 64 times
  EXPECT_NEAR(1e3 * largest(path.y) / largest(path.x), expected, between_samples * expected);
}

// A bouncing rotor: the section has a point for every begin of a touch that the record has, moves
// outward at each of them, and the clearance is a line of the plane beyond which it touches.
TEST_F(PlotMotion, RelativeMotionHasItsSectionAtImpacts) {
  make({"simulate", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--revolutions", "32"}, "s.h5");
  const ResultView view(folder / "s.h5");
  const auto record = read_result<MotionRecord>(view.file);
  const Figure f = figures_in("contact_motion", view).at(0);
  EXPECT_EQ(f.variant, "ring");
  const auto ring = std::find_if(record.stations.begin(), record.stations.end(),
                                 [](const StationMotion& s) { return s.station == "7 ring"; });
  ASSERT_NE(ring, record.stations.end());
  const double clearance = view.model->contacts.at(0).clearance;
  std::size_t begins = 0;
  for (Eigen::Index j = 1; j < record.normal.cols(); ++j) {
    begins += record.normal(0, j) > 0.0 && !(record.normal(0, j - 1) > 0.0);
    if (record.normal(0, j) > 0.0) {
      EXPECT_GT(std::hypot(ring->x(j), ring->y(j)), clearance * (1.0 - 1e-9));
    }
  }
  ASSERT_GT(begins, 3u);
  ASSERT_EQ(f.panels.size(), 2u);
  ASSERT_EQ(f.panels[0].rules.size(), 1u);
  EXPECT_EQ(f.panels[0].x.title, "distance [mm]");
  EXPECT_NEAR(f.panels[0].rules[0].at, 1e3 * clearance, 1e-9);
  const Curve section = f.panels[1].curves.at(0);
  ASSERT_EQ(section.x.size(), begins);
  for (std::size_t i = 0; i < begins; ++i) {
    EXPECT_TRUE(section.x[i] >= 0.0 && section.x[i] < 360.0);
    EXPECT_GT(section.y[i], 0.0);
  }
}

// Tilts are those of the recorded coordinates, theta_x and theta_y of the station's node, and their
// strongest line is that of the unbalance, forward.
TEST_F(PlotMotion, TiltsAreThoseOfTheRecord) {
  make({"simulate", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--set",
        "contact.ring.clearance=1", "--revolutions", "32"},
       "s.h5");
  const ResultView view(folder / "s.h5");
  const auto record = read_result<MotionRecord>(view.file);
  const auto figures = figures_in("tilts", view);
  ASSERT_GE(figures.size(), 2u);
  const Figure& paths = figures[0];
  const int node = std::stoi(paths.variant) - 1;
  const Vec theta_x = (record.basis.row(4 * node + 2) * record.coordinates).transpose();
  const Curve tilt = named(paths.panels.at(0), "tilt").at(0);
  ASSERT_EQ(static_cast<Eigen::Index>(tilt.x.size()), theta_x.size());
  const double factor = tilt.x[1] / theta_x(1);
  for (std::size_t j = 0; j < tilt.x.size(); ++j) {
    EXPECT_NEAR(tilt.x[j], factor * theta_x(static_cast<Eigen::Index>(j)), 1e-9 * largest(tilt.x));
  }
  EXPECT_EQ(figures[1].variant, paths.variant + ", spectrum");
  const Panel& spectrum = figures[1].panels.at(0);
  const Curve& lines = spectrum.curves.at(0);
  const auto top =
      static_cast<std::size_t>(std::max_element(lines.y.begin(), lines.y.end()) - lines.y.begin());
  EXPECT_NEAR(lines.x[top], view.model->speed / hertz, 0.5);
}

// Spectra of all points at once have at each station what its own spectrum has.
TEST_F(PlotMotion, SpectraOfAllPointsAreThoseOfTheStations) {
  make({"identify", WHIRL_SOURCE_DIR "/models/two_disk_mac.toml", "--revolutions", "32"}, "i.h5");
  const ResultView view(folder / "i.h5");
  const Figure f = figures_in("all_spectra", view).at(0);
  ASSERT_EQ(f.panels.size(), 3u);  // lateral, tilts, MAC
  const Cells& cells = f.panels[0].cells;
  const auto stations = read_result<MotionRecord>(view.file).stations;
  const auto spectra = read_result<StationSpectra>(view.file);
  ASSERT_FALSE(stations.empty());
  const double factor = cells.title == "log10 of the radius [µm]" ? 1e6 : 1e3;
  for (std::size_t s = 0; s < stations.size(); ++s) {
    const auto row = std::find(cells.y_names.begin(), cells.y_names.end(), stations[s].station);
    ASSERT_NE(row, cells.y_names.end()) << stations[s].station;
    const auto from = cells.values.begin() +
                      (row - cells.y_names.begin()) * static_cast<std::ptrdiff_t>(cells.x.size());
    double top = -100.0;
    for (auto v = from; v != from + std::ssize(cells.x); ++v) top = std::fmax(top, *v);
    const double expected = spectra.stations[s].amplitude.maxCoeff();
    if (expected > 0.0) {
      EXPECT_NEAR(top, std::log10(factor * expected), 1e-6);
    }
  }
  EXPECT_EQ(f.panels[2].cells.title, "MAC");
}

// Every exponent of every value of a sweep, as the result has them.
TEST_F(PlotMotion, AllExponentsOfASweepAreDrawn) {
  make({"sweep", "rub.toml"}, "w.h5");
  const ResultView view(folder / "w.h5");
  const auto figures = figures_in("exponents_over", view);
  ASSERT_FALSE(figures.empty());
  const Panel& all = figures[0].panels.back();
  ASSERT_EQ(all.curves.size(), 4u);  // states of a rotor of two coordinates
  const figures::SweepView sweep(view);
  ASSERT_TRUE(sweep.point(0));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(all.curves[k].name, std::to_string(k + 1));
    EXPECT_EQ(all.curves[k].y.at(0), sweep.point(0)->motion.exponents.at(k));
  }
}

// Exponents over the revolutions that they are averaged over end where the result has them; an
// orbit that is proven has no such path.
TEST_F(PlotMotion, ExponentsSettleOverTime) {
  make({"classify", WHIRL_SOURCE_DIR "/models/jeffcott_stator.toml", "--speed", "151rad/s", "--set",
        "contact.ring.stiffness=150e6", "--set", "contact.ring.friction=0.2", "--discard", "200",
        "--revolutions", "200"},
       "c.h5");
  const ResultView view(folder / "c.h5");
  const auto figures = figures_in("exponents", view);
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[1].variant, "over time");
  const Panel& p = figures[1].panels.at(0);
  const Vec last = view.file.vector("/classify/exponent");
  ASSERT_EQ(std::ssize(p.curves), last.size());
  for (Eigen::Index i = 0; i < last.size(); ++i) {
    const Curve& c = p.curves[static_cast<std::size_t>(i)];
    EXPECT_NEAR(c.y.back(), last(i), 1e-9 * std::abs(last(i)));
    EXPECT_GE(c.x.back(), 200.0);
  }
  make({"classify", "rub.toml"}, "o.h5");
  EXPECT_EQ(figures_in("exponents", ResultView(folder / "o.h5")).size(), 1u);
}

// The force of the unbalance of rub.toml, 2 kg at 1 mm, is 20 N at 100 rad/s.
TEST_F(PlotMotion, ForcesOverThatOfTheUnbalance) {
  make({"sweep", "rub.toml"}, "w.h5");
  const ResultView view(folder / "w.h5");
  const auto figures = figures_in("bifurcation", view);
  const Figure& f = figures.back();
  EXPECT_EQ(f.variant, "force over unbalance");
  const figures::SweepView sweep(view);
  ASSERT_TRUE(sweep.point(0));
  const double Omega = sweep.axis.path == "operation.speed"
                           ? sweep.axis.factor * sweep.axis.values[0]
                           : view.model->speed;
  const double force = sweep.point(0)->motion.contacts.at(0).max_normal;
  EXPECT_NEAR(f.panels.at(0).curves.at(0).y.at(0), force / (2e-3 * Omega * Omega), 1e-9);
}

// The rotor of rub.toml touches where its clearance is below 1 mm: over three clearances of which
// two are wider a point has two kinds of motion if rubbing is another kind, and no more than
// values.
TEST_F(PlotMotion, KindsOfAPointAreCounted) {
  const Outcome outcome =
      whirl({"map", "rub.toml", "--over", "contact.ring.stiffness=1e4,2e4", "--over",
             "contact.ring.friction=0,0.1", "--over", "contact.ring.clearance=0.6:1.8:0.6mm",
             "--discard", "50", "--revolutions", "20", "--out", "m.h5"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultView view(folder / "m.h5");
  const auto figures = figures_in("shares", view);
  ASSERT_EQ(figures.size(), 4u);
  const Figure& f = figures.back();
  EXPECT_EQ(f.variant, "kinds over contact.ring.clearance");
  const auto& study = figures::study_of<MapResult>(view);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      std::set<double> kinds;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto point = study.points[(i * 2 + j) * 3 + k];
        if (point->kind == MotionKind::not_settled) continue;
        kinds.insert(figures::motion_number(point->kind, point->period));
      }
      EXPECT_EQ(f.panels.at(0).cells.values.at(j * 2 + i), static_cast<double>(kinds.size()));
    }
  }
}

// A blade that rubs is bent by its friction: l^3 / (3 E I) per force, less by the tension of its
// spin.
TEST_F(PlotMotion, BladesThatTouchAreBent) {
  make({"simulate", WHIRL_SOURCE_DIR "/models/blade_seal.toml", "--revolutions", "10", "--discard",
        "20"},
       "b.h5");
  const ResultView view(folder / "b.h5");
  const Figure f = figures_in("contact_forces", view).at(0);
  const auto bent = std::find_if(f.panels.begin(), f.panels.end(), [](const Panel& p) {
    return p.y.title.starts_with("deflection of its tip");
  });
  ASSERT_NE(bent, f.panels.end());
  const auto record = read_result<MotionRecord>(view.file);
  std::size_t blades = 0;
  while (!std::holds_alternative<BladeTip<>>(view.model->contacts.at(blades).law)) ++blades;
  const auto& blade = std::get<BladeTip<>>(view.model->contacts[blades].law);
  const double free = std::pow(blade.blade_length, 3) / (3.0 * blade.bending_stiffness);
  const Vec friction = record.friction.row(static_cast<Eigen::Index>(blades));
  const double most = largest(bent->curves.at(0).y);
  const double unit = bent->y.title.ends_with("[mm]")   ? 1e3
                      : bent->y.title.ends_with("[nm]") ? 1e9
                                                        : 1e6;
  EXPECT_LE(most, unit * free * friction.cwiseAbs().maxCoeff() * (1.0 + 1e-12));
  EXPECT_GT(friction.cwiseAbs().maxCoeff(), 0.0);
}

// Shares are of all points with a value, and add up to all of them; periods up to eight have names
// and colors of their own.
TEST_F(PlotMotion, SharesOfAMapAddUp) {
  make({"map", "rub.toml"}, "m.h5");
  const ResultView view(folder / "m.h5");
  const auto figures = figures_in("shares", view);
  ASSERT_EQ(figures.size(), 2u);
  for (const Figure& f : figures) {
    const auto& curves = f.panels.at(0).curves;
    ASSERT_FALSE(curves.empty());
    const std::size_t values = curves[0].x.size() / 2;  // there along the top, back along the foot
    EXPECT_EQ(values, 2u);
    for (std::size_t i = 0; i < values; ++i) {
      for (std::size_t k = 0; k + 1 < curves.size(); ++k) {
        EXPECT_EQ(curves[k].y[i], curves[k + 1].y[2 * values - 1 - i]);
      }
      EXPECT_EQ(curves.front().y[2 * values - 1 - i], 0.0);
      EXPECT_NEAR(curves.back().y[i], 100.0, 1e-9);
    }
  }
  std::set<Paint> paints;
  for (int period = 1; period <= 9; ++period) {
    const double number = figures::motion_number(MotionKind::periodic, period);
    const Category& c = figures::motions().at(static_cast<std::size_t>(number));
    EXPECT_EQ(c.name, period <= 8 ? "period " + std::to_string(period) : "longer period");
    paints.insert(c.paint);
  }
  EXPECT_EQ(paints.size(), 9u);
}

// The rotor of rub.toml goes round at 1 mm: of three clearances in one plane, two are wider. The
// edge lies between the clearances of the map, the same at both stiffnesses.
TEST_F(PlotMotion, EdgesOfContactLieBetweenThePointsOfAMap) {
  const Outcome outcome = whirl({"map", "rub.toml", "--over", "contact.ring.stiffness=1e4,2e4",
                                 "--over", "contact.ring.clearance=0.6:1.8:0.6mm", "--discard",
                                 "50", "--revolutions", "20", "--out", "m.h5"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const ResultView view(folder / "m.h5");
  const Panel p = figures_in("contact_edges", view).at(0).panels.at(0);
  const auto edges = named(p, "contact");
  ASSERT_EQ(edges.size(), 1u);
  std::size_t segments = 0;
  for (const double x : edges[0].x) segments += std::isnan(x);
  EXPECT_EQ(segments, 2u);
  for (const double y : edges[0].y) {
    if (std::isnan(y)) continue;
    EXPECT_NEAR(y, 0.9, 1e-9);
  }
}

}  // namespace plot_motion_test
}  // namespace whirl::test
