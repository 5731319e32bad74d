#pragma once
/// The borders in the plane of two parameters.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/verbs/branch_parameters.hpp"
#include "apps/verbs/branches.hpp"
#include "libdyn/branches/border.hpp"

namespace whirl {

/// Curves of all bifurcations of branches; none without a second parameter.
class Borders {
 public:
  Borders(const BranchParameters& parameters, std::shared_ptr<const Scene> first,
          const BranchLayout& layout, int most_points);

  /// Walks along all of them until they end; false: interrupted.
  /// @param added  called after each point
  bool walk(const std::vector<TracedBranch>& branches,
            const std::function<void(std::size_t points)>& added);

  void write(ResultWriter& file) const;
  void read(const ResultReader& file);
  Record record() const;
  std::string text() const;

 private:
  void begin(const std::vector<TracedBranch>& branches);
  BranchEquations equations(const TracedBranch& border) const;
  ContinuationOptions options(const TracedBranch& border) const;
  BorderAxes axes() const;

  const BranchParameters& parameters_;
  std::shared_ptr<const Scene> first_;
  const BranchLayout& layout_;
  int most_points_;
  std::vector<TracedBranch> borders_;
};

}  // namespace whirl
