#pragma once
/// The kind of a motion as a result (libbase/structs/column.hpp).

#include <optional>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/studies/classify.hpp"

namespace whirl::inline dyn {

/// What a classification found; group /classify.
struct ClassificationResult {
  Classification of;
  double revolution = 0.0;  ///< period of a revolution [s]

  bool is_known() const { return of.is_good(); }
  std::string motion() const { return std::string(name_of(of.kind)); }
  /// Lyapunov exponents, descending [1/s].
  Vec exponents() const { return of.exponents / revolution; }

  /// Estimates from the first revolutions alone, exponents x estimates [1/s]; empty: none.
  Mat settling() const { return of.path.exponents / revolution; }

  /// The p of p/n of each contact.
  std::vector<double> impacts_of_contacts() const {
    std::vector<double> all;
    for (const ContactMeasure& m : of.contacts) all.push_back(m.impacts);
    return all;
  }

  static constexpr std::string_view group = "/classify";
  static constexpr auto columns() {
    using enum Written;
    using Result = ClassificationResult;
    constexpr auto motion = [](const Result& r) {
      return r.is_known() ? std::optional(r.motion()) : std::nullopt;
    };
    constexpr auto known = [](const Result& r, long n) {
      return r.is_known() && n > 0 ? std::optional(n) : std::nullopt;
    };
    constexpr auto period = [known](const Result& r) { return known(r, r.of.period); };
    constexpr auto settles = [known](const Result& r) { return known(r, r.of.settles_after); };
    constexpr auto period_time = [](const Result& r) {
      return r.is_known() && r.of.period_time > 0.0 ? std::optional(r.of.period_time)
                                                    : std::nullopt;
    };
    constexpr auto residual = [](const Result& r) {
      return r.of.is_proven ? std::optional(r.of.residual) : std::nullopt;
    };
    return ColumnList{
        column("exponent", &Result::exponents, "1/s", "Lyapunov exponents, descending")
            .along("exponents")
            .only(in_file),
        column(
            "averaged", [](const Result& r) { return r.of.path.revolutions; }, "",
            "revolutions that estimates are of")
            .axis("averaged")
            .only(in_file)
            .maybe(),
        column("exponent_estimate", &Result::settling, "1/s",
               "Lyapunov exponents, descending, of the first revolutions alone")
            .along("exponents averaged")
            .only(in_file)
            .maybe(),
        column("motion", &Result::motion, "", "kind of motion").only(in_file),
        column(
            "period_revolutions", [](const Result& r) { return r.of.period; }, "", "period")
            .only(in_file),
        column("period_time", period_time, "s",
               "after which a motion repeats that nothing turns with")
            .as("period_s")
            .maybe(),
        column("motion", motion, "", "kind of motion").only(in_json),
        column("period_revs", period, "", "period [revolutions]").only(in_json),
        column(
            "lyapunov_per_rev", [](const Result& r) { return r.of.exponents; }, "",
            "Lyapunov exponents, descending")
            .only(in_json),
        column(
            "zero_per_rev", [](const Result& r) { return r.of.zero; }, "",
            "exponents within it count as zero")
            .only(in_json),
        column(
            "resolution_per_rev", [](const Result& r) { return r.of.resolution; }, "",
            "of the largest exponent")
            .only(in_json),
        column(
            "is_proven", [](const Result& r) { return r.of.is_proven; }, "",
            "the attracting orbit was found")
            .only(in_json),
        column(
            "section_dimension", [](const Result& r) { return r.of.section_dimension; }, "",
            "of the sections at phase 0")
            .only(in_json),
        column("settles_after_revs", settles, "", "revolutions of transient").only(in_json),
        column("residual", residual, "", "of the orbit, in length scales").only(in_json),
        column(
            "impacts", [](const Result& r) { return r.of.impacts(); }, "", "of all contacts")
            .only(in_json),
        column("impacts_of_contacts", &Result::impacts_of_contacts, "", "of each contact")
            .only(in_json),
        column(
            "revs", [](const Result& r) { return r.of.revolutions; }, "",
            "that contacts were measured over")
            .only(in_json)};
  }
};

}  // namespace whirl::inline dyn
