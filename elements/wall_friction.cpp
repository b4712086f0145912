#include <algorithm>
#include <cmath>

#include "elements/wall_pressure_curve.hpp"

namespace arcwall {

PressedPart WallPressure::nearest_to(std::size_t point) {
  const double t = rubbing_point(point), half = 0.5 * rubbing_point(1);
  return {.from = std::max(t - half, 0.0), .to = std::min(t + half, 1.0)};
}

// Edges of contact lie where they do: the force on a part changes smoothly as one passes through it.
std::array<WallPressure::Rubbed, WallPressure::rubbing_points> WallPressure::rubbed(const double* u,
                                                                                    double lambda) const {
  std::array<Rubbed, rubbing_points> out;
  const Curve touching(*this, u), rubbing(rubbing_ ? *rubbing_ : *this, u);
  for (std::size_t i = 0; i < rubbing_points; ++i) {
    const double t = rubbing_point(i);
    const PressedPart whole = nearest_to(i);
    out[i].length = touching.speed(t) * (whole.to - whole.from);
    const Vec2 at = rubbing.place(t);
    if (!std::isfinite(wall_->slope(at, lambda).value)) continue;
    const WallGap::Response place = wall_->along(at, lambda);
    out[i].faces_wall = true;
    out[i].place = place.value;
    out[i].place_rate = place.rate;
    rubbing.add(Curve::Controls(rubbing.gradient(t).transpose() * place.slope), out[i].place_by.data());
  }
  for (const PressedPart& part : touching.gaps(lambda).pressed_parts())
    for (std::size_t i = 0; i < rubbing_points; ++i) {
      const PressedPart whole = nearest_to(i);
      const PressedPart here{.from = std::max(part.from, whole.from), .to = std::min(part.to, whole.to)};
      if (!(here.to > here.from)) continue;
      Curve::Controls slope = Curve::Controls::Zero();
      for_each_gauss_point(touching, lambda, here, [&](const GaussPoint& at) {
        const double stiffness = at.length * at.stiffness;
        out[i].force += at.length * at.pressure;
        out[i].force_rate -= stiffness * at.gap.rate;
        slope -= stiffness * touching.gradient(at.t).transpose() * at.gap.slope;
      });
      touching.add(slope, out[i].force_by.data());
    }
  return out;
}

void WallPressure::add_second_of_place(const double* u, double lambda, std::size_t point, double factor, double* K,
                                       double* f_lambda) const {
  const Curve rubbing(rubbing_ ? *rubbing_ : *this, u);
  const double t = rubbing_point(point);
  const WallGap::Response place = wall_->along(rubbing.place(t), lambda);
  const Curve::Gradient gradient = rubbing.gradient(t);
  Curve::ControlsSquare second = factor * gradient.transpose() * place.second * gradient;
  rubbing.add_second(t, factor * place.slope, second);
  rubbing.add(Curve::Controls(factor * gradient.transpose() * place.slope), second, K);
  rubbing.add(Curve::Controls(factor * gradient.transpose() * place.slope_rate), f_lambda);
}

WallPressure::Resultant WallPressure::friction_resultant(const double* u, double lambda, std::size_t point,
                                                         const ForceAlong& T, const Vec2& about) const {
  Resultant out;
  const Curve rubbing(rubbing_ ? *rubbing_ : *this, u);
  const double t = rubbing_point(point);
  const WallGap::Response place = wall_->along(rubbing.place(t), lambda);
  const Vec2 force = T.value * place.slope, arm = rubbing.place(t) - about;
  const Vec2 force_rate = T.rate * place.slope + T.value * place.slope_rate;
  const Curve::Gradient gradient = rubbing.gradient(t), of_slope = T.value * place.second * gradient;
  out.value = {force.x(), force.y(), cross(arm, force)};
  out.rate = {force_rate.x(), force_rate.y(), cross(arm, force_rate)};
  const double lever = cross(arm, place.slope);
  const std::array<double, 3> by_T{place.slope.x(), place.slope.y(), lever};
  const std::array<Curve::Controls, 3> by_controls{
      of_slope.row(0).transpose(), of_slope.row(1).transpose(),
      arm.x() * of_slope.row(1).transpose() - arm.y() * of_slope.row(0).transpose() +
          force.y() * gradient.row(0).transpose() - force.x() * gradient.row(1).transpose()};
  for (std::size_t i = 0; i < 3; ++i) {
    rubbing.add(by_controls[i], out.by_unknowns[i].data());
    for (std::size_t k = 0; k < static_cast<std::size_t>(unknown_count()); ++k)
      out.by_unknowns[i][k] += by_T[i] * T.by_unknowns[k];
  }
  return out;
}

Vec2 WallPressure::tangent(const double* u, double lambda, std::size_t point) const {
  const Curve rubbing(rubbing_ ? *rubbing_ : *this, u);
  const Vec2 at = rubbing.place(rubbing_point(point));
  return std::isfinite(wall_->slope(at, lambda).value) ? Vec2(wall_->along(at, lambda).slope.normalized())
                                                       : Vec2(Vec2::UnitX());
}

}  // namespace arcwall
