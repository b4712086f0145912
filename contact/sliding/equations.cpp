#include "contact/sliding/equations.hpp"

#include <algorithm>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/neutral_spans.hpp"
#include "contact/sliding/touch.hpp"
#include "core/algebra/assembly.hpp"

namespace arcwall::sliding {

namespace {

// visit(touch, index of its force) for all that carry force.
template <typename Visit>
void for_each_force(const SlidingSetting& setting, const SlidingState& at, const Visit& visit) {
  Index force = at.index.nodes;
  for (std::size_t j = 0; j < at.contacts(); ++j)
    if (at.is_closed(j)) visit(touch_of_contact(setting, at.layout, j), force++);
  for (const SlidingContactLayout::PressedNode& node : at.layout.pressed_nodes())
    visit(touch_of_node(setting, node), force++);
}

// visit(touch, index of its moment) for all pressed tips.
template <typename Visit>
void for_each_tip_moment(const SlidingSetting& setting, const SlidingState& at, const Visit& visit) {
  const auto& tips = at.layout.pressed_tips();
  for (std::size_t i = 0; i < tips.size(); ++i) visit(touch_of_tip(setting, tips[i]), at.index.tip_moment(i));
}

// visit(span, unknowns of its middle, index of its force) for all neutral spans.
template <typename Visit>
void for_each_middle(const SlidingState& at, const Visit& visit) {
  const auto& spans = at.layout.neutral_spans();
  for (std::size_t i = 0; i < spans.size(); ++i)
    visit(spans[i], at.mesh.node_unknowns(spans[i].strand, spans[i].middle), at.index.holding_force(i));
}

// visit(span) for all neutral spans that may be anywhere between the flat parts beside them.
template <typename Visit>
void for_each_loose(const SlidingState& at, const Visit& visit) {
  for (const SlidingContactLayout::NeutralSpan& span : at.layout.neutral_spans())
    if (at.layout.is_loose(span)) visit(span);
}

// Of the equation that lengths of flat parts keep their difference, which then is a moment as its neighbours are.
double moment_of_length(const SlidingSetting& setting, const SlidingContactLayout::NeutralSpan& span) {
  const double L = setting.body.length(span.strand);
  return setting.body.bending_stiffness(span.strand) / (L * L);
}

NodeUnknowns unknowns_of(const SlidingState& at, const Touch& touch) {
  return at.mesh.node_unknowns(touch.strand, touch.position);
}

// The forces of contact on the body, and the equations −g = 0, −t = 0 and m = 0 or EI (κ̂ − κ) = m. The moments m₁ and
// m₂ at the ends of a loose span are equal by symmetry: m₁ + m₂ = 0 says all of them, and (8.6b) where the span is.
void add_contact(const SlidingSetting& setting, const SlidingState& at, Eigen::Ref<Vector> F) {
  for_each_force(setting, at, [&](const Touch& touch, Index p) {
    const TouchGap touching = touch_gap(setting, touch, at);
    add_at_node(unknowns_of(at, touch), -at.state.x[p] * touching.gap.gradient, F);
    F[p] = -touching.gap.value;
  });
  for_each_middle(at, [&](const SlidingContactLayout::NeutralSpan& span, const NodeUnknowns& unknowns, Index p) {
    const NodeFunction off = off_halfway(setting, at, span);
    add_at_node(unknowns, -at.state.x[p] * off.gradient, F);
    F[p] = -off.value;
  });
  for_each_tip_moment(setting, at, [&](const Touch& touch, Index m) {
    const TouchGap touching = touch_gap(setting, touch, at);
    add_at_node(unknowns_of(at, touch), -at.state.x[m] * touching.tilt.gradient, F);
    F[m] = -touching.tilt.value;
  });
  for (Index k = 0; k < at.index.points; ++k) {
    const auto point = static_cast<std::size_t>(k);
    const Touch touch = touch_of_contact(setting, at.layout, point);
    const TouchGap touching = touch_gap(setting, touch, at);
    add_at_node(unknowns_of(at, touch), -at.moment(k) * touching.tilt.gradient, F);
    F[at.index.moment(k)] = -touching.tilt.value;
    F[at.index.coordinate(k)] = at.layout.lies_pressed(point) ? setting.body.bending_stiffness(touch.strand) *
                                                                    curvature_gap(setting, at, point).value
                                                              : at.moment(k);
  }
  for_each_loose(at, [&](const SlidingContactLayout::NeutralSpan& span) {
    F[at.index.coordinate(span.first_point)] += at.moment(span.last_point);
    F[at.index.coordinate(span.last_point)] = moment_of_length(setting, span) * grown_apart(at, span);
  });
}

// The row of a constraint, less its gradient by a node.
void set_row(const NodeUnknowns& unknowns, const Eigen::Vector3d& gradient, Index row, SparseMatrix& K) {
  for (std::size_t i = 0; i < 3; ++i)
    if (unknowns[i] >= 0) K.coeffRef(row, unknowns[i]) = -gradient[static_cast<Index>(i)];
}

// What a force along a gradient adds to the stiffness of its node.
void add_hessian(const NodeUnknowns& unknowns, const Eigen::Matrix3d& hessian, double force, SparseMatrix& K) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      if (unknowns[i] < 0 || unknowns[j] < 0) continue;
      const double h = hessian(static_cast<Index>(i), static_cast<Index>(j));
      if (h != 0.0) K.coeffRef(std::max(unknowns[i], unknowns[j]), std::min(unknowns[i], unknowns[j])) -= force * h;
    }
}

// The row of a constraint, and what its multiplier adds to K and F_λ at the constraint's node.
void add_constraint(const NodeFunction& constraint, const NodeUnknowns& unknowns, Index multiplier,
                    const SlidingState& at, Linearization& out) {
  const double force = at.state.x[multiplier];
  set_row(unknowns, constraint.gradient, multiplier, out.K);
  add_hessian(unknowns, constraint.hessian, force, out.K);
  add_at_node(unknowns, -force * constraint.gradient_rate, out.F_lambda);
  out.F_lambda[multiplier] = -constraint.rate;
}

// The pattern of K: that of the mesh with rows of forces and moments behind it.
void lay_out(const SlidingSetting& setting, const SlidingState& at, Linearization& out) {
  std::vector<RowEntry> entries;
  const auto add_row = [&](const NodeUnknowns& unknowns, Index row) {
    for (const Index unknown : unknowns)
      if (unknown >= 0) entries.push_back({.row = row - at.index.nodes, .column = unknown});
  };
  const auto add = [&](const Touch& touch, Index row) { add_row(unknowns_of(at, touch), row); };
  for_each_force(setting, at, add);
  for_each_middle(at, [&](const SlidingContactLayout::NeutralSpan&, const NodeUnknowns& unknowns, Index row) {
    add_row(unknowns, row);
  });
  for_each_tip_moment(setting, at, add);
  out.holding.clear();
  for (Index k = 0; k < at.index.points; ++k) {
    add(touch_of_contact(setting, at.layout, static_cast<std::size_t>(k)), at.index.moment(k));
    out.holding.push_back(at.index.moment(k));
  }
  out.K = with_rows_behind(out.inner->K, entries, at.index.multipliers());
  out.pattern_of = at.state.piece;
}

// F, K, F_λ and B of the mesh in the places that they have among all equations.
void take_over(const Linearization& mesh, const SlidingState& at, Linearization& out) {
  const Index n = at.index.nodes;
  out.F.resize(at.index.size());
  out.F.head(n) = mesh.F;
  out.F_lambda.setZero(at.index.size());
  out.F_lambda.head(n) = mesh.F_lambda;
  out.B.setZero(at.index.of_K(), at.index.points);
  out.B.topRows(n) = mesh.B;
  copy_values(mesh.K, out.K);
}

}  // namespace

void residual(const SlidingSetting& setting, const SlidingState& at, Eigen::Ref<Vector> F) {
  at.mesh.residual(at.now, F.head(at.index.nodes));
  add_contact(setting, at, F);
}

void linearize(const SlidingSetting& setting, const SlidingState& at, Linearization& out) {
  if (!out.inner) out.inner = std::make_unique<Linearization>();
  Linearization& mesh = *out.inner;
  if (!out.pattern_of || out.pattern_of->layout() != at.state.piece.layout()) mesh.pattern_of.reset();
  at.mesh.linearize(at.now, mesh);
  mesh.pattern_of = at.state.piece;
  if (!out.pattern_of || *out.pattern_of != at.state.piece) lay_out(setting, at, out);

  take_over(mesh, at, out);
  add_contact(setting, at, out.F);
  out.border_rates = border_rates(setting, at);
  for_each_force(setting, at, [&](const Touch& touch, Index p) {
    add_constraint(touch_gap(setting, touch, at).gap, unknowns_of(at, touch), p, at, out);
  });
  for_each_middle(at, [&](const SlidingContactLayout::NeutralSpan& span, const NodeUnknowns& unknowns, Index p) {
    add_constraint(off_halfway(setting, at, span), unknowns, p, at, out);
  });
  for_each_tip_moment(setting, at, [&](const Touch& touch, Index m) {
    add_constraint(touch_gap(setting, touch, at).tilt, unknowns_of(at, touch), m, at, out);
  });
  out.C.setZero(at.index.points, at.index.size());
  for (Index k = 0; k < at.index.points; ++k) {
    const auto point = static_cast<std::size_t>(k);
    const Touch touch = touch_of_contact(setting, at.layout, point);
    add_constraint(touch_gap(setting, touch, at).tilt, unknowns_of(at, touch), at.index.moment(k), at, out);
    if (at.layout.lies_pressed(point)) {
      const double EI = setting.body.bending_stiffness(touch.strand);
      const CurvatureGap bend = curvature_gap(setting, at, point);
      out.C.row(k).head(at.index.nodes) = EI * bend.dx;
      out.C.row(k).tail(at.index.points) = EI * bend.ds;
      out.F_lambda[at.index.coordinate(k)] = EI * bend.dlambda;
    } else {
      out.C(k, at.index.moment(k)) = 1.0;
    }
  }
  for_each_loose(at, [&](const SlidingContactLayout::NeutralSpan& span) {
    out.C(span.first_point, at.index.moment(span.last_point)) = 1.0;
    out.C.row(span.last_point) = moment_of_length(setting, span) * grown_apart_gradient(at, span).dx;
  });
}

}  // namespace arcwall::sliding
