#include "contact/wall_kink.hpp"

#include <cmath>

#include "core/unit_tangent.hpp"

namespace arcwall {

std::optional<WallKink> first_kink(const Obstacle& wall, const PlaceInStep& point, double from_lambda,
                                   double to_lambda) {
  constexpr int digits = 45;       // binary, of the part
  constexpr double turned = 1e-9;  // of a straight piece against another one [rad]
  if (!may_have_kinks(wall)) return std::nullopt;
  const auto place = [&](double part) -> Vec2 { return point.from + part * (point.to - point.from); };
  const auto lambda = [&](double part) { return from_lambda + part * (to_lambda - from_lambda); };
  const auto faces = [&](double part) { return wall.faces(place(part), lambda(part)); };
  const auto curvature = [&](double part) { return wall.curvature(place(part), lambda(part)).value; };
  if (!faces(0.0) || !faces(1.0)) return std::nullopt;
  const auto direction = [&](double part) { return wall.direction(place(part), lambda(part)).value; };
  const double here = curvature(0.0), heads = direction(0.0);
  // An arc between two straight pieces may be passed as a whole.
  const auto is_beyond = [&](double part) {
    return curvature_jumps(here, curvature(part)) || (here == 0.0 && std::abs(direction(part) - heads) > turned);
  };
  if (!is_beyond(1.0)) return std::nullopt;
  double before = 0.0, beyond = 1.0;
  for (int i = 0; i < digits; ++i) {
    const double middle = 0.5 * (before + beyond);
    if (!faces(middle)) return std::nullopt;
    (is_beyond(middle) ? beyond : before) = middle;
  }
  if (!curvature_jumps(curvature(before), curvature(beyond))) return std::nullopt;  // it changes fast, but smoothly
  const auto at_rest = [&](const Vec2& position) { return wall.seen_at_rest(position, lambda(beyond)); };
  const Vec2 there = place(beyond), along = unit_tangent(wall.direction(there, lambda(beyond)).value);
  WallKink kink{.part = beyond};
  kink.at.place = at_rest(there);
  kink.at.tangent = (at_rest(there + along) - kink.at.place).normalized();
  kink.sense = wall.beyond(kink.at, point.to, to_lambda).value >= wall.beyond(kink.at, point.from, from_lambda).value
                   ? 1.0
                   : -1.0;
  return kink;
}

LinearField past_kink(const Obstacle& wall, const WallKink& kink, const Vec2& place, double lambda) {
  LinearField far = wall.beyond(kink.at, place, lambda);
  for (double* const value : {&far.value, &far.x, &far.z, &far.rate}) *value *= kink.sense;
  return far;
}

}  // namespace arcwall
