#pragma once
/// Why a computation has no result.

#include <ostream>
#include <string>
#include <string_view>
#include <utility>

namespace whirl::inline base {

/// Why something failed, in one sentence for people; empty if nothing failed.
///
/// A result that failed, but has parts worth keeping, says so by a member of this type. Wrong input
/// throws (ModelError), and so does failed mathematics that leaves nothing to return
/// (NumericalError). Programs decide by an enumeration beside the Failure (Outcome, BranchEnd); no
/// sentence is ever compared.
class Failure {
 public:
  Failure() = default;
  Failure(std::string why) : why_(std::move(why)) {}
  Failure(const char* why) : why_(why) {}

  /// Whether something failed.
  explicit operator bool() const { return !why_.empty(); }
  /// The sentence; empty if nothing failed.
  const std::string& text() const { return why_; }
  operator std::string_view() const { return why_; }

  bool operator==(const Failure&) const = default;

 private:
  std::string why_;
};

inline std::ostream& operator<<(std::ostream& out, const Failure& failure) {
  return out << failure.text();
}

}  // namespace whirl::inline base
