#include "libdyn/motions/combinations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int highest_order = 7;
constexpr std::size_t most_terms = 3;
constexpr double by_chance = 0.05;  ///< share of frequencies that some combination tried would meet

/// Calls use with every combination of so many of the frequencies, of an order.
template <class Use>
void each_combination(std::span<const double> frequencies, std::size_t terms, int order,
                      Combination& c, const Use& use) {
  if (terms == 0) {
    if (order == 0) use(c);
    return;
  }
  for (std::size_t i = 0; i + terms <= frequencies.size(); ++i) {
    const int most = order - static_cast<int>(terms) + 1;  // each of the others is there once
    for (int times = terms == 1 ? order : 1; times <= most; ++times) {
      for (const int sign : {1, -1}) {
        c.terms.push_back({sign * times, frequencies[i]});
        each_combination(frequencies.subspan(i + 1), terms - 1, order - times, c, use);
        c.terms.pop_back();
      }
    }
  }
}

}  // namespace

double Combination::frequency() const {
  double sum = 0.0;
  for (const Term& t : terms) sum += t.times * t.frequency;
  return sum;
}

int Combination::order() const {
  int sum = 0;
  for (const Term& t : terms) sum += std::abs(t.times);
  return sum;
}

std::optional<Combination> combination_of(double f, std::span<const double> others,
                                          double tolerance) {
  double reach = std::abs(f);
  for (const double other : others) reach = std::max(reach, std::abs(other));
  double tried = 0.0;
  std::optional<Combination> best;
  for (int order = 2; order <= highest_order; ++order) {
    for (std::size_t terms = 1; terms <= most_terms; ++terms) {
      double least = tolerance;
      Combination c;
      each_combination(others, terms, order, c, [&](const Combination& made) {
        ++tried;
        const double error = std::abs(made.frequency() - f);
        if (error > least) return;
        least = error;
        best = made;
      });
      if (tried * tolerance > by_chance * reach) return std::nullopt;
      if (!best) continue;
      std::stable_sort(best->terms.begin(), best->terms.end(), [](const auto& a, const auto& b) {
        return std::abs(a.times) > std::abs(b.times);
      });
      return best;
    }
  }
  return std::nullopt;
}

std::string Combination::text() const {
  std::string text;
  for (const Term& t : terms) {
    const bool is_minus = t.times < 0;
    text += text.empty() ? (is_minus ? "-" : "") : is_minus ? " - " : " + ";
    if (std::abs(t.times) > 1) text += fmt::format("{} x ", std::abs(t.times));
    text += t.frequency < 0.0 ? fmt::format("({:.1f})", t.frequency / rpm)
                              : fmt::format("{:.1f}", t.frequency / rpm);
  }
  return text;
}

}  // namespace whirl::inline dyn
