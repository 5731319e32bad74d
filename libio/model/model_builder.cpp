#include "libio/model/model_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "libdyn/system/support_limits.hpp"
#include "libio/model/model_checks.hpp"
#include "libio/model/model_table.hpp"
#include "libio/text/workbook.hpp"

namespace whirl::inline io {

namespace {

void read_top(ModelReading& reading) {
  TableReader top(&reading.root, "", reading.problems, reading.asked);
  const auto format = top.integer("format", Range::any, true);
  if (format && *format != 1) {
    top.problem("format", fmt::format("found {}, expected 1, the only format so far", *format));
  }
  if (const auto title = top.string("title")) reading.model.title = *title;
  if (const auto g = top.quantity("gravity", "m/s^2", Range::nonnegative))
    reading.model.structure.gravity = *g;
  for (const ModelTable& table : model_tables()) top.node(table.name);
  top.finish();
}

/// Calls f with all tables, in the order in which they are read.
template <class F>
void for_each_in_turn(const F& f) {
  using enum ModelTable::Turn;
  for (const ModelTable::Turn turn : {early, middle, late}) {
    for (const ModelTable& table : model_tables()) {
      if (table.turn == turn) f(table);
    }
  }
}

void throw_problems(ModelReading& reading) {
  if (reading.problems.empty()) return;
  // in the order of the file; what is in other files (tables) comes behind
  const auto place = [&](const Problem& p) {
    const bool is_elsewhere = p.where.line > 0 && p.where.file != reading.root.where.file;
    return std::tuple(is_elsewhere, p.where.line, p.where.column);
  };
  std::stable_sort(reading.problems.begin(), reading.problems.end(),
                   [&](const Problem& a, const Problem& b) { return place(a) < place(b); });
  // a station that is used twice is wrong once
  const auto last = std::unique(
      reading.problems.begin(), reading.problems.end(), [](const Problem& a, const Problem& b) {
        return a.where == b.where && a.key == b.key && a.message == b.message;
      });
  reading.problems.erase(last, reading.problems.end());
  for (Problem& problem : reading.problems) problem.where = with_cell_name(problem.where);
  throw ModelError(reading.problems);
}

}  // namespace

ModelBuilder::ModelBuilder(const ConfigNode& root, NamedFiles files, std::vector<AskedKey>* asked)
    : reading_(root, std::move(files), asked) {}

Model ModelBuilder::build() {
  read_top(reading_);
  for_each_in_turn([&](const ModelTable& table) { table.read(reading_); });
  check_places(reading_);
  const std::vector<Problem> absent = doubts_of(reading_.named_places);
  reading_.doubts.insert(reading_.doubts.end(), absent.begin(), absent.end());
  throw_problems(reading_);
  add_limits(reading_.model);
  return std::move(reading_.model);
}

Model ModelBuilder::rebuild(const Model& base) {
  // all members, so that a new one does not compile until it is looked at here: what is not copied
  // below begins anew
  [[maybe_unused]] const auto& [title, source, path, structure, contacts, films, speed, has_speed,
                                machine, reduction, start] = base;
  Model& model = reading_.model;
  model.title = base.title;
  model.structure = base.structure;
  model.reduction = base.reduction;
  for_each_in_turn([&](const ModelTable& table) {
    if (!table.is_of_rotor) table.read(reading_);
  });
  throw_problems(reading_);
  model.structure.stations = base.structure.stations;
  model.structure.bearings = base.structure.bearings;  // springs of films among them
  for (const auto& missing : reading_.missing_radii) {
    model.contacts[missing.contact].friction.radius =
        base.contacts[missing.contact].friction.radius;
  }
  add_limits(model);
  return std::move(model);
}

}  // namespace whirl::inline io
