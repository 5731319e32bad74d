#include "libio/page/cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>

#include "libbase/error.hpp"
#include "libio/results/call.hpp"
#include "libio/results/digest.hpp"
#include "libio/text/option_values.hpp"

namespace whirl::inline io {

namespace {

/// The day of the report where nobody says another one.
std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  std::array<char, 16> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d", &local);
  return text.data();
}

bool has_any(const ReportWords& words) {
  return std::apply([&](const auto&... field) { return (... || !(words.*field.member).empty()); },
                    ReportWords::fields());
}

std::string root_text(const ResultView& result, const char* name) {
  return result.file.has_attribute("/", name) ? result.file.string_attribute("/", name) : "";
}

/// "2026-11-02T10:00:00Z", or from the first to the last.
std::string computed_at(const std::vector<std::unique_ptr<ResultView>>& results) {
  std::vector<std::string> times;
  for (const auto& result : results) {
    const std::string time = root_text(*result, "created");
    if (!time.empty()) times.push_back(time);
  }
  if (times.empty()) return "";
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  return *first == *last ? *first : *first + " to " + *last;
}

}  // namespace

void set_words(ReportWords& words, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    const auto equals = line.find('=');
    const std::string key = line.substr(0, equals);
    std::vector<std::string> known;
    bool is_set = false;
    std::apply(
        [&](const auto&... field) {
          const auto look = [&](const auto& f) {
            known.emplace_back(f.name);
            if (f.name != key || equals == std::string::npos) return;
            words.*f.member = line.substr(equals + 1);
            is_set = true;
          };
          (look(field), ...);
        },
        ReportWords::fields());
    if (is_set) continue;
    std::string keys;
    for (const std::string& name : known) keys += (keys.empty() ? "" : ", ") + name;
    throw wrong_option("cover", line,
                       fmt::format("expected KEY=VALUE, a key of the table [report]: {}", keys));
  }
}

Cover cover_of(const std::vector<std::unique_ptr<ResultView>>& results, const std::string& version,
               const std::vector<std::string>& given) {
  Cover cover{.version = version};
  const ResultView& first = *results.front();
  for (const auto& result : results) {
    cover.words = report_words(stored_model(result->file));
    if (has_any(cover.words)) break;
  }
  set_words(cover.words, given);
  if (cover.words.title.empty()) cover.words.title = first.title;
  if (cover.words.date.empty()) cover.words.date = today();
  cover.model = first.model_path;
  cover.digest = sha256_of(stored_model(first.file));
  cover.computed = computed_at(results);
  return cover;
}

std::vector<std::pair<std::string, std::string>> lines_of(const Cover& cover) {
  const ReportWords& w = cover.words;
  std::vector<std::pair<std::string, std::string>> lines{{"Company", w.company},
                                                         {"Client", w.client},
                                                         {"Project", w.project},
                                                         {"Document", w.document},
                                                         {"Revision", w.revision},
                                                         {"Author", w.author},
                                                         {"Checked by", w.checked_by},
                                                         {"Approved by", w.approved_by},
                                                         {"Date", w.date},
                                                         {"Computed", cover.computed},
                                                         {"Program", "whirl " + cover.version},
                                                         {"Model", cover.model},
                                                         {"Model, SHA-256", cover.digest}};
  std::erase_if(lines, [](const auto& line) { return line.second.empty(); });
  return lines;
}

}  // namespace whirl::inline io
