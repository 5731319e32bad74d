#pragma once
/// Other programs, run for what they do better.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace whirl::inline base {

/// Runs a program that is looked for as a shell would, without a shell, and waits for it.
///
/// @param words   its name and arguments
/// @param output  file that takes all that the program prints; empty: it prints where this program
///                does
/// @param meanwhile  called ten times a second while it runs; empty: nothing
/// @return        exit status, 128 + signal if a signal ended the program; nothing if there is no
///                such program
std::optional<int> run_program(std::vector<std::string> words,
                               const std::filesystem::path& output = {},
                               const std::function<void()>& meanwhile = {});

/// Where the search path has a program; nothing: it has none.
std::optional<std::string> program_named(const std::string& name);

/// The line of a program's output that tells most of a failure: the last one with an error of
/// Python, else the last one.
/// @param output  what the program printed
std::string last_words(const std::filesystem::path& output);

}  // namespace whirl::inline base
