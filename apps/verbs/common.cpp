#include "apps/verbs/common.hpp"

#include <fmt/format.h>

#include "apps/verbs/notes.hpp"
#include "apps/version.hpp"
#include "libbase/error.hpp"
#include "libfe/modes.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"
#include "libio/text/value_range.hpp"

namespace whirl {

Record begin_record(const Invocation& call, const Model& model) {
  Record record;
  record.set("model", call.file).set("version", version).set("speed_rpm", model.speed / rpm);
  return record;
}

void add_modes(Record& record, const Modes& modes) {
  const auto entry = [](const Mode& mode, int number) {
    Record r;
    r.set("number", number)
        .set("frequency_rpm", mode.frequency() / rpm)
        .set("damping_ratio", mode.damping_ratio())
        .set("log_decrement", mode.log_decrement())
        .set("heavily_damped", mode.damping_ratio() > heavy_damping)
        .set("whirl", name_of(mode.whirl))
        .set("eigenvalue", mode.lambda)
        .set("kappa", mode.kappa);
    return r;
  };
  Record list = Record::array(), rigid = Record::array(), roots = Record::array();
  int number = 0;
  for (const Mode& mode : modes.oscillatory) list.add(entry(mode, ++number));
  number = 0;
  for (const Mode& mode : modes.rigid_body) rigid.add(entry(mode, ++number));
  for (const Complex& root : modes.overdamped) roots.add(root.real());
  Record overdamped = Record::array();
  for (const Complex& root : modes.overdamped) overdamped.add(root);
  record.set("modes", list)
      .set("real_roots", roots)
      .set("overdamped", overdamped)
      .set("rigid_body", rigid);
}

std::string fixed(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  const bool is_zero = text.find_first_of("123456789ni") == std::string::npos;
  return is_zero && text.starts_with('-') ? text.substr(1) : text;
}

std::string modes_table(const Modes& modes) {
  Table table(
      {"mode", "frequency [rpm]", "[Hz]", "log decrement", "damping ratio", "whirl", "kappa"});
  int number = 0;
  bool has_heavy = false;
  for (const Mode& m : modes.oscillatory) {
    const bool is_heavy = m.damping_ratio() > heavy_damping;
    has_heavy = has_heavy || is_heavy;
    table.row({fmt::format("{}{}", ++number, is_heavy ? heavy_mark : ""),
               fmt::format("{:.1f}", m.frequency() / rpm),
               fmt::format("{:.3f}", m.frequency() / rpm / 60.0), fixed(m.log_decrement(), 4),
               fixed(m.damping_ratio(), 5), std::string(name_of(m.whirl)), fixed(m.kappa, 3)});
  }
  std::string text = table.text();
  if (has_heavy) text += heavy_legend;
  if (!modes.overdamped.empty()) {
    text += "\n  overdamped [1/s]:";
    for (const Complex& root : modes.overdamped) text += fmt::format(" {:.4g}", root.real());
    text += "\n";
  }
  if (!modes.rigid_body.empty()) {
    text += fmt::format("\n  {} rigid-body modes: the rotor is free\n", modes.rigid_body.size());
  }
  return text;
}

void write_modes(ResultWriter& file, const Modes& modes, const DofMap& dofs) {
  const auto n = static_cast<Eigen::Index>(modes.oscillatory.size());
  CVec lambda(n);
  Vec frequency(n), damping(n), decrement(n), kappa(n);
  CMat shapes(dofs.full_size, n);
  std::vector<std::string> whirl;
  std::vector<int> number;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Mode& m = modes.oscillatory[static_cast<std::size_t>(i)];
    lambda(i) = m.lambda;
    frequency(i) = m.frequency();
    damping(i) = m.damping_ratio();
    decrement(i) = m.log_decrement();
    kappa(i) = m.kappa;
    shapes.col(i) = dofs.T * m.shape;
    whirl.emplace_back(name_of(m.whirl));
    number.push_back(static_cast<int>(i) + 1);
  }
  file.dataset("/modes/number", number, {"", "mode", {""}});
  const std::vector<std::string> per_mode{"/modes/number"};
  file.dataset("/modes/eigenvalue", lambda, {"rad/s", "eigenvalue", per_mode});
  file.dataset("/modes/frequency", frequency, {"rad/s", "damped natural frequency", per_mode});
  file.dataset("/modes/damping_ratio", damping, {"", "damping ratio", per_mode});
  file.dataset("/modes/log_decrement", decrement, {"", "logarithmic decrement", per_mode});
  file.dataset("/modes/kappa", kappa,
               {"", "signed axis ratio where the mode moves most", per_mode});
  file.dataset("/modes/whirl", whirl, {"", "sense of whirl", per_mode});
  file.dataset("/modes/shape", shapes,
               {"m, rad",
                "complex shape: x, y, theta_x, theta_y of every node, then of every body",
                {"", "/modes/number"}});
}

void write_points(ResultWriter& file, const Model& model, const Assembler& assembler) {
  std::vector<std::string> names;
  Vec z(assembler.mesh().nodes());
  for (int i = 0; i < assembler.mesh().nodes(); ++i) {
    z(i) = assembler.mesh().z[static_cast<std::size_t>(i)];
    names.emplace_back();
  }
  for (const NamedPoint& p : named_points(model, assembler)) {
    if (p.point.kind == Point::Kind::node) names[static_cast<std::size_t>(p.point.index)] = p.name;
  }
  if (z.size() > 0) {
    file.dataset("/points/z", z, {"m", "position of the nodes along the shaft", {""}});
    file.dataset("/points/node_name", names, {"", "what is at the nodes", {""}});
  }
  std::vector<std::string> bodies;
  for (const Body& body : model.structure.bodies) bodies.push_back(body.name);
  if (!bodies.empty()) file.dataset("/points/body_name", bodies, {"", "bodies", {""}});
}

std::string point_label(const NamedPoint& point) {
  if (point.node() == 0) return point.name;
  return point.name.empty() ? fmt::format("{}", point.node())
                            : fmt::format("{} {}", point.node(), point.name);
}

void set_frequency_unit(const Invocation& call, ResultView& result) {
  const std::string name = call.text("frequency");
  const auto unit = frequency_unit(name);
  if (!unit) throw ModelError({"--frequency " + name}, "", "expected Hz, cpm or rad/s");
  result.frequency = *unit;
}

MotionWindow window_of(const Invocation& call) {
  MotionWindow window;
  if (call.has("times")) {
    const std::string text = call.text("times");
    for (const char* other : {"from-revolution", "revolutions"}) {
      if (call.has(other)) {
        throw ModelError({"--times " + text}, "", fmt::format("does not go with --{}", other));
      }
    }
    const auto range = parse_range(text, "s");
    if (!range) throw ModelError({"--times " + text}, "", range.problem);
    if (range->step) throw ModelError({"--times " + text}, "", "expected two times, first:last");
    window.times = {range->first, range->last};
  }
  if (call.has("from-revolution")) {
    window.from_revolution = static_cast<double>(call.integer("from-revolution", 0));
  }
  if (call.has("revolutions")) {
    window.revolutions = static_cast<double>(call.integer("revolutions"));
  }
  return window;
}

void write_notes(ResultWriter& file, const Report& report) {
  if (report.notes.empty()) return;
  file.attribute("/", "notes", fmt::format("{}", fmt::join(report.notes, "\n")));
}

void commit(const Invocation& call, ResultWriter* file, Report& report) {
  if (!file) return;
  write_notes(*file, report);
  file->commit();
  report.text += fmt::format("\n  result: {}\n", call.given.at("out"));
}

}  // namespace whirl
