#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/gauss_points.hpp"
#include "core/root_find.hpp"
#include "elements/chord_frame.hpp"
#include "elements/cubic_axis.hpp"
#include "elements/shape_functions.hpp"
#include "elements/wall_pressure.hpp"

/// What WallPressure integrates along.
namespace arcwall {

// The line that touches, r(ξ) = Σ a_k ξ^k, as a function of its controls: places at the nodes, and for a cubic angles
// at its ends.
class WallPressure::Curve {
 public:
  static constexpr int most_controls = 6;

  Curve(const WallPressure& on, const double* u) : on_(on), u_(u) {
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

  Vec2 place(double t) const {
    const auto& a = coefficients_;
    return a[0] + t * (a[1] + t * (a[2] + t * a[3]));
  }
  Vec2 velocity(double t) const {
    const auto& a = coefficients_;
    return a[1] + t * (2.0 * a[2] + 3.0 * t * a[3]);
  }

  // ds/dξ of the stress-free axis.
  double speed(double t) const {
    if (is_cubic()) return on_.nodes_.back().arc;
    const ShapeFunctions shape = shape_functions(order(), 2.0 * t - 1.0);
    double speed = 0.0;
    for (std::size_t a = 0; a < on_.nodes_.size(); ++a) speed += 2.0 * shape.dN[a] * on_.nodes_[a].arc;
    return speed;
  }

  double kept_off(double t) const { return std::lerp(on_.nodes_.front().kept_off, on_.nodes_.back().kept_off, t); }

  struct Gap {
    double value, rate;  // and its derivative by ξ; infinite and 0 without a surface
  };
  Gap gap(double lambda, double t) const {
    const WallGap::Slope at = on_.wall_->slope(place(t), lambda);
    if (!std::isfinite(at.value)) return {.value = infinity, .rate = 0.0};
    return {.value = at.value - kept_off(t),
            .rate = at.slope.dot(velocity(t)) - (on_.nodes_.back().kept_off - on_.nodes_.front().kept_off)};
  }
  // As a function of ξ.
  auto gaps(double lambda) const {
    return [this, lambda](double t) { return gap(lambda, t); };
  }

  // --- derivatives by the controls, and from these to the unknowns ---------------------------------------------------

  using Gradient = Eigen::Matrix<double, 2, most_controls>;
  using Controls = Eigen::Matrix<double, most_controls, 1>;
  using ControlsSquare = Eigen::Matrix<double, most_controls, most_controls>;

  // ∂r/∂controls at a fraction.
  Gradient gradient(double t) const {
    if (is_cubic()) return axis().at(t).gradient;
    const ShapeFunctions shape = shape_functions(order(), 2.0 * t - 1.0);
    Gradient gradient = Gradient::Zero();
    for (std::size_t a = 0; a < on_.nodes_.size(); ++a)
      gradient.middleCols<2>(2 * static_cast<Index>(a)) = shape.N[a] * Eigen::Matrix2d::Identity();
    return gradient;
  }

  void add_second(double t, const Vec2& q, ControlsSquare& to) const {
    if (is_cubic()) axis().add_second(t, q, to);
  }

  // Adds ∂/∂u of a function with the slope `by_controls`.
  void add(const Controls& by_controls, double* to) const {
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

  // Adds the second derivatives: Jᵀ H J + Σ slope · ∂²controls, in the lower triangle.
  void add(const Controls& by_controls, const ControlsSquare& second, double* K) const {
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

 private:
  // Of a node's place by its unknowns from the third on, and second ones.
  struct NodeRates {
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

  static EssenburgNode::Vectors vectors_of(const WallPressure& on, const double* u, std::size_t a) {
    const double* const at = u + static_cast<std::size_t>(on.stride_) * a;
    return on.nodes_[a].section.vectors(at[2], on.stride_ == 5 ? at[3] : 0.0, on.stride_ == 5 ? at[4] : 0.0);
  }

  bool is_cubic() const { return on_.shape_ == Shape::cubic; }
  int order() const { return static_cast<int>(on_.nodes_.size()) - 1; }
  Index first_control(std::size_t a) const { return (is_cubic() ? 3 : 2) * static_cast<Index>(a); }
  double angle_of(std::size_t a) const {
    return on_.nodes_[a].angle + u_[static_cast<std::size_t>(on_.stride_) * a + 2];
  }
  Vec2 place_of(std::size_t a) const {
    const Node& node = on_.nodes_[a];
    const double* const at = u_ + static_cast<std::size_t>(on_.stride_) * a;
    const Vec2 axis = node.place + Vec2(at[0], at[1]);
    if (node.offset == 0.0) return axis;
    const EssenburgNode::Vectors v = vectors_of(on_, u_, a);
    return axis + node.offset * (node.section.D + v.d_change) + node.offset * node.offset * v.q;
  }
  CubicAxis axis() const { return {places_[0], angle_of(0), places_[1], angle_of(1)}; }

  const WallPressure& on_;
  const double* u_;
  std::array<Vec2, 3> places_{};
  std::array<Vec2, 4> coefficients_{};
};

namespace wall_pressure {

constexpr int samples = 4;            // intervals of an element in which the gap is looked at for its zeros and turns
constexpr double edge_width = 1e-15;  // of the brackets of these, as a fraction of the element

// Where the gap has been looked at.
struct Sample {
  double t, value, rate;
};

using Samples = std::array<Sample, samples + 1>;

template <class GapAt>
Samples sampled(const GapAt& gap) {
  Samples seen;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const double t = double(k) / samples;
    const auto at = gap(t);
    seen[k] = {.t = t, .value = at.value, .rate = at.rate};
  }
  return seen;
}

// Where the gap turns between two samples whose rates differ in sign.
template <class GapAt>
std::optional<double> turn_between(const GapAt& gap, const Sample& a, const Sample& b) {
  const auto rate = [&](double t) { return std::optional(gap(t).rate); };
  const auto root = bracketed_root(rate, a.t, a.rate, b.t, b.rate, edge_width);
  return root ? std::optional(root->at) : std::nullopt;
}

// Where the gap passes a level between two places on different sides of it. Where there is no surface on one side it is
// where the surface ends.
template <class GapAt>
double crossing(const GapAt& gap, double level, double a, double of_a, double b, double of_b) {
  if (std::isfinite(of_a) && std::isfinite(of_b)) {
    const auto above = [&](double t) -> std::optional<double> {
      const double value = gap(t).value;
      return std::isfinite(value) ? std::optional(value - level) : std::nullopt;
    };
    if (const auto root = bracketed_root(above, a, of_a - level, b, of_b - level, edge_width)) return root->at;
  }
  const bool first_above = of_a > level;
  while (std::abs(b - a) > edge_width * (1.0 + a + b)) {
    const double middle = 0.5 * (a + b);
    if (middle == a || middle == b) break;
    ((gap(middle).value > level) == first_above ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

// Whether the gap may come to a level and go back between two samples on one side of it: the cubic through them goes
// half of the way. Of a straight wall and a cubic line it is the gap itself.
inline bool may_reach(double level, const Sample& a, const Sample& b) {
  constexpr double part = 0.5;
  const double side = a.value > level ? 1.0 : -1.0, length = b.t - a.t;
  const double v0 = side * (a.value - level), v1 = side * (b.value - level);
  if (!std::isfinite(v0) || !std::isfinite(v1) || side * a.rate >= 0.0 || side * b.rate <= 0.0) return false;
  return least_cubic_value(v0, side * a.rate * length, v1, side * b.rate * length) <= part * std::min(v0, v1);
}

// The fractions at which the gap passes a level, ascending.
template <class GapAt>
std::vector<double> crossings(const GapAt& gap, double level, const Samples& seen) {
  std::vector<double> found;
  const auto between = [&](double a, double of_a, double b, double of_b) {
    if ((of_a > level) != (of_b > level)) found.push_back(crossing(gap, level, a, of_a, b, of_b));
  };
  for (std::size_t k = 0; k + 1 < seen.size(); ++k) {
    const Sample &a = seen[k], &b = seen[k + 1];
    const bool same_side = (a.value > level) == (b.value > level);
    const auto turn = same_side && may_reach(level, a, b) ? turn_between(gap, a, b) : std::nullopt;
    if (!turn) {
      between(a.t, a.value, b.t, b.value);
      continue;
    }
    const double there = gap(*turn).value;
    between(a.t, a.value, *turn, there);
    between(*turn, there, b.t, b.value);
  }
  return found;
}

// The parts where the gap is none or negative.
template <class GapAt>
std::vector<PressedPart> pressed_parts(const GapAt& gap) {
  const Samples seen = sampled(gap);
  const std::vector<double> edges = crossings(gap, 0.0, seen);
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

}  // namespace wall_pressure

// What acts at a point of Gauss's rule: W and its derivatives by the place, times the length that it stands for.
struct WallPressure::GaussPoint {
  double t, length, energy, pressure, stiffness;
  const WallGap::Response& gap;
  Vec2 slope, slope_rate;  // of W by the place, and its rate by λ
  Eigen::Matrix2d second;
};

// Between the edges and the kinks of the law.
template <class Visit>
void WallPressure::for_each_gauss_point(const Curve& curve, double lambda, const PressedPart& part,
                                        const Visit& visit) const {
  using namespace wall_pressure;
  std::vector<double> breaks{part.from, part.to};
  if (!law_->kinks().empty()) {
    const auto gap = curve.gaps(lambda);
    const Samples seen = sampled(gap);
    for (const double kink : law_->kinks())
      for (const double t : crossings(gap, -kink, seen))
        if (t > part.from && t < part.to) breaks.push_back(t);
    std::sort(breaks.begin(), breaks.end());
  }
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double middle = 0.5 * (breaks[i] + breaks[i + 1]), half = 0.5 * (breaks[i + 1] - breaks[i]);
    for (const auto& [place, weight] : gauss_points)
      for (const double side : {-1.0, 1.0}) {
        const double t = middle + side * half * place;
        const Vec2 at = curve.place(t);
        if (!std::isfinite(wall_->slope(at, lambda).value)) continue;
        const WallGap::Response gap = wall_->at(at, lambda);
        const PressureLaw::Response law = law_->at(std::max(0.0, curve.kept_off(t) - gap.value));
        const double length = weight * half * curve.speed(t);
        visit(GaussPoint{
            .t = t,
            .length = length,
            .energy = length * law.energy,
            .pressure = law.pressure,
            .stiffness = law.stiffness,
            .gap = gap,
            .slope = -length * law.pressure * gap.slope,
            .slope_rate = length * (law.stiffness * gap.rate * gap.slope - law.pressure * gap.slope_rate),
            .second = length * (law.stiffness * gap.slope * gap.slope.transpose() - law.pressure * gap.second)});
      }
  }
}

}  // namespace arcwall
