#include "contact/sliding/rubbing.hpp"

#include <cmath>
#include <memory>
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

double held_place(const SlidingState& at, std::size_t point) { return at.state.x[*at.index.place(point)]; }

// How a point has moved along the body since its anchor.
struct Roll {
  double sense, stretch, way;  // of the body along the obstacle; the mean since the anchor; of the coordinate

  // Along the obstacle, as if it had rolled.
  double length() const { return sense * stretch * way; }
};

Roll roll_of(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Rubbing& anchor = at.layout.points()[point].rubbing;
  return {.sense = body_sense(setting, at, point),
          .stretch = 0.5 * (anchor.stretch + mean_stretch(setting, at, point)),
          .way = at.s(static_cast<Index>(point)) - anchor.s};
}

// What a point does from here on.
Rubbing begun_here(const SlidingSetting& setting, const SlidingState& at, std::size_t point, ContactMode mode) {
  const ContactPlace place = place_of_rubbing(setting, at, point);
  return {.mode = mode,
          .w = place.w,
          .s = at.s(static_cast<Index>(point)),
          .stretch = place.stretch,
          .slipped = at.rubs(point) ? slip_of(setting, at, point) : 0.0};
}

}  // namespace

double friction_coefficient(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact) {
  const Touch touch = touch_of_contact(setting, layout, contact);
  return setting.obstacles[touch.obstacle].friction(touch.strand);
}

bool friction_is_modelled(const SlidingSetting& setting, const ActiveSet& active_set) {
  const SlidingContactLayout& layout = sliding_layout(active_set);
  for (std::size_t j = 0; j < active_set.contacts(); ++j) {
    if (active_set[j] == 0 || friction_coefficient(setting, layout, j) == 0.0) continue;
    if (!rubs(active_set, j) || layout.lies_beside(j)) return false;
  }
  for (std::size_t strand = 0; strand < layout.lying().size(); ++strand)
    if (const auto obstacle = layout.lying()[strand])
      if (setting.obstacles[*obstacle].friction(static_cast<Index>(strand)) > 0.0) return false;
  return true;
}

std::string friction_under_pressure() {
  return "friction along a member that lies on a wall is not modelled with moving contact points";
}

std::string friction_at_end() { return "friction at an end of a member is not modelled with moving contact points"; }

double body_sense(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Touch touch = touch_of_contact(setting, at.layout, point);
  const Obstacle& surface = *setting.obstacles[touch.obstacle].surface;
  const AxisPlace axis = touch.axis(at);
  return sign_of(surface.side()) * travel(surface, face(touch.offset, axis), axis.angle, at.now.lambda);
}

// Λ_f = Λ − o κ of either side.
double mean_stretch(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Touch touch = touch_of_contact(setting, at.layout, point);
  const double offset = offset_along_normal(setting, touch, touch.axis(at));
  double sum = 0.0;
  for (const auto side : {SlidingMesh::At::before, SlidingMesh::At::behind}) {
    const AxisStrain strain = at.mesh.strain(static_cast<Index>(point), side, at.now);
    sum += strain.stretch - offset * strain.curvature;
  }
  return 0.5 * sum;
}

namespace {

// Its derivatives.
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

ContactPlace place_of_rubbing(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const auto touched = [&] {
    return touched_place(setting, touch_of_contact(setting, at.layout, point), at, 0.0).value;
  };
  const double w = at.rubs(point) ? held_place(at, point) : touched();
  return {.w = w,
          .s = body_sense(setting, at, point) * at.s(static_cast<Index>(point)),
          .stretch = mean_stretch(setting, at, point)};
}

ContactPlace rates_of_rubbing(const SlidingSetting& setting, const SlidingState& at, const Direction& direction,
                              std::size_t point) {
  if (!at.rubs(point)) return {};
  return {.w = direction.dx[*at.index.place(point)],
          .s = body_sense(setting, at, point) * direction.dx[at.index.coordinate(static_cast<Index>(point))],
          .stretch = apply(mean_stretch_gradient(setting, at, point), direction)};
}

Row slip_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  Row row = at.no_slope();
  row.dx[*at.index.place(point)] = 1.0;
  row.dx[at.index.coordinate(static_cast<Index>(point))] =
      -body_sense(setting, at, point) * mean_stretch(setting, at, point);
  return row;
}

double slip_of(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Rubbing& anchor = at.layout.points()[point].rubbing;
  if (!slips(anchor.mode)) return anchor.slipped;
  return anchor.slipped + held_place(at, point) - anchor.w - roll_of(setting, at, point).length();
}

LawOfFriction law_of_friction(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  const Rubbing& anchor = at.layout.points()[point].rubbing;
  const Index w = *at.index.place(point);
  LawOfFriction law{.row = at.no_slope()};
  if (slips(anchor.mode)) {
    const Index T = *at.index.friction(point), p = *at.index.force(point);
    const double ratio = slip_sense(anchor.mode) * friction_coefficient(setting, at.layout, point);
    law.value = at.state.x[T] + ratio * at.state.x[p];
    law.row.dx[T] = 1.0;
    law.row.dx[p] = ratio;
    return law;
  }
  const Roll roll = roll_of(setting, at, point);
  const Row by_stretch = mean_stretch_gradient(setting, at, point);
  law.value = at.state.x[w] - anchor.w - roll.length();
  law.row.dx = -0.5 * roll.sense * roll.way * by_stretch.dx;
  law.row.dlambda = -0.5 * roll.sense * roll.way * by_stretch.dlambda;
  law.row.dx[w] += 1.0;
  law.row.dx[at.index.coordinate(static_cast<Index>(point))] -= roll.sense * roll.stretch;
  return law;
}

Rubbing anchored_anew(const SlidingSetting& setting, const SlidingState& at, std::size_t point) {
  return begun_here(setting, at, point, at.layout.points()[point].rubbing.mode);
}

State with_modes(const SlidingSetting& setting, const SlidingState& at, std::span<const ModeOfContact> modes) {
  const ActiveSet& before = at.state.active_set;
  std::vector<SlidingContactLayout::Point> points = at.layout.points();
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!at.is_closed(k)) points[k].rubbing = {};
  for (const auto& [contact, mode] : modes) {
    const auto k = static_cast<std::size_t>(contact);
    if (k >= points.size()) continue;
    if (mode == ContactMode::open || friction_coefficient(setting, at.layout, k) == 0.0)
      points[k].rubbing = {};
    else if (mode != points[k].rubbing.mode)
      points[k].rubbing = begun_here(setting, at, k, mode);
  }
  const auto layout = std::make_shared<const SlidingContactLayout>(
      setting.body, at.layout.shared_mesh(), std::move(points), at.layout.origin(), at.layout.lying());
  ActiveSet changed(before.contacts(), 0, layout);
  for (std::size_t j = 0; j < before.contacts(); ++j) changed[j] = before[j];
  for (const auto& [contact, mode] : modes)
    changed[static_cast<std::size_t>(contact)] = mode == ContactMode::open ? 0 : 1;
  State next{.x = moved_unknowns(at.state.x, before, changed),
             .lambda = at.state.lambda,
             .active_set = changed.with_kinks_of(before)};
  const SlidingUnknowns index(next.active_set);
  for (std::size_t k = 0; k < layout->points().size(); ++k)
    if (const auto w = index.place(k); w && !at.rubs(k)) next.x[*w] = layout->points()[k].rubbing.w;
  return next;
}

}  // namespace arcwall::sliding
