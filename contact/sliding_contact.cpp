#include "contact/sliding_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/algebra/assembly.hpp"

namespace arcwall {

using Bound = SlidingContactLayout::Bound;

SlidingContact::SlidingContact(const SlidingBody& body, std::vector<Obstacle> obstacles, const ContactScales& scales)
    : body_(body), obstacles_(std::move(obstacles)), scales_(scales) {
  ElementsPerSegment cut;
  for (Index strand = 0; strand < body.strands(); ++strand) {
    cut.push_back(
        {std::max(1, static_cast<int>(std::lround(body.elements_between(strand, 0.0, body.length(strand)))))});
    for (std::size_t w = 0; w < obstacles_.size(); ++w)
      for (const bool last : {false, true})
        if (obstacles_[w].strands[static_cast<std::size_t>(strand)] && !body.end_is_held(strand, last))
          tied_.push_back({.strand = strand, .last = last, .obstacle = w, .travel = 0.0});
  }
  const auto layout = std::make_shared<SlidingContactLayout>(body, body.mesh(cut),
                                                             std::vector<SlidingContactLayout::Point>{}, Vector());
  const Vector x = body.rest(layout->mesh(), Vector()), s;
  const MeshState rest{.x = x, .s = s, .lambda = 0.0};
  for (Tied& end : tied_) {
    constexpr double vertical = 1e-6;
    const double along =
        std::cos(layout->mesh().node(end.strand, end.last ? layout->mesh().nodes(end.strand) - 1 : 0, rest).angle);
    end.travel = std::abs(along) > vertical ? std::copysign(1.0, along) : 0.0;
  }
  open_ = Piece(tied_.size(), 0, layout);
}

const SlidingContactLayout& SlidingContact::layout(const Piece& piece) const {
  return static_cast<const SlidingContactLayout&>(*piece.layout());
}

State SlidingContact::rest() const {
  const SlidingMesh& mesh = layout(open_).mesh();
  return {.x = body_.rest(mesh, Vector()), .lambda = 0.0, .piece = open_};
}

State SlidingContact::adopted(const State& state) const {
  const SlidingContactLayout& on = layout(state.piece);
  const auto here = std::make_shared<SlidingContactLayout>(body_, body_.mesh(on.mesh().elements_per_segment()),
                                                           on.points(), on.s_of(state));
  State out{.x = state.x, .lambda = state.lambda, .piece = Piece(state.piece.size(), 0, here)};
  for (std::size_t j = 0; j < state.piece.size(); ++j) out.piece[j] = state.piece[j];
  return out;
}

// --- sizes and places in x: q, forces of closed contacts, forces of held nodes, moments, s ---------------------------

Index SlidingContact::multiplier_count(const Piece& piece) const {
  const SlidingContactLayout& on = layout(piece);
  return piece.closed_count() + static_cast<Index>(on.held().size() + on.points().size());
}

Index SlidingContact::border_width(const Piece& piece) const {
  return static_cast<Index>(layout(piece).points().size());
}

Index SlidingContact::size(const Piece& piece) const {
  return layout(piece).mesh().unknowns() + multiplier_count(piece) + border_width(piece);
}

std::optional<Index> SlidingContact::multiplier_index(const Piece& piece, Index j) const {
  if (!piece[static_cast<std::size_t>(j)]) return std::nullopt;
  return layout(piece).mesh().unknowns() + std::count(piece.begin(), piece.begin() + j, std::uint8_t{1});
}

Vector SlidingContact::weights(const Piece& piece) const {
  Vector weights = Vector::Zero(size(piece));
  weights.head(layout(piece).mesh().unknowns()) = layout(piece).mesh().weights();
  return weights;
}

// --- the equations --------------------------------------------------------------------------------------------------

// visit(touch, where its force stands in x)
template <typename Visit>
void SlidingContact::for_each_force(const State& state, const Visit& visit) const {
  const SlidingContactLayout& on = layout(state.piece);
  Index at = on.mesh().unknowns();
  for (std::size_t j = 0; j < state.piece.size(); ++j)
    if (state.piece[j]) visit(touch(on, j), at++);
  for (const SlidingContactLayout::Held& node : on.held())
    visit(Touch{.strand = node.strand,
                .position = node.position,
                .obstacle = node.obstacle,
                .offset = normal_offset(node.obstacle, node.strand)},
          at++);
}

void SlidingContact::residual(const State& state, Eigen::Ref<Vector> F) const {
  const SlidingContactLayout& on = layout(state.piece);
  on.mesh().residual(mesh_state_of(state), F.head(on.mesh().unknowns()));
  add_contact(state, F);
}

// The forces on the structure, and the equations of contact.
void SlidingContact::add_contact(const State& state, Eigen::Ref<Vector> F) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Index m = border_width(state.piece);
  const MeshState now = mesh_state_of(state);
  const auto add = [&](const Touch& at, const Eigen::Vector3d& gradient, double force) {
    const NodeUnknowns unknowns = on.mesh().node_unknowns(at.strand, at.position);
    for (std::size_t i = 0; i < 3; ++i)
      if (unknowns[i] >= 0) F[unknowns[i]] -= force * gradient[static_cast<Index>(i)];
  };
  for_each_force(state, [&](const Touch& at, Index p) {
    const NodeGap gap = node_gap(at, now, on);
    add(at, gap.gap_gradient, state.x[p]);
    F[p] = -gap.gap;
  });
  const Index moments = F.size() - 2 * m;
  for (Index k = 0; k < m; ++k) {
    const Touch at = touch(on, static_cast<std::size_t>(k));
    const NodeGap gap = node_gap(at, now, on);
    add(at, gap.tilt_gradient, state.x[moments + k]);
    F[moments + k] = -gap.tilt;
    F[moments + m + k] = on.lies_pressed(static_cast<std::size_t>(k)) ? bending_gap(state, static_cast<std::size_t>(k))
                                                                      : state.x[moments + k];
  }
}

void SlidingContact::linearize(const State& state, Linearization& out) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Index n = on.mesh().unknowns(), m = border_width(state.piece), size = state.x.size();
  if (!out.inner) out.inner = std::make_unique<Linearization>();
  Linearization& inner = *out.inner;
  if (!out.pattern_of || out.pattern_of->layout() != state.piece.layout()) inner.pattern_of.reset();
  const MeshState now = mesh_state_of(state);
  on.mesh().linearize(now, inner);
  inner.pattern_of = state.piece;
  if (!out.pattern_of || *out.pattern_of != state.piece) lay_out(state, out);

  out.F.resize(size);
  out.F.head(n) = inner.F;
  add_contact(state, out.F);
  out.F_lambda.setZero(size);
  out.F_lambda.head(n) = inner.F_lambda;
  out.B.setZero(size - m, m);
  out.B.topRows(n) = inner.B;
  copy_values(inner.K, out.K);
  out.border_rates = border_rates(state);
  const auto add_row = [&](const Touch& at, const Eigen::Vector3d& gradient, Index row) {
    const NodeUnknowns unknowns = on.mesh().node_unknowns(at.strand, at.position);
    for (std::size_t i = 0; i < 3; ++i)
      if (unknowns[i] >= 0) out.K.coeffRef(row, unknowns[i]) = -gradient[static_cast<Index>(i)];
  };
  const auto add_hessian = [&](const Touch& at, const Eigen::Matrix3d& hessian, double force) {
    const NodeUnknowns unknowns = on.mesh().node_unknowns(at.strand, at.position);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        if (unknowns[i] < 0 || unknowns[j] < 0) continue;
        const double h = hessian(static_cast<Index>(i), static_cast<Index>(j));
        if (h != 0.0)
          out.K.coeffRef(std::max(unknowns[i], unknowns[j]), std::min(unknowns[i], unknowns[j])) -= force * h;
      }
  };
  for_each_force(state, [&](const Touch& at, Index p) {
    const NodeGap gap = node_gap(at, now, on);
    add_row(at, gap.gap_gradient, p);
    add_hessian(at, gap.gap_hessian, state.x[p]);
  });
  const Index moments = size - 2 * m;
  out.C.setZero(m, size);
  for (Index k = 0; k < m; ++k) {
    const Touch at = touch(on, static_cast<std::size_t>(k));
    const NodeGap gap = node_gap(at, now, on);
    add_row(at, gap.tilt_gradient, moments + k);
    add_hessian(at, gap.tilt_hessian, state.x[moments + k]);
    if (on.lies_pressed(static_cast<std::size_t>(k))) {
      const double EI = body_.bending_stiffness(at.strand);
      const CurvatureGap bend = curvature_gap(state, static_cast<std::size_t>(k));
      out.C.row(k).head(n) = EI * bend.dx;
      out.C.row(k).tail(m) = EI * bend.ds;
      out.F_lambda[size - m + k] = EI * bend.dlambda;
    } else {
      out.C(k, moments + k) = 1.0;
    }
  }
}

void SlidingContact::lay_out(const State& state, Linearization& out) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Index n = out.inner->K.cols(), m = border_width(state.piece), core = state.x.size() - m;
  std::vector<RowEntry> entries;
  const auto touches = [&](const Touch& at, Index row) {
    for (const Index unknown : on.mesh().node_unknowns(at.strand, at.position))
      if (unknown >= 0) entries.push_back({.row = row - n, .column = unknown});
  };
  for_each_force(state, touches);
  for (Index k = 0; k < m; ++k) touches(touch(on, static_cast<std::size_t>(k)), core - m + k);
  out.K = with_rows_behind(out.inner->K, entries, core - n);
  out.holding.clear();
  for (Index k = 0; k < m; ++k) out.holding.push_back(core - m + k);
  out.pattern_of = state.piece;
}

double SlidingContact::energy(const State& state) const {
  const SlidingContactLayout& on = layout(state.piece);
  return on.mesh().energy(mesh_state_of(state));
}

// --- guards ---------------------------------------------------------------------------------------------------------

Index SlidingContact::guard_count(const Piece& piece) const {
  return static_cast<Index>(piece.size() + layout(piece).limits().size());
}

Vector SlidingContact::guards(const State& state) const {
  Vector guards(guard_count(state.piece));
  for (Index j = 0; j < guards.size(); ++j) guards[j] = guard(state, j);
  return guards;
}

double SlidingContact::guard(const State& state, Index j) const {
  const auto contacts = static_cast<Index>(state.piece.size());
  if (j >= contacts) return limit_value(state, static_cast<std::size_t>(j - contacts));
  if (const auto p = multiplier_index(state.piece, j)) return state.x[*p] / scales_.force;
  const SlidingContactLayout& on = layout(state.piece);
  const Touch at = touch(on, static_cast<std::size_t>(j));
  const double gap = face_gap(at, on.mesh().node(at.strand, at.position, mesh_state_of(state)));
  return std::isfinite(gap) ? gap / scales_.length : 1.0;
}

Row SlidingContact::guard_gradient(const State& state, Index j) const {
  const auto contacts = static_cast<Index>(state.piece.size());
  if (j >= contacts) return limit_gradient(state, static_cast<std::size_t>(j - contacts));
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (const auto p = multiplier_index(state.piece, j)) {
    row.dx[*p] = 1.0 / scales_.force;
    return row;
  }
  const SlidingContactLayout& on = layout(state.piece);
  const Touch at = touch(on, static_cast<std::size_t>(j));
  const MeshState now = mesh_state_of(state);
  if (!std::isfinite(face_gap(at, on.mesh().node(at.strand, at.position, now)))) return row;
  const NodeGap gap = node_gap(at, now, on);
  const NodeUnknowns unknowns = on.mesh().node_unknowns(at.strand, at.position);
  for (std::size_t i = 0; i < 3; ++i)
    if (unknowns[i] >= 0) row.dx[unknowns[i]] = gap.gap_gradient[static_cast<Index>(i)] / scales_.length;
  return row;
}

Vector SlidingContact::unit_force(const State& state, Index j) const {
  return guard_gradient(state, j).dx * scales_.length * scales_.force;
}

Vector SlidingContact::transfer(const Vector& x, const Piece& from, const Piece& to) const {
  const Index n = layout(from).mesh().unknowns();
  const Index rest = x.size() - n - from.closed_count();
  Vector moved = Vector::Zero(n + to.closed_count() + rest);
  moved.head(n) = x.head(n);
  moved.tail(rest) = x.tail(rest);
  Index source = n, target = n;
  for (std::size_t j = 0; j < to.size(); ++j) {
    if (from[j] && to[j]) moved[target] = x[source];
    source += from[j] ? 1 : 0;
    target += to[j] ? 1 : 0;
  }
  return moved;
}

std::optional<std::string> SlidingContact::invalid_reason(const State& state) const {
  const SlidingContactLayout& on = layout(state.piece);
  const MeshState now = mesh_state_of(state);
  for (std::size_t j = 0; j < state.piece.size(); ++j) {
    const Touch at = touch(on, j);
    if (state.piece[j] && !std::isfinite(face_gap(at, on.mesh().node(at.strand, at.position, now)))) return "wall_end";
  }
  return std::nullopt;
}

// Where the pressure is least that the number of a guard stands for; empty for a contact.
std::optional<SlidingContact::Lifting> SlidingContact::lifting(const State& state, Index j) const {
  const SlidingContactLayout& on = layout(state.piece);
  if (j < static_cast<Index>(state.piece.size())) return std::nullopt;
  const auto limit = on.limits()[static_cast<std::size_t>(j) - state.piece.size()];
  assert(limit.bound == Bound::pressure);
  const SlidingContactLayout::Held& held = on.held()[limit.which];
  return Lifting{.obstacle = held.obstacle,
                 .at = {.strand = held.strand, .s = least_pressure_place(state, limit.which)}};
}

ContactLabel SlidingContact::label(const State& state, Index j) const {
  const auto named = [this](std::size_t obstacle, const MaterialPoint& at) -> ContactLabel {
    const auto [member, fraction] = body_.label(at);
    return {.wall = obstacles_[obstacle].name, .member = member, .fraction = fraction};
  };
  if (const auto least = lifting(state, j)) return named(least->obstacle, least->at);
  const SlidingContactLayout& on = layout(state.piece);
  const Touch at = touch(on, static_cast<std::size_t>(j));
  return named(at.obstacle, {.strand = at.strand, .s = on.mesh().coordinate(at.strand, at.position, on.s_of(state))});
}

Vec2 SlidingContact::place(const State& state, Index j) const {
  const SlidingContactLayout& on = layout(state.piece);
  if (const auto least = lifting(state, j))
    return face(normal_offset(least->obstacle, least->at.strand), on.mesh().place(least->at, mesh_state_of(state)));
  const Touch at = touch(on, static_cast<std::size_t>(j));
  return face(at.offset, on.mesh().node(at.strand, at.position, mesh_state_of(state)));
}

double SlidingContact::force(const State& state, Index j) const {
  const auto p = multiplier_index(state.piece, j);
  return p ? state.x[*p] : 0.0;
}

std::vector<SlidingContact::HeldNode> SlidingContact::held_nodes(const State& state) const {
  const SlidingContactLayout& on = layout(state.piece);
  const MeshState now = mesh_state_of(state);
  std::vector<HeldNode> nodes;
  Index force = on.mesh().unknowns() + state.piece.closed_count();
  for (const SlidingContactLayout::Held& held : on.held()) {
    const auto coordinate = [&](Index position) { return on.mesh().coordinate(held.strand, position, now.s); };
    const auto [member, fraction] = body_.label({.strand = held.strand, .s = coordinate(held.position)});
    nodes.push_back(
        {.label = {.wall = obstacles_[held.obstacle].name,
                   .member = member,
                   .fraction = fraction,
                   .tributary = 0.5 * (coordinate(held.position + 1) - coordinate(held.position - 1))},
         .place = face(normal_offset(held.obstacle, held.strand), on.mesh().node(held.strand, held.position, now)),
         .force = state.x[force++]});
  }
  return nodes;
}

}  // namespace arcwall
