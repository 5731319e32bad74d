#pragma once
/// The list of kinds of bearings, seals and links.
///
/// A kind is a struct with
///
///   static constexpr std::string_view name;      the word in the model file
///   static constexpr std::string_view told_by;   the key that tells this kind where the word is
///                                                left out; empty: none does. The first kind of
///                                                the list is meant where nothing tells another
///   static constexpr auto fields();              keys, units, ranges, meanings
///   BearingCoefficients at(Omega, omega);        at a spin and a whirl frequency [rad/s]
///   bool depends_on_speed();                     whether the coefficients change with the spin
///   bool depends_on_whirl();                     and with the frequency of the journal's whirl
///   std::span<const double> speeds();            those that it was told, ascending [rad/s]:
///                                                between them coefficients at one frequency have
///                                                no extremes, beyond them they stay; empty: none
///   std::span<const double> whirls();            the same of whirl frequencies, in any order
///
/// Coefficients are those of motions e^(i omega t). They are real, so that they hold for either
/// sense of whirl, and omega is not negative: the magnitude of the imaginary part of an eigenvalue.

#include <span>
#include <variant>

#include "libfe/parts/bearings/constant.hpp"
#include "libfe/parts/bearings/table.hpp"

namespace whirl::inline fe {

using AnyBearing = std::variant<  //
    ConstantBearing,              //
    TableBearing>;

/// Coefficients of any bearing at a spin speed and a whirl frequency [rad/s].
inline BearingCoefficients coefficients(const AnyBearing& bearing, double Omega, double omega) {
  return std::visit([&](const auto& b) { return b.at(Omega, omega); }, bearing);
}

/// The same where the journal whirls with the spin, as unbalance lets it. The matrices of a speed
/// have these.
inline BearingCoefficients coefficients(const AnyBearing& bearing, double Omega) {
  return coefficients(bearing, Omega, Omega);
}

/// True if the coefficients change with the frequency at which the journal whirls.
inline bool depends_on_whirl(const AnyBearing& bearing) {
  return std::visit([](const auto& b) { return b.depends_on_whirl(); }, bearing);
}

/// True if the coefficients of synchronous whirl change with speed.
inline bool depends_on_speed(const AnyBearing& bearing) {
  return depends_on_whirl(bearing) ||
         std::visit([](const auto& b) { return b.depends_on_speed(); }, bearing);
}

/// Speeds that a bearing was told, as its kind states them.
inline std::span<const double> told_speeds(const AnyBearing& bearing) {
  return std::visit([](const auto& b) { return b.speeds(); }, bearing);
}

/// Whirl frequencies that a bearing was told, as its kind states them.
inline std::span<const double> told_whirls(const AnyBearing& bearing) {
  return std::visit([](const auto& b) { return b.whirls(); }, bearing);
}

}  // namespace whirl::inline fe
