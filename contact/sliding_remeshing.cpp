// Layouts, and the same shape on another one.
#include <algorithm>
#include <cmath>

#include "contact/layout_edit.hpp"
#include "contact/sliding_contact.hpp"

namespace arcwall {

using Layout_ = SlidingContactLayout;
using Span = SlidingContactLayout::Span;
using Point = SlidingContactLayout::Point;

LayoutEdit SlidingContact::draft_of(const State& state) const {
  const Layout_& on = layout(state.piece);
  LayoutEdit edit{.cut = on.mesh().elements_per_segment(), .points = on.points(), .s = on.s_of(state)};
  for (std::size_t k = 0; k < on.points().size(); ++k) {
    edit.strands.push_back(on.mesh().breakpoint(static_cast<Index>(k)).first);
    edit.closed.push_back(state.piece[k]);
    edit.forces.push_back(force(state, static_cast<Index>(k)));
  }
  return edit;
}

std::shared_ptr<const SlidingContactLayout> SlidingContact::layout_of(const LayoutEdit& edit) const {
  return std::make_shared<Layout_>(body_, body_.mesh(edit.cut), edit.points, edit.s);
}

std::shared_ptr<const SlidingContactLayout> SlidingContact::layout_of(const ElementsPerSegment& cut,
                                                                      std::vector<Point> points,
                                                                      const Vector& origin) const {
  if (static_cast<Index>(cut.size()) != body_.strands() || static_cast<Index>(points.size()) != origin.size())
    return nullptr;
  Index k = 0;
  for (Index strand = 0; strand < body_.strands(); ++strand) {
    const std::vector<int>& elements = cut[static_cast<std::size_t>(strand)];
    const double most = 1000.0 + 100.0 * body_.elements_between(strand, 0.0, body_.length(strand));  // of a segment
    const auto wrong = [most](int n) { return n < 1 || n > most; };
    if (elements.empty() || std::any_of(elements.begin(), elements.end(), wrong)) return nullptr;
    double before = 0.0;
    for (std::size_t i = 0; i + 1 < elements.size(); ++i, ++k) {
      if (k == origin.size() || !(origin[k] >= before && origin[k] <= body_.length(strand))) return nullptr;
      before = origin[k];
    }
  }
  const auto unknown = [&](const Point& point) { return point.obstacle >= obstacles_.size(); };
  if (k != origin.size() || std::any_of(points.begin(), points.end(), unknown)) return nullptr;
  return std::make_shared<Layout_>(body_, body_.mesh(cut), std::move(points), origin);
}

State SlidingContact::redrawn(const State& state, const LayoutEdit& by,
                              const std::shared_ptr<const SlidingContactLayout>& on) const {
  const Layout_& from = layout(state.piece);
  const std::size_t points = by.points.size(), before = from.points().size();
  Piece piece(points + tied_.size(), 0, on);
  for (std::size_t k = 0; k < points; ++k) piece[k] = by.closed[k];
  for (std::size_t j = 0; j < tied_.size(); ++j) piece[points + j] = state.piece[before + j];
  State out{.x = Vector::Zero(size(piece)), .lambda = state.lambda, .piece = piece};
  const Index n = on->mesh().unknowns();
  out.x.head(n) = from.mesh().transferred(mesh_state_of(state), on->mesh(), by.s);
  Index p = n;
  for (std::size_t j = 0; j < piece.size(); ++j)
    if (piece[j]) out.x[p++] = j < points ? by.forces[j] : force(state, static_cast<Index>(before + j - points));
  out.x.tail(by.s.size()) = by.s;
  return out;
}

Transition SlidingContact::remeshed(const State& state, const Direction& forward, const Edit& edit) const {
  constexpr double step = 1e-6;  // [path metric]
  const auto edited = [&](const State& from) {
    LayoutEdit changed = draft_of(from);
    edit(changed);
    return changed;
  };
  const LayoutEdit here = edited(state);
  const auto on = layout_of(here);
  Transition transition{.change = Transition::Change::remeshed, .guess = redrawn(state, here, on)};
  const State ahead = moved(state, forward, step);
  transition.forward = difference(redrawn(ahead, edited(ahead), on), transition.guess);
  transition.forward.dx /= step;
  transition.forward.dlambda /= step;
  return transition;
}

// The least gap that an open point followed is about to vanish, or has become shallow for its distance: before the body
// is straight it must be let go, as nothing would say where it is.
Transition SlidingContact::without(const State& state, const Direction& forward, std::size_t k) const {
  return remeshed(state, forward,
                  [k](LayoutEdit& edit) { edit.erase(k, edit.elements_before(k) + edit.elements_behind(k)); });
}

Transition SlidingContact::with_elements(const State& state, const Direction& forward, std::size_t segment,
                                         int elements) const {
  const Layout_::Segment& changed = layout(state.piece).segments()[segment];
  return remeshed(state, forward, [&changed, elements](LayoutEdit& edit) {
    if (changed.last_point >= 0) {
      edit.elements_before(static_cast<std::size_t>(changed.last_point)) = elements;
    } else if (changed.first_point >= 0) {
      edit.elements_behind(static_cast<std::size_t>(changed.first_point)) = elements;
    } else {
      edit.cut[static_cast<std::size_t>(changed.strand)] = {elements};
    }
  });
}

// A flat part that is bent is none.
Piece SlidingContact::canonical_piece(const State& state) const {
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

}  // namespace arcwall
