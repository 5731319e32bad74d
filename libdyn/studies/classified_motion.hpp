#pragma once
/// What a study keeps of a motion: its kind, and what the contacts do.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libbase/structs/column.hpp"
#include "libdyn/studies/classify.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// A motion at a point of a study, as it was classified.
struct ClassifiedMotion {
  std::optional<MotionKind> kind{};  ///< nothing: the motion failed, and only `failure` is known
  int period = 0;           ///< of a periodic motion [revolutions]; 0: not periodic, or longer
  bool is_proven = false;   ///< the attracting orbit was found
  long transient = 0;       ///< revolutions until the kind was known, or all of the transient
  long revolutions = 0;     ///< that contacts were measured over
  double resolution = 0.0;  ///< of the largest exponent [1/revolution], see Classification
  double section_dimension = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> exponents{};  ///< Lyapunov exponents, descending [1/revolution]
  std::vector<ContactDoing> contacts{};
  long settles_after = 0;  ///< see Classification
  Failure failure{};       ///< why the motion failed; empty if it was read from a file

  bool has_failed() const { return !kind; }
  /// The strongest regime of all contacts.
  Regime regime() const;
  /// Impacts of all contacts together; NaN if the motion failed.
  double impacts_per_rev() const;
  /// The largest exponent; NaN if there is none.
  double largest_exponent() const;

  static constexpr auto columns() {
    using C = ClassifiedMotion;
    return ColumnList{
        column("motion", &C::kind, "", "kind of motion"),
        column("period", &C::period, "",
               "period of a periodic motion [revolutions]; 0: none, or longer"),
        column("is_proven", &C::is_proven, "",
               "whether Newton's method found the attracting orbit"),
        column("transient", &C::transient, "",
               "revolutions until this was known, or all of the transient"),
        column("revolutions", &C::revolutions, "", "revolutions of contact measures"),
        column("resolution", &C::resolution, "",
               "the largest exponent is known to this in 99 of 100 motions [1/revolution]"),
        column("section_dimension", &C::section_dimension, "",
               "dimension of the sections, 1 for a closed curve"),
        column("exponent", &C::exponents, "", "Lyapunov exponents, descending [1/revolution]")
            .along("exponents+"),
        rows(&C::contacts, "contacts"),
        column("settles_after", &C::settles_after, "",
               "revolutions of transient that would have settled the motion; 0: it has, or that is "
               "not known")
            .maybe()};
  }
};

/// A motion in short; all is empty of a motion that failed.
struct MotionSummary {
  std::optional<MotionKind> motion;
  std::optional<int> period;  ///< of a periodic motion [revolutions]
  std::optional<Regime> regime;
  std::optional<double> largest_exponent;  ///< [1/revolution]

  static constexpr auto columns() {
    using S = MotionSummary;
    return ColumnList{column("motion", &S::motion, "", "kind of motion"),
                      column("period_revs", &S::period, "", "period [revolutions]"),
                      column("regime", &S::regime, "", "the strongest of all contacts"),
                      column("lyapunov_max", &S::largest_exponent, "",
                             "largest Lyapunov exponent [1/revolution]")};
  }
};
MotionSummary summary_of(const ClassifiedMotion& motion);

/// What is kept of a motion.
ClassifiedMotion classified(const Classification& found);

/// What all motions of a study have in common.
struct StudySystem {
  std::vector<std::string> contacts{};  ///< names
  Eigen::Index states = 0;              ///< coordinates and velocities
  Eigen::Index dofs = 0;                ///< of all points, see FullState
  int most_exponents = 0;               ///< as ClassifyOptions has it

  /// Lyapunov exponents of a motion.
  Eigen::Index exponents() const;
};
StudySystem study_system(const Scene& scene, const ClassifyOptions& options);

/// Column of the names of the contacts of a study.
template <class Result>
constexpr auto contact_names() {
  return column(
             "contact", [](auto& r) -> auto& { return r.system.contacts; }, "", "contact")
      .axis("contacts")
      .maybe();
}

/// Names of dimensions, with their sizes.
using ColumnSizes = std::vector<std::pair<std::string_view, Eigen::Index>>;

}  // namespace whirl::inline dyn
