#pragma once
/// The head of a report: whose it is, and what it is of.

#include <string>
#include <utility>
#include <vector>

#include "libio/figures/figures.hpp"
#include "libio/model/report_words.hpp"

namespace whirl::inline io {

/// Sets words of a cover by lines KEY=VALUE, whose keys are those of table [report].
/// @throws ModelError  for a line without "=" or with another key, with the known ones
void set_words(ReportWords& words, const std::vector<std::string>& lines);

/// What stands on a cover.
struct Cover {
  ReportWords words{};     ///< its title and date are never empty
  std::string version{};   ///< of the program that makes the report
  std::string model{};     ///< where the model came from; empty: not known
  std::string digest{};    ///< SHA-256 of the model that the results hold
  std::string computed{};  ///< when the first and the last result were computed
};

/// The cover of results: the words are those of the first model that has any.
/// @param given  words instead of the model's, KEY=VALUE
/// @throws ModelError  as set_words
Cover cover_of(const std::vector<std::unique_ptr<ResultView>>& results, const std::string& version,
               const std::vector<std::string>& given = {});

/// What a cover says, name by name, without what is empty.
std::vector<std::pair<std::string, std::string>> lines_of(const Cover& cover);

}  // namespace whirl::inline io
