#include "apps/verify/touches.hpp"

#include <cmath>

#include "apps/verify/differences.hpp"
#include "apps/verify/node_touches.hpp"
#include "apps/verify/sliding_touches.hpp"
#include "core/unit_tangent.hpp"

namespace arcwall::verify {

void NodeFunction::resolve(double length) {
  constexpr double part = 0.02;  // the slope of a circle right before its end to 4e-8
  steps.head<2>() = steps.head<2>().cwiseMin(part * length);
}

Vector NodeFunction::gradient() const {
  Vector gradient = slopes ? slopes(at) : Vector(Vector::Zero(at.size()));
  for (Index i = 0; slopes && i < at.size(); ++i)
    if (unknowns[static_cast<std::size_t>(i)] < 0) gradient[i] = 0.0;
  if (slopes) return gradient;
  for (Index i = 0; i < at.size(); ++i)
    if (unknowns[static_cast<std::size_t>(i)] >= 0)
      gradient[i] = derivative([&](double step) { return of(at + step * Vector::Unit(at.size(), i)); }, steps[i]);
  return gradient;
}

Matrix NodeFunction::hessian() const {
  const Index n = at.size();
  if (bends) return bends(at);
  Matrix hessian = Matrix::Zero(n, n);
  const auto varied = [&](Index i, double by) {
    NodeFunction moved = *this;
    moved.at[i] += by;
    return moved.gradient();
  };
  for (Index i = 0; i < n; ++i)
    if (unknowns[static_cast<std::size_t>(i)] >= 0)
      hessian.col(i) = derivative([&](double step) { return varied(i, step); }, steps[i]);
  return 0.5 * (hessian + hessian.transpose());
}

// ∂g = n, ∂²g = −κ/(1 − κ d) t tᵀ: by differences alone where the curvature is infinite, at a sharp corner.
void take_outline(const PlainWall& wall, const std::function<Vec2(const Vector&)>& place, NodeFunction& gap) {
  gap.slopes = [=, &wall](const Vector& u) {
    Vector slopes = Vector::Zero(u.size());
    slopes.head<2>() = wall.normal(place(u));
    return slopes;
  };
  if (!std::isfinite(wall.curvature(place(gap.at)))) return;
  gap.bends = [=, &wall, unknowns = gap.unknowns](const Vector& u) {
    const Vec2 along = unit_tangent(wall.slope_angle(place(u)));
    Matrix bends = Matrix::Zero(u.size(), u.size());
    bends.topLeftCorner<2, 2>() = -wall.turn(place(u)) * along * along.transpose();
    for (Index i = 0; i < 2; ++i)
      if (unknowns[static_cast<std::size_t>(i)] < 0) bends.row(i).setZero(), bends.col(i).setZero();
    return bends;
  };
}

Touches touches(const Model& model, const std::vector<PlainWall>& walls, const State& state) {
  if (model.sliding() != nullptr) return sliding_touches(model, walls, state);
  if (model.compliant() != nullptr) return {.of_compliant_walls = model.compliant()->closed_contacts(state)};
  return model.contact() != nullptr ? node_touches(model, walls, state) : Touches{};
}

}  // namespace arcwall::verify
