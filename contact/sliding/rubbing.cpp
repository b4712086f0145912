#include "contact/sliding/rubbing.hpp"

#include <cmath>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

using Rubbing = SlidingContactLayout::Rubbing;

// The offset of where friction acts from the axis, along the axis' normal.
double offset_along_normal(const SlidingSetting& setting, const Touch& touch, const AxisPlace& axis) {
  const double offset = setting.obstacles[touch.obstacle].rubbing_offset(setting.body.half_height(touch.strand));
  return std::cos(axis.angle) >= 0.0 ? offset : -offset;
}

double held_place(const SlidingState& at, std::size_t contact) { return at.state.x[*at.index.place(contact)]; }

double coordinate(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  const Touch touch = touch_of_contact(setting, at.layout, contact);
  return at.mesh.coordinate(touch.strand, touch.position, at.now.s);
}

// How a contact has moved along the body since its anchor.
struct Roll {
  double sense, stretch, way;  // of the body along the obstacle; the mean since the anchor; of the coordinate

  // Along the obstacle, as if it had rolled.
  double length() const { return sense * stretch * way; }
};

Roll roll_of(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  if (!moves_along_body(at, contact)) return {.sense = 1.0, .stretch = 0.0, .way = 0.0};
  const Rubbing& anchor = at.layout.rubbing(contact);
  return {.sense = body_sense(setting, at, contact),
          .stretch = 0.5 * (anchor.stretch + mean_stretch(setting, at, contact)),
          .way = coordinate(setting, at, contact) - anchor.s};
}

// What a contact does from here on.
Rubbing begun_here(const SlidingSetting& setting, const SlidingState& at, std::size_t contact, ContactMode mode) {
  const ContactPlace place = place_of_rubbing(setting, at, contact);
  return {.mode = mode,
          .w = place.w,
          .s = coordinate(setting, at, contact),
          .stretch = place.stretch,
          .slipped = at.rubs(contact) ? slip_of(setting, at, contact) : 0.0};
}

// Whether supports leave an end that touches one direction of motion at most: then they bear the friction.
bool supports_bear_friction(const SlidingSetting& setting, const SlidingContactLayout& layout, const Touch& touch) {
  const NodeUnknowns unknowns = layout.mesh().node_unknowns(touch.strand, touch.position);
  const bool has_lever =
      setting.obstacles[touch.obstacle].rubbing_offset(setting.body.half_height(touch.strand)) != 0.0;
  const bool slides = unknowns[0] >= 0 && unknowns[1] >= 0;
  return !slides && !(has_lever && unknowns[2] >= 0);
}

// Without pressure nothing rubs between the edges of a part. With a lever friction would bend the body into the wall at
// one of them.
std::string why_not_beside(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t point) {
  if (!layout.lies_beside(point)) return {};
  const Touch touch = touch_of_contact(setting, layout, point);
  if (layout.lies_pressed(point))
    return "friction along a member that a wall presses is not modelled with moving contact points";
  if (setting.obstacles[touch.obstacle].rubbing_offset(setting.body.half_height(touch.strand)) != 0.0)
    return "friction of a part that lies on a wall with its face is not modelled: contact.friction_at = \"axis\" or "
           "contact.points = \"nodes\" is";
  return {};
}

}  // namespace

double friction_coefficient(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact) {
  const Touch touch = touch_of_contact(setting, layout, contact);
  const SlidingObstacle& obstacle = setting.obstacles[touch.obstacle];
  if (contact < layout.points().size()) return obstacle.friction(touch.strand);
  const double coefficient = obstacle.friction_at_end(touch.strand, touch.position > 0);
  return coefficient > 0.0 && supports_bear_friction(setting, layout, touch) ? 0.0 : coefficient;
}

std::string why_friction_is_not_modelled_at(const SlidingSetting& setting, const SlidingContactLayout& layout,
                                            std::size_t contact) {
  if (contact < layout.points().size() || friction_coefficient(setting, layout, contact) == 0.0) return {};
  const FreeEnd& end = setting.free_ends[contact - layout.points().size()];
  if (setting.body.is_tip(end.strand, end.last) && end.joined.empty()) return {};
  return "friction at a joint or a support is not modelled with moving contact points";
}

std::string why_friction_is_not_modelled(const SlidingSetting& setting, const ActiveSet& active_set) {
  const SlidingContactLayout& layout = sliding_layout(active_set);
  for (std::size_t j = 0; j < active_set.contacts(); ++j) {
    if (active_set[j] == 0 || friction_coefficient(setting, layout, j) == 0.0) continue;
    std::string why = j < layout.points().size() ? why_not_beside(setting, layout, j)
                                                 : why_friction_is_not_modelled_at(setting, layout, j);
    if (!why.empty()) return why;
    if (!rubs(active_set, j))
      return "how friction goes on where contact changes like this is not modelled with moving contact points";
  }
  for (const SlidingContactLayout::NeutralSpan& span : layout.neutral_spans())
    if (rubs(active_set, span.end_point()))
      return "friction beside free spans without moments at their ends is not modelled with moving contact points";
  for (std::size_t strand = 0; strand < layout.lying().size(); ++strand)
    if (const auto obstacle = layout.lying()[strand])
      if (setting.obstacles[*obstacle].friction(static_cast<Index>(strand)) > 0.0)
        return "friction along a member that lies on a wall is not modelled with moving contact points";
  return {};
}

double body_sense(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  const Touch touch = touch_of_contact(setting, at.layout, contact);
  const Obstacle& surface = *setting.obstacles[touch.obstacle].surface;
  const AxisPlace axis = touch.axis(at);
  return sign_of(surface.side()) * travel(surface, face(touch.offset, axis), axis.angle, at.now.lambda);
}

// Λ_f = Λ − o κ of either side.
double mean_stretch(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  const Touch touch = touch_of_contact(setting, at.layout, contact);
  const double offset = offset_along_normal(setting, touch, touch.axis(at));
  if (!moves_along_body(at, contact)) {
    const bool last = touch.position > 0;
    const AxisStrain inside = at.mesh.end_strain(touch.strand, last, at.now);
    const double s = last ? setting.body.length(touch.strand) : 0.0;
    if (setting.body.is_on_plane(touch.strand, last)) return inside.stretch - offset * inside.curvature;
    const double stretch = 1.0 + setting.body.free_strain(touch.strand, at.now.lambda).value;
    const double curvature = setting.body.natural_curvature({.strand = touch.strand, .s = s}, at.now.lambda);
    return 0.5 * (inside.stretch + stretch - offset * (inside.curvature + curvature));
  }
  const auto point = static_cast<Index>(contact);
  double sum = 0.0;
  for (const auto side : {SlidingMesh::At::before, SlidingMesh::At::behind}) {
    const AxisStrain strain = at.mesh.strain(point, side, at.now);
    sum += strain.stretch - offset * strain.curvature;
  }
  return 0.5 * sum;
}

namespace {

// Its derivatives, at a tracked point.
Row mean_stretch_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Touch touch = touch_of_contact(setting, at.layout, point);
  const double offset = offset_along_normal(setting, touch, touch.axis(at));
  Row row = at.no_slope();
  for (const auto side : {SlidingMesh::At::before, SlidingMesh::At::behind}) {
    const AxisStrainGradient strain = at.mesh.strain_gradient(static_cast<Index>(point), side, at.now);
    row.dx.head(at.index.nodes) += 0.5 * (strain.stretch_dx - offset * strain.curvature_dx);
    row.dx.tail(at.index.points) += 0.5 * (strain.stretch_ds - offset * strain.curvature_ds);
    row.dlambda += 0.5 * (strain.stretch_dlambda - offset * strain.curvature_dlambda);
  }
  return row;
}

}  // namespace

ContactPlace place_of_rubbing(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  const auto touched = [&] {
    return touched_place(setting, touch_of_contact(setting, at.layout, contact), at, 0.0).value;
  };
  const double w = at.rubs(contact) ? held_place(at, contact) : touched();
  return {.w = w,
          .s = body_sense(setting, at, contact) * coordinate(setting, at, contact),
          .stretch = mean_stretch(setting, at, contact)};
}

ContactPlace rates_of_rubbing(const SlidingSetting& setting, const SlidingState& at, const Direction& direction,
                              std::size_t contact) {
  if (!at.rubs(contact)) return {};
  const double w_rate = direction.dx[*at.index.place(contact)];
  if (!moves_along_body(at, contact)) return {.w = w_rate};
  return {.w = w_rate,
          .s = body_sense(setting, at, contact) * direction.dx[at.index.coordinate(static_cast<Index>(contact))],
          .stretch = apply(mean_stretch_gradient(setting, at, contact), direction)};
}

Row slip_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  Row row = at.no_slope();
  row.dx[*at.index.place(contact)] = 1.0;
  if (moves_along_body(at, contact))
    row.dx[at.index.coordinate(static_cast<Index>(contact))] =
        -body_sense(setting, at, contact) * mean_stretch(setting, at, contact);
  return row;
}

double slip_of(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  const Rubbing& anchor = at.layout.rubbing(contact);
  if (!slips(anchor.mode)) return anchor.slipped;
  return anchor.slipped + held_place(at, contact) - anchor.w - roll_of(setting, at, contact).length();
}

LawOfFriction law_of_friction(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  const Rubbing& anchor = at.layout.rubbing(contact);
  const Index w = *at.index.place(contact);
  LawOfFriction law{.row = at.no_slope()};
  if (slips(anchor.mode)) {
    const Index T = *at.index.friction(contact), p = *at.index.force(contact);
    const double ratio = slip_sense(anchor.mode) * friction_coefficient(setting, at.layout, contact);
    law.value = at.state.x[T] + ratio * at.state.x[p];
    law.row.dx[T] = 1.0;
    law.row.dx[p] = ratio;
    return law;
  }
  const Roll roll = roll_of(setting, at, contact);
  law.value = at.state.x[w] - anchor.w - roll.length();
  if (moves_along_body(at, contact)) {
    const Row by_stretch = mean_stretch_gradient(setting, at, contact);
    law.row.dx = -0.5 * roll.sense * roll.way * by_stretch.dx;
    law.row.dlambda = -0.5 * roll.sense * roll.way * by_stretch.dlambda;
    law.row.dx[at.index.coordinate(static_cast<Index>(contact))] -= roll.sense * roll.stretch;
  }
  law.row.dx[w] += 1.0;
  return law;
}

bool has_same_contacts(const SlidingState& one, const SlidingState& other) {
  if (one.layout.shared_mesh() == other.layout.shared_mesh()) return true;  // what they do alone differs
  const auto closed = [](const SlidingState& at) {
    using Span = SlidingContactLayout::Span;
    std::vector<std::tuple<Index, std::size_t, Span, Span>> contacts;
    const auto& points = at.layout.points();
    for (std::size_t k = 0; k < points.size(); ++k)
      if (at.is_closed(k))
        contacts.emplace_back(at.mesh.breakpoint(static_cast<Index>(k)).first, points[k].obstacle, points[k].before,
                              points[k].behind);
    for (std::size_t j = points.size(); j < at.contacts(); ++j)
      if (at.is_closed(j)) contacts.emplace_back(-1, j - points.size(), Span::free, Span::free);
    return contacts;
  };
  return closed(one) == closed(other);
}

namespace {

// The contact with friction of another state that is nearest along the body to one of a state, on the same obstacle, of
// those that are `like` it.
template <class Like>
std::optional<std::size_t> nearest_like(const SlidingSetting& setting, const SlidingState& at, std::size_t contact,
                                        const SlidingState& other, const Like& like) {
  const auto place = [&](const SlidingState& in, const Touch& touch) {
    return in.mesh.coordinate(touch.strand, touch.position, in.now.s);
  };
  const Touch here = touch_of_contact(setting, at.layout, contact);
  std::optional<std::size_t> nearest;
  double least = infinity;
  for (std::size_t j = 0; j < other.contacts(); ++j) {
    if (!other.rubs(j) || !like(j)) continue;
    const Touch there = touch_of_contact(setting, other.layout, j);
    if (there.strand != here.strand || there.obstacle != here.obstacle) continue;
    const double off = std::abs(place(other, there) - place(at, here));
    if (off >= least) continue;
    least = off;
    nearest = j;
  }
  return nearest;
}

}  // namespace

// The edges of a zone that has spread from a point have one anchor: of these each is the nearest.
double slip_since(const SlidingSetting& setting, const SlidingState& event, const SlidingState& at,
                  std::size_t contact) {
  if (has_same_contacts(event, at)) return 0.0;
  const Rubbing& anchor = at.layout.rubbing(contact);
  const auto known = nearest_like(setting, at, contact, event,
                                  [&](std::size_t before) { return event.layout.rubbing(before) == anchor; });
  return slip_of(setting, at, contact) - (known ? slip_of(setting, event, *known) : anchor.slipped);
}

std::optional<Index> nearest_rubbing(const SlidingSetting& setting, const SlidingState& at, std::size_t contact,
                                     const SlidingState& other) {
  const auto nearest = nearest_like(setting, at, contact, other, [](std::size_t) { return true; });
  return nearest ? std::optional(static_cast<Index>(*nearest)) : std::nullopt;
}

Rubbing anchored_anew(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  return begun_here(setting, at, contact, at.layout.rubbing(contact).mode);
}

State with_modes(const SlidingSetting& setting, const SlidingState& at, std::span<const ModeOfContact> modes) {
  const ActiveSet& before = at.state.active_set;
  std::vector<SlidingContactLayout::Point> points = at.layout.points();
  SlidingContactLayout::EndRubbings ends;
  for (std::size_t j = points.size(); j < at.contacts(); ++j) ends.push_back(at.layout.rubbing(j));
  const auto rubbing_of = [&](std::size_t j) -> Rubbing& {
    return j < points.size() ? points[j].rubbing : ends[j - points.size()];
  };
  for (std::size_t j = 0; j < at.contacts(); ++j)
    if (!at.is_closed(j)) rubbing_of(j) = {};
  for (const auto& [contact, mode] : modes) {
    const auto j = static_cast<std::size_t>(contact);
    Rubbing& rubbing = rubbing_of(j);
    if (mode == ContactMode::open || friction_coefficient(setting, at.layout, j) == 0.0)
      rubbing = {};
    else if (mode != rubbing.mode)
      rubbing = begun_here(setting, at, j, mode);
  }
  const auto layout = std::make_shared<const SlidingContactLayout>(
      setting.body, at.layout.shared_mesh(), std::move(points), at.layout.origin(), at.layout.lying(), std::move(ends));
  ActiveSet changed(before.contacts(), 0, layout);
  for (std::size_t j = 0; j < before.contacts(); ++j) changed[j] = before[j];
  for (const auto& [contact, mode] : modes)
    changed[static_cast<std::size_t>(contact)] = mode == ContactMode::open ? 0 : 1;
  State next{.x = moved_unknowns(at.state.x, before, changed),
             .lambda = at.state.lambda,
             .active_set = changed.with_kinks_of(before)};
  const SlidingUnknowns index(next.active_set);
  for (std::size_t j = 0; j < at.contacts(); ++j)
    if (const auto w = index.place(j); w && !at.rubs(j)) next.x[*w] = layout->rubbing(j).w;
  return next;
}

}  // namespace arcwall::sliding
