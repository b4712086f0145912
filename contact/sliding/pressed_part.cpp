#include "contact/sliding/pressed_part.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <optional>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/curve_pressure.hpp"
#include "contact/sliding/pulling_jumps.hpp"

namespace arcwall::sliding {

namespace {

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

Extent extent(const SlidingSetting& setting, const SlidingState& at, const SlidingContactLayout::Segment& part) {
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  return {.from = from, .length = to - from};
}

// --- on a curved obstacle ------------------------------------------------------------------------------------------

// A place near a node, in elements from it, with the weights of the pressures before, at and behind the node there.
struct NearNode {
  double offset = 0.0;
  Eigen::Vector3d weights = Eigen::Vector3d::UnitY();
};

// The least value of the parabola through three pressures within half an element of the middle one.
NearNode least_of_parabola(const Eigen::Vector3d& pressure) {
  const double slope = 0.5 * (pressure[2] - pressure[0]), bend = pressure[2] - 2.0 * pressure[1] + pressure[0];
  const auto rise = [&](double t) { return t * (slope + 0.5 * t * bend); };
  double t = rise(-0.5) < rise(0.5) ? -0.5 : 0.5;
  if (bend > 0.0) t = std::clamp(-slope / bend, -0.5, 0.5);
  return {.offset = t, .weights = {0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0)}};
}

// What is left of the pressure beside a node where the rate of the wall's curvature jumps so that it pulls: all of the
// pull counts within half an element of the node, nothing from a whole one on.
struct LeftBeside {
  double value = infinity;
  double offset = 0.0;      // of the place from the node, in elements
  NodeFunction distance{};  // of the node beyond the place [length]
  double by_distance = 0.0, by_element = 0.0;
};

LeftBeside remaining_pressure_at_jump(const SlidingSetting& setting, const SlidingState& at, const PartOfNode& part,
                                      const CurvePressure& on) {
  const Touch touch = on.touch(part.node + 1);
  const Obstacle& wall = *setting.obstacles[touch.obstacle].surface;
  LeftBeside least;
  if (wall.curvature_rate_jumps().empty()) return least;
  const AxisPlace axis = touch.axis(at);
  const Vec2 place = face(touch.offset, axis), at_rest = wall.seen_at_rest(place, at.now.lambda);
  const double h = on.element(), way = travel(wall, place, axis.angle, at.now.lambda);
  const LengthToHold to_hold = length_to_hold(setting, at, part.pressed.segment);
  for (const CurvatureRateJump& jump : wall.curvature_rate_jumps()) {
    if ((jump.place - at_rest).norm() > 2.0 * h) continue;
    const NodeFunction far = beyond(wall, jump, touch, at);
    const double offset = -way * far.value / h;
    const MaterialPoint of_jump{.strand = touch.strand, .s = on.coordinate(double(part.node + 1) + offset)};
    const double pulled = pull(setting, of_jump, touch.obstacle, jump) / to_hold.value;
    if (pulled <= 0.0) continue;
    const double away = std::abs(offset), weight = std::min(2.0 - 2.0 * away, 1.0);
    if (weight <= 0.0) continue;
    const double there = double(part.node + 1) + offset, left = on.pressure_between(there) - weight * pulled;
    if (left >= least.value) continue;
    const double by_offset = on.slope_between(there) + (weight < 1.0 ? std::copysign(2.0 * pulled, offset) : 0.0);
    least = {.value = left,
             .offset = offset,
             .distance = far,
             .by_distance = -way * by_offset / h,
             .by_element = -by_offset * offset / h + weight * pulled * to_hold.by_element / to_hold.value};
  }
  return least;
}

// The least pressure that a node sees: of the parabola through it and its neighbours, of the end of the part beside it,
// or what is left of it where the wall pulls.
struct LeastOnCurve {
  double value = 0.0, offset = 0.0;  // of the place from the node, in elements
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  std::optional<LeftBeside> left{};
};

LeastOnCurve least_on_curve(const SlidingSetting& setting, const SlidingState& at, const PartOfNode& part,
                            const CurvePressure& on) {
  const Eigen::Vector3d three(on.pressure(part.node), on.pressure(part.node + 1), on.pressure(part.node + 2));
  const NearNode inside = least_of_parabola(three);
  LeastOnCurve least{.value = inside.weights.dot(three), .offset = inside.offset, .weights = inside.weights};
  for (const Index end : {0, 2}) {
    if (part.node != (end == 0 ? 0 : part.nodes - 1) || three[end] >= least.value) continue;
    least = {.value = three[end], .offset = double(end - 1), .weights = Eigen::Vector3d::Unit(end)};
  }
  if (const LeftBeside left = remaining_pressure_at_jump(setting, at, part, on); left.value < least.value)
    least = {.value = left.value, .offset = left.offset, .left = left};
  return least;
}

Row gradient_on_curve(const SlidingSetting& setting, const SlidingState& at, const PartOfNode& part) {
  const CurvePressure on(setting, at, part.pressed.segment);
  const LeastOnCurve least = least_on_curve(setting, at, part, on);
  Row row = at.no_slope();
  for (Index j = 0; j < 3; ++j)
    if (least.weights[j] != 0.0) on.add_gradient(part.node + j, least.weights[j], row);
  if (!least.left) return row;
  on.add_gradient_between(double(part.node + 1) + least.offset, 1.0, row);
  const Touch touch = on.touch(part.node + 1);
  add_at_node(at.mesh.node_unknowns(touch.strand, touch.position),
              least.left->by_distance * least.left->distance.gradient, row.dx);
  row.dlambda += least.left->by_distance * least.left->distance.rate;
  on.add_element_gradient(least.left->by_element, row);
  return row;
}

// --- on a straight obstacle: the axis is straight, so that its pressure is known -------------------------------------

// A place of a part by its fraction r, and the pressure there.
struct AtFraction {
  double r, pressure;
};

// How far a fraction of a part lies ahead of the tracked point at its end, or of the end itself.
struct AheadOfPoint {
  double from, length;

  AheadOfPoint(const SlidingSetting& setting, const SlidingState& at, const SlidingContactLayout::Segment& part) {
    const Extent whole = extent(setting, at, part);
    from = part.has_point() ? whole.from - at.s(static_cast<Index>(part.end_point())) : 0.0;
    length = whole.length;
  }
  double operator()(double r) const { return from + r * length; }
};

// The least of what the node sees, at an end or between. At an end of the strand where the pressure is zero for all λ
// it is no bound: what the pressure beside it is says whether the part lies on.
AtFraction least_on_straight(const SlidingSetting& setting, const SlidingState& at, const PartOfNode& part) {
  constexpr int digits = 26;  // binary, of the place
  const double h = 1.0 / part.segment.elements;
  double from = part.node == 0 ? 0.0 : (double(part.node) + 0.5) * h;
  double to = part.node == part.nodes - 1 ? 1.0 : (double(part.node) + 1.5) * h;
  const HeldAxis held = held_axis(setting, at, part.segment);
  const AheadOfPoint ahead(setting, at, part.segment);
  const auto is_no_bound = [&](double r) { return pressure_vanishes_for_all_lambda(setting, held, ahead(r)); };
  if (from == 0.0 && part.segment.first_point < 0 && is_no_bound(0.0)) from = 0.5 * h;
  if (to == 1.0 && part.segment.last_point < 0 && is_no_bound(1.0)) to = 1.0 - 0.5 * h;
  const auto pressure = [&](double r) { return required_pressure_on_straight_wall(setting, held, ahead(r)); };
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
  const double r = least_on_straight(setting, at, part).r, ahead = AheadOfPoint(setting, at, part.segment)(r);
  const HeldAxis held = held_axis(setting, at, ends);
  const double slope = required_pressure_slope_on_straight_wall(setting, held, ahead);
  Row row = straight_pressure_gradient(setting, at, held, ahead);
  if (ends.first_point >= 0) row.dx[at.index.coordinate(ends.first_point)] += (1.0 - r) * slope;
  if (ends.last_point >= 0) row.dx[at.index.coordinate(ends.last_point)] += r * slope;
  return row;
}

bool part_is_on_straight(const SlidingSetting& setting, const SlidingState& at,
                         const SlidingContactLayout::Segment& part) {
  if (!part.has_point()) return true;
  const AheadOfPoint ahead(setting, at, part);
  const std::size_t point = part.end_point();
  return obstacle_is_straight(setting, at, point, ahead(0.0)) && obstacle_is_straight(setting, at, point, ahead(1.0));
}

}  // namespace

bool lies_on_straight(const SlidingSetting& setting, const SlidingState& at, std::size_t node) {
  return part_is_on_straight(setting, at, PartOfNode(at.layout, node).segment);
}

bool part_needs_no_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t segment) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  const bool at_plane = (part.first_point < 0 && setting.body.is_on_plane(part.strand, false)) ||
                        (part.last_point < 0 && setting.body.is_on_plane(part.strand, true));
  if (!part.has_point() || !(at_plane || at.layout.hands_loads_on(segment))) return false;
  const std::size_t point = part.end_point();
  const auto [from, to] = at.layout.ends(setting.body, part, at.now.s);
  const double place = at.s(static_cast<Index>(point));
  return lies_by_itself(setting, at, point) && obstacle_is_straight(setting, at, point, from - place) &&
         obstacle_is_straight(setting, at, point, to - place);
}

LeastPressure least_pressure(const SlidingSetting& setting, const SlidingState& at, std::size_t node) {
  const PartOfNode part(at.layout, node);
  if (part_is_on_straight(setting, at, part.segment)) {
    const auto [from, length] = extent(setting, at, part.segment);
    const AtFraction least = least_on_straight(setting, at, part);
    return {.value = least.pressure, .s = from + least.r * length};
  }
  const CurvePressure on(setting, at, part.pressed.segment);
  const LeastOnCurve least = least_on_curve(setting, at, part, on);
  return {.value = least.value, .s = on.coordinate(double(part.node + 1) + least.offset)};
}

// The place of the least pressure moves, which at a least one, or at the end of its range, has no part in this.
Row least_pressure_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t node) {
  const PartOfNode part(at.layout, node);
  return part_is_on_straight(setting, at, part.segment) ? gradient_on_straight(setting, at, part)
                                                        : gradient_on_curve(setting, at, part);
}

double least_pressure_rate(const SlidingSetting& setting, const SlidingMotion& motion, std::size_t node) {
  const PartOfNode part(motion.at.layout, node);
  if (!part_is_on_straight(setting, motion.at, part.segment)) {
    const CurvePressure on(setting, motion.at, part.pressed.segment);
    const LeastOnCurve least = least_on_curve(setting, motion.at, part, on);
    double rate = 0.0;
    for (Index j = 0; j < 3; ++j)
      if (least.weights[j] != 0.0) rate += least.weights[j] * on.rate(part.node + j, motion);
    if (!least.left) return rate;
  }
  return apply(least_pressure_gradient(setting, motion.at, node), motion.direction);
}

// The angles φ at the nodes of a part of n elements under a linear pressure, zero at its ends, are those of
//
//     EI/h (2 φᵢ₋₁ + 8 φᵢ + 2 φᵢ₊₁) = −h² Δ/15,     φ₁ = −c h³ Δ/(15 EI),     12 c = 1 − (z + zⁿ⁻¹)/(1 + zⁿ)
//
// with z = √3 − 2 and the change Δ of the pressure over an element. They add 6 EI φ₁/h² to the force of the element at
// the end and 2 EI φ₁/h to its moment there, which would be h (7 p₀ + 3 p₁)/20 and h² (3 p₀ + 2 p₁)/60 between clamped
// nodes.
PressureOfEndElement pressure_of_end_element(int elements) {
  const double z = std::sqrt(3.0) - 2.0, n = double(elements);
  const double c = (1.0 - (z + std::pow(z, n - 1.0)) / (1.0 + std::pow(z, n))) / 12.0;
  return {.force_by_change = 0.15 - 0.4 * c, .moment_by_change = 0.4 - 1.6 * c};
}

PressureAtEnd pressure_at_end(const SlidingSetting& setting, const SlidingState& at, std::size_t segment, bool last) {
  const SlidingContactLayout::Segment& part = at.layout.segments()[segment];
  const double h = extent(setting, at, part).length / part.elements;
  const Index end = last ? part.elements : 0, next = last ? part.elements - 1 : 1;
  double at_end = 0.0, at_next = 0.0;
  if (part_is_on_straight(setting, at, part)) {
    const HeldAxis held = held_axis(setting, at, part);
    const AheadOfPoint ahead(setting, at, part);
    at_end = required_pressure_on_straight_wall(setting, held, ahead(double(end) / part.elements));
    at_next = required_pressure_on_straight_wall(setting, held, ahead(double(next) / part.elements));
  } else {
    const CurvePressure on(setting, at, segment);
    at_end = on.pressure(end);
    at_next = on.pressure(next);
  }
  const double by_change = pressure_of_end_element(part.elements).force_by_change;
  return {.force = h * (0.5 * at_end + by_change * (at_next - at_end)), .length = 0.5 * h};
}

}  // namespace arcwall::sliding
