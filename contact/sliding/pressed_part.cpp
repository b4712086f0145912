#include "contact/sliding/pressed_part.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/part_loads.hpp"

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

// A pressed node and the part that it belongs to.
struct PartOfNode {
  const SlidingContactLayout::PressedNode& pressed;
  const SlidingContactLayout::Segment& segment;
  Index node, nodes;  // which of the part's nodes it is, and how many there are

  PartOfNode(const SlidingContactLayout& layout, std::size_t number)
      : pressed(layout.pressed_nodes()[number]), segment(layout.segments()[pressed.segment]) {
    const Index begin = segment.first_point < 0 ? 0 : layout.mesh().breakpoint(segment.first_point).second;
    node = pressed.position - begin - 1;
    nodes = segment.elements - 1;
  }
};

// Material coordinates of a part's ends.
struct Extent {
  double from, length;
};

Extent extent(const SlidingSetting& setting, const SlidingState& at, const PartOfNode& part) {
  const auto [from, to] = at.layout.ends(setting.body, part.segment, at.now.s);
  return {.from = from, .length = to - from};
}

// --- on a curved obstacle: by the forces of the nodes --------------------------------------------------------------

struct ByForces {
  Index first = 0;      // the first force of the part among the unknowns
  Vector weights{};     // of the forces of the part's nodes: their sum is the pressure times the length of an element
  double offset = 0.0;  // of the place from the node, in elements
  double sum = 0.0;     // of the forces less what point loads add to them, by the weights
};

ByForces least_by_forces(const SlidingSetting& setting, const SlidingState& at, std::size_t number,
                         const PartOfNode& part) {
  ByForces out{.first = at.index.pressed_force(number - static_cast<std::size_t>(part.node))};
  const Vector forces = at.state.x.segment(out.first, part.nodes) - forces_of_loads(setting, at, part.pressed.segment);
  const Matrix smooth = smoothing(part.nodes);
  const Place least = least_near(smooth * forces, part.node);
  out.weights = smooth.transpose() * least.weights;
  out.offset = least.offset;
  out.sum = out.weights.dot(forces);
  return out;
}

// --- on a straight obstacle: the axis is straight, so that its pressure is known -------------------------------------

// A place of a part by its fraction r, and the pressure there.
struct AtFraction {
  double r, pressure;
};

// How far a fraction of a part lies ahead of the tracked point at its end, or of the end itself.
struct AheadOfPoint {
  double from, length;

  AheadOfPoint(const SlidingSetting& setting, const SlidingState& at, const PartOfNode& part) {
    const Extent whole = extent(setting, at, part);
    from = part.segment.has_point() ? whole.from - at.s(static_cast<Index>(part.segment.end_point())) : 0.0;
    length = whole.length;
  }
  double operator()(double r) const { return from + r * length; }
};

// The least of what the node sees, at an end or between.
AtFraction least_on_straight(const SlidingSetting& setting, const SlidingState& at, const PartOfNode& part) {
  constexpr int digits = 26;  // binary, of the place
  const double h = 1.0 / part.segment.elements;
  const double from = part.node == 0 ? 0.0 : (double(part.node) + 0.5) * h;
  const double to = part.node == part.nodes - 1 ? 1.0 : (double(part.node) + 1.5) * h;
  const HeldAxis held = held_axis(setting, at, part.segment);
  const AheadOfPoint ahead(setting, at, part);
  const auto pressure = [&](double r) { return straight_pressure(setting, held, ahead(r)); };
  const auto at_fraction = [&](double r) { return AtFraction{.r = r, .pressure = pressure(r)}; };
  const AtFraction first = at_fraction(from), middle = at_fraction(0.5 * (from + to)), last = at_fraction(to);
  const AtFraction least = first.pressure <= last.pressure ? first : last;
  const double bend = first.pressure - 2.0 * middle.pressure + last.pressure;
  if (!(2.0 * bend > std::abs(first.pressure - last.pressure))) return least;  // their parabola is least at an end
  const auto [r, value] = boost::math::tools::brent_find_minima(pressure, from, to, digits);
  return value < least.pressure ? AtFraction{.r = r, .pressure = value} : least;
}

// The place is at a fraction of the part, and moves along the body with its ends.
Row gradient_on_straight(const SlidingSetting& setting, const SlidingState& at, const PartOfNode& part) {
  const SlidingContactLayout::Segment& ends = part.segment;
  const double r = least_on_straight(setting, at, part).r, ahead = AheadOfPoint(setting, at, part)(r);
  const HeldAxis held = held_axis(setting, at, ends);
  const double slope = straight_pressure_slope(setting, held, ahead);
  Row row = straight_pressure_gradient(setting, at, held, ahead);
  if (ends.first_point >= 0) row.dx[at.index.coordinate(ends.first_point)] += (1.0 - r) * slope;
  if (ends.last_point >= 0) row.dx[at.index.coordinate(ends.last_point)] += r * slope;
  return row;
}

bool part_is_on_straight(const SlidingSetting& setting, const SlidingState& at, const PartOfNode& part) {
  if (!part.segment.has_point()) return true;
  const AheadOfPoint ahead(setting, at, part);
  const std::size_t point = part.segment.end_point();
  return obstacle_is_straight(setting, at, point, ahead(0.0)) && obstacle_is_straight(setting, at, point, ahead(1.0));
}

}  // namespace

bool lies_on_straight(const SlidingSetting& setting, const SlidingState& at, std::size_t node) {
  return part_is_on_straight(setting, at, PartOfNode(at.layout, node));
}

bool part_needs_no_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  if (!part.has_point() || !at.layout.hands_loads_on(segment)) return false;
  const std::size_t point = part.end_point();
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  const double place = at.s(static_cast<Index>(point));
  return lies_by_itself(setting, at, point) && obstacle_is_straight(setting, at, point, from - place) &&
         obstacle_is_straight(setting, at, point, to - place);
}

LeastPressure least_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t node) {
  const PartOfNode part(at.layout, node);
  const auto [from, length] = extent(setting, at, part);
  if (part_is_on_straight(setting, at, part)) {
    const AtFraction least = least_on_straight(setting, at, part);
    return {.value = least.pressure, .s = from + least.r * length};
  }
  const ByForces least = least_by_forces(setting, at, node, part);
  const double element = length / part.segment.elements;
  return {.value = least.sum / element,
          .s = at.mesh.coordinate(part.pressed.strand, part.pressed.position, at.now.s) + least.offset * element};
}

// The place of the least pressure moves, which at a least one, or at the end of its range, has no part in this.
Row least_pressure_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t node) {
  const PartOfNode part(at.layout, node);
  if (part_is_on_straight(setting, at, part)) return gradient_on_straight(setting, at, part);
  const ByForces least = least_by_forces(setting, at, node, part);
  const double length = extent(setting, at, part).length, per_force = part.segment.elements / length;
  const double p = least.sum;
  Row row = at.no_slope();
  row.dx.segment(least.first, part.nodes) = per_force * least.weights;
  const SlidingContactLayout::Segment& ends = part.segment;
  if (ends.last_point >= 0) row.dx[at.index.coordinate(ends.last_point)] = -per_force * p / length;
  if (ends.first_point >= 0) row.dx[at.index.coordinate(ends.first_point)] = per_force * p / length;
  add_forces_of_loads_gradient(setting, at, part.pressed.segment, -per_force * least.weights, row);
  return row;
}

}  // namespace arcwall::sliding
