#include "tests/properties/retold.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace arcwall::test {

namespace {

using deck::Deck;

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // clang 14 does not deduce aggregates

void for_points(deck::Curve& curve, const auto& change) {
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const deck::Vector at = change(deck::Vector{.x = curve.x[i], .z = curve.z[i]});
    curve.x[i] = at.x;
    curve.z[i] = at.z;
  }
}

// Deviations count from the left of the direction of travel, which a mirror image has on the right.
void move(deck::Member& member, const Isometry& isometry) {
  const double handed = isometry.mirrored ? -1.0 : 1.0;
  const auto point = [&](const deck::Vector& p) { return isometry.moved(p); };
  for (deck::Imperfection& wave : member.imperfections) wave.amplitude *= handed;
  std::visit(Overloaded{[](deck::Straight&) {}, [&](deck::Arc& arc) { arc.via = point(arc.via); },
                        [&](deck::SineAxis& sine) { sine.rise *= handed; },
                        [&](deck::Curve& curve) { for_points(curve, point); }},
             member.axis);
}

void move(deck::Load& load, const Isometry& isometry) {
  std::visit(Overloaded{[&](deck::PointLoad& at) {
                          at.force = isometry.turned(at.force);
                          at.moment *= isometry.mirrored ? -1.0 : 1.0;
                        },
                        [&](deck::MemberLoad& on) {
                          if (on.frame == LoadFrame::global) on.distributed = isometry.turned(on.distributed);
                          if (on.frame == LoadFrame::member && isometry.mirrored) on.distributed.z = -on.distributed.z;
                        },
                        [&](deck::Heat& heat) { heat.gradient *= isometry.mirrored ? -1.0 : 1.0; },
                        [&](deck::Pressure& on) { on.pressure *= isometry.mirrored ? -1.0 : 1.0; }},
             load.action);
}

deck::LineProfile moved(const deck::LineProfile& line, const Isometry& isometry) {
  const deck::Vector through = isometry.moved({.x = 0.0, .z = line.z});
  const deck::Vector along = isometry.turned({.x = 1.0, .z = line.slope});
  const double slope = along.z / along.x;
  return {.z = through.z - slope * through.x, .slope = slope};
}

void move(deck::Wall& wall, const Isometry& isometry) {
  if (isometry.mirrored) wall.side = wall.side == Side::above ? Side::below : Side::above;
  if (auto* line = std::get_if<deck::LineProfile>(&wall.profile)) *line = moved(*line, isometry);
  if (auto* circle = std::get_if<deck::CircleProfile>(&wall.profile)) circle->centre = isometry.moved(circle->centre);
}

void scale(deck::Section& section, double length) {
  auto& shape = std::get<deck::Rectangle>(section.shape);
  shape.width *= length;
  shape.height *= length;
}

void scale(deck::Wall& wall, double length) {
  if (auto* line = std::get_if<deck::LineProfile>(&wall.profile)) line->z *= length;
  if (auto* circle = std::get_if<deck::CircleProfile>(&wall.profile))
    *circle = {.centre = {.x = length * circle->centre.x, .z = length * circle->centre.z},
               .radius = length * circle->radius};
}

void scale(deck::Member& member, double length) {
  const auto point = [&](const deck::Vector& p) { return deck::Vector{.x = length * p.x, .z = length * p.z}; };
  for (deck::Imperfection& wave : member.imperfections) wave.amplitude *= length;
  std::visit(Overloaded{[](deck::Straight&) {}, [&](deck::Arc& arc) { arc.via = point(arc.via); },
                        [&](deck::SineAxis& sine) { sine.rise *= length; },
                        [&](deck::Curve& curve) { for_points(curve, point); }},
             member.axis);
}

// Forces by one factor, forces per length by another, moments by a third.
void scale(deck::Load& load, double force, double per_length, double moment) {
  std::visit(Overloaded{[&](deck::PointLoad& at) {
                          at.force = {.x = force * at.force.x, .z = force * at.force.z};
                          at.moment *= moment;
                        },
                        [&](deck::MemberLoad& on) {
                          on.distributed = {.x = per_length * on.distributed.x, .z = per_length * on.distributed.z};
                        },
                        [&](deck::Heat& heat) { heat.gradient *= per_length / force; },
                        [&](deck::Pressure& on) { on.pressure *= per_length; }},
             load.action);
}

}  // namespace

deck::Vector Isometry::turned(const deck::Vector& v) const {
  const double c = std::cos(angle), s = std::sin(angle), z = mirrored ? -v.z : v.z;
  return {.x = c * v.x - s * z, .z = s * v.x + c * z};
}

deck::Vector Isometry::moved(const deck::Vector& p) const {
  const deck::Vector v = turned(p);
  return {.x = v.x + shift.x, .z = v.z + shift.z};
}

Deck moved(Deck deck, const Isometry& isometry) {
  for (deck::Point& point : deck.points) point.at = isometry.moved(point.at);
  for (deck::Member& member : deck.members) move(member, isometry);
  for (deck::Load& load : deck.loads) move(load, isometry);
  for (deck::Wall& wall : deck.walls) move(wall, isometry);
  return deck;
}

Deck in_units(Deck deck, double length, double force) {
  for (deck::Material& material : deck.materials) material.E *= force / (length * length);
  for (deck::Section& section : deck.sections) scale(section, length);
  for (deck::Point& point : deck.points) point.at = {.x = length * point.at.x, .z = length * point.at.z};
  for (deck::Member& member : deck.members) scale(member, length);
  for (deck::Load& load : deck.loads) scale(load, force, force / length, force * length);
  for (deck::Wall& wall : deck.walls) scale(wall, length);
  return deck;
}

Deck with_opposite_loads(Deck deck) {
  for (deck::Load& load : deck.loads)
    if (!load.constant) scale(load, -1.0, -1.0, -1.0);
  deck.path.step *= -1.0;
  return deck;
}

Deck with_reversed_member(Deck deck, const std::string& name) {
  const auto found = std::find_if(deck.members.begin(), deck.members.end(),
                                  [&](const deck::Member& member) { return member.name == name; });
  std::swap(found->from, found->to);
  std::swap(found->hinge_from, found->hinge_to);
  // sin(n π (1 − s)) = −(−1)ⁿ sin(n π s), and the left is on the other side.
  for (deck::Imperfection& wave : found->imperfections) wave.amplitude *= wave.waves % 2 == 0 ? 1.0 : -1.0;
  if (auto* sine = std::get_if<deck::SineAxis>(&found->axis)) sine->rise *= sine->waves % 2 == 0 ? 1.0 : -1.0;
  if (auto* curve = std::get_if<deck::Curve>(&found->axis)) {
    std::reverse(curve->x.begin(), curve->x.end());
    std::reverse(curve->z.begin(), curve->z.end());
  }
  for (deck::Load& load : deck.loads)
    if (auto* at = std::get_if<deck::PointLoad>(&load.action); at && at->at.fraction && at->at.name == name)
      at->at.fraction = 1.0 - *at->at.fraction;
  return deck;
}

}  // namespace arcwall::test
