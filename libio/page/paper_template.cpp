#include "libio/page/paper_template.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "libio/page/pdf_file.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/xml.hpp"

namespace whirl::inline io {

namespace {

/// Without these a report is none.
constexpr std::string_view needed[] = {"style", "verdict", "report"};

/// Nothing runs; pictures, fonts and styles are files of this machine or in the page.
constexpr std::string_view policy =
    "default-src 'none'; img-src data: file:; style-src 'unsafe-inline' file:; font-src data: "
    "file:";

std::vector<std::string> names_of_places(const TemplateValues& values) {
  std::vector<std::string> names;
  for (const auto* all : {&values.texts, &values.blocks}) {
    for (const auto& [name, value] : *all) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Fills a template place by place.
class Filler {
 public:
  Filler(const std::string& name, const TemplateValues& values) : name_(name), values_(values) {}

  std::string fill(std::string_view page) {
    std::string out;
    for (auto at = page.find("{{"); at != std::string_view::npos; at = page.find("{{")) {
      out += page.substr(0, at);
      line_ += std::count(page.begin(), page.begin() + static_cast<std::ptrdiff_t>(at), '\n');
      const auto end = page.find("}}", at);
      if (end == std::string_view::npos) fail("\"{{\" without \"}}\"");
      out += value_of(trimmed(page.substr(at + 2, end - at - 2)));
      line_ += std::count(page.begin() + static_cast<std::ptrdiff_t>(at),
                          page.begin() + static_cast<std::ptrdiff_t>(end), '\n');
      page.remove_prefix(end + 2);
    }
    out += page;
    for (const std::string_view place : needed) {
      if (seen_.contains(place)) continue;
      throw FileError(
          fmt::format("{}: the place {{{{{}}}}} is missing: a template needs {{{{{}}}}}", name_,
                      place, fmt::join(needed, "}}, {{")));
    }
    return out;
  }

 private:
  static std::string_view trimmed(std::string_view text) {
    constexpr const char* blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw FileError(fmt::format("{}:{}: {}", name_, line_, why));
  }

  std::string value_of(std::string_view place) {
    seen_.emplace(place);
    if (const auto block = values_.blocks.find(place); block != values_.blocks.end()) {
      return block->second;
    }
    const auto text = values_.texts.find(place);
    if (text == values_.texts.end()) {
      fail(fmt::format("{{{{{}}}}} stands for nothing; places are {}", place,
                       fmt::join(names_of_places(values_), ", ")));
    }
    if (text->second.empty()) {
      fail(fmt::format(
          "{{{{{0}}}}} has no value: say it by {0} in [report] of the model, or by --cover {0}=...",
          place));
    }
    return xml_text(text->second);
  }

  const std::string& name_;
  const TemplateValues& values_;
  long line_ = 1;
  std::set<std::string, std::less<>> seen_{};
};

}  // namespace

std::string filled_template(std::string_view page, const std::string& name,
                            const TemplateValues& values) {
  std::string head = fmt::format(
      "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"{}\">\n",
      policy);
  if (!name.empty()) {
    const std::filesystem::path folder = std::filesystem::absolute(name).parent_path();
    head += fmt::format("<base href=\"{}\">\n", file_address(folder / ""));
  }
  return head + Filler(name, values).fill(page);
}

}  // namespace whirl::inline io
