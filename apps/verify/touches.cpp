#include "apps/verify/touches.hpp"

#include "apps/verify/differences.hpp"
#include "apps/verify/node_touches.hpp"
#include "apps/verify/sliding_touches.hpp"

namespace arcwall::verify {

void NodeFunction::resolve(double length) {
  constexpr double part = 0.02;  // the slope of a circle right before its end to 4e-8
  steps.head<2>() = steps.head<2>().cwiseMin(part * length);
}

Vector NodeFunction::gradient() const {
  Vector gradient = Vector::Zero(at.size());
  if (by_place) {
    const Vec2 slope = by_place(at);
    for (Index i = 0; i < 2; ++i)
      if (unknowns[static_cast<std::size_t>(i)] >= 0) gradient[i] = slope[i];
    return gradient;
  }
  for (Index i = 0; i < at.size(); ++i)
    if (unknowns[static_cast<std::size_t>(i)] >= 0)
      gradient[i] = derivative([&](double step) { return of(at + step * Vector::Unit(at.size(), i)); }, steps[i]);
  return gradient;
}

Matrix NodeFunction::hessian() const {
  const Index n = at.size();
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

Touches touches(const Model& model, const std::vector<PlainWall>& walls, const State& state) {
  if (model.sliding() != nullptr) return sliding_touches(model, walls, state);
  return model.contact() != nullptr ? node_touches(model, walls, state) : Touches{};
}

}  // namespace arcwall::verify
