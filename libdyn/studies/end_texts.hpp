#pragma once
/// Why branches end, as results say it (libbase/structs/column.hpp).

#include <optional>
#include <string>

#include "libbase/structs/column.hpp"
#include "libdyn/branches/branch.hpp"

namespace whirl::inline dyn {

/// The end of a branch; all of it is empty while the branch goes on.
struct EndTexts {
  std::string end, end_kind, end_reason;

  EndTexts() = default;
  explicit EndTexts(const Branch& branch) {
    if (!branch.end) return;
    end = branch.end->text;
    end_kind = name_of(branch.end->kind);
    end_reason = branch.end->reason;
  }

  /// Files of earlier versions have the sentence alone.
  std::optional<BranchEnd> branch_end() const {
    if (end.empty()) return std::nullopt;
    const EndKind known = value_named<EndKind>(end_kind).value_or(EndKind::untold);
    return BranchEnd{.kind = known, .text = end, .reason = end_reason};
  }

  std::optional<std::string> kind() const {
    return end_kind.empty() ? std::nullopt : std::optional(end_kind);
  }

  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("end", &EndTexts::end, "", "why it ends"),
        column("end_kind", &EndTexts::end_kind, "", "what makes it end").only(in_file).maybe(),
        column("end_kind", &EndTexts::kind, "", "null: it goes on").only(in_json),
        column("end_reason", &EndTexts::end_reason, "", "what fails where no orbit is found")
            .only(in_file)
            .maybe()};
  }
};

}  // namespace whirl::inline dyn
