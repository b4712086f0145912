#include "contact/sliding/remeshing.hpp"

#include <algorithm>
#include <cmath>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/tolerances.hpp"

namespace arcwall::sliding {

using Span = SlidingContactLayout::Span;
using Point = SlidingContactLayout::Point;

namespace {

// The length by which a direction moves the nodes of a mesh, in the path metric.
double motion_of(const SlidingMesh& mesh, const Direction& direction) {
  const auto dx = direction.dx.head(mesh.unknowns());
  return std::sqrt(dx.dot(mesh.metric().weights.cwiseProduct(dx)));
}

}  // namespace

State mapped_onto(const SlidingSetting& setting, const SlidingState& at, const LayoutEdit& edit,
                  const std::shared_ptr<const SlidingContactLayout>& on) {
  const std::size_t points = edit.points.size(), ends = setting.free_ends.size();
  ActiveSet active_set(points + ends, 0, on);
  for (std::size_t k = 0; k < points; ++k) active_set[k] = edit.closed[k];
  for (std::size_t j = 0; j < ends; ++j) active_set[points + j] = edit.ends_closed[j];
  const SlidingUnknowns index(active_set);
  State out{.x = Vector::Zero(index.size()), .lambda = at.now.lambda, .active_set = active_set};
  out.x.head(index.nodes) = at.mesh.transferred(at.now, on->mesh(), edit.s);
  for (std::size_t j = 0; j < active_set.size(); ++j)
    if (const auto p = index.force(j)) out.x[*p] = j < points ? edit.forces[j] : edit.end_forces[j - points];
  for (std::size_t j = 0; j < points + ends; ++j) {
    const auto T = index.friction(j);
    if (!T) continue;
    out.x[*T] = j < points ? edit.frictions[j] : edit.end_frictions[j - points];
    out.x[*index.place(j)] = j < points ? edit.held[j] : edit.ends_held[j - points];
  }
  out.x.tail(edit.s.size()) = edit.s;
  return out;
}

Deferred<State> mapped_when_tried(const SlidingSetting& setting, const SlidingState& at, LayoutEdit edit) {
  return Deferred<State>([&setting, from = at.state, edit = std::move(edit)] {
    return mapped_onto(setting, SlidingState(from), edit, layout_of(edit));
  });
}

Transition remeshed(const SlidingSetting& setting, const SlidingState& at, const Direction& forward,
                    const EditLayout& edit) {
  const auto edited = [&](const SlidingState& from) {
    LayoutEdit changed = edit_of(setting.body, from);
    edit(changed, from);
    return changed;
  };
  const LayoutEdit here = edited(at);
  const auto on = layout_of(here);
  Transition transition{.change = Transition::Change::remeshed, .guess = mapped_onto(setting, at, here, on)};
  const State moved_on = moved(at.state, forward, difference_step_at_place);
  const SlidingState ahead(moved_on);
  transition.forward = difference(mapped_onto(setting, ahead, edited(ahead), on), transition.guess.get());
  transition.forward.dx /= difference_step_at_place;
  transition.forward.dlambda /= difference_step_at_place;
  // Where a point slides fast along a body that hardly moves, little but the error of the mesh is left.
  constexpr double sure = 0.01;
  if (motion_of(on->mesh(), transition.forward) < sure * motion_of(at.mesh, forward)) transition.forward.dx.setZero();
  return transition;
}

Transition divided_evenly(const SlidingSetting& setting, const SlidingState& at, const Direction& forward) {
  return remeshed(setting, at, forward, [](LayoutEdit& edit, const SlidingState&) { divide_evenly(edit); });
}

Transition divided_beside_waiting(const SlidingSetting& setting, const SlidingState& at, const Direction& forward) {
  return remeshed(setting, at, forward, [](LayoutEdit& edit, const SlidingState&) { divide_beside_waiting(edit); });
}

Transition with_elements(const SlidingSetting& setting, const SlidingState& at, const Direction& forward,
                         std::size_t segment, int elements) {
  const SlidingContactLayout::Segment& changed = at.layout.segments()[segment];
  return remeshed(setting, at, forward, [&changed, elements](LayoutEdit& edit, const SlidingState&) {
    edit.elements[static_cast<std::size_t>(changed.strand)][changed.place].elements = elements;
    divide_evenly(edit);
  });
}

Transition without_point(const SlidingSetting& setting, const SlidingState& at, const Direction& forward,
                         std::size_t point) {
  return remeshed(setting, at, forward, [point](LayoutEdit& edit, const SlidingState&) {
    const bool waits = edit.points[point].waits();
    edit.erase(point, edit.elements_without(point));
    waits ? divide_beside_waiting(edit) : divide_evenly(edit);
  });
}

std::optional<Transition> without_open_points(const SlidingSetting& setting, const SlidingState& at,
                                              const Direction& forward, std::optional<Index> touching) {
  std::vector<std::size_t> open;
  for (std::size_t k = at.layout.points().size(); k-- > 0;)
    if (!at.is_closed(k) && !at.layout.points()[k].is_pinched() && touching != static_cast<Index>(k)) open.push_back(k);
  if (open.empty()) return std::nullopt;
  return remeshed(setting, at, forward, [&open](LayoutEdit& edit, const SlidingState&) {
    for (const std::size_t point : open) edit.erase(point, edit.elements_without(point));
    divide_evenly(edit);
  });
}

Transition up_to(double value, std::shared_ptr<const Observable> quantity, Transition::Change change,
                 Deferred<State> guess) {
  Transition transition{};
  transition.change = change;
  transition.guess = std::move(guess);
  transition.quantity = std::move(quantity);
  transition.value = value;
  return transition;
}

Transition unsupported(std::string what) {
  return {.change = Transition::Change::unsupported, .detail = std::move(what)};
}

std::shared_ptr<const SlidingContactLayout> checked_layout(const SlidingSetting& setting,
                                                           const ElementsPerSegment& elements,
                                                           std::vector<Point> points, const Vector& origin,
                                                           SlidingContactLayout::Lying lying,
                                                           SlidingContactLayout::EndRubbings ends) {
  const SlidingBody& body = setting.body;
  if (static_cast<Index>(elements.size()) != body.strands() || static_cast<Index>(points.size()) != origin.size())
    return nullptr;
  Index k = 0;
  for (Index strand = 0; strand < body.strands(); ++strand) {
    const std::vector<MeshSegment>& in_strand = elements[static_cast<std::size_t>(strand)];
    const std::vector<double>& loads = body.point_loads(strand);
    const double most = 1000.0 + 100.0 * body.elements_between(strand, 0.0, body.length(strand));  // of a segment
    const auto is_none = [&](Index load) { return load < 0 || load >= static_cast<Index>(loads.size()); };
    const auto wrong = [&](const MeshSegment& segment) {
      return segment.elements < 1 || segment.elements > most || segment.load < -1 ||
             segment.load >= static_cast<Index>(loads.size()) ||
             std::any_of(segment.handed_on.begin(), segment.handed_on.end(), is_none);
    };
    if (in_strand.empty() || in_strand.back().ends_at_load()) return nullptr;
    if (std::any_of(in_strand.begin(), in_strand.end(), wrong)) return nullptr;
    for (std::size_t i = 0; i < in_strand.size(); ++i)
      if (in_strand[i].straight && (i == 0 || i + 1 == in_strand.size() || in_strand[i].elements != 1 ||
                                    in_strand[i].ends_at_load() || in_strand[i - 1].ends_at_load()))
        return nullptr;
    double before = 0.0;
    for (std::size_t i = 0; i + 1 < in_strand.size(); ++i) {
      if (!in_strand[i].ends_at_load() && k == origin.size()) return nullptr;
      const double end = in_strand[i].ends_at_load() ? loads[static_cast<std::size_t>(in_strand[i].load)] : origin[k++];
      if (!(end >= before && end <= body.length(strand))) return nullptr;
      before = end;
    }
  }
  const auto unknown = [&](const Point& point) {
    return point.obstacle >= setting.obstacles.size() || (point.pinch && *point.pinch >= setting.pinches.size()) ||
           point.undivided < 0;
  };
  if (k != origin.size() || std::any_of(points.begin(), points.end(), unknown)) return nullptr;
  if (!lying.empty() && static_cast<Index>(lying.size()) != body.strands()) return nullptr;
  if (!ends.empty() && ends.size() != setting.free_ends.size()) return nullptr;
  for (std::size_t strand = 0; strand < lying.size(); ++strand) {
    if (!lying[strand]) continue;
    const bool has_points = std::any_of(elements[strand].begin(), elements[strand].end() - 1,
                                        [](const MeshSegment& segment) { return !segment.ends_at_load(); });
    if (has_points || *lying[strand] >= setting.obstacles.size()) return nullptr;
  }
  return std::make_shared<SlidingContactLayout>(body, body.mesh(elements), std::move(points), origin, std::move(lying),
                                                std::move(ends));
}

ActiveSet with_layout(const ActiveSet& active_set, std::shared_ptr<const SlidingContactLayout> on) {
  ActiveSet out(active_set.contacts(), 0, std::move(on));
  for (std::size_t j = 0; j < active_set.contacts(); ++j) out[j] = active_set[j];
  return out.with_kinks_of(active_set);
}

ActiveSet canonical_active_set(const SlidingSetting& setting, const SlidingState& at) {
  std::vector<Point> points = at.layout.points();
  bool changed = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (std::abs(curvature_gap(setting, at, k)) * setting.scales.length <= nearly_straight) continue;
    for (Span* part : {&points[k].before, &points[k].behind}) {
      if (*part != Span::flat) continue;
      *part = Span::free;
      changed = true;
    }
  }
  if (!changed) return at.state.active_set;
  return with_layout(at.state.active_set,
                     std::make_shared<SlidingContactLayout>(setting.body, at.layout.shared_mesh(), std::move(points),
                                                            at.now.s, at.layout.lying(), at.layout.end_rubbings()));
}

}  // namespace arcwall::sliding
