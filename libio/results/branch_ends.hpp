#pragma once
/// Why branches end, in a result file.

#include <optional>
#include <string>
#include <vector>

#include "libdyn/branches/branch.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// Datasets `end`, `end_kind` and `end_reason` of a group, empty of branches that go on.
/// @param axis  path of the dataset along the branches; empty: there is none
void write_ends(ResultWriter& file, const std::string& group, const std::string& axis,
                const std::vector<std::optional<BranchEnd>>& ends);

/// Those ends again. Files of earlier versions have texts alone.
std::vector<std::optional<BranchEnd>> read_ends(const ResultReader& file, const std::string& group);

}  // namespace whirl::inline io
