#include "elements/mechanism.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace arcwall {

namespace {

using Rows = Eigen::SparseMatrix<double>;

// Sets of numbers 0 … n − 1 that are united step by step (union–find).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t representative(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t a, std::size_t b) { parent_[representative(a)] = representative(b); }

 private:
  std::vector<std::size_t> parent_;
};

// A node of a beam element: where its motion is seen by others.
struct ElementEnd {
  Index node;
  Index rotation;  // degree of freedom
};

// Beam elements that move as one, by the motion of their centre and ωℓ: point r moves by u + ω e_y × (r − centre).
struct RigidBody {
  Vec2 centre = Vec2::Zero();
  double size = 0.0;               // ℓ, the greatest distance of a node from the centre
  std::vector<ElementEnd> ends{};  // of all its elements

  // The motion of a point in x and z, by u_x, u_z and ωℓ.
  Eigen::Matrix<double, 2, 3> motion_at(const Vec2& point) const {
    const Vec2 arm = (point - centre) / size;
    Eigen::Matrix<double, 2, 3> by;
    by << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
    return by;
  }
};

std::vector<RigidBody> rigid_bodies(const Structure& structure) {
  std::vector<std::pair<ElementEnd, ElementEnd>> beams;
  for (const MemberMesh& mesh : structure.members())
    for (std::size_t k = 0; k + 1 < mesh.nodes.size(); ++k)
      if (mesh.rotations[k])
        beams.push_back({{mesh.nodes[k], *mesh.rotations[k]}, {mesh.nodes[k + 1], *mesh.rotations[k + 1]}});

  DisjointSets sets(beams.size());
  std::map<Index, std::size_t> beam_of_rotation;
  for (std::size_t e = 0; e < beams.size(); ++e)
    for (const ElementEnd& end : {beams[e].first, beams[e].second})
      sets.unite(e, beam_of_rotation.try_emplace(end.rotation, e).first->second);

  std::map<std::size_t, RigidBody> bodies;
  for (std::size_t e = 0; e < beams.size(); ++e)
    for (const ElementEnd& end : {beams[e].first, beams[e].second}) bodies[sets.representative(e)].ends.push_back(end);
  std::vector<RigidBody> out;
  for (auto& [key, body] : bodies) {
    for (const ElementEnd& end : body.ends) body.centre += structure.position(end.node) / double(body.ends.size());
    for (const ElementEnd& end : body.ends)
      body.size = std::max(body.size, (structure.position(end.node) - body.centre).norm());
    out.push_back(std::move(body));
  }
  return out;
}

// The motions q of a structure of rigid beams: three of each body, then two of each node that only bars have. A node
// of a body moves with the first one that has it; the others are joined to it by conditions.
struct Motions {
  const Structure& structure;
  std::vector<RigidBody> bodies;
  std::vector<std::optional<std::size_t>> body_of_node;
  std::vector<Eigen::Index> first_of_node;  // of those without a body
  Eigen::Index count = 0;

  explicit Motions(const Structure& of)
      : structure(of),
        bodies(rigid_bodies(of)),
        body_of_node(static_cast<std::size_t>(of.node_count())),
        first_of_node(body_of_node.size(), -1),
        count(3 * static_cast<Eigen::Index>(bodies.size())) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (const ElementEnd& end : bodies[b].ends)
        if (auto& body = body_of_node[static_cast<std::size_t>(end.node)]; !body) body = b;
    for (const MemberMesh& mesh : of.members())
      for (const Index node : mesh.nodes) {
        const auto i = static_cast<std::size_t>(node);
        if (body_of_node[i] || first_of_node[i] >= 0) continue;
        first_of_node[i] = count;
        count += 2;
      }
  }

  // Of node in a direction: what is multiplied with q, as (place, factor).
  std::vector<std::pair<Eigen::Index, double>> of_node(Index node, const Vec2& direction) const {
    const auto i = static_cast<std::size_t>(node);
    if (body_of_node[i]) return of_body(*body_of_node[i], node, direction);
    return {{first_of_node[i], direction.x()}, {first_of_node[i] + 1, direction.y()}};
  }
  std::vector<std::pair<Eigen::Index, double>> of_body(std::size_t body, Index node, const Vec2& direction) const {
    const Eigen::RowVector3d by = direction.transpose() * bodies[body].motion_at(structure.position(node));
    const Eigen::Index first = 3 * static_cast<Eigen::Index>(body);
    return {{first, by[0]}, {first + 1, by[1]}, {first + 2, by[2]}};
  }

  // Of a displacement or a rotation.
  std::vector<std::pair<Eigen::Index, double>> of_dof(Index dof) const {
    const Structure::Meaning meaning = structure.meaning_of_dof(dof);
    if (meaning.dof == Dof::x) return of_node(meaning.node, Vec2::UnitX());
    if (meaning.dof == Dof::z) return of_node(meaning.node, Vec2::UnitY());
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (const ElementEnd& end : bodies[b].ends)
        if (end.rotation == dof) return {{3 * static_cast<Eigen::Index>(b) + 2, 1.0 / bodies[b].size}};
    return {};
  }
};

// Conditions C q = 0: bars keep their lengths, bodies hold together at their joints, and what supports or springs join
// to the ground does not move.
class Conditions {
 public:
  explicit Conditions(const Motions& motions) : motions_(motions) {
    keep_lengths_of_bars();
    join_bodies();
    hold_supports();
    join_by_springs();
  }

  Rows matrix() const {
    Rows C(rows_, motions_.count);
    C.setFromTriplets(entries_.begin(), entries_.end());
    return C;
  }

 private:
  using Terms = std::vector<std::pair<Eigen::Index, double>>;

  void add(const Terms& plus, const Terms& minus = {}) {
    for (const auto& [place, factor] : plus) entries_.emplace_back(rows_, place, factor);
    for (const auto& [place, factor] : minus) entries_.emplace_back(rows_, place, -factor);
    ++rows_;
  }

  void keep_lengths_of_bars() {
    const Structure& structure = motions_.structure;
    for (const MemberMesh& mesh : structure.members())
      for (std::size_t k = 0; k + 1 < mesh.nodes.size(); ++k) {
        if (mesh.rotations[k]) continue;
        const Index a = mesh.nodes[k], b = mesh.nodes[k + 1];
        const Vec2 along = (structure.position(b) - structure.position(a)).normalized();
        add(motions_.of_node(b, along), motions_.of_node(a, along));
      }
  }

  void join_bodies() {
    std::set<std::pair<std::size_t, Index>> joined;
    for (std::size_t b = 0; b < motions_.bodies.size(); ++b)
      for (const ElementEnd& end : motions_.bodies[b].ends)
        if (motions_.body_of_node[static_cast<std::size_t>(end.node)] != b && joined.insert({b, end.node}).second)
          for (const Vec2& direction : {Vec2(Vec2::UnitX()), Vec2(Vec2::UnitY())})
            add(motions_.of_body(b, end.node, direction), motions_.of_node(end.node, direction));
  }

  void hold_supports() {
    const Structure& structure = motions_.structure;
    std::set<Index> seen;
    const auto holds = [&](Index dof) {
      const bool grounded = !structure.unknown(dof) || structure.nodal_terms().ground_stiffness(dof) != 0.0;
      return grounded && seen.insert(dof).second;
    };
    for (const MemberMesh& mesh : structure.members())
      for (const Index node : mesh.nodes) {
        if (holds(structure.dof(node, Dof::x))) add(motions_.of_node(node, Vec2::UnitX()));
        if (holds(structure.dof(node, Dof::z))) add(motions_.of_node(node, Vec2::UnitY()));
      }
    for (std::size_t b = 0; b < motions_.bodies.size(); ++b)
      for (const ElementEnd& end : motions_.bodies[b].ends)
        if (holds(end.rotation)) add({{3 * static_cast<Eigen::Index>(b) + 2, 1.0}});
  }

  void join_by_springs() {
    for (const NodalTerms::Spring& spring : motions_.structure.nodal_terms().springs())
      add(motions_.of_dof(spring.first), motions_.of_dof(spring.second));
  }

  const Motions& motions_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::Index rows_ = 0;
};

// An orthonormal basis of all q with C q = 0, at most `most` of its vectors: where the columns of Cᵀ have no full rank,
// the last columns of Q in Cᵀ = Q R are orthogonal to all of them.
std::vector<Vector> null_vectors(const Rows& C, Eigen::Index most) {
  const Eigen::Index n = C.cols();
  std::vector<Vector> vectors;
  Rows transposed = C.transpose();
  transposed.makeCompressed();
  std::optional<Eigen::SparseQR<Rows, Eigen::COLAMDOrdering<int>>> qr;
  if (C.rows() > 0) qr.emplace(transposed);
  const Eigen::Index count = std::min(most, n - (qr ? qr->rank() : 0));
  for (Eigen::Index i = 1; i <= count; ++i) {
    const Vector unit = Vector::Unit(n, n - i);
    vectors.push_back(qr ? Vector(qr->matrixQ() * unit) : unit);
  }
  return vectors;
}

// How much a motion moves a node in a direction.
double moved(const Motions& motions, const Vector& q, Index node, const Vec2& direction) {
  double sum = 0.0;
  for (const auto& [place, factor] : motions.of_node(node, direction)) sum += factor * q[place];
  return sum;
}

}  // namespace

std::optional<Mechanism> find_mechanism(const Structure& structure) {
  const Motions motions(structure);
  if (motions.count == 0) return std::nullopt;
  const std::vector<Vector> null = null_vectors(Conditions(motions).matrix(), 1);
  if (null.empty()) return std::nullopt;
  const Vector& q = null.front();

  Mechanism greatest{};
  double motion = -1.0;
  const auto compare = [&](Index node, Dof dof, double here) {
    if (std::abs(here) <= motion * (1.0 + 1e-9)) return;
    motion = std::abs(here);
    greatest = {.node = node, .dof = dof};
  };
  for (const MemberMesh& mesh : structure.members())
    for (const Index node : mesh.nodes) {
      compare(node, Dof::x, moved(motions, q, node, Vec2::UnitX()));
      compare(node, Dof::z, moved(motions, q, node, Vec2::UnitY()));
    }
  for (std::size_t b = 0; b < motions.bodies.size(); ++b) {
    const double turns = q[3 * static_cast<Eigen::Index>(b) + 2] / motions.bodies[b].size;
    compare(motions.bodies[b].ends.front().node, Dof::rotation, turns * 0.5 * structure.length_scale());
  }
  return greatest;
}

namespace {

constexpr double least_motion = 1e-9;  // of a motion of unit length

// Directions of nodes, and how much each motion of a basis of those without strain moves each.
struct MovedDirections {
  std::vector<NodeDirection> directions{};
  std::vector<Vector> rows{};

  MovedDirections(const Structure& structure, const std::vector<Index>& nodes) {
    const Motions motions(structure);
    if (motions.count == 0) return;
    const std::vector<Vector> null = null_vectors(Conditions(motions).matrix(), motions.count);
    for (const Index node : nodes)
      for (const Dof dof : {Dof::x, Dof::z}) {
        Vector row(static_cast<Index>(null.size()));
        for (std::size_t i = 0; i < null.size(); ++i)
          row[static_cast<Index>(i)] = moved(motions, null[i], node, dof == Dof::x ? Vec2::UnitX() : Vec2::UnitY());
        directions.push_back({.node = node, .dof = dof});
        rows.push_back(std::move(row));
      }
  }
};

}  // namespace

// The fewest by pivots: each is the direction that is moved most by what the ones before leave free.
FreeDirections free_directions(const Structure& structure, const std::vector<Index>& nodes) {
  constexpr double clearly = 1.0 + 1e-9;  // of two alike the first
  MovedDirections left(structure, nodes);
  FreeDirections free;
  for (std::size_t i = 0; i < left.rows.size(); ++i)
    if ((left.rows[i].array().abs() > least_motion).any()) free.all.push_back(left.directions[i]);
  while (!left.rows.empty()) {
    std::size_t pivot = 0;
    for (std::size_t i = 1; i < left.rows.size(); ++i)
      if (left.rows[i].norm() > clearly * left.rows[pivot].norm()) pivot = i;
    if (left.rows[pivot].norm() <= least_motion) break;
    const Vector taken = left.rows[pivot].normalized();
    for (Vector& row : left.rows) row -= row.dot(taken) * taken;
    free.fewest.push_back(left.directions[pivot]);
  }
  return free;
}

}  // namespace arcwall
