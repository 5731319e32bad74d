#pragma once
/// What kinds of figures share.

#include <algorithm>
#include <functional>
#include <optional>

#include "libbase/numerics/constants.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libfe/analyses/modes.hpp"
#include "libio/figures/figures.hpp"

namespace whirl::inline io {

namespace figures {

/// Numbers of lengths along the shaft in one meter: in the shown unit of mm.
double per_mm();

std::vector<double> row(const Mat& m, Eigen::Index i);
std::vector<double> numbers(const Vec& v);
/// The samples of a motion's numbers.
std::vector<double> numbers(const Vec& v, const MotionSamples& samples);
/// The largest displacement of a station along x or y [m].
double largest_displacement(const StationMotion& motion);

/// "4430 rpm"; empty for a result without a speed.
std::string speed_text(const ResultView& result);
/// Speeds of a measured run-up or coast-down [rad/s].
struct SpeedRange {
  double slowest = 0.0, fastest = 0.0;
};
/// Nothing: the result is no record with orders, or its speed is steady.
std::optional<SpeedRange> run_up_of(const ResultView& result);
/// " at 4430 rpm", to go on in a sentence; empty for a result without a speed.
std::string at_speed(const ResultView& result);
/// The same of what a record shows: of a run-up " from 300 to 3000 rpm".
std::string at_speeds(const ResultView& result);
/// The operating speed [rad/s], or NaN.
double speed_of(const ResultView& result);
/// Three digits without an exponent: 0.0123, 12.3, 1230.
std::string plain_number(double value);
/// A speed in speed_unit() as tables and labels tell it: whole rpm, other units as fine.
std::string speed_label(double shown);

struct WhirlStyle {
  Paint paint;
  Dash dash;
  Marker marker;
  const char *name, *letter;
};
WhirlStyle whirl_style(Whirl whirl);

/// An axis of a study, as it is shown.
struct ShownAxis {
  std::string path;   ///< of the parameter, empty for numbered starts
  std::string title;  ///< "operation.speed [rpm]"
  std::vector<double> values;
  double factor = 1.0;  ///< of shown numbers in SI
  std::string si_unit{};
  std::string unit{};  ///< of the shown numbers
};
ShownAxis shown_axis(const ResultView& result, const std::string& path);
/// The axes of a study, with the values that are drawn.
std::vector<ShownAxis> shown_axes(const ResultView& result, std::string_view group);

/// A text for a command line with places, as Cells and Curve have it: braces of the text become
/// ones that are no places.
std::string without_places(std::string text);

/// A line for a shell that calls a verb on the model of a result, with the values that were set in
/// the model, and with some of the options of the result's own call; places may be added.
/// @param kept  names of these options, as far as they were given
std::string command_on_model(const ResultView& result, const std::string& verb,
                             const std::vector<std::string_view>& kept);

/// " --set a.b=2rad/s" to be added to such a line.
/// @param paths  one path, or several with commas, for one value at all; "-a.b": the value negated
/// @param value  a number [unit], or a place for one: "{x}", negated "{-x}"
std::string set_command(const std::string& paths, const std::string& value,
                        const std::string& unit);

/// The unit of a probe, and its name with the direction: "DE 1X, 45°".
DisplayUnit unit_of(const ProbeLabel& probe);
/// The unit that all probes of a list have; else the unit in which the largest of their readings
/// [m] reads well.
template <class Probes>
DisplayUnit unit_of(const Probes& probes, double largest) {
  const bool is_one = !probes.empty() && std::all_of(probes.begin(), probes.end(), [&](auto& p) {
    return p.unit == probes.front().unit;
  });
  return is_one ? unit_of(probes.front()) : unit_for(largest, "m");
}
std::string probe_name(const ProbeLabel& probe);

/// A text beside a point, on the side that looks away from the origin.
Label label_outwards(Complex at, const std::string& text);

/// The largest logarithmic decrement that is shown: branches that are heavily damped are for who
/// zooms out.
inline constexpr double most_decrement = 3.0;
/// Shows logarithmic decrements as far as they tell stability: branches that are heavily damped
/// everywhere are for who zooms out.
/// @return  a note that names these; empty: there are none
std::string show_decrements(Panel& panel);

/// The stroke of one of several curves, which tells them apart where colors do not.
constexpr Dash series_dash(std::size_t i) {
  constexpr Dash dashes[] = {Dash::solid, Dash::dashed, Dash::dash_dot, Dash::dotted};
  return dashes[(i + i / 20) % 4];
}

/// The title of an axis with its unit: "x [mm]".
std::string with_unit(const std::string& what, const DisplayUnit& unit);

/// Whether a label of the trajectory ("7 ring") is that of a station of the model.
/// @pre  the result has a model and an assembler
bool is_at(const ResultView& result, const Station& station, const std::string& label);
/// The contact at a station of the trajectory ("7 ring"), as its number; -1 if there is none.
int contact_at(const ResultView& result, const std::string& station);
/// Numbers of stations, those with a contact first, those that do not move last.
std::vector<std::size_t> stations_by_interest(const ResultView& result,
                                              const std::vector<std::string>& names);

/// Columns at which the largest magnitude of all rows has a maximum, the four highest, ascending.
std::vector<Eigen::Index> deflection_peaks(const Mat& magnitude);

/// A circle of 181 points.
Curve circle(const std::string& name, double radius, double x = 0.0, double y = 0.0);
/// A closed curve about a middle.
/// @param reach  distance from the middle in a direction of length one
Curve curve_around(const std::string& name, const std::function<double(const Vec2&)>& reach,
                   const Vec2& middle = Vec2::Zero());
/// A line across a direction, at a distance from a point, and of a length to both sides.
Curve line_across(const std::string& name, const Vec2& direction, double distance, double length,
                  const Vec2& from = Vec2::Zero());

/// A curve for the dots of a path in time, one a revolution; it has no dots yet.
Curve dots_of_revolutions();
/// Gives an axis a range if its values differ by `room` at most, as by rounding, which would be
/// drawn large otherwise.
/// @param room  to both sides of the values; values that are farther apart have the range that they
///              need
void keep_room(FigureAxis& axis, const std::vector<double>& values, double room);

constexpr double seen_revolutions = 8.0;  ///< of a time history, at first

/// Names of the stations that the motion of a result was recorded at; none without a motion.
std::vector<std::string> recorded_stations(const ResultView& result);

/// A motion of a result, and which stretch of it is drawn.
struct Motion : RecordedMotion {
  /// @throws FileError  for a result without a motion
  explicit Motion(const ResultView& result);

  const MotionRecord& record;
  std::vector<std::string> stations;  ///< their names
  MotionWindow window;

  /// The samples that are seen at first: the last `revolutions` if no window was asked for.
  MotionSamples shown(double revolutions) const;
  /// The samples that curves are made of: those of a window that was asked for, else all, so that
  /// the view can be moved along them.
  MotionSamples drawn(double revolutions) const;
  /// Says what is seen at first; nothing where all is seen.
  std::vector<std::string> notes(double revolutions) const;
  /// Shows a part of the motion over time at first: that of a window that was asked for, else where
  /// the first load begins, else the last `revolutions`; with the instants at which loads begin.
  void show_over_time(Panel& p, double revolutions) const;
  /// What is shown so, in words.
  std::vector<std::string> time_notes(double revolutions) const;

  Eigen::Index size() const { return time.size(); }
  double phase(Eigen::Index i) const;  ///< of the rotor at a sample [rad]
  bool ends_revolution(Eigen::Index i) const;
};

/// Outline of half a seal seen from the side: a ring with teeth that end near the shaft.
struct SealShape {
  std::vector<double> x, y;
};
/// @param at    its middle
/// @param half  of its width
/// @param tip   where the teeth end; top: the ring's far side
SealShape seal_shape(double at, double half, double tip, double top);

}  // namespace figures

}  // namespace whirl::inline io
