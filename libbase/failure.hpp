#pragma once
/// Why a computation has no result.

#include <ostream>
#include <string>
#include <string_view>
#include <utility>

namespace whirl::inline base {

/// Why something failed, in one sentence for people; nothing where it did not.
///
/// A result whose parts are worth keeping says by such a member that it failed. Wrong input throws
/// (ModelError), and so does failed mathematics that leaves nothing to return (NumericalError).
/// What programs decide by is an enumeration beside it (Outcome, BranchEnd); no sentence is ever
/// compared.
class Failure {
 public:
  Failure() = default;
  Failure(std::string why) : why_(std::move(why)) {}
  Failure(const char* why) : why_(why) {}

  /// Whether it failed.
  explicit operator bool() const { return !why_.empty(); }
  /// Why; empty where it did not.
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
