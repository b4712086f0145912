// The pieces of sliding contact that lie behind what bounds one.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "contact/layout_edit.hpp"
#include "contact/sliding_contact.hpp"
#include "core/text.hpp"

namespace arcwall {

using Layout_ = SlidingContactLayout;
using Span = SlidingContactLayout::Span;
using Bound = SlidingContactLayout::Bound;
using Point = SlidingContactLayout::Point;

namespace {

constexpr int fewest_pressed = 6;  // elements of a pressed part that lifts off inside

// How many elements the mesh of a strand asks for between two places.
int elements_asked(const SlidingBody& body, Index strand, double from, double to, int fewest) {
  return std::max(fewest, static_cast<int>(std::lround(body.elements_between(strand, from, to))));
}

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

// Whose first point is where the quantity has the value.
Transition up_to(double value, std::shared_ptr<const Observable> quantity, Transition::Change change, State guess) {
  Transition transition{};
  transition.change = change;
  transition.forward = {.dx = Vector::Zero(guess.x.size()), .dlambda = 0.0};
  transition.guess = std::move(guess);
  transition.quantity = std::move(quantity);
  transition.value = value;
  return transition;
}

std::string counted(Index count, const std::string& what) {
  return std::to_string(count) + " " + what + (count > 1 ? "s" : "");
}

}  // namespace

// --- which transition
// --------------------------------------------------------------------------------------------------

// Limits of one kind that are reached together.
std::vector<std::size_t> SlidingContact::reached(const State& state, Bound bound, double tolerance) const {
  const Layout_& on = layout(state.piece);
  std::vector<std::size_t> found;
  for (std::size_t l = 0; l < on.limits().size(); ++l)
    if (on.limits()[l].bound == bound && limit_value(state, l) <= std::max(1e-6, 10.0 * tolerance))
      found.push_back(on.limits()[l].which);
  return found;
}

// Clamped ends of point k's strand, parallel to its wall, at which the body loses its curvature with the point: like
// contacts (the first integral of the elastica), and then straight parts begin to grow there.
Index SlidingContact::straightened_ends(const State& state, std::size_t k) const {
  constexpr double parallel = 1e-9, straight = 0.1;  // [rad]; of the greatest curvature in the strand
  const Layout_& on = layout(state.piece);
  const SlidingMesh& mesh = on.mesh();
  const MeshState now = mesh_state_of(state);
  const Touch at = touch(on, k);
  const AxisPlace place = mesh.node(at.strand, at.position, now);
  const Index last = mesh.nodes(at.strand) - 1;
  double greatest = 0.0;
  for (Index e = 0; e < last; ++e) {
    const double h = mesh.coordinate(at.strand, e + 1, now.s) - mesh.coordinate(at.strand, e, now.s);
    greatest =
        std::max(greatest, std::abs(mesh.node(at.strand, e + 1, now).angle - mesh.node(at.strand, e, now).angle) / h);
  }
  Index count = 0;
  for (const bool end : {false, true}) {
    const Index node = end ? last : 0, e = end ? last - 1 : 0;
    const NodeUnknowns unknowns = mesh.node_unknowns(at.strand, node);
    if (unknowns[1] >= 0 || unknowns[2] >= 0) continue;
    const auto angle = [&](double t) { return mesh.inside(at.strand, e, end ? 1.0 - t : t, now).angle; };
    if (std::abs(angle(0.0) - place.angle) > parallel) continue;
    const double h = mesh.coordinate(at.strand, e + 1, now.s) - mesh.coordinate(at.strand, e, now.s);
    const double curvature = (4.0 * angle(0.5) - 3.0 * angle(0.0) - angle(1.0)) / h;
    if (std::abs(curvature) <= straight * greatest) ++count;
  }
  return count;
}

std::vector<Transition> SlidingContact::transitions(const State& state, const Direction& forward, Index bound_number,
                                                    double tolerance) const {
  const Layout_& on = layout(state.piece);
  const auto contacts = static_cast<Index>(state.piece.size());
  const auto [bound, which] = on.limits()[static_cast<std::size_t>(bound_number - contacts)];
  switch (bound) {
    case Bound::curvature:
      if (!state.piece[which]) return {without(state, forward, which)};
      return straightened(state, tolerance);
    case Bound::length:
      return {shrunk(state, which, tolerance),
              {.change = Transition::Change::unsupported,
               .detail = "a stretch between contacts closes, and no equilibrium without it was found"}};
    case Bound::coarse:
      return {with_elements(state, forward, which, 2 * on.segments()[which].elements)};
    case Bound::fine:
      return {with_elements(state, forward, which, (on.segments()[which].elements + 1) / 2)};
    case Bound::half_wave: {
      const Index strand = on.segments()[which].strand;
      return {with_elements(state, forward, which, elements_asked(body_, strand, 0.0, body_.length(strand), 8))};
    }
    case Bound::straight:
      return {with_elements(state, forward, which, 1)};
    case Bound::room:
      return {{.change = Transition::Change::unsupported,
               .detail = "a contact point reached the end of its member, or another wall's contact"}};
    case Bound::pressure:
      return lifted(state, tolerance);
    case Bound::lies:
      return {{.change = Transition::Change::unsupported, .detail = "the free end of a member lies down on a wall"}};
    case Bound::upright:
      return {{.change = Transition::Change::unsupported,
               .detail = "the free end of a member stands upright against a wall: its other corner would touch"}};
  }
  return {};
}

// --- points become lines --------------------------------------------------------------------------------------------

// All point contacts of an equilibrium with straight walls become lines together; of several flat ones only the sum of
// lengths is determined.
std::vector<Transition> SlidingContact::straightened(const State& state, double tolerance) const {
  const Layout_& on = layout(state.piece);
  std::vector<std::size_t> points = reached(state, Bound::curvature, tolerance);
  std::erase_if(points, [&](std::size_t k) { return !state.piece[k]; });
  Index lines = std::count_if(points.begin(), points.end(), [&](std::size_t k) { return lies_by_itself(state, k); });
  const bool new_lines = lines > 0;
  for (const Point& point : on.points()) lines += point.behind == Span::flat;
  const Index ends = new_lines ? straightened_ends(state, points.front()) : 0;
  if (new_lines && lines + ends > 1) return {continuum(state, lines, ends)};
  return spreads(state, points);
}

Transition SlidingContact::continuum(const State& state, Index lines, Index ends) const {
  const Layout_& on = layout(state.piece);
  const Vector s = on.s_of(state);
  Continuum common{.energy = energy(state)};
  for (std::size_t k = 0; k < on.points().size(); ++k)
    if (on.points()[k].behind == Span::flat) common.length += s[static_cast<Index>(k) + 1] - s[static_cast<Index>(k)];
  return {.change = Transition::Change::continuum,
          .detail = counted(lines, "contact") + (ends > 0 ? " and " + counted(ends, "clamped end") : "") +
                    " become lines together: only the sum of their lengths is determined, " +
                    round_trip(common.length) + " here; all such equilibria have the energy " +
                    round_trip(common.energy),
          .continuum = common};
}

// Where the wall is straight and the body lies on it by itself, the part between is flat; else pressure holds it, or it
// arches off the wall. On a curved wall the axial force, and with it the pressure, may grow with the part: it is then
// begun longer. On straight walls little but its length may resist, and it is begun as short as a span may be.
std::vector<Transition> SlidingContact::spreads(const State& state, const std::vector<std::size_t>& points) const {
  const Index strand = layout(state.piece).mesh().breakpoint(static_cast<Index>(points.front())).first;
  const double length = 2.0 * least_span(strand);
  constexpr double shorter = 0.6;
  const auto flat = [&](std::size_t k) { return lies_by_itself(state, k); };
  const auto with_end = [&](std::vector<Transition> transitions) {
    transitions.push_back({.change = Transition::Change::unsupported, .detail = why_none_spreads(state, points)});
    return transitions;
  };
  if (std::all_of(points.begin(), points.end(), flat)) return with_end({spread(state, points, Span::flat, length)});
  const Transition arches = spread(state, points, Span::free, length);
  if (std::all_of(points.begin(), points.end(),
                  [&](std::size_t k) { return pressure(state, k) < 0.0 && wall_curvature(state, k) == 0.0; }))
    return with_end({arches, spread(state, points, Span::pressed, length)});
  std::vector<Transition> transitions;
  for (const double factor : {1.0, 2.0, 4.0, 8.0, 16.0})
    transitions.push_back(spread(state, points, Span::pressed, factor * length));
  transitions.push_back(arches);
  transitions.push_back(spread(state, points, Span::pressed, shorter * length));
  return with_end(std::move(transitions));
}

// In words: what was looked for behind points that lose their curvature, and why it may be hard to find.
std::string SlidingContact::why_none_spreads(const State& state, const std::vector<std::size_t>& points) const {
  const auto straight = [&](std::size_t k) { return wall_curvature(state, k) == 0.0; };
  const auto count = static_cast<Index>(points.size());
  std::string text = counted(count, "point") + " of contact " + (count > 1 ? "become stretches" : "becomes a stretch") +
                     ", and no equilibrium with short ones was found";
  const bool others = points.size() < layout(state.piece).points().size();
  if ((count > 1 || others) && std::all_of(points.begin(), points.end(), straight))
    text +=
        "; the structure is nearly perfect, and of a perfect one only the sum of the lengths of all stretches is "
        "determined";
  return text;
}

// Each of the points, ascending, becomes two, a short way apart.
Transition SlidingContact::spread(const State& state, const std::vector<std::size_t>& points, Span between,
                                  double length) const {
  LayoutEdit edit = draft_of(state);
  for (auto k = points.rbegin(); k != points.rend(); ++k) {
    const Span span = lies_by_itself(state, *k) ? Span::flat : between;
    const int behind = edit.elements_behind(*k);
    double& s = edit.s[static_cast<Index>(*k)];
    s -= 0.5 * length;
    const int between_them = span == Span::flat ? 1 : elements_asked(body_, edit.strands[*k], s, s + length, 2);
    edit.forces[*k] *= 0.5;
    edit.insert({.point = edit.points[*k],
                 .strand = edit.strands[*k],
                 .s = s + length,
                 .closed = true,
                 .force = edit.forces[*k]},
                between_them, behind);
    edit.points[*k].behind = span;
  }
  Transition transition = up_to(length, std::make_shared<SpanLength>(points.front()), Transition::Change::spreads,
                                redrawn(state, edit, layout_of(edit)));
  for (const std::size_t k : points) transition.contacts.push_back(static_cast<Index>(k));
  return transition;
}

// --- lines become points, and gaps between them vanish --------------------------------------------------------------

// A span that has become short: a line gathers to a point; the gap between two parts on the wall closes.
Transition SlidingContact::shrunk(const State& state, std::size_t k, double tolerance) const {
  const Layout_& on = layout(state.piece);
  const auto closes = [&](std::size_t j) { return on.parts_pressed(j); };
  std::vector<std::size_t> spans = reached(state, Bound::length, tolerance);
  if (std::find(spans.begin(), spans.end(), k) == spans.end()) spans = {k};
  std::erase_if(spans, [&](std::size_t j) { return closes(j) != closes(k); });
  return closes(k) ? joined(state, spans) : gathered(state, spans);
}

// Up to the limit nearest a place in the piece ahead from which the span would have grown.
Transition SlidingContact::shrunk_passage(const State& state, const LayoutEdit& edit, double s,
                                          Transition::Change change) const {
  const Bound bound = change == Transition::Change::gathers ? Bound::curvature : Bound::pressure;
  const auto on = layout_of(edit);
  std::optional<std::size_t> nearest;
  double least = infinity;
  for (std::size_t l = 0; l < on->limits().size(); ++l) {
    if (on->limits()[l].bound != bound) continue;
    const std::size_t which = on->limits()[l].which;
    const double place = bound == Bound::curvature
                             ? edit.s[static_cast<Index>(which)]
                             : on->mesh().coordinate(on->held()[which].strand, on->held()[which].position, edit.s);
    if (std::abs(place - s) >= least) continue;
    least = std::abs(place - s);
    nearest = l;
  }
  assert(nearest);
  State guess = redrawn(state, edit, on);
  const auto guard = static_cast<Index>(guess.piece.size() + *nearest);
  Transition transition = up_to(0.0, std::make_shared<Guard>(*this, guard), change, std::move(guess));
  transition.contacts = {bound == Bound::curvature ? static_cast<Index>(on->limits()[*nearest].which) : guard};
  return transition;
}

Transition SlidingContact::gathered(const State& state, const std::vector<std::size_t>& spans) const {
  LayoutEdit edit = draft_of(state);
  const auto middle = [&](std::size_t k) {
    return 0.5 * (edit.s[static_cast<Index>(k)] + edit.s[static_cast<Index>(k) + 1]);
  };
  const double place = middle(spans.front());
  for (auto k = spans.rbegin(); k != spans.rend(); ++k) {
    const double s = middle(*k);
    edit.points[*k].behind = edit.points[*k + 1].behind;
    edit.forces[*k] += edit.forces[*k + 1];
    edit.erase(*k + 1, edit.elements_behind(*k + 1));
    edit.s[static_cast<Index>(*k)] = s;
  }
  return shrunk_passage(state, edit, place, Transition::Change::gathers);
}

// Two pressed parts become one, or a pressed part and a point contact beside it.
Transition SlidingContact::joined(const State& state, const std::vector<std::size_t>& gaps) const {
  LayoutEdit edit = draft_of(state);
  const Layout_& on = layout(state.piece);
  const double place = edit.s[static_cast<Index>(gaps.front())];
  for (auto k = gaps.rbegin(); k != gaps.rend(); ++k) {
    const bool before = on.span_before(*k) == Span::pressed, behind = on.points()[*k + 1].behind == Span::pressed;
    if (behind) {
      edit.points[*k].behind = Span::pressed;
      edit.erase(*k + 1, edit.elements_behind(*k + 1) + (before ? 0 : 1));
    }
    if (before) edit.erase(*k, edit.elements_before(*k) + (behind ? edit.elements_behind(*k) : 1));
  }
  return shrunk_passage(state, edit, place, Transition::Change::joins);
}

// --- pressed parts lift off inside ----------------------------------------------------------------------------------

// Where the pressure vanishes the part becomes two with a free stretch between them; at its end, one and a point
// contact.
std::vector<Transition> SlidingContact::lifted(const State& state, double tolerance) const {
  const Layout_& on = layout(state.piece);
  std::vector<std::size_t> nodes;
  std::size_t last_reached = 0;
  for (const std::size_t node : reached(state, Bound::pressure, tolerance)) {  // of neighbours the one with least
    const bool neighbour =
        !nodes.empty() && on.held()[node].segment == on.held()[nodes.back()].segment && node - last_reached == 1;
    last_reached = node;
    if (!neighbour) {
      nodes.push_back(node);
    } else if (least_pressure_around(state, node) < least_pressure_around(state, nodes.back())) {
      nodes.back() = node;
    }
  }
  const double length = 2.0 * least_span(on.held()[nodes.front()].strand);
  std::vector<Transition> transitions;
  for (const double factor : {1.0, 2.0, 4.0, 8.0, 16.0}) add_split(state, nodes, factor * length, transitions);
  transitions.push_back({.change = Transition::Change::unsupported,
                         .detail =
                             "a part that is pressed on a wall lifts off inside, and no equilibrium with one free "
                             "stretch was found"});
  return transitions;
}

// Nothing where a part is too short for the stretch.
void SlidingContact::add_split(const State& state, const std::vector<std::size_t>& nodes, double length,
                               std::vector<Transition>& to) const {
  const Layout_& on = layout(state.piece);
  const Vector s = on.s_of(state);
  LayoutEdit edit = draft_of(state);
  std::size_t first = 0;  // the first of the new free stretches begins behind this point
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    const Layout_::Held& held = on.held()[*node];
    const Layout_::Segment& part = on.segments()[held.segment];
    const auto a = static_cast<std::size_t>(part.first_point);
    const double place = least_pressure_place(state, *node);
    const double begin = s[part.first_point], end = s[part.last_point], h = (end - begin) / part.elements;
    const bool at_first = place - begin < 0.5 * h, at_last = end - place < 0.5 * h;
    const double left = at_first ? begin : at_last ? end - length : place - 0.5 * length;
    const auto elements = [&](double begin_at, double end_at, int fewest) {
      return elements_asked(body_, held.strand, begin_at, end_at, fewest);
    };
    const int across = elements(left, left + length, 2);
    const double next = edit.s[part.first_point + 1];  // up to where it has lifted before
    const double least_between = 8.0 * least_span(held.strand);
    const int behind = elements(left + length, next, fewest_pressed);
    const bool fits = left >= begin && left + length <= next;
    if (!fits || (!at_first && !at_last && length < least_between)) return;
    LayoutEdit::Entry edge{.point = {.obstacle = held.obstacle}, .strand = held.strand, .s = left, .closed = true};
    first = at_first ? a : edit.insert(edge, elements(begin, left, fewest_pressed), at_last ? across : behind);
    edit.points[first].behind = Span::free;
    if (at_last) continue;
    edge.point.behind = Span::pressed;
    edge.s = left + length;
    edit.insert(edge, across, behind);
  }
  const auto contacts = static_cast<Index>(state.piece.size());
  Transition transition = up_to(length, std::make_shared<SpanLength>(first), Transition::Change::splits,
                                redrawn(state, edit, layout_of(edit)));
  for (std::size_t l = 0; l < on.limits().size(); ++l)
    if (on.limits()[l].bound == Bound::pressure &&
        std::find(nodes.begin(), nodes.end(), on.limits()[l].which) != nodes.end())
      transition.contacts.push_back(contacts + static_cast<Index>(l));
  to.push_back(std::move(transition));
}

}  // namespace arcwall
