#include "apps/verbs/continue_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

std::string axis_label(const ParameterAxis& axis) {
  return axis.path + (axis.unit.empty() ? "" : " [" + axis.unit + "]");
}

Record end_record(const Branch& branch) {
  return branch.end ? Record(name_of(branch.end->kind)) : Record(nullptr);
}

Record point_record(const TracedBranch& traced, std::size_t i, int number, double period) {
  const BranchPoint& p = traced.branch.points[i];
  const OrbitMeasure& measure = traced.measures[i];
  Record r, duty = Record::array(), impacts = Record::array(), normal = Record::array(),
            floquet = Record::array();
  for (const ContactMeasure& c : p.contacts) {
    duty.add(c.duty);
    impacts.add(c.impacts / period);
    normal.add(c.max_normal);
  }
  for (const Complex& m : p.multipliers) floquet.add(m);
  r.set("value", p.value).set("branch", number).set("period_revs", period);
  r.set("amplitude_m", measure.radii.empty() ? Record(nullptr) : Record(measure.radii[0]));
  r.set("work_j", measure.work);
  r.set("stable", p.multipliers.size() == 0 ? Record(nullptr) : Record(p.is_stable()));
  r.set("duty", duty).set("impacts_per_rev", impacts).set("max_normal_n", normal);
  r.set("floquet", floquet);
  return r;
}

std::string period_text(const Branch& branch, const BranchLayout& layout) {
  double least = layout.period(branch, branch.points.front()), most = least;
  for (const BranchPoint& p : branch.points) {
    least = std::min(least, layout.period(branch, p));
    most = std::max(most, layout.period(branch, p));
  }
  return least == most ? fmt::format("{:.6g}", least)
                       : fmt::format("{:.6g} to {:.6g}", least, most);
}

std::string bifurcations_table(const Branch& branch, const ParameterAxis& axis) {
  Table table({"bifurcation", axis_label(axis), "after point", "multiplier"});
  for (const Bifurcation& x : branch.bifurcations) {
    const bool is_grazing = x.kind == BifurcationKind::grazing;
    table.row({std::string(name_of(x.kind)) + (is_grazing ? " of " + x.contact : ""),
               fmt::format("{:.9g}", x.at.value), std::to_string(x.after + 1),
               is_grazing
                   ? fmt::format("{:+g} impacts", x.change)
                   : fmt::format("{:+.6f} {:+.6f} i", x.multiplier.real(), x.multiplier.imag())});
  }
  return table.text();
}

Record branches_record(const BranchTree& tree) {
  Record list = Record::array();
  for (const TracedBranch& b : tree.branches) {
    Record r;
    r.set("period_revs", b.branch.period);
    r.set("parent", b.parent > 0 ? Record(b.parent) : Record(nullptr))
        .set("end", b.branch.end_text());
    r.set("end_kind", end_record(b.branch));
    list.add(r);
  }
  return list;
}

Record points_record(const BranchTree& tree) {
  Record list = Record::array();
  int number = 0;
  for (const TracedBranch& b : tree.branches) {
    ++number;
    for (std::size_t i = 0; i < b.branch.points.size(); ++i) {
      list.add(point_record(b, i, number, tree.layout.period(b.branch, b.branch.points[i])));
    }
  }
  return list;
}

Record bifurcations_record(const BranchTree& tree) {
  Record list = Record::array();
  int number = 0;
  for (const TracedBranch& traced : tree.branches) {
    ++number;
    for (const Bifurcation& b : traced.branch.bifurcations) {
      Record r;
      r.set("value", b.at.value).set("kind", name_of(b.kind));
      r.set("branch", number).set("after_point", static_cast<long>(b.after) + 1);
      const bool is_grazing = b.kind == BifurcationKind::grazing;
      r.set("contact", is_grazing ? Record(b.contact) : Record(nullptr));
      r.set("multiplier", is_grazing ? Record(nullptr) : Record(b.multiplier));
      list.add(r);
    }
  }
  return list;
}

Record curves_record(const BifurcationCurves& curves, const ParameterRange& along) {
  Record list = Record::array();
  for (const BifurcationCurve& c : curves.curves) {
    Record r, points = Record::array();
    r.set("kind", name_of(c.kind)).set("period_revs", c.branch.period);
    r.set("branch", c.branch_number);
    r.set("contact", c.contact.empty() ? Record(nullptr) : Record(c.contact));
    for (const BranchPoint& p : c.branch.points) {
      Record pair = Record::array();
      pair.add(first_value(along, p));
      pair.add(p.value);
      points.add(pair);
    }
    r.set("points", points).set("end", c.branch.end_text());
    r.set("end_kind", end_record(c.branch));
    list.add(r);
  }
  return list;
}

std::string branches_text(const BranchTree& tree, const ParameterAxis& axis) {
  std::string text;
  int number = 0;
  for (const TracedBranch& traced : tree.branches) {
    const Branch& b = traced.branch;
    const auto stable = std::count_if(b.points.begin(), b.points.end(),
                                      [](const BranchPoint& p) { return p.is_stable(); });
    text += fmt::format(
        "\n  branch {}: period {}, {} points, {} of them stable; from {:.8g} to {:.8g}{}\n  it "
        "ends: {}\n",
        ++number, period_text(b, tree.layout), b.points.size(), stable, b.points.front().value,
        b.points.back().value,
        traced.parent > 0 ? fmt::format("; begins on branch {}", traced.parent) : "",
        b.end ? b.end->text : "not yet");
    if (!b.bifurcations.empty()) text += "\n" + bifurcations_table(b, axis);
  }
  return text;
}

std::string curves_text(const BifurcationCurves& curves, const CurveAxes& axes) {
  if (curves.curves.empty()) return "\n  no border: there is no bifurcation to follow\n";
  Table table({"border", "of branch", "points", axis_label(axes.first),
               "at " + axis_label(axes.second), "it ends"});
  const auto first = [&](const BranchPoint& p) { return first_value(axes.along, p); };
  for (const BifurcationCurve& c : curves.curves) {
    const auto &begin = c.branch.points.front(), &end = c.branch.points.back();
    table.row({std::string(name_of(c.kind)) + (c.contact.empty() ? "" : " of " + c.contact),
               std::to_string(c.branch_number), std::to_string(c.branch.points.size()),
               fmt::format("{:.6g} to {:.6g}", first(begin), first(end)),
               fmt::format("{:.6g} to {:.6g}", begin.value, end.value), c.branch.end_text()});
  }
  return "\n  borders in the plane of both parameters\n\n" + table.text();
}

}  // namespace

Report continue_report(const Invocation& call, const Model& model, const ContinueCall& asked,
                       const FollowedBranches& found) {
  const BranchTree& tree = found.tree;
  const ParameterAxis& axis = asked.parameters.along.axis;
  Report report{.record = begin_record(call, model), .status = found.status};
  note_tables(call, model, report);
  Record& r = report.record;
  r.set("parameter", axis.path).set("unit", axis.unit).set("method", call.text("method"));
  const bool is_series = asked.tree.method == OrbitMethod::harmonic_balance;
  if (is_series) r.set("harmonics", tree.layout.harmonics);
  r.set("branches", branches_record(tree)).set("points", points_record(tree));
  r.set("bifurcations", bifurcations_record(tree)).set("resumed", found.resumed);
  report.text =
      "Periodic orbits along " + axis.path + (model.title.empty() ? "" : ": " + model.title) + "\n";
  if (is_series) {
    report.text += fmt::format("  by harmonic balance with {} harmonics\n", tree.layout.harmonics);
  }
  report.text += branches_text(tree, axis);
  if (asked.parameters.across) {
    r.set("borders", curves_record(found.curves, asked.tree.along));
    report.text += curves_text(found.curves, asked.curve_axes());
  }
  if (found.resumed > 0) {
    report.text += fmt::format("\n  {} points were there already\n", found.resumed);
  }
  if (found.status == 130) {
    report.text +=
        fmt::format("\n  stopped{}\n", call.has("out") ? "; the same line goes on from there" : "");
  }
  if (call.has("out")) report.text += fmt::format("\n  result: {}\n", call.given.at("out"));
  return report;
}

}  // namespace whirl::inline cli
