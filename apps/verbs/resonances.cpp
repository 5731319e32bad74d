#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/simulation.hpp"
#include "libbase/constants.hpp"
#include "libbase/error.hpp"
#include "libdyn/motions/identify.hpp"
#include "libdyn/studies/bouncing.hpp"
#include "libfe/resonance.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

/// Orbit of a mode in each contact, by the largest of the rotor.
std::vector<double> sizes_at_contacts(const Model& model, const Assembler& assembler,
                                      const System& system, const Mode& mode) {
  std::vector<double> sizes;
  for (const Contact& c : model.contacts) {
    const Eigen::Vector2cd d = closing_rows(c, assembler, system.dofs).cast<Complex>() * mode.shape;
    sizes.push_back(Orbit(d(0), d(1)).major());
  }
  return sizes;
}

/// A resonance, and what the model makes of it.
struct Place {
  InternalResonance resonance;
  std::vector<double> fast_size, slow_size;  ///< at the contacts
  std::optional<Bouncing> bouncing;
};

std::string branch_name(const Campbell& diagram, int branch) {
  return fmt::format("{} {}", branch + 1,
                     name_of(diagram.branches[static_cast<std::size_t>(branch)].whirl));
}

std::string sizes_text(const std::vector<double>& sizes) {
  std::string text;
  for (const double s : sizes) text += fmt::format("{}{:.2f}", text.empty() ? "" : " ", s);
  return text;
}

void write(ResultWriter& file, const std::vector<Place>& places) {
  std::vector<double> speed, frequency, bouncing_speed, period;
  std::vector<int> p, q, fast, slow, stable;
  for (const Place& place : places) {
    const InternalResonance& r = place.resonance;
    speed.push_back(r.speed);
    frequency.push_back(r.frequency);
    p.push_back(r.p);
    q.push_back(r.q);
    fast.push_back(r.fast + 1);
    slow.push_back(r.slow + 1);
    const auto& b = place.bouncing;
    bouncing_speed.push_back(b ? b->speed : nan);
    period.push_back(b ? b->turns : nan);
    stable.push_back(!b ? -1 : b->cycle.is_stable() ? 1 : 0);
  }
  if (places.empty()) return;
  const std::vector<std::string> axes{"/resonances/speed"};
  file.dataset("/resonances/speed", speed, {"rad/s", "speed of the resonance", {""}});
  file.dataset("/resonances/p", p, {"", "of the ratio p:q, of the faster mode", axes});
  file.dataset("/resonances/q", q, {"", "of the ratio p:q, of the slower mode", axes});
  file.dataset("/resonances/fast", fast, {"", "branch of the faster mode", axes});
  file.dataset("/resonances/slow", slow, {"", "branch of the slower mode", axes});
  file.dataset("/resonances/frequency", frequency,
               {"rad/s", "of both modes over p and q, seen from the rotor", axes});
  file.dataset("/resonances/bouncing_speed", bouncing_speed,
               {"rad/s", "where a bouncing motion was found", axes});
  file.dataset("/resonances/bouncing_period", period,
               {"", "its period seen from the rotor [revolutions]", axes});
  file.dataset("/resonances/bouncing_stable", stable,
               {"", "1 stable, 0 unstable, -1 none found or not looked for", axes});
}

Report run_resonances(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const std::vector<double> speeds = call.speeds(model);
  const int count = static_cast<int>(call.integer("modes"));
  const int largest = static_cast<int>(call.integer("largest"));
  const bool confirms = call.has("confirm");
  if (confirms && model.contacts.empty()) {
    throw ModelError({"--confirm"}, "", "expected a model with contacts to bounce in");
  }
  const BouncingOptions search{.starts = static_cast<int>(call.integer("starts")),
                               .seed = static_cast<std::uint64_t>(call.integer("seed"))};
  const auto file = call.result_file(model);
  const Campbell diagram = campbell(assembler, speeds, count);
  const ModeFinder finder(assembler);

  std::vector<Place> places;
  for (const InternalResonance& r : internal_resonances(diagram, largest)) {
    Place place{.resonance = r};
    const Modes modes = finder.at(r.speed, count + 2);
    const System system = finder.system(r.speed);
    const auto sizes = [&](int branch, double seen) {
      const Whirl whirl = diagram.branches[static_cast<std::size_t>(branch)].whirl;
      const Mode* nearest = nullptr;
      double distance = std::numeric_limits<double>::infinity();
      for (const Mode& m : modes.oscillatory) {
        const double sense = whirl == Whirl::backward ? -1.0 : 1.0;
        const double off = std::abs(std::abs(r.speed - sense * m.frequency()) - seen);
        if (m.whirl == whirl && off < distance) {
          nearest = &m;
          distance = off;
        }
      }
      return nearest ? sizes_at_contacts(model, assembler, system, *nearest)
                     : std::vector<double>(model.contacts.size(), nan);
    };
    place.fast_size = sizes(r.fast, r.p * r.frequency);
    place.slow_size = sizes(r.slow, r.q * r.frequency);
    places.push_back(std::move(place));
  }
  const auto scene_at = [&](double speed) {
    Model at = model;
    at.speed = speed;
    at.has_speed = true;
    return std::make_shared<const Scene>(make_scene(at, ReductionEstimate::no));
  };
  int status = 0;
  if (confirms) {
    install_interrupt_handler();
    Progress progress("looking for bouncing motions", std::ssize(places), call.shows_progress);
    for (std::size_t i = 0; i < places.size() && status == 0; ++i) {
      places[i].bouncing = find_bouncing(scene_at, diagram, places[i].resonance, search);
      progress.update(static_cast<long>(i) + 1);
      if (is_interrupted()) status = 130;
    }
  }

  Report report{.record = begin_record(call, model), .status = status};
  Record list = Record::array();
  std::vector<std::string> head{"speed [rpm]", "ratio", "faster mode", "slower mode",
                                "seen from the rotor [rpm]"};
  if (!model.contacts.empty()) head.push_back("at the contacts");
  if (confirms) head.push_back("bouncing");
  Table table(head);
  for (const Place& place : places) {
    const InternalResonance& r = place.resonance;
    Record entry, contacts = Record::array();
    entry.set("speed_rpm", r.speed / rpm).set("p", r.p).set("q", r.q);
    entry.set("fast", r.fast + 1).set("slow", r.slow + 1);
    entry.set("frequency_rpm", r.frequency / rpm);
    for (std::size_t c = 0; c < model.contacts.size(); ++c) {
      Record at;
      at.set("name", model.contacts[c].name);
      at.set("fast", place.fast_size[c]).set("slow", place.slow_size[c]);
      contacts.add(at);
    }
    entry.set("contacts", contacts);
    std::vector<std::string> row{
        fmt::format("{:.1f}", r.speed / rpm), fmt::format("{}:{}", r.p, r.q),
        branch_name(diagram, r.fast), branch_name(diagram, r.slow),
        fmt::format("{:.1f}, {:.1f}", r.p * r.frequency / rpm, r.q * r.frequency / rpm)};
    if (!model.contacts.empty()) {
      row.push_back(sizes_text(place.fast_size) + " | " + sizes_text(place.slow_size));
    }
    if (confirms) {
      Record bouncing(nullptr);
      std::string text = "none found";
      if (const auto& b = place.bouncing) {
        bouncing = Record();
        bouncing.set("speed_rpm", b->speed / rpm).set("period_revs", b->turns);
        bouncing.set("stable", b->cycle.is_stable());
        text = fmt::format("{} at {:.1f} rpm, {:.4f} revolutions",
                           b->cycle.is_stable() ? "stable" : "unstable", b->speed / rpm, b->turns);
      }
      entry.set("bouncing", bouncing);
      row.push_back(text);
    }
    table.row(row);
    list.add(entry);
  }
  report.record.set("resonances", list);
  report.text = "Internal resonances seen from the rotor" +
                (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                (places.empty() ? "  none between these speeds\n" : table.text());
  if (!places.empty() && !model.contacts.empty()) {
    std::string names;
    for (const Contact& c : model.contacts) names += (names.empty() ? "" : ", ") + c.name;
    report.text += fmt::format(
        "\n  at the contacts ({}): orbits of both modes by their largest on the rotor\n", names);
  }
  if (status == 130) report.text += "\n  stopped\n";
  if (!confirms) note_left_out(model, report);
  note_tables(model, speeds.front(), speeds.back(), report);
  const auto first = std::find_if(places.begin(), places.end(),
                                  [](const Place& place) { return place.bouncing.has_value(); });
  if (file) {
    if (first != places.end()) {
      MotionState on_it;
      on_it.y = first->bouncing->cycle.state;
      write_end(*file, model, *scene_at(first->bouncing->speed), on_it);
    } else {
      write_points(*file, model, assembler);
    }
    write_campbell(*file, diagram);
    write(*file, places);
  }
  commit(call, file.get(), report);
  return report;
}

}  // namespace

Verb resonances_verb() {
  return {
      .name = "resonances",
      .group = "Linear rotordynamics",
      .summary =
          "speeds at which two modes are in p:q resonance seen from the rotor, where it may bounce",
      .example = "whirl resonances models/two_disk_mac.toml --speeds 1000:8000:50rpm --confirm",
      .options = {{"modes", "N", "how many modes", "4"},
                  speeds_option,
                  {"largest", "N", "of p and q", "4"},
                  {"confirm", "", "look for bouncing motions near each of them"},
                  {"starts", "N", "of them at every speed that is tried", "16"},
                  seed_option},
      .run = run_resonances,
  };
}

}  // namespace whirl
