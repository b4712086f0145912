#include "contact/sliding/pressed_part.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall::sliding {

namespace {

// Forces of the nodes of a pressed part, its first and last node left out, less what the mesh adds at the ends: the
// part is a beam on knife edges at equal distances whose slope is held at its ends. To a pressure with the slope f′
// from edge to edge belong moments that miss those of the interior by a thirtieth of f′, from which a layer of forces
// decays,
//
//   −f′ r / (5 (2 − r)) · (−r)^j,   r = 2 − √3,   j nodes from the first.
//
// A cubic through four forces shows the force that an edge at the end itself would have, and f′ with the layer's own
// part in it.
constexpr Index fewest_for_ends = 4;

using Four = Eigen::Vector4d;
const Four at_end(4.0, -6.0, 4.0, -1.0);
const Four slope_at_end(-13.0 / 3.0, 19.0 / 2.0, -7.0, 11.0 / 6.0);

// (1 − layer) as a matrix: smooth forces from forces.
Matrix smoothing(Index count) {
  Matrix smooth = Matrix::Identity(count, count);
  if (count < fewest_for_ends) return smooth;
  const double r = 2.0 - std::sqrt(3.0);
  const double c = r / (5.0 * (2.0 - r));
  double layer = c / (1.0 - c * slope_at_end.dot(Four(1.0, -r, r * r, -r * r * r)));
  for (Index j = 0; j < count; ++j, layer *= -r) {
    smooth.row(j).head<4>() += layer * slope_at_end;
    smooth.row(count - 1 - j).tail<4>() += layer * slope_at_end.reverse();
  }
  return smooth;
}

// A place near a node, in elements from it, with the weights of the nodes' smooth forces there.
struct Place {
  double offset = 0.0;
  Vector weights{};
};

// The least value of the parabola through the forces of three neighbours within half an element of node i.
Place least_of_parabola(const Vector& force, Index i) {
  const Index count = force.size();
  Place least{.offset = 0.0, .weights = Vector::Unit(count, i)};
  if (count < 3) return least;
  const Index middle = std::clamp(i, Index{1}, count - 2);
  const double slope = 0.5 * (force[middle + 1] - force[middle - 1]);
  const double bend = force[middle + 1] - 2.0 * force[middle] + force[middle - 1];
  const auto rise = [&](double t) { return t * (slope + 0.5 * t * bend); };
  const double a = double(i - middle) - 0.5, b = a + 1.0;
  double t = rise(a) < rise(b) ? a : b;
  if (bend > 0.0) t = std::clamp(-slope / bend, a, b);
  least.offset = t - double(i - middle);
  least.weights.setZero();
  least.weights.segment<3>(middle - 1) << 0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0);
  return least;
}

// From the first and the last node the end of the part is seen, too.
Place least_near(const Vector& force, Index i) {
  const Index count = force.size();
  Place least = least_of_parabola(force, i);
  for (const bool last : {false, true}) {
    if (count < fewest_for_ends || i != (last ? count - 1 : 0)) continue;
    Vector end = Vector::Zero(count);
    last ? end.tail<4>() = at_end.reverse() : end.head<4>() = at_end;
    if (end.dot(force) >= least.weights.dot(force)) continue;
    least.weights = end;
    least.offset = last ? 1.0 : -1.0;
  }
  return least;
}

}  // namespace

LeastPressure least_pressure(const SlidingState& at, std::size_t node) {
  const SlidingContactLayout::PressedNode& pressed = at.layout.pressed_nodes()[node];
  const SlidingContactLayout::Segment& segment = at.layout.segments()[pressed.segment];
  const Index count = segment.elements - 1;
  const Index begin = segment.first_point < 0 ? 0 : at.mesh.breakpoint(segment.first_point).second;
  const Index i = pressed.position - begin - 1;
  const std::size_t first = node - static_cast<std::size_t>(i);
  const auto forces = at.state.x.segment(at.index.pressed_force(first), count);
  const Matrix smooth = smoothing(count);
  const Place least = least_near(smooth * forces, i);

  LeastPressure out{.first = first, .weights = smooth.transpose() * least.weights};
  const double length = at.mesh.coordinate(pressed.strand, begin + segment.elements, at.now.s) -
                        at.mesh.coordinate(pressed.strand, begin, at.now.s);
  out.element = length / segment.elements;
  out.value = out.weights.dot(forces) * segment.elements / length;
  out.s = at.mesh.coordinate(pressed.strand, pressed.position, at.now.s) + least.offset * out.element;
  return out;
}

}  // namespace arcwall::sliding
