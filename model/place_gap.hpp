#pragma once

#include <memory>
#include <vector>

#include "contact/candidate.hpp"
#include "contact/obstacle.hpp"
#include "core/observable.hpp"
#include "elements/sliding_structure.hpp"

namespace arcwall {

/// What stands in the way of a member: an obstacle, and how far the faces that it is touched by are from the axis, 0
/// where that is the axis.
struct FacedObstacle {
  std::shared_ptr<const Obstacle> obstacle{};
  Side side = Side::above;
  double half_height = 0.0;  ///< [length]

  /// The distances from the axis, along the normal of a section whose axis has this angle, of the faces that look at
  /// the obstacle: one, or both of a section that stands across it.
  std::vector<double> offsets(double angle) const;
};

/// The gap between a node of a mesh whose nodes are fixed and a wall [length], as contact measures it: positive
/// outside; infinite where the wall has no surface that faces the place. The least of those of several points.
class NodeGap final : public Observable {
 public:
  explicit NodeGap(std::vector<Candidate> points) : points_(std::move(points)) {}

  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  const Candidate& nearest(const State& state) const;

  std::vector<Candidate> points_;
};

/// The same of a place of a structure whose mesh slides.
class StrandGap final : public Observable {
 public:
  /// `structure` must outlive this.
  StrandGap(const SlidingStructure& structure, const MaterialPoint& point, FacedObstacle faced);

  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  // With the distance of the face from the axis; the axis where it is in the state.
  std::pair<LinearField, double> nearest(const AxisPlace& axis, double lambda) const;

  MaterialPoint point_;
  FacedObstacle faced_;
  std::vector<double> offsets_;
};

}  // namespace arcwall
