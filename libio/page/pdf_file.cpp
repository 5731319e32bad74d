#include "libio/page/pdf_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "libbase/system/program.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/temporary_folder.hpp"

namespace whirl::inline io {

namespace {

namespace fs = std::filesystem;

constexpr int least_version = 131;  ///< of Chromium that fills margin boxes: numbers of pages
constexpr const char* most_seconds = "300";
constexpr int timed_out = 124;  ///< exit status of timeout

/// Runs a program with an end, its output in a file.
std::optional<int> run_with_end(std::vector<std::string> words, const fs::path& output) {
  words.insert(words.begin(), {"timeout", "--foreground", "--kill-after=10", most_seconds});
  return run_program(std::move(words), output);
}

/// Major version that `PROGRAM --version` tells, "Chromium 141.0.7390.54 ..."; 0: it does not.
int version_of(const std::string& program, const fs::path& folder) {
  const fs::path output = folder / "version.txt";
  if (run_with_end({program, "--version"}, output) != 0) return 0;
  // launchers say other things with numbers before it
  std::ifstream file(output);
  for (std::string word, before; file >> word; before = word) {
    if (before != "Chromium" && before != "Chrome") continue;
    if (const int version = std::atoi(word.c_str()); version > 0) return version;
  }
  return 0;
}

/// What is printed, and where everything of it lies.
struct PrintJob {
  fs::path folder, page, pdf, output;
};

std::vector<std::string> chromium_words(const std::string& program, const PrintJob& job) {
  std::vector<std::string> words{program,
                                 "--headless",
                                 "--disable-gpu",
                                 "--disable-dev-shm-usage",
                                 "--no-first-run",
                                 "--disable-extensions",
                                 "--disable-background-networking",
                                 "--disable-component-update",
                                 "--disable-sync",
                                 "--host-resolver-rules=MAP * ~NOTFOUND",
                                 "--user-data-dir=" + (job.folder / "profile").string(),
                                 "--no-pdf-header-footer",
                                 "--generate-pdf-document-outline",
                                 "--print-to-pdf=" + job.pdf.string()};
  if (::geteuid() == 0) words.emplace_back("--no-sandbox");  // which root cannot have
  words.push_back(file_address(job.page));
  return words;
}

/// A program that prints, as words of its call.
struct Printer {
  std::string name;
  std::vector<std::string> words;
};

std::optional<Printer> printer_for(const PrintJob& job, std::string& why_none) {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    const auto program = program_named(name);
    if (!program) continue;
    const int version = version_of(*program, job.folder);
    if (version >= least_version) return Printer{name, chromium_words(*program, job)};
    why_none = fmt::format(" ({} is of version {}, {} or later is needed)", *program, version,
                           least_version);
  }
  if (const auto program = program_named("weasyprint")) {
    return Printer{"weasyprint", {*program, "--quiet", job.page.string(), job.pdf.string()}};
  }
  return std::nullopt;
}

bool is_pdf(const fs::path& file) {
  constexpr std::string_view begin = "%PDF-";
  std::array<char, begin.size()> head{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), head.size());
  return stream && std::string_view(head.data(), head.size()) == begin;
}

}  // namespace

std::string file_address(const fs::path& file) {
  constexpr std::string_view plain = "/-_.~";
  std::string address = "file://";
  for (const char c : fs::absolute(file).lexically_normal().string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(byte) != 0 || plain.find(c) != std::string_view::npos;
    address += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return address;
}

void write_pdf(const std::string& html, const fs::path& place, Replaces replaces) {
  FileReplacement file(place, replaces);
  const TemporaryFolder folder("print", place);
  const fs::path inside = fs::absolute(folder.path());
  const PrintJob job{inside, inside / "report.html", inside / "report.pdf", inside / "output.txt"};
  std::string why_none;
  const auto printer = printer_for(job, why_none);
  if (!printer) {
    throw FileError(fmt::format(
        "cannot write {}: printing needs the Debian package chromium or weasyprint{}; or write an "
        ".html",
        place.string(), why_none));
  }
  replace_file(job.page, html);
  const std::optional<int> status = run_with_end(printer->words, job.output);
  if (status != 0 || !is_pdf(job.pdf)) {
    throw FileError(fmt::format(
        "cannot write {}: {} {}: {}", place.string(), printer->name,
        status == timed_out ? fmt::format("did not end within {} s", most_seconds) : "failed",
        last_words(job.output)));
  }
  fs::copy_file(job.pdf, file.temporary(), fs::copy_options::overwrite_existing);
  mark_as_own(file.temporary());
  file.commit();
}

}  // namespace whirl::inline io
