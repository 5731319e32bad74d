#include "libio/import/ross_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "libbase/error.hpp"
#include "libfe/parts/structure.hpp"
#include "libio/import/ross_differences.hpp"
#include "libio/import/ross_shafts.hpp"
#include "libio/import/ross_text.hpp"

namespace whirl::inline io {

namespace {

constexpr double least_stiffness = 1.0;  ///< Young's modulus of a shaft that bears nothing [Pa]

double hutchinson_of_ross(const RossElement& e) {
  const double r = (e.inner[0] + e.inner[1]) / (e.outer[0] + e.outer[1]), r2 = r * r;
  const double a = (1.0 + r2) * (1.0 + r2), nu = e.nu;
  return 6.0 * a * (1.0 + nu) /
         (a * (7.0 + 12.0 * nu + 4.0 * nu * nu) + 4.0 * r2 * (5.0 + 6.0 * nu + 2.0 * nu * nu));
}

/// Equal elements beside one another, of the shaft or of a layer.
struct Run {
  const RossElement* element;
  int count = 1;

  int end() const { return element->node + count; }
};

/// Joins elements that go on where a run ends.
std::vector<Run> runs_of(const std::vector<const RossElement*>& elements) {
  std::vector<Run> runs;
  for (const RossElement* e : elements) {
    const auto before = std::find_if(runs.begin(), runs.end(), [&](const Run& run) {
      return run.end() == e->node && run.element->is_like(*e);
    });
    if (before == runs.end()) {
      runs.push_back({e});
    } else {
      ++before->count;
    }
  }
  return runs;
}

class Writer {
 public:
  Writer(const RossRotor& rotor, const std::string& source, const std::string& stem)
      : rotor_(rotor), source_(source), stem_(stem), shafts_(shafts_of(rotor)) {
    result_.left_out = rotor.left_out;
    result_.taken_differently = rotor.taken_differently;
    for (const auto& [from, to] : {std::pair(&shafts_.left_out, &result_.left_out),
                                   {&shafts_.taken_differently, &result_.taken_differently}}) {
      to->insert(to->end(), from->begin(), from->end());
    }
  }

  ImportedModel write() {
    names_["body"] = {"ground"};  // and the names of shafts: bearings may be against either
    if (shafts_.shafts.size() > 1) names_["body"].insert("shaft");
    for (const RossShaft& s : shafts_.shafts) names_["body"].insert(s.name);
    text("# From {}, saved by ROSS {}.\nformat = 1\ntitle  = {}\n", one_line(source_),
         rotor_.version.empty() ? "(of unknown version)" : one_line(rotor_.version),
         toml_text(stem_));
    write_speeds();
    for (const RossMaterial& m : rotor_.materials) {
      text("\n[material.{}]\ndensity        = {}\nyoungs_modulus = {}\nshear_modulus  = {}\n",
           toml_key(m.name), shown_number(m.rho), shown_number(m.E), shown_number(m.G));
    }
    write_rotors();
    write_shaft();
    write_layers();
    write_disks();
    write_couplings();
    write_teeth();
    write_supports();
    for (const RossBearing& b : rotor_.bearings) write_bearing(b);
    write_damping();
    for (std::string& told : differences_of(rotor_)) {
      result_.taken_differently.push_back(std::move(told));
    }
    return std::move(result_);
  }

 private:
  template <class... Values>
  void text(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(result_.text), format, std::forward<Values>(values)...);
  }

  /// A name that nothing else of its kind has.
  std::string unique(const std::string& kind, const std::string& wanted) {
    std::string name = wanted;
    int& copies = copies_[{kind, wanted}];  // many may want one name: none looks from the first on
    for (copies = std::max(copies, 1); !names_[kind].insert(name).second;) {
      name = fmt::format("{} {}", wanted, ++copies);
    }
    return name;
  }

  /// Name of what is between the halves of a coupling, which no other material has.
  std::string gap_material() const {
    std::string name = "nothing";
    const auto is_taken = [&](const RossMaterial& m) { return m.name == name; };
    while (std::any_of(rotor_.materials.begin(), rotor_.materials.end(), is_taken)) name += "_";
    return name;
  }

  /// "node = 3" or "body = "pedestal"", or with braces around it.
  std::string station(int node) const {
    if (shafts_.has(node)) return fmt::format("node = {}", shafts_.number(node));
    return fmt::format("body = {}", toml_text(supports_.at(node)));
  }

  void write_speeds() {
    std::string keys;
    const auto add = [&](const char* key, double speed) {
      if (speed > 0.0) keys += fmt::format("{:<13} = \"{} rad/s\"\n", key, speed);
    };
    add("speed", rotor_.rated_speed);
    add("minimum_speed", rotor_.minimum_speed);
    add("maximum_speed", rotor_.maximum_speed);
    if (!keys.empty()) text("\n[operation]\n{}", keys);
  }

  /// Shafts beside the first one.
  void write_rotors() {
    for (const RossShaft& s : shafts_.shafts) {
      if (s.name.empty()) continue;
      text("\n[[rotor]]\nname     = {}\nratio    = {}\n", toml_text(s.name), s.ratio);
      if (s.position > 0.0) text("position = {}\n", s.position);
    }
  }

  /// The head of a segment between two nodes of ROSS.
  void begin_segment(int from, int to, const std::string& note) {
    text("\n[[shaft]]                       # nodes {} to {}{}\n", shafts_.number(from),
         shafts_.number(to), note);
    const RossShaft* shaft = shafts_.shaft_of(from);
    if (!shaft->name.empty()) text("rotor          = {}\n", toml_text(shaft->name));
  }

  void write_beam_keys(const RossElement& e) {
    text("material       = {}\nouter_diameter = {}\n", toml_text(e.material), shown_pair(e.outer));
    if (e.inner[0] > 0.0 || e.inner[1] > 0.0) text("inner_diameter = {}\n", shown_pair(e.inner));
    if (!e.shears) text("theory         = {}\n", e.tilts ? "\"rayleigh\"" : "\"euler-bernoulli\"");
    if (e.shears && e.is_hutchinson) {
      text("shear_coefficient = {}\n", hutchinson_of_ross(e));
    }
    if (e.mass_damping != 0.0 || e.stiffness_damping != 0.0) {
      text("rayleigh       = {{ mass = {}, stiffness = {} }}\n", e.mass_damping,
           e.stiffness_damping);
    }
  }

  void write_shaft() {
    std::vector<Run> runs = runs_of(shafts_.elements);
    std::map<int, std::string> segments;  // by their first nodes: couplings are between them
    for (const Run& run : runs) {
      const RossElement& e = *run.element;
      std::string before;
      std::swap(before, result_.text);
      begin_segment(e.node, run.end(), "");
      text("length         = {}\nelements       = {}\n", run.count * e.length, run.count);
      write_beam_keys(e);
      if (e.axial_force != 0.0) text("axial_force    = {}\n", e.axial_force);
      if (e.torque != 0.0) text("torque         = {}\n", e.torque);
      segments[e.node] = std::move(result_.text);
      result_.text = std::move(before);
    }
    if (!rotor_.couplings.empty()) {
      text(
          "\n[material.{}]                # between the halves of a coupling\ndensity        = 0\n"
          "youngs_modulus = {}\npoisson_ratio  = 0.3\n",
          toml_key(gap_material()), least_stiffness);
    }
    for (const RossCoupling& c : rotor_.couplings) {
      std::string before;
      std::swap(before, result_.text);
      begin_segment(c.node, c.node + 1, ": " + one_line(c.name));
      text("length         = {}\nelements       = 1\nmaterial       = {}\nouter_diameter = {}\n",
           c.length, toml_text(gap_material()),
           c.outer > 0.0 ? c.outer : rotor_.elements.front().outer[0]);
      segments[c.node] = std::move(result_.text);
      result_.text = std::move(before);
    }
    for (const auto& [node, segment] : segments) result_.text += segment;
  }

  void write_layers() {
    for (const Run& run : runs_of(shafts_.layers)) {
      text("\n[[layer]]\nfrom           = {{ node = {} }}\nto             = {{ node = {} }}\n",
           shafts_.number(run.element->node), shafts_.number(run.end()));
      write_beam_keys(*run.element);
      if (run.element->inner[0] == 0.0) text("inner_diameter = 0\n");
      if (run.element->axial_force != 0.0 || run.element->torque != 0.0) {
        result_.left_out.push_back(
            fmt::format("axial force and torque of the layer at nodes {} to {}",
                        shafts_.number(run.element->node), shafts_.number(run.end())));
      }
    }
  }

  void write_disk(const std::string& name, int node, double m, double Id, double Ip) {
    text("\n[[disk]]\nname              = {}\nnode              = {}\nmass              = {}\n",
         toml_text(unique("disk", name)), shafts_.number(node), m);
    if (Id != 0.0) text("diametral_inertia = {}\n", Id);
    if (Ip != 0.0) text("polar_inertia     = {}\n", Ip);
  }

  void write_disks() {
    for (const RossDisk& d : rotor_.disks) {
      if (!shafts_.has(d.node)) {
        throw ModelError(d.where, d.name, fmt::format("there is no shaft at node {}", d.node));
      }
      write_disk(d.name, d.node, d.m, d.Id, d.Ip);
    }
    for (const RossCoupling& c : rotor_.couplings) {
      for (const int end : {0, 1}) {
        const auto i = static_cast<std::size_t>(end);
        if (c.has_equal_halves() || (c.m[i] == 0.0 && c.Id[i] == 0.0 && c.Ip[i] == 0.0)) continue;
        write_disk(c.name + (end == 0 ? " left" : " right"), c.node + end, c.m[i], c.Id[i],
                   c.Ip[i]);
      }
    }
  }

  void write_couplings() {
    for (const RossCoupling& c : rotor_.couplings) {
      text(
          "\n[[coupling]]\nname           = {}\nfrom           = {{ node = {} }}\n"
          "to             = {{ node = {} }}\nstiffness      = {}\ndamping        = {}\n"
          "tilt_stiffness = {}\ntilt_damping   = {}\n",
          toml_text(unique("link", c.name)), shafts_.number(c.node), shafts_.number(c.node + 1),
          shown_matrix(c.k[0], 0.0, 0.0, c.k[1]), shown_matrix(c.c[0], 0.0, 0.0, c.c[1]),
          shown_matrix(c.k_tilt[0], 0.0, 0.0, c.k_tilt[1]),
          shown_matrix(c.c_tilt[0], 0.0, 0.0, c.c_tilt[1]));
      if (!c.has_equal_halves()) continue;
      const std::pair<const char*, double> half[] = {
          {"mass", c.m[0]}, {"diametral_inertia", c.Id[0]}, {"polar_inertia", c.Ip[0]}};
      for (const auto& [key, value] : half) {
        if (value != 0.0) text("{:<14} = {}\n", key, value);
      }
    }
  }

  void write_teeth() {
    if (!shafts_.teeth) return;
    const auto& [driving, driven, stiffness, centers] = *shafts_.teeth;
    text(
        "\n[[gear]]\nname           = {}\ndriving        = {{ node = {} }}\n"
        "driven         = {{ node = {} }}\nstiffness      = {}\ndriving_radius = {}\n"
        "driven_radius  = {}\ncenters        = {}\npressure_angle = {}\n",
        toml_text(driving->name + " and " + driven->name), shafts_.number(driving->node),
        shafts_.number(driven->node), shown_number(stiffness), driving->pitch_radius,
        driven->pitch_radius, centers, driving->pressure_angle);
    if (driving->helix_angle != 0.0) text("helix_angle    = {}\n", driving->helix_angle);
  }

  /// Point masses: bodies where supports are, disks on the shaft, or fluid that moves with it.
  void write_supports() {
    std::map<int, RossPointMass> masses;
    const auto add_support = [&](int node) {
      if (node >= 0 && !shafts_.has(node)) {
        masses.try_emplace(node, RossPointMass{fmt::format("support {}", node), node});
      }
    };
    for (const RossPointMass& m : rotor_.masses) {
      const auto [at, is_new] = masses.try_emplace(m.node, m);
      if (is_new) continue;
      at->second.mx += m.mx;
      at->second.my += m.my;
    }
    for (const RossBearing& b : rotor_.bearings) {
      add_support(b.node);
      add_support(b.link);
    }
    for (const auto& [node, m] : masses) {
      if (shafts_.has(node) && m.mx == m.my) {
        write_disk(m.name, node, m.mx, 0.0, 0.0);
      } else if (shafts_.has(node)) {
        text("\n[[bearing]]\nname       = {}\nnode       = {}\nadded_mass = {}\n",
             toml_text(unique("bearing", m.name)), shafts_.number(node),
             shown_matrix(m.mx, 0.0, 0.0, m.my));
        result_.taken_differently.push_back(
            fmt::format("\"{}\" is another mass along x and y on the shaft: added mass without "
                        "weight",
                        m.name));
      } else {
        supports_[node] = unique("body", m.name);
        const std::array<double, 2> both{m.mx, m.my};
        text("\n[[body]]\nname = {}\nmass = {}\n", toml_text(supports_[node]), shown_pair(both));
      }
    }
  }

  /// A magnetic bearing, by its magnets and controller.
  void write_magnets(const RossMagnets& magnets) {
    const std::pair<const char*, double> keys[] = {
        {"angle", magnets.angle},
        {"current_stiffness", magnets.current_stiffness},
        {"negative_stiffness", magnets.negative_stiffness},
        {"proportional", magnets.proportional},
        {"integral", magnets.integral},
        {"derivative", magnets.derivative},
        {"derivative_bandwidth", magnets.derivative_bandwidth}};
    for (const auto& [key, value] : keys) {
      if (value != 0.0 || key == std::string_view("proportional")) {
        text("{} = {}\n", key, shown_number(value));
      }
    }
  }

  void write_bearing(const RossBearing& b) {
    int node = b.node, link = b.link;
    if (link >= 0 && shafts_.has(link) && !shafts_.has(node)) std::swap(node, link);
    const bool is_link = link >= 0 && shafts_.has(link);
    if (is_link && (b.has_speed || b.has_whirl || b.magnets)) {
      throw ModelError(b.where, b.name,
                       "coefficients of a link between two nodes of shafts that change with speed "
                       "or frequency have no place in a model; give constant ones");
    }
    const std::string kind = b.magnets   ? "magnetic_bearing"
                             : is_link   ? "link"
                             : b.is_seal ? "seal"
                                         : "bearing";
    const std::string name = unique(kind, b.name);
    text("\n[[{}]]\nname       = {}\n", kind, toml_text(name));
    if (is_link) {
      text("from       = {{ {} }}\nto         = {{ {} }}\n", station(node), station(link));
    } else {
      const std::string at = station(node);
      text("{:<10} = {}\n", at.substr(0, at.find(' ')), at.substr(at.find("= ") + 2));
      if (link >= 0) text("to         = {}\n", toml_text(supports_.at(link)));
    }
    if (b.magnets) return write_magnets(*b.magnets);
    if (b.has_speed || b.has_whirl) {
      const std::string file =
          unique("file", fmt::format("{}_{}", stem_, file_part(name))) + ".csv";
      result_.tables.push_back({file, table_of(b)});
      text("table      = {}\n", toml_text(file));
      if (b.rows.size() > 1) text("interpolation = \"pchip\"\n");
      return;
    }
    const auto& v = b.rows.front().values;
    const std::pair<const char*, std::size_t> groups[] = {
        {"stiffness ", 0}, {"damping   ", 4}, {"added_mass", 8}};
    for (const auto& [key, i] : groups) {
      const bool is_zero = v[i] == 0.0 && v[i + 1] == 0.0 && v[i + 2] == 0.0 && v[i + 3] == 0.0;
      if (!is_zero || i == 0)
        text("{} = {}\n", key, shown_matrix(v[i], v[i + 1], v[i + 2], v[i + 3]));
    }
  }

  /// Damping of the whole rotor.
  void write_damping() {
    const bool is_rayleigh = rotor_.mass_damping > 0.0 || rotor_.stiffness_damping > 0.0;
    std::vector<double> ratios = rotor_.damping_ratios;
    const auto is_default = [&](double ratio) { return ratio == rotor_.default_ratio; };
    const bool is_one = std::all_of(ratios.begin(), ratios.end(), is_default);
    const bool is_modal = !is_one || rotor_.default_ratio > 0.0;
    if (!is_rayleigh && !is_modal) return;
    text("\n[damping]\n");
    if (is_rayleigh) {
      text("rayleigh = {{ mass = {}, stiffness = {} }}\n", rotor_.mass_damping,
           rotor_.stiffness_damping);
    }
    if (!is_modal) return;
    if (is_one) {
      text("modal    = {}\n", rotor_.default_ratio);
    } else {
      if (rotor_.default_ratio > 0.0 && ratios.size() < most_damped_modes) {
        ratios.resize(most_damped_modes, rotor_.default_ratio);
      }
      text("modal    = [{}]\n", fmt::join(ratios, ", "));
    }
    result_.taken_differently.push_back(fmt::format(
        "damping ratios of modes are those of lateral modes at rest that deform{}; ROSS counts "
        "modes along and about the axis, too",
        is_one ? fmt::format(", up to number {}", most_damped_modes) : ""));
  }

  const RossRotor& rotor_;
  const std::string &source_, &stem_;
  ImportedModel result_;
  RossShafts shafts_;
  std::map<int, std::string> supports_;                        ///< names of bodies
  std::map<std::string, std::set<std::string>> names_;         ///< taken, by kind
  std::map<std::pair<std::string, std::string>, int> copies_;  ///< of a kind that wanted a name
};

}  // namespace

ImportedModel model_of(const RossRotor& rotor, const std::string& source, const std::string& stem) {
  return Writer(rotor, source, stem).write();
}

}  // namespace whirl::inline io
