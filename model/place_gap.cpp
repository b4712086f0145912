#include "model/place_gap.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall {

std::vector<double> FacedObstacle::offsets(double angle) const {
  if (half_height == 0.0) return {0.0};
  constexpr double level = 1e-9;
  const double up = std::cos(angle) * (side == Side::above ? 1.0 : -1.0);
  if (std::abs(up) <= level) return {half_height, -half_height};
  return {up > 0.0 ? half_height : -half_height};
}

// --- fixed nodes ----------------------------------------------------------------------------------------------------

const Candidate& NodeGap::nearest(const State& state) const {
  return *std::min_element(points_.begin(), points_.end(),
                           [&](const Candidate& a, const Candidate& b) { return a.gap(state) < b.gap(state); });
}

double NodeGap::value(const State& state) const { return nearest(state).gap(state); }

Row NodeGap::gradient(const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  const Candidate& point = nearest(state);
  if (!point.faces_wall(state)) return row;
  Gap gap;
  point.gap(state, gap);
  const std::vector<Index>& unknowns = point.point().unknowns();
  for (std::size_t i = 0; i < unknowns.size(); ++i) row.dx[unknowns[i]] = gap.gradient[static_cast<Index>(i)];
  row.dlambda = gap.rate;
  return row;
}

// --- a mesh that slides ---------------------------------------------------------------------------------------------

StrandGap::StrandGap(const SlidingStructure& structure, const MaterialPoint& point, FacedObstacle faced)
    : point_(point), faced_(std::move(faced)), offsets_(faced_.offsets(structure.undeformed(point, true).angle)) {}

std::pair<LinearField, double> StrandGap::nearest(const AxisPlace& axis, double lambda) const {
  std::pair<LinearField, double> least{{.value = infinity}, 0.0};
  for (const double offset : offsets_)
    if (const LinearField gap = faced_.obstacle->gap_slope(axis.position + offset * axis_normal(axis.angle), lambda);
        gap.value < least.first.value)
      least = {gap, offset};
  return least;
}

double StrandGap::value(const State& state) const {
  return nearest(mesh_of(state).place(point_, mesh_state_of(state)), state.lambda).first.value;
}

// The face at r + o n(θ) has the rate −o t by θ, t the tangent.
Row StrandGap::gradient(const State& state) const {
  const SlidingMesh& mesh = mesh_of(state);
  const MeshState now = mesh_state_of(state);
  const AxisPlace axis = mesh.place(point_, now);
  const auto [gap, offset] = nearest(axis, state.lambda);
  const auto by_place = mesh.place_gradient(point_, now);
  const double turn = -offset * (gap.x * std::cos(axis.angle) + gap.z * std::sin(axis.angle));
  const Eigen::RowVector3d slope(gap.x, gap.z, turn);
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = gap.rate + slope * by_place.dlambda};
  row.dx.head(now.x.size()) = (slope * by_place.dx).transpose();
  row.dx.tail(now.s.size()) = (slope * by_place.ds).transpose();
  return row;
}

}  // namespace arcwall
