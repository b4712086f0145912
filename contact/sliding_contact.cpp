#include "contact/sliding_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "contact/sliding_layout.hpp"
#include "core/assembly.hpp"

namespace arcwall {

using Span = SlidingContactLayout::Span;
using Bound = SlidingContactLayout::Bound;

namespace {

Vec2 normal(double angle) { return {-std::sin(angle), std::cos(angle)}; }
Vec2 tangent(double angle) { return {std::cos(angle), std::sin(angle)}; }

// Slope angle of a wall and its curvature, with derivatives by x.
struct Bend {
  double angle, angle_x, angle_xx, curvature, curvature_x;
};

Bend bend(const Profile& profile, double x) {
  const Height psi = profile.at(x);
  const double w = 1.0 + psi.first * psi.first, root = std::sqrt(w);
  return {.angle = std::atan(psi.first),
          .angle_x = psi.second / w,
          .angle_xx = psi.third / w - 2.0 * psi.first * psi.second * psi.second / (w * w),
          .curvature = psi.second / (w * root),
          .curvature_x = psi.third / (w * root) - 3.0 * psi.first * psi.second * psi.second / (w * w * root)};
}

// The point of a section that looks at a wall: its normal looks along the wall's or against it, with the direction of
// travel.
Vec2 face(double offset, const AxisPlace& place) {
  return place.position + (std::cos(place.angle) >= 0.0 ? offset : -offset) * normal(place.angle);
}

// Where the body does not lie on the wall; before a point contact.
SlidingMesh::At free_side(const SlidingContactLayout& on, std::size_t point) {
  return on.span_before(point) == Span::free ? SlidingMesh::At::before : SlidingMesh::At::behind;
}

double sign_of(Side side) { return side == Side::below ? 1.0 : -1.0; }

}  // namespace

SlidingContact::SlidingContact(const SlidingBody& body, std::vector<Obstacle> obstacles, const ContactScales& scales)
    : body_(body), obstacles_(std::move(obstacles)), scales_(scales) {
  Cut cut;
  for (Index run = 0; run < body.runs(); ++run) {
    cut.push_back({std::max(1, static_cast<int>(std::lround(body.elements_between(run, 0.0, body.length(run)))))});
    for (std::size_t w = 0; w < obstacles_.size(); ++w)
      for (const bool last : {false, true})
        if (obstacles_[w].runs[static_cast<std::size_t>(run)] && !body.end_is_held(run, last))
          tied_.push_back({.run = run, .last = last, .obstacle = w, .travel = 0.0});
  }
  const auto layout = std::make_shared<SlidingContactLayout>(body, body.mesh(cut),
                                                             std::vector<SlidingContactLayout::Point>{}, Vector());
  const Vector rest = body.rest(layout->mesh(), Vector());
  for (Tied& end : tied_) {
    constexpr double vertical = 1e-6;
    const double along =
        std::cos(layout->mesh().node(end.run, end.last ? layout->mesh().nodes(end.run) - 1 : 0, rest).angle);
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
  const auto here =
      std::make_shared<SlidingContactLayout>(body_, body_.mesh(on.mesh().cut()), on.points(), on.s_of(state));
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

// --- kinematics of contact ------------------------------------------------------------------------------------------

// Of the face that looks at the obstacle, along the wall's normal (upwards).
double SlidingContact::normal_offset(std::size_t obstacle, Index run) const {
  return obstacles_[obstacle].on_face ? -sign_of(obstacles_[obstacle].side) * body_.half_height(run) : 0.0;
}

SlidingContact::Touch SlidingContact::touch(const SlidingContactLayout& on, std::size_t j) const {
  if (j < on.points().size()) {
    const auto [run, position] = on.mesh().breakpoint(static_cast<Index>(j));
    const std::size_t obstacle = on.points()[j].obstacle;
    return {.run = run, .position = position, .obstacle = obstacle, .offset = normal_offset(obstacle, run)};
  }
  const Tied& end = tied_[j - on.points().size()];
  return {.run = end.run,
          .position = end.last ? on.mesh().nodes(end.run) - 1 : 0,
          .obstacle = end.obstacle,
          .offset = normal_offset(end.obstacle, end.run)};
}

double SlidingContact::face_gap(const Touch& touch, const AxisPlace& place) const {
  const Vec2 at = face(touch.offset, place);
  const Obstacle& obstacle = obstacles_[touch.obstacle];
  return obstacle.profile->covers(at.x()) ? surface_gap(*obstacle.profile, obstacle.side, at).value : infinity;
}

// The face r + o n(θ) with ∂n/∂θ = −t; the tilt is θ − φ(x of the face), φ the wall's slope.
SlidingContact::NodeGap SlidingContact::node_gap(const Touch& touch, const Vector& x,
                                                 const SlidingContactLayout& on) const {
  const AxisPlace place = on.mesh().node(touch.run, touch.position, x);
  const Obstacle& obstacle = obstacles_[touch.obstacle];
  const Vec2 n = normal(place.angle), t = tangent(place.angle);
  const double o = t.x() >= 0.0 ? touch.offset : -touch.offset;
  const Vec2 face = place.position + o * n;
  const SurfaceGap g = surface_gap(*obstacle.profile, obstacle.side, face);
  const Bend wall = bend(*obstacle.profile, face.x());

  NodeGap out;
  out.gap = g.value;
  out.angle = place.angle - wall.angle;
  out.tilt = std::remainder(out.angle, pi);
  out.gap_gradient << g.x, g.z, -o * (g.x * t.x() + g.z * t.y());
  out.tilt_gradient << -wall.angle_x, 0.0, 1.0 + wall.angle_x * o * t.x();
  const double sway = o * t.x();  // of the face against x, by angle
  out.tilt_hessian.setZero();
  out.tilt_hessian(0, 0) = -wall.angle_xx;
  out.tilt_hessian(0, 2) = out.tilt_hessian(2, 0) = wall.angle_xx * sway;
  out.tilt_hessian(2, 2) = -wall.angle_xx * sway * sway + wall.angle_x * o * n.x();
  out.gap_hessian.setZero();
  out.gap_hessian(0, 0) = g.xx;
  out.gap_hessian(0, 1) = out.gap_hessian(1, 0) = g.xz;
  out.gap_hessian(0, 2) = out.gap_hessian(2, 0) = -o * (g.xx * t.x() + g.xz * t.y());
  out.gap_hessian(1, 2) = out.gap_hessian(2, 1) = -o * g.xz * t.x();
  out.gap_hessian(2, 2) = o * o * (g.xx * t.x() * t.x() + 2.0 * g.xz * t.x() * t.y()) - o * (g.x * n.x() + g.z * n.y());
  return out;
}

// ± (κ − λ κ̂): κ the body's curvature and λ its stretch by stress-free length, κ̂ the curvature of the curve at the
// face's distance from the wall, on which the axis would lie. Travel against x turns the sign of κ.
SlidingContact::CurvatureGap SlidingContact::curvature_gap(const State& state, std::size_t k) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Vector x = on.x_of(state), s = on.s_of(state);
  const Touch at = touch(on, k);
  const AxisPlace place = on.mesh().node(at.run, at.position, x);
  const double travel = std::cos(place.angle) >= 0.0 ? 1.0 : -1.0, offset = travel * at.offset;
  const double side = sign_of(obstacles_[at.obstacle].side);
  const AxisStrain strain = on.mesh().strain(static_cast<Index>(k), free_side(on, k), x, s, state.lambda);
  const Bend wall = bend(*obstacles_[at.obstacle].profile, (place.position + offset * normal(place.angle)).x());
  const double shrink = 1.0 / (1.0 + at.offset * wall.curvature);
  const double parallel = wall.curvature * shrink, parallel_x = wall.curvature_x * shrink * shrink;

  CurvatureGap out{.value = side * (travel * strain.curvature - strain.stretch * parallel)};
  out.dx = side * (travel * strain.curvature_dx - parallel * strain.stretch_dx);
  out.ds = side * (travel * strain.curvature_ds - parallel * strain.stretch_ds);
  out.dlambda = side * (travel * strain.curvature_dlambda - parallel * strain.stretch_dlambda);
  const NodeUnknowns unknowns = on.mesh().node_unknowns(at.run, at.position);
  out.dx[unknowns[0]] -= side * strain.stretch * parallel_x;
  out.dx[unknowns[2]] += side * strain.stretch * parallel_x * offset * std::cos(place.angle);
  return out;
}

// In terms of a moment.
double SlidingContact::bending_gap(const State& state, std::size_t k) const {
  const Index run = layout(state.piece).mesh().breakpoint(static_cast<Index>(k)).first;
  return body_.bending_stiffness(run) * curvature_gap(state, k).value;
}

// Force per length that would hold the body on the wall at point k: ± [EI (κ̂″ − κ₀″) + P κ̂ − q·n], q the load along
// the body. Its sign says whether the body lies on the wall there, its vanishing that it does so by itself.
double SlidingContact::pressure(const State& state, std::size_t k) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Vector x = on.x_of(state), s = on.s_of(state);
  const Touch at = touch(on, k);
  const AxisPlace place = on.mesh().node(at.run, at.position, x);
  const double travel = std::cos(place.angle) >= 0.0 ? 1.0 : -1.0;
  const double L = body_.length(at.run), step = 0.01 * L, S = s[static_cast<Index>(k)];
  const Profile& profile = *obstacles_[at.obstacle].profile;
  const auto second = [step](const auto& f) { return (f(1.0) - 2.0 * f(0.0) + f(-1.0)) / (step * step); };
  const double natural = second([&](double i) { return body_.natural_curvature({.run = at.run, .s = S + i * step}); });
  const auto wall = [&](double i) {
    const double x_there = place.position.x() + i * step * std::cos(place.angle);
    return profile.covers(x_there) ? bend(profile, x_there).curvature : 0.0;
  };
  const double EI = body_.bending_stiffness(at.run), EA = body_.axial_stiffness(at.run);
  const double thrust =
      -EA * (on.mesh().strain(static_cast<Index>(k), free_side(on, k), x, s, state.lambda).stretch - 1.0);
  const Vec2 up = travel * normal(place.angle);
  const double q =
      sign_of(obstacles_[at.obstacle].side) *
      (EI * (second(wall) - travel * natural) + thrust * wall(0.0) - body_.load(at.run, state.lambda).dot(up));
  const double noise = 1e-7 * EI / (L * L * L);
  return std::abs(q) > noise ? q : 0.0;
}

double SlidingContact::wall_curvature(const State& state, std::size_t k) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Touch at = touch(on, k);
  const AxisPlace place = on.mesh().node(at.run, at.position, on.x_of(state));
  return bend(*obstacles_[at.obstacle].profile, place.position.x()).curvature;
}

// Whether the body needs no pressure to lie on a straight wall behind point k.
bool SlidingContact::lies_by_itself(const State& state, std::size_t k) const {
  return pressure(state, k) == 0.0 && wall_curvature(state, k) == 0.0;
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
    visit(Touch{.run = node.run,
                .position = node.position,
                .obstacle = node.obstacle,
                .offset = normal_offset(node.obstacle, node.run)},
          at++);
}

void SlidingContact::residual(const State& state, Eigen::Ref<Vector> F) const {
  const SlidingContactLayout& on = layout(state.piece);
  on.mesh().residual(on.x_of(state), on.s_of(state), state.lambda, F.head(on.mesh().unknowns()));
  add_contact(state, F);
}

// The forces on the structure, and the equations of contact.
void SlidingContact::add_contact(const State& state, Eigen::Ref<Vector> F) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Index m = border_width(state.piece);
  const Vector x = on.x_of(state);
  const auto add = [&](const Touch& at, const Eigen::Vector3d& gradient, double force) {
    const NodeUnknowns unknowns = on.mesh().node_unknowns(at.run, at.position);
    for (std::size_t i = 0; i < 3; ++i)
      if (unknowns[i] >= 0) F[unknowns[i]] -= force * gradient[static_cast<Index>(i)];
  };
  for_each_force(state, [&](const Touch& at, Index p) {
    const NodeGap gap = node_gap(at, x, on);
    add(at, gap.gap_gradient, state.x[p]);
    F[p] = -gap.gap;
  });
  const Index moments = F.size() - 2 * m;
  for (Index k = 0; k < m; ++k) {
    const Touch at = touch(on, static_cast<std::size_t>(k));
    const NodeGap gap = node_gap(at, x, on);
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
  const Vector x = on.x_of(state);
  on.mesh().linearize(x, on.s_of(state), state.lambda, inner);
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
  const auto add_row = [&](const Touch& at, const Eigen::Vector3d& gradient, Index row) {
    const NodeUnknowns unknowns = on.mesh().node_unknowns(at.run, at.position);
    for (std::size_t i = 0; i < 3; ++i)
      if (unknowns[i] >= 0) out.K.coeffRef(row, unknowns[i]) = -gradient[static_cast<Index>(i)];
  };
  const auto add_hessian = [&](const Touch& at, const Eigen::Matrix3d& hessian, double force) {
    const NodeUnknowns unknowns = on.mesh().node_unknowns(at.run, at.position);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        if (unknowns[i] < 0 || unknowns[j] < 0) continue;
        const double h = hessian(static_cast<Index>(i), static_cast<Index>(j));
        if (h != 0.0)
          out.K.coeffRef(std::max(unknowns[i], unknowns[j]), std::min(unknowns[i], unknowns[j])) -= force * h;
      }
  };
  for_each_force(state, [&](const Touch& at, Index p) {
    const NodeGap gap = node_gap(at, x, on);
    add_row(at, gap.gap_gradient, p);
    add_hessian(at, gap.gap_hessian, state.x[p]);
  });
  const Index moments = size - 2 * m;
  out.C.setZero(m, size);
  for (Index k = 0; k < m; ++k) {
    const Touch at = touch(on, static_cast<std::size_t>(k));
    const NodeGap gap = node_gap(at, x, on);
    add_row(at, gap.tilt_gradient, moments + k);
    add_hessian(at, gap.tilt_hessian, state.x[moments + k]);
    if (on.lies_pressed(static_cast<std::size_t>(k))) {
      const double EI = body_.bending_stiffness(at.run);
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
    for (const Index unknown : on.mesh().node_unknowns(at.run, at.position))
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
  return on.mesh().energy(on.x_of(state), on.s_of(state), state.lambda);
}

// Of −tilt: the axis goes on by the stretch along its tangent and turns by its curvature. Where the body lies on the
// wall, and where it is about to, the tilt is held.
Vector SlidingContact::border_rates(const State& state) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Vector x = on.x_of(state), s = on.s_of(state);
  Vector rates = Vector::Zero(border_width(state.piece));
  for (Index k = 0; k < rates.size(); ++k) {
    const auto point = static_cast<std::size_t>(k);
    if (on.lies_beside(point)) continue;
    const Touch at = touch(on, point);
    const AxisStrain strain = on.mesh().strain(k, free_side(on, point), x, s, state.lambda);
    const double angle = on.mesh().node(at.run, at.position, x).angle, travel = std::cos(angle) >= 0.0 ? 1.0 : -1.0;
    const Vec2 along = strain.stretch * tangent(angle);
    const double rate = node_gap(at, x, on).tilt_gradient.dot(Eigen::Vector3d(along.x(), along.y(), strain.curvature));
    constexpr double touching = 1e-9;  // a line is about to form, or has just vanished
    if (sign_of(obstacles_[at.obstacle].side) * travel * rate * scales_.length > touching) rates[k] = -rate;
  }
  return rates;
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
  const double gap = face_gap(at, on.mesh().node(at.run, at.position, on.x_of(state)));
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
  const Vector x = on.x_of(state);
  if (!std::isfinite(face_gap(at, on.mesh().node(at.run, at.position, x)))) return row;
  const NodeGap gap = node_gap(at, x, on);
  const NodeUnknowns unknowns = on.mesh().node_unknowns(at.run, at.position);
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

std::optional<std::string> SlidingContact::obstruction(const State& state) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Vector x = on.x_of(state);
  for (std::size_t j = 0; j < state.piece.size(); ++j) {
    const Touch at = touch(on, j);
    if (state.piece[j] && !std::isfinite(face_gap(at, on.mesh().node(at.run, at.position, x)))) return "wall_end";
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
  return Lifting{.obstacle = held.obstacle, .at = {.run = held.run, .s = least_pressure_place(state, limit.which)}};
}

ContactLabel SlidingContact::label(const State& state, Index j) const {
  const auto named = [this](std::size_t obstacle, const MaterialPoint& at) -> ContactLabel {
    const auto [member, fraction] = body_.label(at);
    return {.wall = obstacles_[obstacle].name, .member = member, .fraction = fraction};
  };
  if (const auto least = lifting(state, j)) return named(least->obstacle, least->at);
  const SlidingContactLayout& on = layout(state.piece);
  const Touch at = touch(on, static_cast<std::size_t>(j));
  return named(at.obstacle, {.run = at.run, .s = on.mesh().coordinate(at.run, at.position, on.s_of(state))});
}

Vec2 SlidingContact::place(const State& state, Index j) const {
  const SlidingContactLayout& on = layout(state.piece);
  if (const auto least = lifting(state, j))
    return face(normal_offset(least->obstacle, least->at.run),
                on.mesh().place(least->at, on.x_of(state), on.s_of(state)));
  const Touch at = touch(on, static_cast<std::size_t>(j));
  return face(at.offset, on.mesh().node(at.run, at.position, on.x_of(state)));
}

double SlidingContact::force(const State& state, Index j) const {
  const auto p = multiplier_index(state.piece, j);
  return p ? state.x[*p] : 0.0;
}

std::vector<SlidingContact::HeldNode> SlidingContact::held_nodes(const State& state) const {
  const SlidingContactLayout& on = layout(state.piece);
  const Vector x = on.x_of(state), s = on.s_of(state);
  std::vector<HeldNode> nodes;
  Index force = on.mesh().unknowns() + state.piece.closed_count();
  for (const SlidingContactLayout::Held& held : on.held()) {
    const auto coordinate = [&](Index position) { return on.mesh().coordinate(held.run, position, s); };
    const auto [member, fraction] = body_.label({.run = held.run, .s = coordinate(held.position)});
    nodes.push_back({.label = {.wall = obstacles_[held.obstacle].name,
                               .member = member,
                               .fraction = fraction,
                               .tributary = 0.5 * (coordinate(held.position + 1) - coordinate(held.position - 1))},
                     .place = face(normal_offset(held.obstacle, held.run), on.mesh().node(held.run, held.position, x)),
                     .force = state.x[force++]});
  }
  return nodes;
}

}  // namespace arcwall
