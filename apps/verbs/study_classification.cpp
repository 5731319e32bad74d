#include "apps/verbs/study_classification.hpp"

#include <cassert>

#include "libio/results/hdf5.hpp"
#include "libio/results/motion_codes.hpp"

namespace whirl {

namespace {

constexpr std::size_t classification_size = 15;  ///< columns

}  // namespace

std::vector<PointColumn> classification_columns(const Scene& scene, const std::string& group) {
  const std::vector<Eigen::Index> exponents{scene.contacts.size()};
  const std::vector<Eigen::Index> contacts{scene.contacts.owners()};
  const std::vector<std::string> per{contacts[0] > 0 ? group + "/contact" : ""};
  return {
      {"motion", "", "kind of motion: " + motion_legend(), true, {}, {}, motion_words()},
      {"period", "", "period of a periodic motion [revolutions]; 0: none, or longer", true},
      {"is_proven", "", "whether Newton's method found the attracting orbit", true},
      {"transient", "", "revolutions until this was known, or all of the transient", true},
      {"revolutions", "", "revolutions of contact measures", true},
      {"resolution", "",
       "the largest exponent is known to this in 99 of 100 motions [1/revolution]"},
      {"section_dimension", "", "dimension of the sections, 1 for a closed curve"},
      {"exponent", "", "Lyapunov exponents, descending [1/revolution]", false, exponents},
      {"regime", "", "regime of a contact: 0 none, 1 intermittent, 2 permanent", true, contacts,
       per},
      {"duty", "", "share of time in touch", false, contacts, per},
      {"impacts_per_rev", "", "impacts per revolution", false, contacts, per},
      {"sticking", "", "share of time sticking", false, contacts, per},
      {"max_normal", "N", "largest normal force", false, contacts, per},
      {"max_tangential", "N", "largest friction force", false, contacts, per},
      {"settles_after",
       "",
       "revolutions of transient that would have settled the motion; 0: it has, or that is not "
       "known",
       true,
       {},
       {},
       "",
       true},
  };
}

void write_classification_axes(ResultWriter& file, const Scene& scene, const std::string& group) {
  std::vector<std::string> names(static_cast<std::size_t>(scene.contacts.owners()));
  for (const ReducedContact& c : scene.contacts.contacts()) {
    names[static_cast<std::size_t>(c.owner)] = c.name;
  }
  if (!names.empty()) file.dataset(group + "/contact", names, {"", "contact", {""}});
}

PointRow classification_row(const StudyPoint& point) {
  const Classification& c = point.subject.found;
  if (!point.is_good()) {
    PointRow row(classification_size);
    row[0] = {-1.0};
    return row;
  }
  PointRow row{{static_cast<double>(c.kind)},
               {static_cast<double>(c.period)},
               {c.is_proven ? 1.0 : 0.0},
               {static_cast<double>(c.transient)},
               {static_cast<double>(c.revolutions)},
               {c.resolution},
               {c.section_dimension},
               {c.exponents.begin(), c.exponents.end()},
               {},
               {},
               {},
               {},
               {},
               {},
               {static_cast<double>(c.settles_after)}};
  assert(row.size() == classification_size);
  for (const ContactMeasure& m : c.contacts) {
    row[8].push_back(static_cast<double>(m.regime()));
    row[9].push_back(m.duty);
    row[10].push_back(m.impacts / static_cast<double>(c.revolutions));
    row[11].push_back(m.sticking);
    row[12].push_back(m.max_normal);
    row[13].push_back(m.max_tangential);
  }
  return row;
}

std::string motion_name(const PointTable& table, std::size_t point) {
  const double code = table.number("motion", point);
  return code < 0.0 ? "" : std::string(name_of(static_cast<MotionKind>(static_cast<int>(code))));
}

}  // namespace whirl
