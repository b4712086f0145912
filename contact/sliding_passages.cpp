// What bounds a piece of sliding contact besides gaps and forces, and the pieces that lie behind.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "contact/sliding_contact.hpp"
#include "contact/sliding_layout.hpp"
#include "core/text.hpp"

namespace arcwall {

using Layout_ = SlidingContactLayout;
using Span = SlidingContactLayout::Span;
using Bound = SlidingContactLayout::Bound;
using Point = SlidingContactLayout::Point;

namespace {

constexpr double shortest_flat = 0.8;  // of a half wave, below which a flat part has one element

// s of the point behind `k` less that of k.
class SpanLength final : public Observable {
 public:
  explicit SpanLength(std::size_t k) : k_(static_cast<Index>(k)) {}
  double value(const State& state) const override {
    const Index first = state.x.size() - mesh_of(state).breakpoints();
    return state.x[first + k_ + 1] - state.x[first + k_];
  }
  Row gradient(const State& state) const override {
    const Index first = state.x.size() - mesh_of(state).breakpoints();
    Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
    row.dx[first + k_ + 1] = 1.0;
    row.dx[first + k_] = -1.0;
    return row;
  }

 private:
  Index k_;
};

class Guard final : public Observable {
 public:
  Guard(const System& system, Index j) : system_(system), j_(j) {}
  double value(const State& state) const override { return system_.guards(state)[j_]; }
  Row gradient(const State& state) const override { return system_.guard_gradient(state, j_); }

 private:
  const System& system_;
  Index j_;
};

// The least value in [0, 1] of the cubic with these end values and slopes, where it has one inside.
struct Least {
  double at, value;
};

std::optional<Least> least_inside(double v0, double r0, double v1, double r1) {
  const double a = 2.0 * (v0 - v1) + r0 + r1, b = 3.0 * (v1 - v0) - 2.0 * r0 - r1;
  // v′ = r0 + 2 b t + 3 a t²; the root where v″ > 0
  double t;
  const double discriminant = b * b - 3.0 * a * r0;
  if (discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  if (b + root > 0.0) {
    t = -r0 / (b + root);
  } else {
    if (a <= 0.0) return std::nullopt;
    t = (root - b) / (3.0 * a);
  }
  if (!(t >= 0.0 && t <= 1.0)) return std::nullopt;
  return Least{.at = t, .value = v0 + t * (r0 + t * (b + t * a))};
}

}  // namespace

// --- limits ---------------------------------------------------------------------------------------------------------

// Spans below this are points.
double SlidingContact::least_span(Index run) const {
  const double L = body_.length(run);
  return std::max(0.125 * L / body_.elements_between(run, 0.0, L), 1e-3 * L);
}

// Where the force of a held node stands in x.
Index SlidingContact::held_force(const State& state, std::size_t node) const {
  return layout(state.piece).mesh().unknowns() + state.piece.closed_count() + static_cast<Index>(node);
}

double SlidingContact::limit_value(const State& state, std::size_t limit) const {
  const Layout_& on = layout(state.piece);
  const Vector s = on.s_of(state);
  const auto [bound, which] = on.limits()[limit];
  const auto asked = [&] {
    const Layout_::Segment& segment = on.segments()[which];
    const auto [from, to] = on.ends(body_, segment, s);
    return body_.elements_between(segment.run, from, to);
  };
  switch (bound) {
    case Bound::curvature:
      return curvature_gap(state, which).value * scales_.length;
    case Bound::length: {
      const Index k = static_cast<Index>(which), run = on.mesh().breakpoint(k).first;
      return (s[k + 1] - s[k] - least_span(run)) / scales_.length;
    }
    case Bound::coarse:
      return coarsest - asked() / on.segments()[which].elements;
    case Bound::fine:
      return asked() / on.segments()[which].elements - finest;
    case Bound::half_wave:
    case Bound::straight: {
      // (k d/π)², k² = P λ/EI the wave number of a straight part under the thrust P
      const Layout_::Segment& segment = on.segments()[which];
      const Index k = segment.last_point;
      const double d = s[k] - s[k - 1], stretch = on.mesh().strain(k, on.x_of(state), s, state.lambda).stretch;
      const double EA = body_.axial_stiffness(segment.run), EI = body_.bending_stiffness(segment.run);
      const double waves = EA * (1.0 - stretch) * stretch / EI * d * d / (pi * pi);
      return bound == Bound::half_wave ? 1.0 - waves : waves - shortest_flat * shortest_flat;
    }
    case Bound::room:
      return asked() - 0.5;
    case Bound::pressure: {
      // Force over the length that belongs to the node.
      const Layout_::Segment& segment = on.segments()[on.held()[which].segment];
      const double length = (s[segment.last_point] - s[segment.first_point]) / segment.elements;
      return state.x[held_force(state, which)] * scales_.length / (length * scales_.force);
    }
  }
  return 1.0;
}

Row SlidingContact::limit_gradient(const State& state, std::size_t limit) const {
  const Layout_& on = layout(state.piece);
  const Vector s = on.s_of(state);
  const auto [bound, which] = on.limits()[limit];
  const Index n = on.mesh().unknowns(), first_s = state.x.size() - s.size();
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  const auto by_ends = [&](double factor) {
    const Layout_::Segment& segment = on.segments()[which];
    const auto [from, to] = on.ends(body_, segment, s);
    const double step = 1e-6 * body_.length(segment.run);
    const auto density = [&](double S) {
      return body_.elements_between(segment.run, S - step, S + step) / (2.0 * step) * factor;
    };
    if (segment.first_point >= 0) row.dx[first_s + segment.first_point] = -density(from);
    if (segment.last_point >= 0) row.dx[first_s + segment.last_point] = density(to);
  };
  switch (bound) {
    case Bound::curvature: {
      const CurvatureGap gap = curvature_gap(state, which);
      row.dx.head(n) = scales_.length * gap.dx;
      row.dx.tail(s.size()) = scales_.length * gap.ds;
      row.dlambda = scales_.length * gap.dlambda;
      break;
    }
    case Bound::length:
      row.dx[first_s + static_cast<Index>(which)] = -1.0 / scales_.length;
      row.dx[first_s + static_cast<Index>(which) + 1] = 1.0 / scales_.length;
      break;
    case Bound::coarse:
      by_ends(-1.0 / on.segments()[which].elements);
      break;
    case Bound::fine:
      by_ends(1.0 / on.segments()[which].elements);
      break;
    case Bound::half_wave:
    case Bound::straight: {
      const Layout_::Segment& segment = on.segments()[which];
      const Index k = segment.last_point;
      const AxisStrain strain = on.mesh().strain(k, on.x_of(state), s, state.lambda);
      const double EA = body_.axial_stiffness(segment.run), EI = body_.bending_stiffness(segment.run);
      const double sign = bound == Bound::half_wave ? -1.0 : 1.0, d = s[k] - s[k - 1];
      const double factor = sign * EA / EI / (pi * pi), stretch = strain.stretch;
      const double by_stretch = factor * (1.0 - 2.0 * stretch) * d * d;
      row.dx.head(n) = by_stretch * strain.stretch_dx;
      row.dx.tail(s.size()) = by_stretch * strain.stretch_ds;
      row.dlambda = by_stretch * strain.stretch_dlambda;
      row.dx[first_s + k] += factor * (1.0 - stretch) * stretch * 2.0 * d;
      row.dx[first_s + k - 1] -= factor * (1.0 - stretch) * stretch * 2.0 * d;
      break;
    }
    case Bound::room:
      by_ends(1.0);
      break;
    case Bound::pressure: {
      const Layout_::Segment& segment = on.segments()[on.held()[which].segment];
      const double span = s[segment.last_point] - s[segment.first_point], p = state.x[held_force(state, which)];
      const double per_force = scales_.length * segment.elements / (span * scales_.force);
      row.dx[held_force(state, which)] = per_force;
      row.dx[first_s + segment.last_point] = -per_force * p / span;
      row.dx[first_s + segment.first_point] = per_force * p / span;
      break;
    }
  }
  return row;
}

// --- gaps between the nodes -----------------------------------------------------------------------------------------

// visit(Minimum) for each least gap inside an element, the gap being a cubic between its nodes. Beside contact points,
// and where the body lies on the wall, guards say all; these elements are left out unless `everywhere`.
template <typename Visit>
void SlidingContact::for_each_minimum(const State& state, bool everywhere, const Visit& visit) const {
  const Layout_& on = layout(state.piece);
  const SlidingMesh& mesh = on.mesh();
  const Vector x = on.x_of(state), s = on.s_of(state);
  for (std::size_t w = 0; w < obstacles_.size(); ++w)
    for (Index run = 0; run < body_.runs(); ++run) {
      if (!obstacles_[w].runs[static_cast<std::size_t>(run)]) continue;
      std::vector<std::uint8_t> skip(static_cast<std::size_t>(mesh.nodes(run)), 0);  // element behind the node
      for (std::size_t k = 0; k < on.points().size() && !everywhere; ++k) {
        const auto [at, position] = mesh.breakpoint(static_cast<Index>(k));
        if (at != run || on.points()[k].obstacle != w) continue;
        skip[static_cast<std::size_t>(position) - 1] = skip[static_cast<std::size_t>(position)] = 1;
        if (on.points()[k].behind == Span::free) continue;
        const Index last = mesh.breakpoint(static_cast<Index>(k) + 1).second;
        std::fill(skip.begin() + position, skip.begin() + last, std::uint8_t{1});
      }
      const double offset = normal_offset(w, run);
      struct Sample {
        double gap;
        Vec2 place, slope;  // slope: gap per place moved along the tangent
        double rate;
      };
      const auto sample = [&](Index position) {
        const AxisPlace place = mesh.node(run, position, x);
        const Vec2 t = Vec2(std::cos(place.angle), std::sin(place.angle));
        const double o = t.x() >= 0.0 ? offset : -offset;
        const Vec2 face = place.position + o * perp(t);
        Sample out{.gap = infinity, .place = place.position, .slope = Vec2::Zero(), .rate = 0.0};
        if (!obstacles_[w].profile->covers(face.x())) return out;
        const SurfaceGap g = surface_gap(*obstacles_[w].profile, obstacles_[w].side, face);
        out.gap = g.value;
        out.rate = g.x * t.x() + g.z * t.y();
        return out;
      };
      Sample before = sample(0);
      for (Index e = 0; e + 1 < mesh.nodes(run); ++e) {
        const Sample after = sample(e + 1);
        const double length = (after.place - before.place).norm();
        const double r0 = before.rate * length, r1 = after.rate * length;
        const bool far = std::min(before.gap, after.gap) > 0.5 * (std::abs(r0) + std::abs(r1));
        if (!skip[static_cast<std::size_t>(e)] && std::isfinite(before.gap) && std::isfinite(after.gap) &&
            (!far || everywhere))
          if (const auto least = least_inside(before.gap, r0, after.gap, r1)) {
            const double S1 = mesh.coordinate(run, e, s), S2 = mesh.coordinate(run, e + 1, s);
            visit(Minimum{.obstacle = w, .at = {.run = run, .s = S1 + least->at * (S2 - S1)}, .gap = least->value});
          }
        before = after;
      }
    }
}

std::optional<SlidingContact::Minimum> SlidingContact::deepest(const State& state, double margin) const {
  std::optional<Minimum> deepest;
  for_each_minimum(state, false, [&](const Minimum& minimum) {
    if (minimum.gap < margin * scales_.length && (!deepest || minimum.gap < deepest->gap)) deepest = minimum;
  });
  return deepest;
}

bool SlidingContact::admissible(const State& state, double margin) const { return !deepest(state, margin); }

// --- other pieces ---------------------------------------------------------------------------------------------------

// The same shape on another layout.
struct SlidingContact::Redrawn {
  std::shared_ptr<const Layout_> layout{};
  Vector s{};
  std::vector<std::uint8_t> closed{};  // of the layout's points
  std::vector<double> forces{};        // of the layout's points; of open ones left out of account
};

State SlidingContact::redrawn(const State& state, const Redrawn& by) const {
  const Layout_ &from = layout(state.piece), &to = *by.layout;
  const std::size_t points = to.points().size(), before = from.points().size();
  Piece piece(points + tied_.size(), 0, by.layout);
  for (std::size_t k = 0; k < points; ++k) piece[k] = by.closed[k];
  for (std::size_t j = 0; j < tied_.size(); ++j) piece[points + j] = state.piece[before + j];
  State out{.x = Vector::Zero(size(piece)), .lambda = state.lambda, .piece = piece};
  const Index n = to.mesh().unknowns();
  out.x.head(n) = from.mesh().transferred(from.x_of(state), from.s_of(state), to.mesh(), by.s);
  Index p = n;
  for (std::size_t j = 0; j < piece.size(); ++j)
    if (piece[j]) out.x[p++] = j < points ? by.forces[j] : force(state, static_cast<Index>(before + j - points));
  out.x.tail(by.s.size()) = by.s;
  return out;
}

Passage SlidingContact::remeshed(const State& state, const Direction& forward, const Map& map) const {
  constexpr double step = 1e-6;  // [path metric]
  Passage passage{.change = Passage::Change::remeshed, .guess = map(state)};
  const State ahead = map(moved(state, forward, step));
  passage.forward = difference(ahead, passage.guess);
  passage.forward.dx /= step;
  passage.forward.dlambda /= step;
  return passage;
}

std::vector<Passage> SlidingContact::passages(const State& state, const Direction& forward, Index limit,
                                              double tolerance) const {
  const Layout_& on = layout(state.piece);
  const auto contacts = static_cast<Index>(state.piece.size());
  const auto [bound, which] = on.limits()[static_cast<std::size_t>(limit - contacts)];
  switch (bound) {
    case Bound::curvature: {
      if (!state.piece[which]) return {without(state, forward, which)};
      // All point contacts of an equilibrium become lines together; of several only the sum of lengths is determined.
      Index lines = 0;
      for (std::size_t l = 0; l < on.limits().size(); ++l)
        if (on.limits()[l].bound == Bound::curvature && state.piece[on.limits()[l].which] &&
            limit_value(state, l) <= std::max(1e-6, 10.0 * tolerance))
          ++lines;
      for (const Point& point : on.points())
        if (point.behind == Span::flat) ++lines;
      if (lines > 1)
        return {{.change = Passage::Change::family,
                 .detail = std::to_string(lines) +
                           " contacts become lines together: only the sum of their lengths is determined, all such "
                           "equilibria have the energy " +
                           round_trip(energy(state))}};
      return spreads(state, which);
    }
    case Bound::length:
      return {gathered(state, which)};
    case Bound::coarse:
      return {with_elements(state, forward, which, 2 * on.segments()[which].elements)};
    case Bound::fine:
      return {with_elements(state, forward, which, (on.segments()[which].elements + 1) / 2)};
    case Bound::half_wave: {
      const Index run = on.segments()[which].run;
      const double asked = body_.elements_between(run, 0.0, body_.length(run));
      return {with_elements(state, forward, which, std::max(8, static_cast<int>(std::lround(asked))))};
    }
    case Bound::straight:
      return {with_elements(state, forward, which, 1)};
    case Bound::room:
      return {{.change = Passage::Change::unsupported,
               .detail = "a contact point reached the end of its member, or another wall's contact"}};
    case Bound::pressure:
      return {{.change = Passage::Change::unsupported, .detail = "a part that lies on a wall lifts off inside"}};
  }
  return {};
}

namespace {

std::vector<std::uint8_t> closed_points(const State& state, std::size_t points) {
  return {state.piece.begin(), state.piece.begin() + static_cast<std::ptrdiff_t>(points)};
}

template <typename T>
void insert_at(std::vector<T>& values, std::size_t at, T value) {
  values.insert(values.begin() + static_cast<std::ptrdiff_t>(at), value);
}

template <typename T>
void erase_at(std::vector<T>& values, std::size_t at) {
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(at));
}

Vector inserted(const Vector& s, std::size_t at, double value) {
  const auto k = static_cast<Index>(at);
  Vector out(s.size() + 1);
  out << s.head(k), value, s.tail(s.size() - k);
  return out;
}

Vector erased(const Vector& s, std::size_t at) {
  const auto k = static_cast<Index>(at);
  Vector out(s.size() - 1);
  out << s.head(k), s.tail(s.size() - k - 1);
  return out;
}

// Of a layout's points.
std::vector<double> point_forces(const SlidingContact& contact, const State& state, std::size_t points) {
  std::vector<double> forces;
  for (std::size_t k = 0; k < points; ++k) forces.push_back(contact.force(state, static_cast<Index>(k)));
  return forces;
}

}  // namespace

// Where the wall is straight and the body lies on it by itself, the part between is flat; else pressure holds it, or it
// arches off the wall. On a curved wall the axial force, and with it the pressure, may grow with the part: it is then
// begun longer.
std::vector<Passage> SlidingContact::spreads(const State& state, std::size_t k) const {
  const Index run = layout(state.piece).mesh().breakpoint(static_cast<Index>(k)).first;
  const double q = pressure(state, k), length = 2.0 * least_span(run);
  const bool curved = wall_curvature(state, k) != 0.0;
  if (q == 0.0 && !curved) return {spread(state, k, Lying::flat, length)};
  const Passage arches = spread(state, k, Lying::off, length);
  if (q < 0.0 && !curved) return {arches, spread(state, k, Lying::pressed, length)};
  std::vector<Passage> passages;
  for (const double factor : {1.0, 2.0, 4.0, 8.0, 16.0})
    passages.push_back(spread(state, k, Lying::pressed, factor * length));
  passages.push_back(arches);
  return passages;
}

// The point becomes two, a short way apart.
Passage SlidingContact::spread(const State& state, std::size_t k, Lying lying, double length) const {
  const Layout_& on = layout(state.piece);
  const auto [run, position] = on.mesh().breakpoint(static_cast<Index>(k));
  const Span span = lying == Lying::flat ? Span::flat : lying == Lying::pressed ? Span::pressed : Span::free;

  Cut cut = on.mesh().cut();
  const auto first_of_run = static_cast<Index>(
      std::count_if(on.segments().begin(), on.segments().end(),
                    [&](const Layout_::Segment& segment) { return segment.run < run && segment.last_point >= 0; }));
  const std::size_t segment = k - static_cast<std::size_t>(first_of_run);
  insert_at(cut[static_cast<std::size_t>(run)], segment + 1, span == Span::flat ? 1 : 2);
  std::vector<Point> points = on.points();
  insert_at(points, k + 1, points[k]);
  points[k].behind = span;
  const Vector s = on.s_of(state);
  const double middle = s[static_cast<Index>(k)];
  Redrawn by{.s = inserted(s, k, middle - 0.5 * length)};
  by.s[static_cast<Index>(k) + 1] = middle + 0.5 * length;
  by.layout = std::make_shared<Layout_>(body_, body_.mesh(cut), points, by.s);
  by.closed = closed_points(state, on.points().size());
  insert_at(by.closed, k, std::uint8_t{1});
  by.forces = point_forces(*this, state, on.points().size());
  by.forces[k] *= 0.5;
  insert_at(by.forces, k, by.forces[k]);
  Passage passage{.change = Passage::Change::spreads,
                  .contacts = {static_cast<Index>(k)},
                  .guess = redrawn(state, by),
                  .quantity = std::make_shared<SpanLength>(k),
                  .value = length};
  passage.forward = {.dx = Vector::Zero(passage.guess.x.size()), .dlambda = 0.0};
  return passage;
}

Passage SlidingContact::gathered(const State& state, std::size_t k) const {
  const Layout_& on = layout(state.piece);
  const auto [run, position] = on.mesh().breakpoint(static_cast<Index>(k));
  Cut cut = on.mesh().cut();
  const auto at = std::find_if(on.segments().begin(), on.segments().end(), [&](const Layout_::Segment& segment) {
    return segment.first_point == static_cast<Index>(k);
  });
  const auto first = std::find_if(on.segments().begin(), on.segments().end(),
                                  [&](const Layout_::Segment& segment) { return segment.run == at->run; });
  erase_at(cut[static_cast<std::size_t>(run)], static_cast<std::size_t>(at - first));
  std::vector<Point> points = on.points();
  points[k].behind = points[k + 1].behind;
  erase_at(points, k + 1);
  const Vector s = on.s_of(state);
  Redrawn by{.s = erased(s, k + 1)};
  by.s[static_cast<Index>(k)] = 0.5 * (s[static_cast<Index>(k)] + s[static_cast<Index>(k) + 1]);
  by.layout = std::make_shared<Layout_>(body_, body_.mesh(cut), points, by.s);
  by.closed = closed_points(state, on.points().size());
  erase_at(by.closed, k + 1);
  by.forces = point_forces(*this, state, on.points().size());
  by.forces[k] += by.forces[k + 1];
  erase_at(by.forces, k + 1);
  Passage passage{.change = Passage::Change::gathers,
                  .contacts = {static_cast<Index>(k), static_cast<Index>(k) + 1},
                  .guess = redrawn(state, by),
                  .value = 0.0};
  const auto limit = std::find_if(by.layout->limits().begin(), by.layout->limits().end(),
                                  [&](const Layout_::Limit& l) { return l.bound == Bound::curvature && l.which == k; });
  assert(limit != by.layout->limits().end());
  passage.quantity = std::make_shared<Guard>(
      *this, static_cast<Index>(passage.guess.piece.size()) + (limit - by.layout->limits().begin()));
  passage.forward = {.dx = Vector::Zero(passage.guess.x.size()), .dlambda = 0.0};
  return passage;
}

// The extremum that an open point followed is about to vanish.
Passage SlidingContact::without(const State& state, const Direction& forward, std::size_t k) const {
  const Layout_& on = layout(state.piece);
  const Index run = on.mesh().breakpoint(static_cast<Index>(k)).first;
  Cut cut = on.mesh().cut();
  const auto at = std::find_if(on.segments().begin(), on.segments().end(), [&](const Layout_::Segment& segment) {
    return segment.last_point == static_cast<Index>(k);
  });
  const auto first = std::find_if(on.segments().begin(), on.segments().end(),
                                  [&](const Layout_::Segment& segment) { return segment.run == at->run; });
  auto& elements = cut[static_cast<std::size_t>(run)];
  const auto segment = static_cast<std::size_t>(at - first);
  elements[segment] += elements[segment + 1];
  erase_at(elements, segment + 1);
  std::vector<Point> points = on.points();
  erase_at(points, k);
  const auto mesh = body_.mesh(cut);
  const auto layout_ahead = std::make_shared<Layout_>(body_, mesh, points, erased(on.s_of(state), k));
  return remeshed(state, forward, [&](const State& from) {
    Redrawn by{.layout = layout_ahead, .s = erased(on.s_of(from), k)};
    by.closed = closed_points(from, on.points().size());
    erase_at(by.closed, k);
    by.forces = point_forces(*this, from, on.points().size());
    erase_at(by.forces, k);
    return redrawn(from, by);
  });
}

Passage SlidingContact::with_elements(const State& state, const Direction& forward, std::size_t segment,
                                      int elements) const {
  const Layout_& on = layout(state.piece);
  Cut cut = on.mesh().cut();
  const Layout_::Segment& changed = on.segments()[segment];
  const auto first = std::find_if(on.segments().begin(), on.segments().end(),
                                  [&](const Layout_::Segment& other) { return other.run == changed.run; });
  cut[static_cast<std::size_t>(changed.run)][segment - static_cast<std::size_t>(first - on.segments().begin())] =
      elements;
  const auto ahead = std::make_shared<Layout_>(body_, body_.mesh(cut), on.points(), on.s_of(state));
  return remeshed(state, forward, [&](const State& from) {
    return redrawn(from, {.layout = ahead,
                          .s = on.s_of(from),
                          .closed = closed_points(from, on.points().size()),
                          .forces = point_forces(*this, from, on.points().size())});
  });
}

// A least gap that becomes negative within the step is followed from the step's start on by an open point. It must
// exist there already.
std::optional<Passage> SlidingContact::refined(const State& from, const Direction& forward, const State& to,
                                               double margin) const {
  const auto violated = deepest(to, margin);
  if (!violated) return std::nullopt;
  std::optional<Minimum> start;
  for_each_minimum(from, true, [&](const Minimum& minimum) {
    if (minimum.obstacle != violated->obstacle || minimum.at.run != violated->at.run) return;
    if (!start || std::abs(minimum.at.s - violated->at.s) < std::abs(start->at.s - violated->at.s)) start = minimum;
  });
  const Index run = violated->at.run;
  if (!start || std::abs(start->at.s - violated->at.s) > 0.25 * body_.length(run)) return std::nullopt;

  const Layout_& on = layout(from.piece);
  const Vector s = on.s_of(from);
  // Between which points, and how many elements on each side: by where it will touch, roughly.
  std::size_t k = 0;
  const auto before = [&](std::size_t point) {
    const Index r = on.mesh().breakpoint(static_cast<Index>(point)).first;
    return r < run || (r == run && s[static_cast<Index>(point)] < start->at.s);
  };
  while (k < on.points().size() && before(k)) ++k;
  for (std::size_t j = k > 0 ? k - 1 : 0; j < std::min(k + 1, on.points().size()); ++j)
    if (on.points()[j].obstacle == start->obstacle && on.mesh().breakpoint(static_cast<Index>(j)).first == run &&
        std::abs(s[static_cast<Index>(j)] - start->at.s) < least_span(run))
      return std::nullopt;  // it is followed already
  const auto holds = [&](const Layout_::Segment& segment) {
    const auto [a, b] = on.ends(body_, segment, s);
    return segment.run == run && a <= start->at.s && start->at.s < b;
  };
  const auto at = std::find_if(on.segments().begin(), on.segments().end(), holds);
  if (at == on.segments().end()) return std::nullopt;
  const auto first = std::find_if(on.segments().begin(), on.segments().end(),
                                  [&](const Layout_::Segment& segment) { return segment.run == run; });
  const double fallen = start->gap - violated->gap;
  const double part = fallen > 0.0 ? std::clamp(start->gap / fallen, 0.0, 2.0) : 0.0;
  const double touch = start->at.s + part * (violated->at.s - start->at.s);
  const auto [a, b] = on.ends(body_, *at, s);
  const int elements = std::max(2, at->elements);
  const int first_part =
      std::clamp(static_cast<int>(std::lround(elements * (touch - a) / (b - a) - 1e-3)), 1, elements - 1);
  Cut cut = on.mesh().cut();
  auto& in_run = cut[static_cast<std::size_t>(run)];
  const auto segment = static_cast<std::size_t>(at - first);
  in_run[segment] = first_part;
  insert_at(in_run, segment + 1, elements - first_part);
  std::vector<Point> points = on.points();
  insert_at(points, k, Point{.obstacle = start->obstacle});
  const auto ahead = std::make_shared<Layout_>(body_, body_.mesh(cut), points, inserted(s, k, start->at.s));
  return remeshed(from, forward, [&](const State& state) {
    Redrawn by{.layout = ahead, .s = inserted(on.s_of(state), k, start->at.s)};
    by.closed = closed_points(state, on.points().size());
    insert_at(by.closed, k, std::uint8_t{0});
    by.forces = point_forces(*this, state, on.points().size());
    insert_at(by.forces, k, 0.0);
    return redrawn(state, by);
  });
}

// A flat part that is bent is none.
Piece SlidingContact::settled(const State& state) const {
  const Layout_& on = layout(state.piece);
  constexpr double bent = 1e-6;
  std::vector<Point> points = on.points();
  bool changed = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].behind != Span::flat) continue;
    const double kappa = curvature_gap(state, k).value;
    if (std::abs(kappa) * scales_.length <= bent) continue;
    points[k].behind = Span::free;
    changed = true;
  }
  if (!changed) return state.piece;
  const auto ahead = std::make_shared<Layout_>(body_, on.shared_mesh(), points, on.s_of(state));
  Piece piece(state.piece.size(), 0, ahead);
  for (std::size_t j = 0; j < piece.size(); ++j) piece[j] = state.piece[j];
  return piece;
}

double SlidingContact::least_gap(const State& state, int places) const {
  const Layout_& on = layout(state.piece);
  const Vector x = on.x_of(state), s = on.s_of(state);
  double least = infinity;
  for (std::size_t w = 0; w < obstacles_.size(); ++w)
    for (Index run = 0; run < body_.runs(); ++run) {
      if (!obstacles_[w].runs[static_cast<std::size_t>(run)]) continue;
      const Touch surface{.run = run, .position = 0, .obstacle = w, .offset = normal_offset(w, run)};
      for (Index e = 0; e + 1 < on.mesh().nodes(run); ++e)
        for (int i = 0; i <= places; ++i)
          least = std::min(least, face_gap(surface, on.mesh().inside(run, e, double(i) / places, x, s)));
    }
  return least;
}

}  // namespace arcwall
