#include "contact/sliding/equations.hpp"

#include <algorithm>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/neutral_spans.hpp"
#include "contact/sliding/pinches.hpp"
#include "contact/sliding/rubbing.hpp"
#include "contact/sliding/tips.hpp"
#include "contact/sliding/touch.hpp"
#include "core/algebra/assembly.hpp"

namespace arcwall::sliding {

namespace {

using NeutralSpan = SlidingContactLayout::NeutralSpan;

// σ − w.
NodeFunction off_held_place(const SlidingSetting& setting, const SlidingState& at, const Touch& touch,
                            std::size_t contact) {
  const double w = at.state.x[*at.index.place(contact)];
  NodeFunction place = touched_place(setting, touch, at, w);
  place.value -= w;
  return place;
}

// visit(function of a node, its touch, index of the multiplier) for all constraints −f = 0 of nodes: gaps, neutral
// spans' middles, places and directions at pinches, places that friction holds, tangency.
template <typename Visit>
void for_each_constraint(const SlidingSetting& setting, const SlidingState& at, const Visit& visit) {
  const auto visit_gap = [&](const Touch& touch, Index force) {
    visit([&] { return touch_gap(setting, touch, at).gap; }, touch, force);
  };
  const auto visit_tilt = [&](const Touch& touch, Index moment) {
    visit([&] { return touch_gap(setting, touch, at).tilt; }, touch, moment);
  };
  const SlidingContactLayout& on = at.layout;
  for (std::size_t j = 0; j < at.contacts(); ++j)
    if (at.is_closed(j) && !on.is_pinched(j)) visit_gap(touch_of_contact(setting, on, j), *at.index.force(j));
  for (std::size_t i = 0; i < on.pressed_nodes().size(); ++i)
    visit_gap(touch_of_node(setting, on.pressed_nodes()[i]), at.index.pressed_force(i));
  for (std::size_t i = 0; i < on.neutral_spans().size(); ++i) {
    const NeutralSpan& span = on.neutral_spans()[i];
    const Touch middle{.strand = span.strand,
                       .position = span.middle,
                       .obstacle = on.points()[span.end_point()].obstacle,
                       .offset = 0.0};
    visit([&] { return off_halfway(setting, at, span); }, middle, at.index.holding_force(i));
  }
  for (std::size_t i = 0; i < on.pinched_points().size(); ++i) {
    const std::size_t k = on.pinched_points()[i];
    const Touch touch = touch_of_contact(setting, on, k);
    if (at.is_closed(k)) visit([&] { return off_pinch(setting, at, k).across; }, touch, *at.index.force(k));
    visit([&] { return off_pinch(setting, at, k).along; }, touch, at.index.force_along(i));
    if (holds_direction(setting, on, k))
      visit([&] { return off_pinch(setting, at, k).turned; }, touch, at.index.moment(static_cast<Index>(k)));
  }
  // Free to turn, a tip up to which a part is pressed would leave the nodes beside it with forces 13, −4, 1 % off.
  for (std::size_t i = 0; i < on.pressed_tips().size(); ++i)
    visit_tilt(touch_of_tip(setting, on.pressed_tips()[i]), at.index.tip_moment(i));
  if (at.index.rubbing > 0)
    for (std::size_t j = 0; j < at.contacts(); ++j) {
      if (!at.rubs(j)) continue;
      const Touch touch = touch_of_contact(setting, on, j);
      visit([&, j] { return off_held_place(setting, at, touch, j); }, touch, *at.index.friction(j));
    }
  for (std::size_t k = 0; k < on.points().size(); ++k)
    if (!on.is_pinched(k)) visit_tilt(touch_of_contact(setting, on, k), at.index.moment(static_cast<Index>(k)));
}

NodeUnknowns unknowns_at(const Touch& touch, const SlidingState& at) {
  return at.mesh.node_unknowns(touch.strand, touch.position);
}

// visit(index of the multiplier) for the moments at knife edges, which are 0. As a soft spring would have it, −m c = 0,
// so that they count among the multipliers of K like all others.
template <typename Visit>
void for_each_free_direction(const SlidingSetting& setting, const SlidingState& at, const Visit& visit) {
  for (const std::size_t k : at.layout.pinched_points())
    if (!holds_direction(setting, at.layout, k)) visit(at.index.moment(static_cast<Index>(k)));
}

// visit(tilt of the axis against the obstacle, the node's unknowns, c) for all contacts at joints where the face goes
// on from one strand into the next: contact leaves such a joint as soon as the axis tilts, so that up to there it
// resists the tilt like a spring, by (8.8).
template <typename Visit>
void for_each_joint_passed(const SlidingSetting& setting, const SlidingState& at, const Visit& visit) {
  const std::size_t points = at.layout.points().size();
  for (std::size_t j = 0; j < setting.free_ends.size(); ++j) {
    const FreeEnd& end = setting.free_ends[j];
    if (!at.is_closed(points + j) || !face_goes_on(setting, at, end)) continue;
    const Touch touch = touch_of_end(setting, at.layout, end);
    const double c = at.force(points + j) * slide_by_tilt(setting, at, end);
    visit(touch_gap(setting, touch, at).tilt, unknowns_at(touch, at), c);
  }
}

double compliance(const SlidingSetting& setting) { return 1.0 / (setting.scales.force * setting.scales.length); }

// The loose span at one of whose ends point k is, if it is.
const NeutralSpan* loose_span_at(const SlidingState& at, Index k) {
  const auto& spans = at.layout.neutral_spans();
  const auto found = std::find_if(spans.begin(), spans.end(), [&](const NeutralSpan& span) {
    return at.layout.is_loose(span) && (span.first_point == k || span.last_point == k);
  });
  return found == spans.end() ? nullptr : &*found;
}

// The moments m₁ and m₂ at the ends of a loose span are equal by symmetry: m₁ + m₂ = 0 says all of them, and (8.6b),
// written as a moment, where the span is.
BorderEquation loose_equation(const SlidingSetting& setting, const SlidingState& at, const NeutralSpan& span, Index k) {
  BorderEquation equation{.row = at.no_slope()};
  if (k == span.first_point) {
    equation.value = at.moment(span.first_point) + at.moment(span.last_point);
    equation.row.dx[at.index.moment(span.first_point)] = 1.0;
    equation.row.dx[at.index.moment(span.last_point)] = 1.0;
  } else {
    const double L = setting.body.length(span.strand);
    const double moment = setting.body.bending_stiffness({.strand = span.strand, .s = 0.5 * L}) / (L * L);
    equation.value = moment * grown_apart(at, span);
    equation.row.dx = moment * grown_apart_gradient(at, span).dx;
  }
  return equation;
}

// What says where point k is along the body: m = 0, EI (κ̂ − κ) = 0, at a pinch that the energy is stationary, and what
// loose spans have instead.
BorderEquation border_equation(const SlidingSetting& setting, const SlidingState& at, Index k) {
  const auto point = static_cast<std::size_t>(k);
  if (at.layout.is_pinched(point)) return energy_by_sliding(setting, at, point);
  if (const NeutralSpan* loose = loose_span_at(at, k)) return loose_equation(setting, at, *loose, k);
  BorderEquation equation{.row = at.no_slope()};
  if (at.layout.lies_pressed(point)) {
    const MaterialPoint here{.strand = at.mesh.breakpoint(k).first, .s = at.s(k)};
    const double EI = setting.body.bending_stiffness(here);
    const CurvatureGap bend = curvature_gap_gradient(setting, at, point);
    equation.value = EI * bend.value;
    bend.add_to(equation.row, EI, at.index);
    equation.row.dx[at.index.coordinate(k)] += setting.body.stiffness(here, 1).EI * bend.value;
  } else {
    equation.value = at.moment(k);
    equation.row.dx[at.index.moment(k)] = 1.0;
  }
  return equation;
}

// A constraint in F: its equation, and what its multiplier does to the node.
void add_to_residual(const NodeFunction& constraint, const NodeUnknowns& unknowns, Index multiplier,
                     const SlidingState& at, Eigen::Ref<Vector> F) {
  add_at_node(unknowns, -at.state.x[multiplier] * constraint.gradient, F);
  F[multiplier] = -constraint.value;
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
  for_each_constraint(setting, at, [&](const auto&, const Touch& touch, Index row) {
    for (const Index unknown : unknowns_at(touch, at))
      if (unknown >= 0) entries.push_back({.row = row - at.index.nodes, .column = unknown});
  });
  out.holding.clear();
  out.energetic.clear();
  for (Index i = 0; i < at.index.rubbing; ++i) {
    out.holding.push_back(at.index.moment(0) - at.index.rubbing + i);
    out.energetic.push_back(false);
  }
  for (Index k = 0; k < at.index.points; ++k) {
    out.holding.push_back(at.index.moment(k));
    out.energetic.push_back(at.layout.is_pinched(static_cast<std::size_t>(k)));
  }
  out.K = with_rows_behind(out.inner->K, entries, at.index.behind_mesh());
  out.pattern_of = at.state.active_set;
}

// F, K, F_λ and B of the mesh in the places that they have among all equations.
void take_over(const Linearization& mesh, const SlidingState& at, Linearization& out) {
  const Index n = at.index.nodes;
  out.F.resize(at.index.size());
  out.F.head(n) = mesh.F;
  out.F_lambda.setZero(at.index.size());
  out.F_lambda.head(n) = mesh.F_lambda;
  out.B.setZero(at.index.of_K(), at.index.border());
  out.B.topRightCorner(n, at.index.points) = mesh.B;
  copy_values(mesh.K, out.K);
}

// A force f and a couple at a node, as the gradient of a constraint by the node has them, and their moment about a
// point:
//
//     (f_x, f_z, arm × f + couple).
Eigen::Vector3d with_moment(const Vec2& arm, const Eigen::Vector3d& at_node) {
  return {at_node[0], at_node[1], cross(arm, at_node.head<2>()) + at_node[2]};
}

// What the multiplier of a constraint does to its node, μ ∂f/∂(x, z, θ).
void add_to_action(const NodeFunction& constraint, const Touch& touch, Index multiplier, const SlidingState& at,
                   const Vec2& about, WallAction& action) {
  const double force = at.state.x[multiplier];
  const Vec2 arm = touch.axis(at).position - about;
  const Eigen::Vector3d exerted = force * constraint.gradient;
  const auto add = [&](const Eigen::Vector3d& rate, const Vec2& velocity, auto&& to) {
    const Eigen::Vector3d moved = with_moment(arm, rate);
    for (std::size_t i = 0; i < 3; ++i) to(action.gradient[i]) += moved[static_cast<Index>(i)];
    to(action.gradient[2]) += cross(velocity, exerted.head<2>());
  };
  for (std::size_t i = 0; i < 3; ++i) action.value[i] += with_moment(arm, exerted)[static_cast<Index>(i)];
  add(constraint.gradient, Vec2::Zero(), [&](Row& row) -> double& { return row.dx[multiplier]; });
  const NodeUnknowns unknowns = unknowns_at(touch, at);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 velocity(i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0);
    if (unknowns[i] >= 0)
      add(force * constraint.hessian.col(static_cast<Index>(i)), velocity,
          [&](Row& row) -> double& { return row.dx[unknowns[i]]; });
  }
  add(force * constraint.gradient_rate, at.mesh.node_rate(touch.strand, touch.position).head<2>(),
      [](Row& row) -> double& { return row.dlambda; });
}

// Of the two obstacles of a pinch the one that presses.
std::size_t obstacle_that_acts(const SlidingSetting& setting, const SlidingState& at, const Touch& touch) {
  for (const std::size_t k : at.layout.pinched_points()) {
    const auto [strand, position] = at.mesh.breakpoint(static_cast<Index>(k));
    if (strand != touch.strand || position != touch.position) continue;
    return obstacles_at(setting, at.layout, k)[pinching_force(setting, at, k).value < 0.0 ? 1 : 0];
  }
  return touch.obstacle;
}

}  // namespace

WallAction wall_action(const SlidingSetting& setting, const SlidingState& at, const ContactsOfWall& of,
                       const Vec2& about) {
  WallAction action(at.state.x.size());
  const auto includes = [&](const Touch& touch) {
    const std::string& wall = setting.obstacles[obstacle_that_acts(setting, at, touch)].name;
    if (!of.includes_wall(wall)) return false;
    if (of.member.empty()) return true;
    const double s = at.mesh.coordinate(touch.strand, touch.position, at.now.s);
    const auto [member, fraction] = setting.body.label({.strand = touch.strand, .s = s});
    return of.includes({.wall = wall, .member = member, .fraction = fraction});
  };
  // No wall exerts the couple that keeps an open point where its gap is least, and is zero to round-off.
  const auto is_of_open_point = [&](Index multiplier) {
    const Index k = at.index.points > 0 ? multiplier - at.index.moment(0) : -1;
    const auto point = static_cast<std::size_t>(k);
    return k >= 0 && k < at.index.points && !at.is_closed(point) && !at.layout.is_pinched(point);
  };
  for_each_constraint(setting, at, [&](const auto& function, const Touch& touch, Index multiplier) {
    if (!is_of_open_point(multiplier) && includes(touch))
      add_to_action(function(), touch, multiplier, at, about, action);
  });
  return action;
}

namespace {

void add_friction_to_residual(const SlidingSetting& setting, const SlidingState& at, Eigen::Ref<Vector> F) {
  for (std::size_t j = 0; j < at.contacts(); ++j)
    if (const auto w = at.index.place(j)) F[*w] = law_of_friction(setting, at, j).value;
}

// The border of places that friction holds: their columns in the rows of T, and the laws of friction.
void add_friction(const SlidingSetting& setting, const SlidingState& at, Linearization& out) {
  const Index n = at.index.of_K();
  out.rolling.clear();
  out.slip_senses.resize(0);
  if (at.index.rubbing == 0) return;
  for (std::size_t j = 0; j < at.contacts(); ++j) {
    const auto w = at.index.place(j);
    if (!w) continue;
    const LawOfFriction law = law_of_friction(setting, at, j);
    out.F[*w] = law.value;
    out.F_lambda[*w] = law.row.dlambda;
    out.C.row(*w - n) = law.row.dx.transpose();
    out.B(*at.index.friction(j), *w - n) = 1.0;
    const ContactMode mode = at.layout.rubbing(j).mode;
    if (slips(mode) && out.slip_senses.size() == 0) out.slip_senses = Vector::Zero(at.index.border());
    if (slips(mode)) out.slip_senses[*w - n] = slip_sense(mode);
    if (!moves_along_body(at, j)) continue;
    const auto point = static_cast<Index>(j);
    out.rolling.push_back({.place = *w - n,
                           .coordinate = at.index.coordinate(point) - n,
                           .stretch = body_sense(setting, at, j) * mean_stretch(setting, at, j)});
  }
}

}  // namespace

void residual(const SlidingSetting& setting, const SlidingState& at, Eigen::Ref<Vector> F) {
  at.mesh.residual(at.now, F.head(at.index.nodes));
  for_each_constraint(setting, at, [&](const auto& function, const Touch& touch, Index multiplier) {
    add_to_residual(function(), unknowns_at(touch, at), multiplier, at, F);
  });
  for_each_joint_passed(setting, at, [&](const NodeFunction& tilt, const NodeUnknowns& unknowns, double c) {
    add_at_node(unknowns, c * tilt.value * tilt.gradient, F);
  });
  for_each_free_direction(setting, at, [&](Index m) { F[m] = -at.state.x[m] * compliance(setting); });
  if (at.index.rubbing > 0) add_friction_to_residual(setting, at, F);
  for (Index k = 0; k < at.index.points; ++k) F[at.index.coordinate(k)] = border_equation(setting, at, k).value;
}

void linearize(const SlidingSetting& setting, const SlidingState& at, Linearization& out) {
  if (!out.inner) out.inner = std::make_unique<Linearization>();
  Linearization& mesh = *out.inner;
  if (!out.pattern_of || out.pattern_of->layout() != at.state.active_set.layout()) mesh.pattern_of.reset();
  at.mesh.linearize(at.now, mesh);
  mesh.pattern_of = at.state.active_set;
  if (!out.pattern_of || *out.pattern_of != at.state.active_set) lay_out(setting, at, out);

  take_over(mesh, at, out);
  out.border_rates = Vector::Zero(at.index.border());  // T truly holds
  out.border_rates.tail(at.index.points) = border_rates(setting, at);
  for_each_constraint(setting, at, [&](const auto& function, const Touch& touch, Index multiplier) {
    const NodeFunction constraint = function();
    const NodeUnknowns unknowns = unknowns_at(touch, at);
    add_to_residual(constraint, unknowns, multiplier, at, out.F);
    add_constraint(constraint, unknowns, multiplier, at, out);
  });
  for_each_joint_passed(setting, at, [&](const NodeFunction& tilt, const NodeUnknowns& unknowns, double c) {
    add_at_node(unknowns, c * tilt.value * tilt.gradient, out.F);
    add_hessian(unknowns, tilt.gradient * tilt.gradient.transpose() + tilt.value * tilt.hessian, -c, out.K);
    add_at_node(unknowns, c * (tilt.rate * tilt.gradient + tilt.value * tilt.gradient_rate), out.F_lambda);
  });
  for_each_free_direction(setting, at, [&](Index m) {
    out.F[m] = -at.state.x[m] * compliance(setting);
    out.K.coeffRef(m, m) = -compliance(setting);
  });
  out.C.resize(at.index.border(), at.index.size());
  add_friction(setting, at, out);
  for (Index k = 0; k < at.index.points; ++k) {
    const BorderEquation equation = border_equation(setting, at, k);
    out.F[at.index.coordinate(k)] = equation.value;
    out.C.row(at.index.rubbing + k) = equation.row.dx.transpose();
    out.F_lambda[at.index.coordinate(k)] = equation.row.dlambda;
  }
}

}  // namespace arcwall::sliding
