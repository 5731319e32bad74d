// The manual says what the columns of results say: of result files every dataset has its row there,
// with its unit and its dimensions, and every attribute is named; of JSON every key is named as it
// is printed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "libdata/balancing/balancing.hpp"
#include "libdata/fit/measured_fit.hpp"
#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/order_tracking.hpp"
#include "libdata/measured/running_modes.hpp"
#include "libdata/measured/trend.hpp"
#include "libdata/measured/zones.hpp"
#include "libdyn/linear/critical_over.hpp"
#include "libdyn/linear/frequency_response.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libdyn/linear/modes_over.hpp"
#include "libdyn/linear/static_study.hpp"
#include "libdyn/linear/unbalance_over.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libdyn/motions/run_result.hpp"
#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/branch_result.hpp"
#include "libdyn/studies/classification_result.hpp"
#include "libdyn/studies/curve_result.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/studies/orbit_search.hpp"
#include "libdyn/studies/resonance_study.hpp"
#include "libdyn/studies/study_outcome.hpp"
#include "libdyn/studies/sweep.hpp"
#include "libdyn/studies/torus_result.hpp"
#include "libdyn/studies/work_precision_study.hpp"
#include "libdyn/system/model_facts.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/critical_map.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/result_schema.hpp"
#include "tests/support/manual.hpp"

namespace whirl::result_manual_test {

std::string manual() {
  return test::command_line_manual();
}

/// The part below a heading, up to the next one.
std::string part(const std::string& heading) {
  const std::string text = manual();
  const std::size_t begin = text.find("\n## " + heading + "\n") + 1;
  return text.substr(begin, text.find("\n## ", begin) - begin);
}

struct Row {
  std::string unit, dimensions;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Rows by path; one row may be of several datasets.
std::map<std::string, Row> rows_of(const std::string& text) {
  std::map<std::string, Row> rows;
  const std::regex row(R"(\n\|((?: `/[\w/]+`,?)+) \|([^|]*)\|([^|]*)\|)"), path(R"(`(/[\w/]+)`)");
  for (std::sregex_iterator r(text.begin(), text.end(), row), end; r != end; ++r) {
    const std::string paths = (*r)[1];
    for (std::sregex_iterator p(paths.begin(), paths.end(), path); p != end; ++p) {
      rows[(*p)[1]] = {trimmed((*r)[2]), trimmed((*r)[3])};
    }
  }
  return rows;
}

std::ptrdiff_t count_of(const std::string& list, char separator) {
  return list.empty() ? 0 : std::count(list.begin(), list.end(), separator) + 1;
}

TEST(ResultManual, SaysWhatColumnsSay) {
  const std::string text =
      part("Result file") + part("Datasets of motions") + part("Datasets of studies");
  const std::map<std::string, Row> rows = rows_of(text);
  int stated = 0;
  for (const ResultSet& set : result_schema()) {
    for (const ResultEntry& e : set.entries) {
      if (e.meaning.empty()) continue;  // not by columns
      ++stated;
      const std::size_t at = e.path.find('@');
      if (at != std::string::npos) {
        const std::string name = "`" + e.path.substr(at + 1) + "`";
        EXPECT_NE(text.find(name), std::string::npos) << e.path;
        continue;
      }
      const auto row = rows.find(e.path);
      if (row == rows.end()) {
        ADD_FAILURE() << fmt::format("missing:\n| `{}` | {} | {} | {} |", e.path, e.unit, e.sizes,
                                     e.meaning);
        continue;
      }
      EXPECT_EQ(row->second.unit, e.unit) << e.path;
      EXPECT_EQ(count_of(row->second.dimensions, ','), count_of(e.sizes, ' ')) << e.path;
    }
  }
  EXPECT_GE(stated, 60);
}

// ---- JSON ---------------------------------------------------------------------------------------

/// Words of what is written as code.
std::set<std::string> code_words(const std::string& text) {
  std::set<std::string> words;
  const std::regex code("`([^`]+)`"), word(R"([A-Za-z_]\w*)");
  for (std::sregex_iterator c(text.begin(), text.end(), code), end; c != end; ++c) {
    const std::string written = (*c)[1];
    for (std::sregex_iterator w(written.begin(), written.end(), word); w != end; ++w) {
      words.insert(w->str());
    }
  }
  return words;
}

void add_keys(std::span<const columns::AnyColumn> columns, std::set<std::string>& keys) {
  for (const columns::AnyColumn& c : columns) {
    if (!c.is_rows) {
      if (c.record) keys.insert(columns::json_key(c.info));
    } else if (c.rows.written != Written::in_file) {
      keys.insert(columns::dimension_names(c.rows.dimension).front());
      add_keys(c.of_row, keys);
    }
  }
}

template <class... Results>
std::set<std::string> json_keys_of() {
  std::set<std::string> keys;
  (add_keys(columns::any_columns<Results>, keys), ...);
  return keys;
}

// `phase` stood there for phase_rad, `height` for height_1_hz: whoever reads the manual asks for
// what is not.
TEST(ResultManual, NamesTheKeysOfJsonAsTheyArePrinted) {
  const std::set<std::string> told = code_words(part("JSON"));
  const std::set<std::string> keys =
      json_keys_of<ModelFacts, StaticStudy, ModesAtPoints, ModesOver, ModesOverThreshold,
                   CriticalOver, UnbalanceOver, Campbell, ResonanceStudy, CriticalSpeeds,
                   UnbalanceStudy, FrequencyResponse, ResponsePair, LateralReport, RunSummary,
                   Identification, IdentifiedPeak, MeasuredIdentification, OrderTracking, Trend,
                   ZoneReport, RunningModes, MeasuredFit, FittedParameter, ClassificationResult,
                   ContactShares, ReductionFacts, RotatingOrbit, OrbitSearch, BranchResult,
                   CurveResult, TorusResult, SweepEntry, BasinShares, StudyOutcome,
                   UnsettledMotions, WorkPrecisionStudy, TimedRun, Balancing>();
  for (const std::string& key : keys) EXPECT_TRUE(told.contains(key)) << key;
  EXPECT_GT(keys.size(), 150u);
}

}  // namespace whirl::result_manual_test
