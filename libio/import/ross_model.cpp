#include "libio/import/ross_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "libbase/error.hpp"
#include "libfe/parts/structure.hpp"
#include "libio/import/ross_differences.hpp"

namespace whirl::inline io {

namespace {

constexpr double least_stiffness = 1.0;  ///< Young's modulus of a shaft that bears nothing [Pa]

/// A number as people write it: 2.11e11 rather than 211000000000.
std::string number(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t last = text.find_last_not_of('0');
  const std::size_t first = text.front() == '-' ? 1 : 0;
  constexpr std::size_t long_tail = 5;
  const bool is_whole = text.find_first_of(".e") == std::string::npos;
  if (!is_whole || last == std::string::npos || text.size() - last <= long_tail) return text;
  const std::size_t exponent = text.size() - first - 1;
  std::string digits = text.substr(first, last + 1 - first);
  if (digits.size() > 1) digits.insert(1, ".");
  return fmt::format("{}{}e{}", first == 1 ? "-" : "", digits, exponent);
}

/// A text for a comment, which ends with its line.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  }
  return text;
}

/// A matrix: one value if it is that of both directions, else each that is not zero.
std::string matrix(double xx, double xy, double yx, double yy) {
  if (xx == yy && xx >= 0.0 && xy == 0.0 && yx == 0.0) return number(xx);
  std::string text = fmt::format("{{ xx = {}, yy = {}", number(xx), number(yy));
  if (xy != 0.0) text += fmt::format(", xy = {}", number(xy));
  if (yx != 0.0) text += fmt::format(", yx = {}", number(yx));
  return text + " }";
}

std::string diameter(const std::array<double, 2>& ends) {
  if (ends[0] == ends[1]) return fmt::format("{}", ends[0]);
  return fmt::format("[{}, {}]", ends[0], ends[1]);
}

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
      : rotor_(rotor), source_(source), stem_(stem) {
    result_.left_out = rotor.left_out;
    result_.taken_differently = rotor.taken_differently;
  }

  ImportedModel write() {
    sort_out_elements();
    text("# From {}, saved by ROSS {}.\nformat = 1\ntitle  = {}\n", one_line(source_),
         rotor_.version.empty() ? "(of unknown version)" : one_line(rotor_.version),
         toml_text(stem_));
    write_speeds();
    for (const RossMaterial& m : rotor_.materials) {
      text("\n[material.{}]\ndensity        = {}\nyoungs_modulus = {}\nshear_modulus  = {}\n",
           toml_key(m.name), number(m.rho), number(m.E), number(m.G));
    }
    write_shaft();
    write_disks();
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

  /// Parts the innermost elements, which are the shaft, from those that lie on them.
  void sort_out_elements() {
    std::vector<Problem> problems;
    std::map<int, double> lengths;  // of what joins a node to the next one
    for (const RossCoupling& c : rotor_.couplings) lengths[c.node] = c.length;
    for (const RossElement& e : rotor_.elements) {
      const auto [at, is_first] = lengths.try_emplace(e.node, e.length);
      (is_first ? shaft_ : layers_).push_back(&e);
      if (!is_first && std::abs(at->second - e.length) > 1e-9 * e.length) {
        problems.push_back(
            {e.where, "L",
             fmt::format("{} of a layer on {}: expected the same", e.length, at->second)});
      }
    }
    nodes_ = static_cast<int>(lengths.size()) + 1;
    require_one_shaft(lengths, problems);
    if (!problems.empty()) throw ModelError(std::move(problems));
  }

  /// Coaxial rotors have several shafts, whose nodes no element joins.
  /// @param lengths  of the elements, by their left nodes
  void require_one_shaft(const std::map<int, double>& lengths, std::vector<Problem>& problems) {
    std::vector<std::pair<int, int>> shafts;  // first and last node
    for (const auto& [node, length] : lengths) {
      if (shafts.empty() || shafts.back().second != node) shafts.emplace_back(node, node);
      shafts.back().second = node + 1;
    }
    if (shafts.size() == 1 && shafts.front().first == 0) return;
    std::string which;
    for (const auto& [first, last] : shafts) {
      which += fmt::format("{}{} to {}", which.empty() ? "" : ", ", first, last);
    }
    problems.push_back(
        {rotor_.elements.front().where, "n",
         shafts.size() == 1
             ? fmt::format("the shaft has the nodes {}, expected 0 to {}", which, lengths.size())
             : fmt::format("there are {} shafts, with the nodes {}, and no element between them: a "
                           "model has one shaft; save each as a rotor of its own, or join them by "
                           "elements",
                           shafts.size(), which)});
  }

  bool is_on_shaft(int node) const { return node < nodes_; }

  /// "node = 3" or "body = "pedestal"", or with braces around it.
  std::string station(int node) const {
    if (is_on_shaft(node)) return fmt::format("node = {}", node + 1);
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

  void write_beam_keys(const RossElement& e) {
    text("material       = {}\nouter_diameter = {}\n", toml_text(e.material), diameter(e.outer));
    if (e.inner[0] > 0.0 || e.inner[1] > 0.0) text("inner_diameter = {}\n", diameter(e.inner));
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
    std::vector<Run> runs = runs_of(shaft_);
    std::map<int, std::string> segments;  // by their first nodes: couplings are between them
    for (const Run& run : runs) {
      const RossElement& e = *run.element;
      std::string before;
      std::swap(before, result_.text);
      text("\n[[shaft]]                       # nodes {} to {}\n", e.node + 1, run.end() + 1);
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
      segments[c.node] = fmt::format(
          "\n[[shaft]]                       # nodes {} to {}: {}\nlength         = {}\n"
          "elements       = 1\nmaterial       = {}\nouter_diameter = {}\n",
          c.node + 1, c.node + 2, one_line(c.name), c.length, toml_text(gap_material()),
          c.outer > 0.0 ? c.outer : rotor_.elements.front().outer[0]);
    }
    for (const auto& [node, segment] : segments) result_.text += segment;
    for (const Run& run : runs_of(layers_)) {
      text("\n[[layer]]\nfrom           = {{ node = {} }}\nto             = {{ node = {} }}\n",
           run.element->node + 1, run.end() + 1);
      write_beam_keys(*run.element);
      if (run.element->inner[0] == 0.0) text("inner_diameter = 0\n");
      if (run.element->axial_force != 0.0 || run.element->torque != 0.0) {
        result_.left_out.push_back(
            fmt::format("axial force and torque of the layer at nodes {} to {}",
                        run.element->node + 1, run.end() + 1));
      }
    }
  }

  void write_disk(const std::string& name, int node, double m, double Id, double Ip) {
    text("\n[[disk]]\nname              = {}\nnode              = {}\nmass              = {}\n",
         toml_text(unique("disk", name)), node + 1, m);
    if (Id != 0.0) text("diametral_inertia = {}\n", Id);
    if (Ip != 0.0) text("polar_inertia     = {}\n", Ip);
  }

  void write_disks() {
    for (const RossDisk& d : rotor_.disks) write_disk(d.name, d.node, d.m, d.Id, d.Ip);
    for (const RossCoupling& c : rotor_.couplings) {
      for (const int end : {0, 1}) {
        const auto i = static_cast<std::size_t>(end);
        if (c.m[i] == 0.0 && c.Id[i] == 0.0 && c.Ip[i] == 0.0) continue;
        write_disk(c.name + (end == 0 ? " left" : " right"), c.node + end, c.m[i], c.Id[i],
                   c.Ip[i]);
      }
      text(
          "\n[[link]]\nname           = {}\nfrom           = {{ node = {} }}\n"
          "to             = {{ node = {} }}\nstiffness      = {}\ndamping        = {}\n"
          "tilt_stiffness = {}\ntilt_damping   = {}\n",
          toml_text(unique("link", c.name)), c.node + 1, c.node + 2,
          matrix(c.k[0], 0.0, 0.0, c.k[1]), matrix(c.c[0], 0.0, 0.0, c.c[1]),
          matrix(c.k_tilt[0], 0.0, 0.0, c.k_tilt[1]), matrix(c.c_tilt[0], 0.0, 0.0, c.c_tilt[1]));
    }
  }

  /// Point masses: bodies where supports are, disks on the shaft, or fluid that moves with it.
  void write_supports() {
    std::map<int, RossPointMass> masses;
    const auto add_support = [&](int node) {
      if (node >= 0 && !is_on_shaft(node)) {
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
      if (is_on_shaft(node) && m.mx == m.my) {
        write_disk(m.name, node, m.mx, 0.0, 0.0);
      } else if (is_on_shaft(node)) {
        text("\n[[bearing]]\nname       = {}\nnode       = {}\nadded_mass = {}\n",
             toml_text(unique("bearing", m.name)), node + 1, matrix(m.mx, 0.0, 0.0, m.my));
        result_.taken_differently.push_back(
            fmt::format("\"{}\" is another mass along x and y on the shaft: added mass without "
                        "weight",
                        m.name));
      } else {
        supports_[node] = unique("body", m.name);
        const std::array<double, 2> both{m.mx, m.my};
        text("\n[[body]]\nname = {}\nmass = {}\n", toml_text(supports_[node]), diameter(both));
      }
    }
  }

  void write_bearing(const RossBearing& b) {
    int node = b.node, link = b.link;
    if (link >= 0 && is_on_shaft(link) && !is_on_shaft(node)) std::swap(node, link);
    const bool is_link = link >= 0 && is_on_shaft(link);
    if (is_link && (b.has_speed || b.has_whirl)) {
      throw ModelError(
          b.where, b.name,
          "coefficients of a link between two nodes of the shaft that change with speed "
          "or frequency have no place in a model; give constant ones");
    }
    const std::string kind = is_link ? "link" : b.is_seal ? "seal" : "bearing";
    const std::string name = unique(kind, b.name);
    text("\n[[{}]]\nname       = {}\n", kind, toml_text(name));
    if (is_link) {
      text("from       = {{ {} }}\nto         = {{ {} }}\n", station(node), station(link));
    } else {
      const std::string at = station(node);
      text("{:<10} = {}\n", at.substr(0, at.find(' ')), at.substr(at.find("= ") + 2));
      if (link >= 0) text("to         = {}\n", toml_text(supports_.at(link)));
    }
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
      if (!is_zero || i == 0) text("{} = {}\n", key, matrix(v[i], v[i + 1], v[i + 2], v[i + 3]));
    }
  }

  static std::string file_part(const std::string& name) {
    std::string part;
    for (const char c : name) {
      part += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
    }
    return part;
  }

  /// Coefficients that are zero throughout are left out.
  static std::string table_of(const RossBearing& b) {
    std::vector<std::size_t> used;
    for (std::size_t k = 0; k < ross_coefficients.size(); ++k) {
      const bool is_used = std::any_of(b.rows.begin(), b.rows.end(),
                                       [&](const auto& row) { return row.values[k] != 0.0; });
      if (is_used || k == 0) used.push_back(k);
    }
    std::vector<std::string> head;
    if (b.has_speed) head.emplace_back("speed [rad/s]");
    if (b.has_whirl) head.emplace_back("whirl [rad/s]");
    constexpr const char* units[] = {"N/m", "N.s/m", "kg"};
    for (const std::size_t k : used) {
      head.push_back(fmt::format("{} [{}]", ross_coefficients[k], units[k / 4]));
    }
    std::string csv = fmt::format("{}\n", fmt::join(head, ", "));
    for (const RossBearing::Row& row : b.rows) {
      std::vector<double> cells;
      if (b.has_speed) cells.push_back(row.speed);
      if (b.has_whirl) cells.push_back(row.whirl);
      for (const std::size_t k : used) cells.push_back(row.values[k]);
      csv += fmt::format("{}\n", fmt::join(cells, ", "));
    }
    return csv;
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
  std::vector<const RossElement*> shaft_, layers_;
  int nodes_ = 0;                                              ///< on the shaft
  std::map<int, std::string> supports_;                        ///< names of bodies
  std::map<std::string, std::set<std::string>> names_;         ///< taken, by kind
  std::map<std::pair<std::string, std::string>, int> copies_;  ///< of a kind that wanted a name
};

}  // namespace

ImportedModel model_of(const RossRotor& rotor, const std::string& source, const std::string& stem) {
  return Writer(rotor, source, stem).write();
}

}  // namespace whirl::inline io
