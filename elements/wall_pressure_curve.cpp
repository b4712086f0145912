#include "elements/wall_pressure_curve.hpp"

#include "core/root_find.hpp"
#include "elements/chord_frame.hpp"
#include "elements/shape_functions.hpp"

namespace arcwall {

// Of a node's place by its unknowns from the third on, and second ones.
struct WallPressure::Curve::NodeRates {
  std::array<Vec2, 5> first{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  std::array<Vec2, 5> turn_other = first;
  Vec2 turn_turn = Vec2::Zero();

  NodeRates(const WallPressure& on, const double* u, std::size_t a) {
    const Node& node = on.nodes_[a];
    if (node.offset == 0.0) return;
    const EssenburgNode::Vectors v = vectors_of(on, u, a);
    const double o = node.offset, o2 = o * o;
    first[2] = o * v.d_phi + o2 * v.q_phi;
    turn_turn = o * v.d_phi_phi + o2 * v.q_phi_phi;
    if (on.stride_ < 5) return;
    first[3] = o * v.d_e;
    first[4] = o2 * v.q_xi;
    turn_other[3] = o * v.d_phi_e;
    turn_other[4] = o2 * v.q_phi_xi;
  }
};

EssenburgNode::Vectors WallPressure::Curve::vectors_of(const WallPressure& on, const double* u, std::size_t a) {
  const double* const at = u + static_cast<std::size_t>(on.stride_) * a;
  return on.nodes_[a].section.vectors(at[2], on.stride_ == 5 ? at[3] : 0.0, on.stride_ == 5 ? at[4] : 0.0);
}

WallPressure::Curve::Curve(const WallPressure& on, const double* u) : on_(on), u_(u) {
  for (std::size_t a = 0; a < on.nodes_.size(); ++a) places_[a] = place_of(a);
  if (is_cubic()) {
    const Vec2 chord = places_[1] - places_[0], across = perp(chord);
    const double beta = std::atan2(chord.y(), chord.x());
    const double first = within_half_a_turn(angle_of(0) - beta), second = within_half_a_turn(angle_of(1) - beta);
    coefficients_ = {places_[0], chord + first * across, -(2.0 * first + second) * across, (first + second) * across};
  } else if (on.nodes_.size() == 2) {
    coefficients_ = {places_[0], places_[1] - places_[0], Vec2::Zero(), Vec2::Zero()};
  } else {
    coefficients_ = {places_[0], -3.0 * places_[0] + 4.0 * places_[1] - places_[2],
                     2.0 * places_[0] - 4.0 * places_[1] + 2.0 * places_[2], Vec2::Zero()};
  }
}

Vec2 WallPressure::Curve::place_of(std::size_t a) const {
  const Node& node = on_.nodes_[a];
  const double* const at = u_ + static_cast<std::size_t>(on_.stride_) * a;
  const Vec2 axis = node.place + Vec2(at[0], at[1]);
  if (node.offset == 0.0) return axis;
  const EssenburgNode::Vectors v = vectors_of(on_, u_, a);
  return axis + node.offset * (node.section.D + v.d_change) + node.offset * node.offset * v.q;
}

double WallPressure::Curve::speed(double t) const {
  if (is_cubic()) return on_.nodes_.back().arc;
  const ShapeFunctions shape = shape_functions(order(), 2.0 * t - 1.0);
  double speed = 0.0;
  for (std::size_t a = 0; a < on_.nodes_.size(); ++a) speed += 2.0 * shape.dN[a] * on_.nodes_[a].arc;
  return speed;
}

WallPressure::Curve::Gap WallPressure::Curve::gap(double lambda, double t) const {
  const WallGap::Slope at = on_.wall_->slope(place(t), lambda);
  if (!std::isfinite(at.value)) return {.value = infinity, .rate = 0.0};
  return {.value = at.value - kept_off(t),
          .rate = at.slope.dot(velocity(t)) - (on_.nodes_.back().kept_off - on_.nodes_.front().kept_off)};
}

WallPressure::Curve::Gradient WallPressure::Curve::gradient(double t) const {
  if (is_cubic()) return axis().at(t).gradient;
  const ShapeFunctions shape = shape_functions(order(), 2.0 * t - 1.0);
  Gradient gradient = Gradient::Zero();
  for (std::size_t a = 0; a < on_.nodes_.size(); ++a)
    gradient.middleCols<2>(2 * static_cast<Index>(a)) = shape.N[a] * Eigen::Matrix2d::Identity();
  return gradient;
}

void WallPressure::Curve::add(const Controls& by_controls, double* to) const {
  for (std::size_t a = 0; a < on_.nodes_.size(); ++a) {
    const NodeRates rates(on_, u_, a);
    const Vec2 slope = by_controls.segment<2>(first_control(a));
    double* const of_node = to + static_cast<std::size_t>(on_.stride_) * a;
    of_node[0] += slope.x();
    of_node[1] += slope.y();
    for (std::size_t i = 2; i < static_cast<std::size_t>(on_.stride_); ++i) of_node[i] += slope.dot(rates.first[i]);
    if (is_cubic()) of_node[2] += by_controls[first_control(a) + 2];
  }
}

void WallPressure::Curve::add(const Controls& by_controls, const ControlsSquare& second, double* K) const {
  const auto n = static_cast<Index>(on_.unknown_count());
  Eigen::Matrix<double, most_controls, Eigen::Dynamic, Eigen::ColMajor, most_controls, max_unknowns> J =
      Eigen::Matrix<double, most_controls, Eigen::Dynamic>::Zero(most_controls, n);
  Eigen::Map<Eigen::MatrixXd> to(K, n, n);
  for (std::size_t a = 0; a < on_.nodes_.size(); ++a) {
    const NodeRates rates(on_, u_, a);
    const Index row = first_control(a), column = on_.stride_ * static_cast<Index>(a);
    J.block<2, 2>(row, column).setIdentity();
    for (Index i = 2; i < on_.stride_; ++i) J.block<2, 1>(row, column + i) = rates.first[static_cast<std::size_t>(i)];
    if (is_cubic()) J(row + 2, column + 2) = 1.0;
    const Vec2 slope = by_controls.segment<2>(row);
    to(column + 2, column + 2) += slope.dot(rates.turn_turn);
    for (Index i = 3; i < on_.stride_; ++i)
      to(column + i, column + 2) += slope.dot(rates.turn_other[static_cast<std::size_t>(i)]);
  }
  to += J.transpose() * second * J;
}

// --- the gap along it -----------------------------------------------------------------------------------------------

namespace {

constexpr double edge_width = 1e-15;  // of the brackets of zeros and turns, as a fraction of the element

// Whether the gap may come to a level and go back between two samples on one side of it: the cubic through them goes
// half of the way. Of a straight wall and a cubic line it is the gap itself.
template <class Sample>
bool may_reach(double level, const Sample& a, const Sample& b) {
  constexpr double part = 0.5;
  const double side = a.value > level ? 1.0 : -1.0, length = b.t - a.t;
  const double v0 = side * (a.value - level), v1 = side * (b.value - level);
  if (!std::isfinite(v0) || !std::isfinite(v1) || side * a.rate >= 0.0 || side * b.rate <= 0.0) return false;
  return least_cubic_value(v0, side * a.rate * length, v1, side * b.rate * length) <= part * std::min(v0, v1);
}

}  // namespace

WallPressure::Curve::GapAlong::Samples WallPressure::Curve::GapAlong::sampled() const {
  Samples seen;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const double t = double(k) / intervals;
    const Gap at = (*this)(t);
    seen[k] = {.t = t, .value = at.value, .rate = at.rate};
  }
  return seen;
}

std::optional<double> WallPressure::Curve::GapAlong::turn_between(const Sample& a, const Sample& b) const {
  const auto rate = [&](double t) { return std::optional((*this)(t).rate); };
  const auto root = bracketed_root(rate, a.t, a.rate, b.t, b.rate, edge_width);
  return root ? std::optional(root->at) : std::nullopt;
}

// Where the gap passes a level between two places on different sides of it. Where there is no surface on one side it is
// where the surface ends.
double WallPressure::Curve::GapAlong::crossing(double level, const Sample& a, const Sample& b) const {
  if (std::isfinite(a.value) && std::isfinite(b.value)) {
    const auto above = [&](double t) -> std::optional<double> {
      const double value = (*this)(t).value;
      return std::isfinite(value) ? std::optional(value - level) : std::nullopt;
    };
    if (const auto root = bracketed_root(above, a.t, a.value - level, b.t, b.value - level, edge_width))
      return root->at;
  }
  const bool first_above = a.value > level;
  double first = a.t, last = b.t;
  while (std::abs(last - first) > edge_width * (1.0 + first + last)) {
    const double middle = 0.5 * (first + last);
    if (middle == first || middle == last) break;
    (((*this)(middle).value > level) == first_above ? first : last) = middle;
  }
  return 0.5 * (first + last);
}

std::vector<double> WallPressure::Curve::GapAlong::crossings(double level, const Samples& seen) const {
  std::vector<double> found;
  const auto between = [&](const Sample& a, const Sample& b) {
    if ((a.value > level) != (b.value > level)) found.push_back(crossing(level, a, b));
  };
  for (std::size_t k = 0; k + 1 < seen.size(); ++k) {
    const Sample &a = seen[k], &b = seen[k + 1];
    const bool same_side = (a.value > level) == (b.value > level);
    const auto turn = same_side && may_reach(level, a, b) ? turn_between(a, b) : std::nullopt;
    if (!turn) {
      between(a, b);
      continue;
    }
    const Sample there{.t = *turn, .value = (*this)(*turn).value, .rate = 0.0};
    between(a, there);
    between(there, b);
  }
  return found;
}

std::vector<PressedPart> WallPressure::Curve::GapAlong::pressed_parts() const {
  const Samples seen = sampled();
  const std::vector<double> edges = crossings(0.0, seen);
  std::vector<PressedPart> parts;
  bool is_below = seen.front().value <= 0.0;
  double from = 0.0;
  for (std::size_t i = 0; i <= edges.size(); ++i) {
    const double to = i < edges.size() ? edges[i] : 1.0;
    if (is_below && to > from) parts.push_back({.from = from, .to = to});
    is_below = !is_below;
    from = to;
  }
  return parts;
}

}  // namespace arcwall
