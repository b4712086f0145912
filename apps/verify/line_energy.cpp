#include "apps/verify/line_energy.hpp"

#include <algorithm>

#include "apps/verify/potentials.hpp"

namespace arcwall::verify {

namespace {

constexpr int points = 3;  // of Gauss's rule along an element, but for dead loads between nodes

double at(const AlongElement& along, double inside) { return (1.0 - inside) * along.from + inside * along.to; }

// Whether the element runs against its member: then it has the member's left on its right.
bool is_reversed(const AlongElement& along) { return along.to < along.from; }

// The energy of springs by length at a displacement (x, z).
template <int N>
Jet<N> foundation_density(const std::vector<const deck::Foundation*>& foundations, const std::array<Jet<N>, 2>& u) {
  Jet<N> sum;
  for (const deck::Foundation* foundation : foundations) {
    if (!foundation->law) {
      sum += 0.5 * (foundation->x * (u[0] * u[0]) + foundation->z * (u[1] * u[1]));
      continue;
    }
    const Jet<N>& stretch = u[foundation->law->direction == Dof::x ? 0 : 1];
    sum += stretch.mapped(table_energy(*foundation->law, stretch.value), table_force(*foundation->law, stretch.value),
                          table_slope(*foundation->law, stretch.value));
  }
  return sum;
}

// visit(place inside, ∫ of the dead load about there) for the points of a rule on each piece of the element on which a
// load is smooth. `angle`: of the stress-free axis, as the member travels, at a place inside; `speed`: its arc length
// by that.
template <class Angle, class Speed, class Visit>
void for_each_dead_load(const AlongElement& along, int count, const Angle& angle, const Speed& speed,
                        const Visit& visit) {
  for (const auto& [load, factor] : along.member.loads()) {
    const double acts = factor.at(along.lambda);
    const SmoothPieces pieces(load, angle);
    for (std::size_t piece = 0; piece < pieces.count(); ++piece)
      for (const auto& [place, weight] : gauss_rule_of(count)) {
        const double inside = pieces.begin(piece) + place * pieces.length(piece);
        const double ds = weight * pieces.length(piece) * speed(inside);
        visit(inside, Vec2(acts * ds * load.at(at(along, inside), load.is_straight() ? 0.0 : angle(inside))));
      }
  }
}

// --- slender elements -----------------------------------------------------------------------------------------------

using Place = std::array<Jet<6>, 2>;

// r(ξ) = r₁ + ξ c + c⊥ [ξ (1 − ξ)² t₁ − ξ² (1 − ξ) t₂] with the turns t of the ends against the chord c, from the
// stress-free place of the first end.
class CubicBetween {
 public:
  CubicBetween(const Stretch& stretch, const EndsMotion& motion)
      : first_{unknown(0, motion.first.x()), unknown(1, motion.first.y())},
        chord_{unknown(3, motion.second.x()) - first_[0] + stretch.chord.x(),
               unknown(4, motion.second.y()) - first_[1] + stretch.chord.y()},
        turns_{against_chord(unknown(2, motion.turn1 + stretch.angles.front())),
               against_chord(unknown(5, motion.turn2 + stretch.angles.back()))} {}

  Place at(double xi) const {
    const Jet<6> side = xi * (1.0 - xi) * (1.0 - xi) * turns_[0] - xi * xi * (1.0 - xi) * turns_[1];
    return {first_[0] + xi * chord_[0] - side * chord_[1], first_[1] + xi * chord_[1] + side * chord_[0]};
  }
  Place slope(double xi) const {
    const Jet<6> side = (1.0 - xi) * (1.0 - 3.0 * xi) * turns_[0] - xi * (2.0 - 3.0 * xi) * turns_[1];
    return {chord_[0] - side * chord_[1], chord_[1] + side * chord_[0]};
  }

 private:
  static Jet<6> unknown(std::size_t number, double value) { return Jet<6>::variable(number, value); }
  Jet<6> against_chord(const Jet<6>& angle) const {
    Jet<6> turn = angle - atan2(chord_[1], chord_[0]);
    turn.value = std::remainder(turn.value, 2.0 * pi);
    return turn;
  }

  Place first_, chord_, turns_;
};

// −½ ∫ r × dr, r from a fixed origin.
Jet<6> area_beside(const CubicBetween& axis, const Vec2& origin_to_start) {
  Jet<6> sum;
  for (const auto& [xi, weight] : gauss_rule_of(points)) {
    const Place r = axis.at(xi), slope = axis.slope(xi);
    sum += -0.5 * weight * ((r[0] + origin_to_start.x()) * slope[1] - (r[1] + origin_to_start.y()) * slope[0]);
  }
  return sum;
}

}  // namespace

LocalEnergy line_energy(const AlongElement& along, const Stretch& stretch, const EndsMotion& motion,
                        const Vec2& place) {
  const CubicBetween now(stretch, motion), rest(stretch, {});
  const auto displacement = [&](double xi) {
    const Place r = now.at(xi), R = rest.at(xi);
    return Place{r[0] - R[0].value, r[1] - R[1].value};
  };
  const double turned = is_reversed(along) ? pi : 0.0;
  Jet<6> sum;
  for_each_dead_load(
      along, points, [&](double xi) { return angle_inside(stretch, xi) + turned; },
      [&](double) { return stretch.length; },
      [&](double xi, const Vec2& force) {
        const Place u = displacement(xi);
        sum += -force.x() * u[0] - force.y() * u[1];
      });
  if (!along.member.foundations().empty())
    for (const auto& [xi, weight] : gauss_rule_of(points))
      sum += weight * stretch.length * foundation_density(along.member.foundations(), displacement(xi));
  if (const double p = along.member.pressure().at(along.lambda); p != 0.0)
    sum += (is_reversed(along) ? -p : p) * (area_beside(now, place) - area_beside(rest, place).value);
  return LocalEnergy(sum);
}

// --- nodes with shape functions -------------------------------------------------------------------------------------

namespace {

// Rows of the place (x, z) by the unknowns, or of its derivative by 2ξ − 1, from the factors of the nodes.
Eigen::Matrix<double, 2, Eigen::Dynamic> rows_of(const std::array<double, 3>& factors, std::size_t nodes,
                                                 Index unknowns) {
  const Index stride = unknowns / static_cast<Index>(nodes);
  Eigen::Matrix<double, 2, Eigen::Dynamic> rows = Eigen::Matrix<double, 2, Eigen::Dynamic>::Zero(2, unknowns);
  for (std::size_t a = 0; a < nodes; ++a)
    for (const Index i : {0, 1}) rows(i, stride * static_cast<Index>(a) + i) = factors[a];
  return rows;
}

Vec2 combined(const std::array<double, 3>& factors, const std::vector<Vec2>& places) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t a = 0; a < places.size(); ++a) sum += factors[a] * places[a];
  return sum;
}

// −½ r × r′ by r and r′, less what it is at rest.
Jet<4> area_density(const Vec2& r, const Vec2& slope, const Vec2& r_rest, const Vec2& slope_rest) {
  const auto variable = [](std::size_t i, double value) { return Jet<4>::variable(i, value); };
  const Jet<4> now = variable(0, r.x()) * variable(3, slope.y()) - variable(1, r.y()) * variable(2, slope.x());
  return -0.5 * (now - cross(r_rest, slope_rest));
}

}  // namespace

// One point more than the order: exact for a load that is linear along a straight axis.
LocalEnergy line_energy(const AlongElement& along, const NodesAlong& nodes, const Vector& u, const Vec2& place) {
  const std::size_t count = nodes.places.size();
  const auto speed = [&](double xi) {
    double sum = 0.0;
    for (std::size_t a = 0; a < count; ++a) sum += 2.0 * node_shapes(nodes.order(), xi).dN[a] * nodes.arcs[a];
    return sum;
  };
  LocalEnergy sum(u.size());
  for_each_dead_load(
      along, nodes.order() + 1, [&](double xi) { return along.member.shape().at(at(along, xi)).angle; }, speed,
      [&](double xi, const Vec2& force) {
        const auto rows = rows_of(node_shapes(nodes.order(), xi).N, count, u.size());
        sum.energy -= force.dot(rows * u);
        sum.gradient -= rows.transpose() * force;
      });
  for (const auto& [xi, weight] : gauss_rule_of(points)) {
    const NodeShapes shapes = node_shapes(nodes.order(), xi);
    const auto rows = rows_of(shapes.N, count, u.size());
    const Vec2 moved = rows * u;
    if (!along.member.foundations().empty())
      sum.add(weight * speed(xi) *
                  foundation_density<2>(along.member.foundations(),
                                        {Jet<2>::variable(0, moved.x()), Jet<2>::variable(1, moved.y())}),
              rows);
    if (const double p = along.member.pressure().at(along.lambda); p != 0.0) {
      Eigen::Matrix<double, 4, Eigen::Dynamic> both(4, u.size());
      both << rows, rows_of(shapes.dN, count, u.size());
      const Vec2 r_rest = place + combined(shapes.N, nodes.places), slope_rest = combined(shapes.dN, nodes.places);
      const Eigen::Vector4d change = both * u;
      sum.add(
          2.0 * weight * p * area_density(r_rest + change.head<2>(), slope_rest + change.tail<2>(), r_rest, slope_rest),
          both);
    }
  }
  return sum;
}

LocalEnergy line_energy(const AlongElement& along, const Vec2& chord, const Vector& u) {
  LocalEnergy sum(4);
  for_each_dead_load(
      along, 2, [&](double) { return std::atan2(chord.y(), chord.x()); }, [&](double) { return chord.norm(); },
      [&](double xi, const Vec2& force) {
        const auto rows = rows_of({1.0 - xi, xi, 0.0}, 2, 4);
        sum.energy -= force.dot(rows * u);
        sum.gradient -= rows.transpose() * force;
      });
  return sum;
}

Vec2 origin_of_areas(const Structure& structure) {
  const auto& ends = structure.nodal_terms().pressed_ends();
  if (ends.empty()) return structure.position(0);
  return structure.position(structure.meaning_of_dof(ends.front().x).node) - ends.front().rest;
}

}  // namespace arcwall::verify
