#pragma once
/// Other programs, run for what they do better.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace whirl::inline base {

/// Runs a program that is looked for as a shell would, without a shell, and waits for it.
///
/// @param words   its name and arguments
/// @param output  file that takes all it prints; empty: goes where ours goes
/// @return        exit status, 128 + signal if one ended it; nothing if there is no such program
std::optional<int> run_program(std::vector<std::string> words,
                               const std::filesystem::path& output = {});

/// What a program said last, of which Python's errors are the most telling line.
/// @param output  what it printed
std::string last_words(const std::filesystem::path& output);

}  // namespace whirl::inline base
