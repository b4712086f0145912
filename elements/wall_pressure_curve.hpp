#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/gauss_points.hpp"
#include "elements/cubic_axis.hpp"
#include "elements/wall_pressure.hpp"

/// What WallPressure integrates along.
namespace arcwall {

// The line that touches, r(ξ) = Σ a_k ξ^k, as a function of its controls: places at the nodes, and for a cubic angles
// at its ends.
class WallPressure::Curve {
 public:
  static constexpr int most_controls = 6;

  Curve(const WallPressure& on, const double* u);

  Vec2 place(double t) const {
    const auto& a = coefficients_;
    return a[0] + t * (a[1] + t * (a[2] + t * a[3]));
  }
  Vec2 velocity(double t) const {
    const auto& a = coefficients_;
    return a[1] + t * (2.0 * a[2] + 3.0 * t * a[3]);
  }

  // ds/dξ of the stress-free axis.
  double speed(double t) const;

  double kept_off(double t) const { return std::lerp(on_.nodes_.front().kept_off, on_.nodes_.back().kept_off, t); }

  struct Gap {
    double value, rate;  // and its derivative by ξ; infinite and 0 without a surface
  };
  Gap gap(double lambda, double t) const;

  // As a function of ξ.
  class GapAlong;
  GapAlong gaps(double lambda) const;

  // --- derivatives by the controls, and from these to the unknowns ---------------------------------------------------

  using Gradient = Eigen::Matrix<double, 2, most_controls>;
  using Controls = Eigen::Matrix<double, most_controls, 1>;
  using ControlsSquare = Eigen::Matrix<double, most_controls, most_controls>;

  // ∂r/∂controls at a fraction.
  Gradient gradient(double t) const;

  void add_second(double t, const Vec2& q, ControlsSquare& to) const {
    if (is_cubic()) axis().add_second(t, q, to);
  }

  // Adds ∂/∂u of a function with the slope `by_controls`.
  void add(const Controls& by_controls, double* to) const;

  // Adds the second derivatives: Jᵀ H J + Σ slope · ∂²controls, in the lower triangle.
  void add(const Controls& by_controls, const ControlsSquare& second, double* K) const;

 private:
  struct NodeRates;
  static EssenburgNode::Vectors vectors_of(const WallPressure& on, const double* u, std::size_t a);

  bool is_cubic() const { return on_.shape_ == Shape::cubic; }
  int order() const { return static_cast<int>(on_.nodes_.size()) - 1; }
  Index first_control(std::size_t a) const { return (is_cubic() ? 3 : 2) * static_cast<Index>(a); }
  double angle_of(std::size_t a) const {
    return on_.nodes_[a].angle + u_[static_cast<std::size_t>(on_.stride_) * a + 2];
  }
  Vec2 place_of(std::size_t a) const;
  CubicAxis axis() const { return {places_[0], angle_of(0), places_[1], angle_of(1)}; }

  const WallPressure& on_;
  const double* u_;
  std::array<Vec2, 3> places_{};
  std::array<Vec2, 4> coefficients_{};
};

// The gap along a curve at a value of λ: its zeros and turns, looked for between a few samples.
class WallPressure::Curve::GapAlong {
 public:
  GapAlong(const Curve& curve, double lambda) : curve_(curve), lambda_(lambda) {}

  Gap operator()(double t) const { return curve_.gap(lambda_, t); }

  struct Sample {
    double t, value, rate;
  };
  static constexpr int intervals = 4;  // of an element
  using Samples = std::array<Sample, intervals + 1>;

  Samples sampled() const;

  // Where the gap turns between two samples whose rates differ in sign.
  std::optional<double> turn_between(const Sample& a, const Sample& b) const;

  // The fractions at which the gap passes a level, ascending.
  std::vector<double> crossings(double level, const Samples& seen) const;

  // The parts where the gap is none or negative.
  std::vector<PressedPart> pressed_parts() const;

 private:
  double crossing(double level, const Sample& a, const Sample& b) const;

  const Curve& curve_;
  double lambda_;
};

inline WallPressure::Curve::GapAlong WallPressure::Curve::gaps(double lambda) const { return {*this, lambda}; }

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
  std::vector<double> breaks{part.from, part.to};
  if (!law_->kinks().empty()) {
    const Curve::GapAlong gap = curve.gaps(lambda);
    const Curve::GapAlong::Samples seen = gap.sampled();
    for (const double kink : law_->kinks())
      for (const double t : gap.crossings(-kink, seen))
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
