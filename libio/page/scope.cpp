#include "libio/page/scope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <string_view>

#include "libdyn/linear/lateral_report.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/page/machine_report.hpp"
#include "libio/texts/lateral_text.hpp"

namespace whirl::inline io {

namespace {

/// What is said of all results of a verb.
struct ScopeOfVerb {
  std::string_view verb, assumption, unchecked;
};

constexpr std::array<ScopeOfVerb, 10> scopes{
    {{"lateral",
      "Lateral analysis: linear equations of motion about the static equilibrium; unbalance at "
      "antinodes of modes and overhung ends; cross-coupled stiffness of level I at one station.",
      ""},
     {"static", "Static equilibrium: gravity and constant forces, without unbalance and contacts.",
      ""},
     {"modes", "Modes: linear equations of motion about the static equilibrium, at one speed.",
      "Overdamped modes and modes above those that were computed."},
     {"campbell",
      "Campbell diagram: linear equations of motion about the static equilibrium at each speed.",
      "Modes above those that were followed."},
     {"critical",
      "Critical speeds: undamped ones of the symmetric matrices, damped ones where the frequency "
      "of "
      "a mode meets the excitation.",
      "Amplitudes at the critical speeds, and the margins that these ask for."},
     {"unbalance",
      "Unbalance response: steady, linear, of the unbalances of the model and no others; contacts "
      "are left out.",
      "Stability, and unbalances at other places or of other sizes than those of the model."},
     {"frf", "Frequency response: steady and linear, at one speed.", ""},
     {"simulate",
      "Motion in time: constant speed, the reduced model that the facts of the result tell, from "
      "one start.",
      "Other starts and other motions that may exist beside this one; wear and heat of contacts."},
     {"classify", "Kind of motion: that to which the motion from one start settles.",
      "Other motions that may exist beside this one."},
     {"sweep", "Sweep: motions at constant values, each from the start that the command says.",
      "Motions between the points of the sweep."}}};

/// A set of sentences in the order in which they came.
class Sentences {
 public:
  void add(const std::string& text) {
    if (!text.empty() && known_.insert(text).second) all_.push_back(text);
  }
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::set<std::string> known_{};
  std::vector<std::string> all_{};
};

std::string beams_of(const Structure& s) {
  if (s.shaft.empty()) return "";
  std::string theories;
  for (const auto& [name, theory] : choices(Theory{})) {
    const bool is_used = std::ranges::any_of(s.shafts(), [t = theory](const auto& shaft) {
      return std::ranges::any_of(shaft.segments, [t](const Segment& p) { return p.theory == t; });
    });
    if (is_used) theories += fmt::format("{}{}", theories.empty() ? "" : ", ", name);
  }
  return fmt::format(
      "Shaft: beams of {} theory, circular sections, linear elastic and isotropic material, small "
      "displacements and tilts, torsionally and axially rigid.",
      theories);
}

void add_model(const Model& model, Sentences& to) {
  const Structure& s = model.structure;
  to.add(beams_of(s));
  if (!s.rotors.empty()) {
    to.add(
        "Several shafts: constant ratios of their speeds; coupled by bearings, links, films and "
        "contacts between them.");
  }
  if (!s.disks.empty()) to.add("Disks: rigid, at one station each.");
  if (!s.bodies.empty()) to.add("Bodies (stators, pedestals): lumped masses.");
  if (!s.bearings.empty() || !s.seals.empty() || !s.links.empty()) {
    to.add("Bearings, seals and links: linear stiffness, damping and added mass, as tabulated.");
  }
  if (!s.gears.empty()) {
    to.add(
        "Gears: mean mesh stiffness along the line of action; neither torsion, which lets wheels "
        "give way, nor axial motion, nor excitation by the teeth.");
  }
  if (!s.supports.empty()) {
    to.add(
        "Supports: linear dynamic stiffness between the coordinates that are named; its states are "
        "coordinates of the model.");
  }
  for (const OilFilm& film : model.films) {
    to.add(fmt::format(
        "Oil films: law \"{}\", constant viscosity, aligned journals{}.",
        std::visit([](const auto& law) { return law.name; }, film.law),
        film.is_linearized ? "; in linear analyses linearized about the static equilibrium" : ""));
  }
  if (!rolling_bearings(model.contacts).empty()) {
    to.add(
        "Rolling bearings: each ball or roller pressed by Hertz, rolling without slip, without "
        "mass, in the plane of the bearing; in linear analyses linearized about the static "
        "equilibrium, "
        "the cage where it is at time 0.");
  }
  if (!stator_contacts(model.contacts).empty()) {
    to.add("Contacts: laws and Coulomb friction as tabulated; linear analyses leave them out.");
  }
  to.add(s.gravity > 0.0 ? fmt::format("Gravity: {:.4g} m/s² along -y.", s.gravity)
                         : std::string("Gravity: none in the model."));
}

/// What a lateral analysis leaves out, and no other result of the report has.
std::string left_out_of_lateral(const std::vector<const ResultView*>& results) {
  bool has_level_two = false, has_loss = false, has_rub = false, has_bow = false;
  for (const ResultView* result : results) {
    for (const LateralCheck& c : figures::result_of<LateralReport>(*result).checks) {
      has_level_two = has_level_two || c.rule == LateralRule::level_two;
    }
    if (!result->model) continue;
    const Structure& s = result->model->structure;
    has_bow = has_bow || s.is_bent();
    if (verb_of(*result) != "simulate") continue;
    has_rub = has_rub || !result->model->contacts.empty();
    has_loss = has_loss || std::any_of(s.unbalances.begin(), s.unbalances.end(),
                                       [](const Unbalance& u) { return u.begins.is_late(); });
  }
  std::string faults;
  const auto add = [&](bool is_there, const char* fault) {
    if (!is_there) faults += fmt::format("{}{}", faults.empty() ? "" : ", ", fault);
  };
  add(has_loss, "blade loss");
  add(has_rub, "rubbing");
  add(has_bow, "a bent rotor");
  std::string text = has_level_two ? "" : "A stability analysis of level II";
  if (!faults.empty())
    text += (text.empty() ? "Faults such as " : ", and faults such as ") + faults;
  return text.empty() ? "" : text + ".";
}

void add_missing_checks(const LateralReport& report, Sentences& to) {
  for (const LateralCheck& c : report.checks) {
    if (c.verdict != Verdict::unknown) continue;
    to.add(c.missing.empty() ? fmt::format("{}{}: not known.", name_of(c.rule),
                                           c.place.empty() ? "" : ", " + c.place)
                             : fmt::format("{}: {} was not given.", name_of(c.rule), c.missing));
  }
}

}  // namespace

Scope scope_of(const std::vector<const ResultView*>& results) {
  Sentences assumptions, unchecked;
  for (const ResultView* result : results) {
    if (result->model) add_model(*result->model, assumptions);
  }
  for (const ResultView* result : results) {
    const std::string verb = verb_of(*result);
    for (const ScopeOfVerb& scope : scopes) {
      if (scope.verb != verb) continue;
      assumptions.add(std::string(scope.assumption));
      unchecked.add(std::string(scope.unchecked));
      if (verb == "lateral") unchecked.add(left_out_of_lateral(results));
    }
    add_missing_checks(figures::result_of<LateralReport>(*result), unchecked);
  }
  unchecked.add("Torsional and axial vibration.");
  unchecked.add("Strength, fatigue and temperatures.");
  unchecked.add("Whether the numbers of the model are those of the machine.");
  return {assumptions.all(), unchecked.all()};
}

std::vector<std::string> remarks_in(const ResultView& result) {
  std::vector<std::string> remarks;
  if (!result.file.has_attribute("/", "notes")) return remarks;
  std::istringstream lines(result.file.string_attribute("/", "notes"));
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) remarks.push_back(line);
  }
  return remarks;
}

}  // namespace whirl::inline io
