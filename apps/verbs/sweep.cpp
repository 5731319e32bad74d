#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/simulation.hpp"
#include "apps/verbs/study.hpp"
#include "apps/verbs/study_classification.hpp"
#include "libbase/constants.hpp"
#include "libbase/error.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

constexpr std::size_t carried_piece = 16, most_fresh = 64;  ///< values that go together
constexpr int samples = 64;                                 ///< per revolution, of a portrait
constexpr int highest_order = 8;                            ///< of the spectra
constexpr int sectors = 36;                                 ///< around a stator
const std::string group = "/sweep";

/// What is seen of a motion beside its kind: sections and spectra at stations, largest radii, where
/// contacts touch.
struct Portraits {
  std::vector<NamedPoint> stations;
  long sections, spectrum_revolutions;

  std::vector<PointColumn> columns(const Scene& scene) const;
  void write_axes(ResultWriter& file) const;
  void add(const StudyPoint& point, double tolerance, PointRow& row) const;
};

std::vector<PointColumn> Portraits::columns(const Scene& scene) const {
  const Eigen::Index n = std::ssize(stations), contacts = scene.contacts.owners();
  const std::string station = group + "/station", contact = group + "/contact";
  const Eigen::Index full = scene.reduced.dofs.T.rows(),
                     lines = std::max(1L, spectrum_revolutions) * 2 * highest_order + 1;
  std::vector<PointColumn> columns{
      {"poincare_x", "m", "x at phase 0, last sections", false, {n, sections}, {station, ""}},
      {"poincare_y", "m", "y at phase 0, last sections", false, {n, sections}, {station, ""}},
      {"end_displacement", "m, rad", "displacement that the next value starts from", false, {full}},
      {"end_velocity", "m/s, rad/s", "velocity that the next value starts from", false, {full}}};
  if (spectrum_revolutions == 0) return columns;
  columns.push_back({"max_radius", "m", "largest distance from the axis", false, {n}, {station}});
  columns.push_back({"spectrum",
                     "m",
                     "radius of the circle that turns with an order of the speed; seen from the "
                     "rotor the order is one less",
                     false,
                     {n, lines},
                     {station, group + "/order"}});
  if (contacts > 0) {
    columns.push_back({"contact_angle",
                       "",
                       "share of the time in touch within a sector around the stator",
                       false,
                       {contacts, sectors},
                       {contact, group + "/sector"}});
  }
  return columns;
}

void Portraits::write_axes(ResultWriter& file) const {
  std::vector<std::string> names;
  for (const NamedPoint& p : stations) names.push_back(point_label(p));
  file.dataset(group + "/station", names, {"", "station", {""}});
  if (spectrum_revolutions == 0) return;
  const long lines = spectrum_revolutions * highest_order;
  file.dataset(group + "/order", Vec(Vec::LinSpaced(2 * lines + 1, -highest_order, highest_order)),
               {"", "signed frequency over speed, forward > 0", {""}});
  const double width = turn / sectors;
  file.dataset(group + "/sector",
               Vec(Vec::LinSpaced(sectors, 0.5 * width, (sectors - 0.5) * width)),
               {"rad", "middle of a sector, from x to y", {""}});
}

/// Share of samples in touch, by the angle to which the rotor is displaced there.
void add_angles(const StudyPoint& point, const Recording& recording, std::vector<double>& shares) {
  const ContactSystem& system = point.scene->contacts;
  shares.assign(static_cast<std::size_t>(system.owners()) * sectors, 0.0);
  const double each = 1.0 / static_cast<double>(recording.eta.cols());
  int last = -1;
  for (const ReducedContact& c : system.contacts()) {
    if (c.owner == last) continue;  // another blade
    last = c.owner;
    for (Eigen::Index j = 0; j < recording.eta.cols(); ++j) {
      if (recording.normal(c.owner, j) <= 0.0) continue;
      const Vec2 d = c.U * recording.eta.col(j) - c.offset;
      const double share = std::atan2(d(1), d(0)) / turn;
      const auto sector = static_cast<std::size_t>((share < 0.0 ? share + 1.0 : share) * sectors);
      shares[static_cast<std::size_t>(c.owner) * sectors +
             std::min<std::size_t>(sector, sectors - 1)] += each;
    }
  }
}

void Portraits::add(const StudyPoint& point, double tolerance, PointRow& row) const {
  const std::size_t first = row.size();
  row.resize(first + columns(*point.scene).size());
  const Scene& scene = *point.scene;
  const Classification& found = point.subject.found;
  const Mat map = scene.displacement_map();
  const DofMap& dofs = scene.reduced.dofs;
  const auto n = scene.contacts.coordinates();
  const Eigen::Map<const Mat> states(found.sections.data(), 2 * n,
                                     std::ssize(found.sections) / (2 * n));
  for (const NamedPoint& p : stations) {
    for (const int c : {X, Y}) {
      const Vec line = (map.row(dofs.full_index(p.point, c)) * states.topRows(n)).transpose();
      std::vector<double>& to = row[first + (c == X ? 0u : 1u)];
      to.insert(to.end(), line.begin(), line.end());
      to.resize(to.size() + static_cast<std::size_t>(sections - line.size()),
                std::numeric_limits<double>::quiet_NaN());
    }
  }
  if (spectrum_revolutions == 0) return;

  SimulationOptions how{.revolutions = spectrum_revolutions, .discard = 0, .samples = samples};
  how.method = Taylor{};
  how.integration.tolerance = tolerance;
  const Simulation seen = simulate(scene, found.end, how);
  if (seen.recording.revolutions < spectrum_revolutions) return;
  const ResponseSpectra spectra(scene, seen.recording);
  const long lines = spectrum_revolutions * highest_order;
  for (const NamedPoint& p : stations) {
    const Mat x = map.row(dofs.full_index(p.point, X)) * seen.recording.eta;
    const Mat y = map.row(dofs.full_index(p.point, Y)) * seen.recording.eta;
    row[first + 4].push_back(std::sqrt((x.array().square() + y.array().square()).maxCoeff()));
    const Spectrum s = spectra.at(p.point);
    for (long k = -lines; k <= lines; ++k) row[first + 5].push_back(std::abs(s.at(k)));
  }
  if (!scene.contacts.contacts().empty()) add_angles(point, seen.recording, row[first + 6]);
}

/// One way along the values, each motion going on from the one before.
class Chain {
 public:
  Chain(const StudySetup& setup, const PointTable& table, std::size_t values)
      : setup_(setup), table_(table), values_(values) {}

  /// Value of a row: up, then down.
  std::size_t value_of(std::size_t row) const { return row < values_ ? row : row - values_; }
  /// The row whose end a row starts from; none for the first.
  std::optional<std::size_t> before(std::size_t row) const {
    if (row == 0) return std::nullopt;
    if (row < values_) return row - 1;
    return row == 2 * values_ - 1 ? values_ - 1 : row + 1;
  }

  /// The motion of a row, settled, with the state in which the next one begins.
  StudyPoint go(std::size_t row) {
    const auto from = before(row);
    if (from && last_ != from) {
      end_ = {vector("end_displacement", *from), vector("end_velocity", *from)};
    }
    const bool goes_on = from && end_.displacement.size() > 0 && end_.displacement.allFinite();
    StudyPoint point = setup_.point(value_of(row), goes_on ? &end_ : nullptr);
    last_ = row;
    end_ = {};
    if (!point.failure.empty()) return point;
    settle({&point.subject, 1}, setup_.options());
    const Classification& found = point.subject.found;
    if (!found.is_good()) return point;
    Trajectory on{.system = point.subject.system, .state = found.end};
    on.revolutions = found.is_proven ? 0 : setup_.options().revolutions;
    if (on.revolutions > 0) {
      integrate_single(on,
                       {.tolerance = setup_.options().tolerance, .watch = setup_.options().watch});
    }
    if (on.outcome == Outcome::reached_end) end_ = full_state(*point.scene, on.state);
    return point;
  }
  /// Where the last motion ended; empty if it failed.
  const FullState& end() const { return end_; }

 private:
  Vec vector(const std::string& column, std::size_t row) const {
    const auto values = table_.at(column, row);
    return Eigen::Map<const Vec>(values.data(), std::ssize(values));
  }

  const StudySetup& setup_;
  const PointTable& table_;
  std::size_t values_;
  std::optional<std::size_t> last_;
  FullState end_;
};

std::vector<StudyPoint*> pointers(std::vector<std::pair<std::size_t, StudyPoint>>& points) {
  std::vector<StudyPoint*> all;
  for (auto& [row, point] : points) all.push_back(&point);
  return all;
}

/// Motions of one or two ways, told apart and portrayed.
StudyRows finish(std::vector<std::pair<std::size_t, StudyPoint>>& points,
                 const std::vector<FullState>& ends, const StudySetup& setup,
                 const Portraits& portraits) {
  together(pointers(points),
           [&](std::span<Subject> motions) { average(motions, setup.options()); });
  StudyRows result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [row, point] = points[i];
    if (!point.is_good() && result.failure.empty()) {
      result.failure = setup.describe(row % setup.points()) + ": " + point.why();
    }
    PointRow numbers = classification_row(point);
    if (point.is_good()) {
      const std::size_t first = numbers.size();
      portraits.add(point, setup.options().tolerance, numbers);
      const FullState& end = ends[i];
      numbers[first + 2] = {end.displacement.begin(), end.displacement.end()};
      numbers[first + 3] = {end.velocity.begin(), end.velocity.end()};
    }
    result.rows.emplace_back(row, std::move(numbers));
  }
  result.is_whole = !is_interrupted();
  return result;
}

Record entries(const PointTable& table, const StudySetup& setup, std::size_t first, bool is_down) {
  Record list = Record::array();
  const std::vector<double>& values = setup.axes()[0].values;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t i = is_down ? values.size() - 1 - k : k, row = first + i;
    if (!table.is_done(row)) continue;
    Record r;
    const std::string motion = motion_name(table, row);
    r.set("value", values[i]).set("motion", motion.empty() ? Record(nullptr) : Record(motion));
    const double period = table.number("period", row);
    r.set("period_revs", period > 0.0 ? Record(static_cast<long>(period)) : Record(nullptr));
    Record::Array sections;
    const auto x = table.at("poincare_x", row);
    const std::size_t stations = x.size() / static_cast<std::size_t>(setup.options().sections);
    for (std::size_t j = 0; j < x.size() / std::max<std::size_t>(1, stations); ++j) {
      if (std::isfinite(x[j])) sections.emplace_back(x[j]);
    }
    r.set("poincare_m", Record(sections));
    const auto exponents = table.at("exponent", row);
    r.set("lyapunov_max", exponents.empty() ? Record(nullptr) : Record(exponents[0]));
    double impacts = 0.0;
    for (const double per_rev : table.at("impacts_per_rev", row)) impacts += per_rev;
    r.set("impacts_per_rev", impacts);
    list.add(r);
  }
  return list;
}

/// Stretches of values with the same motion, for people.
std::string stretches(const PointTable& table, const StudySetup& setup, std::size_t first,
                      bool is_down) {
  const ParameterAxis& axis = setup.axes()[0];
  Table text({axis.title(), "values", "motion", "period", "impacts per revolution",
              "largest exponent per revolution"});
  const std::size_t count = axis.values.size();
  const auto row_of = [&](std::size_t k) { return first + (is_down ? count - 1 - k : k); };
  const auto same = [&](std::size_t a, std::size_t b) {
    return table.is_done(a) == table.is_done(b) && motion_name(table, a) == motion_name(table, b) &&
           table.number("period", a) == table.number("period", b);
  };
  for (std::size_t k = 0; k < count;) {
    std::size_t to = k;
    while (to + 1 < count && same(row_of(k), row_of(to + 1))) ++to;
    double low = 1e300, high = -1e300, exponent = -1e300;
    for (std::size_t i = k; i <= to; ++i) {
      double impacts = 0.0;
      for (const double per_rev : table.at("impacts_per_rev", row_of(i))) impacts += per_rev;
      low = std::min(low, impacts);
      high = std::max(high, impacts);
      const auto all = table.at("exponent", row_of(i));
      if (!all.empty()) exponent = std::max(exponent, all[0]);
    }
    const std::size_t row = row_of(k);
    const std::string motion = motion_name(table, row);
    const double from = axis.shown(row - first), until = axis.shown(row_of(to) - first);
    const double period = table.number("period", row);
    text.row({to == k ? fmt::format("{:.7g}", from) : fmt::format("{:.7g} to {:.7g}", from, until),
              fmt::format("{}", to - k + 1),
              !table.is_done(row) ? "not computed"
              : motion.empty()    ? "failed"
                                  : motion,
              period > 0.0 ? fmt::format("{:.0f}", period) : "-",
              motion.empty()      ? "-"
              : high - low < 1e-9 ? fmt::format("{:.4g}", low)
                                  : fmt::format("{:.3g} to {:.3g}", low, high),
              motion.empty() ? "-" : fmt::format("{:+.4f}", exponent)});
    k = to + 1;
  }
  return text.text();
}

Report run_sweep(const Invocation& call) {
  StudySetup setup(call, 1, 1);
  setup.options().sections = call.integer("sections");
  setup.options().watch = [](long) { return !is_interrupted(); };
  const bool is_fresh = call.has("fresh");
  const std::size_t values = setup.axes()[0].values.size(), ways = is_fresh ? 1 : 2;

  const StudyPoint first = setup.point(0);
  if (!first.scene) throw NumericalError(setup.describe(0) + ": " + first.failure);
  Portraits portraits{
      .stations = select_points(*first.model, first.scene->assembler, call.text("stations")),
      .sections = setup.options().sections,
      .spectrum_revolutions = call.integer("spectra", 0)};
  std::vector<PointColumn> columns = classification_columns(*first.scene, group);
  for (const PointColumn& c : portraits.columns(*first.scene)) columns.push_back(c);
  const std::string way = group + "/direction", along = setup.axis_paths(group)[0];
  PointTable table(group, columns,
                   {static_cast<Eigen::Index>(ways), static_cast<Eigen::Index>(values)},
                   {way, along});
  const auto begin = [&] {
    auto file = setup.file(call, group);
    std::vector<std::string> names{is_fresh ? "fresh" : "up"};
    if (!is_fresh) names.emplace_back("down");
    file->dataset(way, names, {"", "direction", {""}});
    write_classification_axes(*file, *first.scene, group);
    portraits.write_axes(*file);
    return file;
  };

  Chain chain(setup, table, values);
  StudyWork work{.label = "sweeping"};
  for (std::size_t w = 0; w < ways && !is_fresh; ++w) {
    for (std::size_t k = 0; k < values; k += carried_piece) {
      work.pieces.emplace_back();
      for (std::size_t j = k; j < std::min(values, k + carried_piece); ++j) {
        work.pieces.back().push_back(w == 0 ? j : 2 * values - 1 - j);
      }
    }
  }
  if (is_fresh) {
    work.most_together = most_fresh;
    work.threads = setup.threads();
    work.prepare = [&](const std::vector<std::size_t>& piece) -> std::function<StudyRows()> {
      return [&, piece] {
        std::vector<std::pair<std::size_t, StudyPoint>> points;
        for (const std::size_t row : piece) points.emplace_back(row, setup.point(row));
        together(pointers(points),
                 [&](std::span<Subject> motions) { settle(motions, setup.options()); });
        return finish(points, std::vector<FullState>(points.size()), setup, portraits);
      };
    };
  } else {
    work.threads = setup.threads() - 1;  // one goes ahead along the chain
    work.prepare = [&](const std::vector<std::size_t>& piece) -> std::function<StudyRows()> {
      auto points = std::make_shared<std::vector<std::pair<std::size_t, StudyPoint>>>();
      auto ends = std::make_shared<std::vector<FullState>>();
      for (const std::size_t row : piece) {
        points->emplace_back(row, chain.go(row));
        ends->push_back(chain.end());
      }
      return [&, points, ends] { return finish(*points, *ends, setup, portraits); };
    };
  }
  const StudyOutcome outcome = run_study(call, work, table, setup.earlier(), begin);

  Report report{.record = begin_record(call, setup.model()), .status = outcome.status};
  note_tables(call, setup.model(), report);
  Record& r = report.record;
  r.set("parameter", setup.axes()[0].path).set("unit", setup.axes()[0].unit);
  r.set("values", setup.axes()[0].values);
  r.set("up", entries(table, setup, 0, false));
  r.set("down", is_fresh ? Record::array() : entries(table, setup, values, true));
  r.set("resumed", static_cast<long>(outcome.resumed));
  const std::string& title = setup.model().title;
  report.text = "Sweep" + (title.empty() ? "" : ": " + title) + "\n";
  for (std::size_t w = 0; w < ways; ++w) {
    report.text += fmt::format("\n  {}\n", is_fresh ? "every value from the start of the model"
                                           : w == 0 ? "up"
                                                    : "down");
    report.text += stretches(table, setup, w * values, w == 1);
  }
  add_outcome(call, outcome, table, report);
  return report;
}

}  // namespace

Verb sweep_verb() {
  return {
      .name = "sweep",
      .group = "Contact",
      .summary = "bifurcation diagram and spectra along one parameter, up and down",
      .example =
          "whirl sweep models/jeffcott_stator.toml --over operation.speed=130:140:0.5rad/s --out "
          "sweep.h5",
      .options = study_options(
          {over_option,
           points_option,
           {"fresh", "", "every value from the model's start, not from the one before"},
           {"sections", "N", "Poincare sections kept of a motion", "64"},
           {"spectra", "N", "revolutions of a value's spectrum, 0: none", "32"},
           {"stations", "NAME,...",
            "of sections and spectra: names, node numbers, all; left out: contacts, disks, "
            "bearings"}}),
      .run = run_sweep,
  };
}

}  // namespace whirl
