#include "continuation/step/path_constraint.hpp"

#include <cassert>
#include <cmath>

#include "core/algebra/sums.hpp"

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

// As PathConstraint::advance(), in one pass.
std::optional<ConstraintRoots> ChordPlaneConstraint::advance(const State& at, const EquilibriumLine& line) const {
  const double *x = at.x.data(), *a = a_.x.data(), *b = b_.x.data(), *p = line.dx.col(0).data(),
               *q = line.dx.col(1).data(), *w = metric_.weights().data();
  auto [squared, covered, along_p, along_q] = sums_over<4>(at.x.size(), [&](const auto& entry, auto& sums) {
    const auto chord = entry(b) - entry(a), weighted = entry(w) * chord;
    sums[0] += weighted * chord;
    sums[1] += weighted * (entry(x) - entry(a));
    sums[2] += weighted * entry(p);
    sums[3] += weighted * entry(q);
  });
  const double dlambda = b_.lambda - a_.lambda;
  squared += metric_.inner_lambda(dlambda, dlambda);
  covered += metric_.inner_lambda(dlambda, at.lambda - a_.lambda);
  along_p += metric_.inner_lambda(dlambda, line.dlambda[0]);
  along_q += metric_.inner_lambda(dlambda, line.dlambda[1]);
  const double tau = -(covered - part_ * squared + along_p - line.off * along_q) / (line.scale * along_q);
  return std::isfinite(tau) ? std::optional(ConstraintRoots{.taken = tau}) : std::nullopt;
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
  const double *x = at.x.data(), *x0 = origin_.x.data(), *p = line.dx.col(0).data(), *q = line.dx.col(1).data(),
               *previous = tangent_.dx.data(), *w = metric_.weights().data();
  const Lanes off = line.off, scale = line.scale;
  auto [a, b, c, along] = sums_over<4>(at.x.size(), [&](const auto& entry, auto& sums) {
    const auto column = entry(q), t = entry(scale) * column, weighted = entry(w) * t;
    const auto D = entry(x) - entry(x0) + (entry(p) - entry(off) * column);
    sums[0] += weighted * t;
    sums[1] += weighted * D;
    sums[2] += entry(w) * D * D;
    sums[3] += weighted * entry(previous);
  });
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
    case PathMethod::cylindrical:
      return std::make_unique<SphereConstraint>(metric, Form::cylindrical, from, tangent,
                                                s * std::sqrt(metric.inner_x(tangent, tangent)));
    case PathMethod::spherical:
      return std::make_unique<SphereConstraint>(metric, Form::spherical, from, tangent, s);
  }
  return nullptr;
}

}  // namespace arcwall
