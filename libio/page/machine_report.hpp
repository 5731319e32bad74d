#pragma once
/// Several results of one machine: analyses of one report, not versions to be compared.

#include <memory>
#include <string>
#include <vector>

#include "libio/figures/figures.hpp"

namespace whirl::inline io {

/// The verb that made a result; empty where it does not say.
std::string verb_of(const ResultView& result);

/// What an analysis is called in a report: "Critical speeds" of critical.
std::string heading_of(const ResultView& result);

/// Whether results are analyses of one machine: each by another verb, and models that differ in
/// nothing but the operation.
bool is_one_machine(const std::vector<std::unique_ptr<ResultView>>& results);

/// Results in the order of a report: static, modes, Campbell, critical speeds, unbalance, motions,
/// studies.
std::vector<const ResultView*> in_order(const std::vector<std::unique_ptr<ResultView>>& results);

}  // namespace whirl::inline io
