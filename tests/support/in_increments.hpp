#pragma once

#include "continuation/load_increments.hpp"
#include "elements/incremental_structure.hpp"
#include "tests/support/models.hpp"

namespace arcwall::test {

/// A structure against walls in load increments, as a study of method `incremental` takes them.
class InIncrements {
 public:
  InIncrements(std::unique_ptr<Structure> structure, const std::vector<TestWall>& walls, const ContactLaw& law);

  /// In equal increments of at most `step`.
  void load_to(double lambda, double step);

  /// Increments without load, which take up what is left unbalanced.
  void relax(int increments);

  const PathPoint& last() const { return last_; }
  int unsettled() const { return scheme_->unsettled(); }

  /// Of all contacts.
  double force() const;

  /// How high a node of the first member stands, on the axis or at an offset from it, less the offset.
  double z_of(std::size_t node, double offset = 0.0) const;

 private:
  void go_to(double lambda);

  std::unique_ptr<Structure> described_;
  IncrementalStructure present_;
  std::unique_ptr<MultiplierContact> contact_;
  std::unique_ptr<LoadIncrements> scheme_;
  PathPoint last_{};
};

}  // namespace arcwall::test
