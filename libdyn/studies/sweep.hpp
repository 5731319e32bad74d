#pragma once
/// A sweep: the motions along one parameter, up and down, each going on from the one before.

#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/point_rows.hpp"
#include "libdyn/studies/portrait.hpp"
#include "libdyn/studies/row_travel.hpp"
#include "libdyn/studies/study_models.hpp"

namespace whirl::inline dyn {

enum class SweepStart {
  carried,  ///< each value from the motion at the value before, up and then down
  fresh     ///< every value from the start of its model
};

struct SweepOptions {
  std::vector<double> values{};  ///< of the parameter [SI]
  SweepStart start = SweepStart::carried;
  ClassifyOptions classify{};  ///< its `sections` are those of the portraits
  PortraitOptions portrait{};
  int threads = 1;
  Stripe stripe{};  ///< the points that are computed
};

/// Where a motion of a sweep ended; empty if the next motion starts afresh.
struct SweepEnd : FullState {
  long revolution = 0;  ///< its number, where forces do not repeat every revolution
};

struct SweepPoint {
  ClassifiedMotion motion{};
  SweepEnd end{};
  Portrait portrait{};

  static constexpr auto columns() {
    return ColumnList{
        column(
            "poincare_x", [](auto& p) -> auto& { return p.portrait.poincare_x; }, "m",
            "x at phase 0, last sections")
            .along("stations sections"),
        column(
            "poincare_y", [](auto& p) -> auto& { return p.portrait.poincare_y; }, "m",
            "y at phase 0, last sections")
            .along("stations sections"),
        column(
            "end_displacement", [](auto& p) -> auto& { return p.end.displacement; }, "m, rad",
            "displacement that the next value starts from")
            .along("full"),
        column(
            "end_velocity", [](auto& p) -> auto& { return p.end.velocity; }, "m/s, rad/s",
            "velocity that the next value starts from")
            .along("full"),
        column(
            "end_revolution", [](auto& p) -> auto& { return p.end.revolution; }, "",
            "revolution that the next value starts in, where forces do not repeat with it")
            .maybe(),
        column(
            "max_radius", [](auto& p) -> auto& { return p.portrait.max_radius; }, "m",
            "largest distance from the axis")
            .along("stations")
            .maybe(),
        column(
            "spectrum", [](auto& p) -> auto& { return p.portrait.spectrum; }, "m",
            "radius of the circle that turns with an order of the speed; seen from the rotor the "
            "order is one less")
            .along("stations orders")
            .maybe(),
        column(
            "contact_angle", [](auto& p) -> auto& { return p.portrait.contact_angle; }, "",
            "share of the time in touch within a sector around the stator")
            .along("contacts sectors")
            .maybe(),
        column(
            "probe_poincare", [](auto& p) -> auto& { return p.portrait.probe_sections; }, "m",
            "what a probe reads at phase 0, last sections")
            .along("probes sections")
            .maybe(),
        column(
            "probe_mean", [](auto& p) -> auto& { return p.portrait.probe_mean; }, "m",
            "mean of what a probe reads")
            .along("probes")
            .maybe(),
        column(
            "probe_peak_to_peak", [](auto& p) -> auto& { return p.portrait.probe_peak_to_peak; },
            "m", "largest less smallest sample of what a probe reads")
            .along("probes")
            .maybe(),
        column(
            "probe_spectrum", [](auto& p) -> auto& { return p.portrait.probe_spectrum; }, "m",
            "peak to peak of what a probe reads at an order of the speed")
            .along("probes probe_orders")
            .maybe(),
        column(
            "support_largest", [](auto& p) -> auto& { return p.portrait.support_largest; }, "N",
            "largest force of the rotor on a support, with its mean")
            .along("supports")
            .maybe(),
        column(
            "support_mean_x", [](auto& p) -> auto& { return p.portrait.support_mean_x; }, "N",
            "mean of the force along x")
            .along("supports")
            .maybe(),
        column(
            "support_mean_y", [](auto& p) -> auto& { return p.portrait.support_mean_y; }, "N",
            "mean of the force along y")
            .along("supports")
            .maybe()};
  }
};

template <class Bytes>
void travel(Bytes& bytes, Is<SweepEnd> auto& end) {
  bytes(end.displacement, end.velocity, end.revolution);
}

template <class Bytes>
void travel(Bytes& bytes, Is<SweepPoint> auto& point) {
  auto& [motion, end, portrait] = point;
  bytes(motion, end, portrait);
}

struct SweepResult {
  static constexpr std::string_view group = "/sweep";
  /// Dimension of the points in front of the parameter.
  static constexpr std::string_view leads = "ways";
  StudySystem system{};
  SweepStart start = SweepStart::carried;
  std::vector<std::string> stations{};  ///< of the portraits
  ProbeLabels probes{};                 ///< of the model
  std::vector<std::string> supports{};  ///< "bearing left", as SupportLoads has them
  long sections = 0, spectrum_revolutions = 0;
  /// Points of one way after the other, each in the order of the values.
  PointRows<SweepPoint> points{};

  /// Names of the ways.
  std::vector<std::string> ways() const;
  Vec orders() const;        ///< of the spectra
  Vec sectors() const;       ///< of the contact angles
  Vec probe_orders() const;  ///< of the spectra of probes
  ColumnSizes sizes() const;
  /// Whether a column was not asked for, or has nothing to say.
  bool leaves_out(std::string_view column) const;
  static constexpr auto columns() {
    using C = SweepResult;
    return joined(
        ColumnList{column("direction", &C::ways, "", "direction").axis("ways+"), contact_names<C>(),
                   column("station", &C::stations, "", "station").axis("stations+"),
                   column("order", &C::orders, "", "signed frequency over speed, forward > 0")
                       .axis("orders+")
                       .within(valid::finite)
                       .maybe(),
                   column("sector", &C::sectors, "rad", "middle of a sector, from x to y")
                       .axis("sectors")
                       .maybe()},
        probe_label_columns(),
        ColumnList{column("probe_order", &C::probe_orders, "", "frequency over speed")
                       .axis("probe_orders+")
                       .within(valid::finite)
                       .maybe(),
                   column("support", &C::supports, "",
                          "bearing, seal, link, oil film or rolling bearing with its name")
                       .axis("supports+")
                       .maybe(),
                   rows(&C::points, "point")});
  }
};

/// A value of a sweep, in short.
struct SweepEntry : MotionSummary {
  double value = 0.0;            ///< of the parameter [SI]
  std::vector<double> poincare;  ///< x at phase 0 of the first station [m]
  double impacts_per_rev = 0.0;
  /// Mean and peak to peak of the readings of the probes [m]; empty without a spectrum.
  std::vector<double> probe_mean{}, probe_peak_to_peak{};
  std::vector<double> support_largest{};  ///< force on each support [N]; empty without a spectrum

  static constexpr auto columns() {
    using enum Written;
    using E = SweepEntry;
    return ColumnList{
        column("value", &E::value, "", "of the parameter"),
        column("motion", &E::motion, "", "kind of motion"),
        column("period_revs", &E::period, "", "period [revolutions]"),
        column("poincare", &E::poincare, "m", "x at phase 0"),
        column("lyapunov_max", &E::largest_exponent, "", "largest exponent"),
        column("impacts_per_rev", &E::impacts_per_rev, "", "impacts per revolution"),
        column("probe_mean", &E::probe_mean, "m", "of what the probes read").only(in_json).maybe(),
        column("probe_peak_to_peak", &E::probe_peak_to_peak, "m", "likewise").only(in_json).maybe(),
        column("support_largest", &E::support_largest, "N", "force on each support")
            .only(in_json)
            .maybe()};
  }
};

/// One way of a sweep, in the order in which the sweep went.
struct SweepWay {
  const SweepResult& sweep;
  const std::vector<double>& values;
  std::size_t way = 0;  ///< 1: down

  std::size_t size() const { return values.size(); }
  /// Number of the value that came k-th on this way.
  std::size_t index(std::size_t k) const { return way == 1 ? size() - 1 - k : k; }
  std::optional<SweepPoint> point(std::size_t k) const;
  /// Entries of the values that are computed.
  std::vector<SweepEntry> entries() const;
};

/// Values of a way, next to each other, at which a contact touches; both ends are among these
/// values.
struct TouchRange {
  std::size_t contact = 0;       ///< its number
  std::size_t from = 0, to = 0;  ///< as SweepWay counts values
  bool begins = false;           ///< the contact does not touch at the value before
  bool ends = false;             ///< the contact does not touch at the value behind
  bool is_permanent = false;     ///< the contact touches all the time at all of these values
};
/// Ranges of contact after contact, along the way. Motions that failed, or are not computed, end a
/// range.
std::vector<TouchRange> touch_ranges(const SweepWay& way);

/// Classifies and portrays the motions along the values of one parameter.
///
/// With SweepStart::carried, a motion that is not proven goes on for the measured revolutions
/// before the next value takes it over; one thread goes ahead along the values, the others tell the
/// kinds of motions. Where a motion fails, the next motion begins afresh.
///
/// @param earlier  what another call with the same models and options has found: its points stay as
///                 they are; empty: none
/// @return  with fewer points if the monitor stopped it
/// @throws ModelError      as models
/// @throws NumericalError  if the first point cannot be computed, or nothing moves
SweepResult sweep(const StudyModels& models, const SweepOptions& options,
                  const Monitor<SweepResult>& monitor = {}, SweepResult earlier = {});

}  // namespace whirl::inline dyn
