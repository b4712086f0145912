#pragma once

#include <memory>

#include "core/observable.hpp"
#include "elements/structure.hpp"

namespace arcwall {

/// A structure in the updated Lagrangian formulation: linear about its present configuration, which carries the
/// stresses of all increments so far. Its unknowns are those of the structure it was made of.
class IncrementalStructure final : public System {
 public:
  /// Stress-free, as `structure` is; every element must have an updated form: see can_be_updated().
  explicit IncrementalStructure(const Structure& structure) : present_(structure.updated()) {}

  Dimensions dimensions(const ActiveSet& active_set) const override { return present_->dimensions(active_set); }
  void residual(const State& state, Eigen::Ref<Vector> F) const override { present_->residual(state, F); }
  void linearize(const State& state, Linearization& out) const override { present_->linearize(state, out); }
  double energy(const State& state) const override { return present_->energy(state); }
  StateMetric metric(const ActiveSet& active_set) const override { return present_->metric(active_set); }

  /// The end of an increment: its configuration becomes the reference.
  void advance(const State& state) { present_ = present_->updated(state); }

  const Structure& present() const { return *present_; }

 private:
  std::unique_ptr<Structure> present_;
};

/// Support reaction by the stresses carried so far; at the end of the last increment alone.
class IncrementalReaction final : public Observable {
 public:
  IncrementalReaction(const IncrementalStructure& structure, Index dof) : structure_(structure), dof_(dof) {}
  double value(const State& state) const override { return structure_.present().reaction(state, dof_); }
  Row gradient(const State& state) const override { return structure_.present().reaction_gradient(state, dof_); }

 private:
  const IncrementalStructure& structure_;
  Index dof_;
};

}  // namespace arcwall
