#include "continuation/step/path_constraint.hpp"

#include <cassert>
#include <cmath>

namespace arcwall {

namespace {

const ParameterValue parameter;

}  // namespace

// c + ∇c · (particular + τ tangent) = 0
std::optional<ConstraintRoots> PathConstraint::advance(const State& at, const EquilibriumLine& line) const {
  const Row row = gradient(at);
  const auto along = [&](Index column) {
    return row.dx.dot(line.dx.col(column)) + row.dlambda * line.dlambda[static_cast<std::size_t>(column)];
  };
  const double slope = along(1);
  const double tau = -(value(at) + along(0) - line.off * slope) / (line.scale * slope);
  return std::isfinite(tau) ? std::optional(ConstraintRoots{.taken = tau}) : std::nullopt;
}

PlaneConstraint::PlaneConstraint(const Metric& metric, const State& origin, const Direction& normal, double offset)
    : origin_(origin), normal_(metric.row(normal)), offset_(offset) {}

double PlaneConstraint::value(const State& state) const { return apply(normal_, difference(state, origin_)) - offset_; }

double ChordPlaneConstraint::value(const State& state) const {
  const Direction chord = difference(b_, a_);
  return metric_.inner(chord, difference(state, a_)) - part_ * metric_.inner(chord, chord);
}

double SphereConstraint::value(const State& state) const {
  const Direction chord = difference(state, origin_);
  return inner(chord, chord) - radius_ * radius_;
}

Row SphereConstraint::gradient(const State& state) const {
  Row row = metric_.row(difference(state, origin_));
  row.dx *= 2.0;
  row.dlambda *= form_ == Form::spherical ? 2.0 : 0.0;
  return row;
}

// With D = X − origin + particular:  |D + τ t|² = radius²,  a τ² + 2 b τ + c = 0
std::optional<ConstraintRoots> SphereConstraint::advance(const State& at, const EquilibriumLine& line) const {
  const auto p = line.dx.col(0), q = line.dx.col(1);
  const Vector t_x = line.scale * q, D_x = at.x - origin_.x + (p - line.off * q);
  const auto w = metric_.weights().array();
  const auto wt = w * t_x.array();
  double a = (wt * t_x.array()).sum(), b = (wt * D_x.array()).sum(), c = (w * D_x.array().square()).sum();
  double along = (wt * tangent_.dx.array()).sum();
  if (form_ == Form::spherical) {
    const double D = at.lambda - origin_.lambda + line.particular_dlambda(), t = line.tangent_dlambda();
    a += metric_.inner_lambda(t, t);
    b += metric_.inner_lambda(D, t);
    c += metric_.inner_lambda(D, D);
    along += metric_.inner_lambda(tangent_.dlambda, t);
  }
  c -= radius_ * radius_;
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0.0) || a == 0.0) return std::nullopt;
  const double greater = -(b + std::copysign(std::sqrt(discriminant), b));
  const double roots[2] = {greater / a, greater != 0.0 ? c / greater : 0.0};
  // Nearer the previous tangent: the greater component of D + τ t along it.
  const bool first = roots[0] * along >= roots[1] * along;
  return ConstraintRoots{.taken = roots[first ? 0 : 1], .other = roots[first ? 1 : 0]};
}

std::unique_ptr<PathConstraint> step_constraint(PathMethod method, const Metric& metric, const State& from,
                                                const Direction& tangent, double s, const Observable* control) {
  using Form = SphereConstraint::Form;
  switch (method) {
    case PathMethod::load:
      return std::make_unique<ValueConstraint>(parameter, from.lambda + s * tangent.dlambda);
    case PathMethod::displacement:
      assert(control != nullptr);
      return std::make_unique<ValueConstraint>(*control, control->value(moved(from, tangent, s)));
    case PathMethod::riks:
    case PathMethod::pseudo_arclength:
      return std::make_unique<PlaneConstraint>(metric, from, tangent, s);
    case PathMethod::normal_plane:
      return std::make_unique<UpdatedPlaneConstraint>(metric, from);
    case PathMethod::cylindrical: {
      constexpr double nothing_moves = 1e-12;  // of a tangent of unit length, squared
      const double squared = metric.inner_x(tangent, tangent);
      if (squared <= nothing_moves)
        return std::make_unique<SphereConstraint>(metric, Form::spherical, from, tangent, s);
      return std::make_unique<SphereConstraint>(metric, Form::cylindrical, from, tangent, s * std::sqrt(squared));
    }
    case PathMethod::spherical:
      return std::make_unique<SphereConstraint>(metric, Form::spherical, from, tangent, s);
  }
  return nullptr;
}

}  // namespace arcwall
