#include "apps/verify/entries.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/verify/sliding_touches.hpp"
#include "core/text.hpp"

namespace arcwall::verify {

namespace {

// An element of a sliding mesh beside a wall: where its face is and how far from the wall, by fractions of the element.
struct ElementBeside {
  const Sliding& at;
  const PlainWall& wall;
  Index strand, position;

  double coordinate(Index behind) const { return at.mesh.coordinate(strand, position + behind, at.now.s); }
  double length() const { return coordinate(1) - coordinate(0); }
  AxisPlace place(double t) const { return at.mesh.inside(strand, position, t, at.now); }
  double gap(double t) const {
    const double half = at.body.half_height(strand);
    return wall.gap_to(face_towards(wall, half, place(t)), half);
  }

  std::string name(double t) const {
    const auto [member, fraction] = at.body.label({.strand = strand, .s = coordinate(0) + t * length()});
    return wall.deck().name + " at " + member + ":" + round_trip(fraction);
  }
};

// The cubic on [0, 1] that has f's values and slopes at both ends.
template <class Function>
double cubic_of_ends(const Function& f, double t) {
  constexpr double step = 1e-4;
  const double from = f(0.0), to = f(1.0);
  const double leaves = (4.0 * f(step) - 3.0 * from - f(2.0 * step)) / (2.0 * step);
  const double arrives = (3.0 * to - 4.0 * f(1.0 - step) + f(1.0 - 2.0 * step)) / (2.0 * step);
  const double r = 1.0 - t;
  return from * r * r * (1.0 + 2.0 * t) + to * t * t * (1.0 + 2.0 * r) + leaves * t * r * r - arrives * t * t * r;
}

// By how much the curvature of the element's shape differs, at most, from κ₀ + M/EI, M being carried from the moments
// at its ends by equilibrium: M = (1 − t) M₀ + t M₁ + (r − r₀ − t c) × f₀ − t (1 − t) c × ((2 − t) q₀ + (1 + t) q₁)
// l/6, c from end to end, under a load that is linear from q₀ to q₁.
double curvature_error(const ElementBeside& beside, int places) {
  const auto& [at, wall, strand, position] = beside;
  const double length = beside.length();
  const auto ends = at.mesh.end_forces(strand, position, at.now);
  const Vec2 first = beside.place(0.0).position, chord = beside.place(1.0).position - first;
  const auto load_at = [&](Index end) -> Vec2 {
    return length * beside.at.body.load({.strand = beside.strand, .s = beside.coordinate(end)},
                                        beside.place(double(end)), chord.norm() / length, beside.at.now.lambda);
  };
  const Vec2 first_load = load_at(0), second_load = load_at(1);
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  double worst = 0.0;
  for (int i = 1; i < places; ++i) {
    const double t = double(i) / places, r = 1.0 - t, step = 0.5 / places;
    const double moment = -r * ends[0][2] + t * ends[1][2] +
                          cross(beside.place(t).position - first - t * chord, ends[0].head<2>()) -
                          t * r / 6.0 * cross(chord, (1.0 + r) * first_load + (1.0 + t) * second_load);
    const MaterialPoint here{.strand = strand, .s = beside.coordinate(0) + t * length};
    const double natural = at.body.natural_curvature(here, at.now.lambda);
    const double curvature = (beside.place(t + step).angle - beside.place(t - step).angle) / (2.0 * step * length);
    worst = std::max(worst, std::abs(curvature - natural - moment / at.body.bending_stiffness(here)));
  }
  return worst;
}

// What the curvature of an element in a pressed part lacks: nodes bear the pressure p that the wall has all along,
// which between them bends by p l²/12 at most.
double lumped_curvature(const ElementBeside& beside) {
  const auto& [at, wall, strand, position] = beside;
  double force = 0.0;
  for (const SlidingContactLayout::PressedNode& node : at.on.pressed_nodes()) {
    if (node.strand != strand || (node.position != position && node.position != position + 1)) continue;
    const auto before = at.mesh.end_forces(strand, node.position - 1, at.now);
    const auto behind = at.mesh.end_forces(strand, node.position, at.now);
    force = std::max(force, (before[1] + behind[0]).head<2>().norm());
  }
  return force * beside.length() / (12.0 * at.body.bending_stiffness({.strand = strand, .s = beside.coordinate(0)}));
}

// What a gap may be off by between the nodes of an element.
class ShapeAllowance {
 public:
  ShapeAllowance(const ElementBeside& beside, int places, double most_of_cubic)
      : bending_(0.5 * beside.length() * beside.length() *
                 (curvature_error(beside, places) + lumped_curvature(beside))) {
    for (int i = 1; i < places; ++i) {
      const double t = double(i) / places;
      const double off = std::abs(beside.gap(t) - cubic_of_ends([&](double f) { return beside.gap(f); }, t));
      if (std::isfinite(off)) cubic_ = std::max(cubic_, off);
    }
    cubic_ = std::min(cubic_, most_of_cubic);
  }

  // A curvature that is off by δ all along bends the middle by δ l²/8.
  double at(double t) const { return bending_ * t * (1.0 - t) + cubic_; }

 private:
  double bending_, cubic_ = 0.0;
};

// So many parts of an element that no wall is narrower than four of them.
int places_along(const PlainWall& wall, double length) {
  constexpr double least = 10.0, most = 400.0;
  return static_cast<int>(std::clamp(std::ceil(4.0 * length / wall.width()), least, most));
}

}  // namespace

Entry deepest_entry(const Model& model, const std::vector<PlainWall>& walls, const State& state, double roundoff) {
  Entry deepest{.allowed = roundoff};
  if (model.sliding() == nullptr) return deepest;
  const Sliding at{.model = model, .state = state};
  const auto look_at = [&](const ElementBeside& beside) {
    const int places = places_along(beside.wall, beside.length());
    std::optional<ShapeAllowance> allowance;
    for (int i = 0; i <= places; ++i) {
      const double t = double(i) / places, depth = -beside.gap(t);
      if (depth > roundoff && !allowance) {
        const bool turns_far = std::abs(beside.place(1.0).angle - beside.place(0.0).angle) > most_turn;
        allowance.emplace(beside, places, (turns_far ? 1e-3 : 1e-5) * at.body.length_scale());
      }
      const double allowed = roundoff + (depth > roundoff ? allowance->at(t) : 0.0);
      if (depth * deepest.allowed > deepest.depth * allowed)  // nearer to what is allowed, or beyond
        deepest = {.depth = depth, .allowed = allowed, .where = beside.name(t)};
    }
  };
  for (Index strand = 0; strand < at.body.strands(); ++strand)
    for (const PlainWall& wall : walls)
      if (wall.concerns(at.body.label({.strand = strand, .s = 0.0}).first))
        for (Index e = 0; e + 1 < at.mesh.nodes(strand); ++e)
          look_at({.at = at, .wall = wall, .strand = strand, .position = e});
  return deepest;
}

}  // namespace arcwall::verify
