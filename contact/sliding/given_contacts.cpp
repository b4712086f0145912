#include "contact/sliding/given_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/sliding/bending.hpp"
#include "contact/sliding/layout_edit.hpp"
#include "contact/sliding/least_gaps.hpp"
#include "contact/sliding/lying.hpp"
#include "contact/sliding/pressed_part.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/touch.hpp"

namespace arcwall::sliding {

namespace {

using Span = SlidingContactLayout::Span;

// Of the obstacles that a wall is, the one whose surface is nearest to a place of a strand.
std::size_t obstacle_of(const SlidingSetting& setting, const SlidingState& at, const GivenContact& contact) {
  const MaterialPoint middle{.strand = contact.strand, .s = 0.5 * (contact.from + contact.to)};
  const AxisPlace axis = at.mesh.place(middle, at.now);
  std::size_t nearest = 0;
  double least = infinity;
  for (std::size_t w = 0; w < setting.obstacles.size(); ++w) {
    const SlidingObstacle& obstacle = setting.obstacles[w];
    if (obstacle.name != contact.wall || !obstacle.concerns(contact.strand)) continue;
    const double gap = std::abs(face_gap(obstacle, setting.face_offset(w, contact.strand), axis, at.now.lambda));
    if (gap < least) {
      least = gap;
      nearest = w;
    }
  }
  return nearest;
}

// The contact of a tip, where a place is so near it that it is one.
std::optional<std::size_t> tip_at(const SlidingSetting& setting, Index strand, double s, std::size_t obstacle) {
  for (std::size_t j = 0; j < setting.free_ends.size(); ++j) {
    const FreeEnd& end = setting.free_ends[j];
    const double tip = end.last ? setting.body.length(end.strand) : 0.0;
    if (end.strand == strand && end.obstacle == obstacle &&
        std::abs(s - tip) <= shortest_span(setting.body, end.strand))
      return j;
  }
  return std::nullopt;
}

// Where a contact at a point is, by the shape: the least gap within an element of where it was found.
double place_of_least_gap(const SlidingSetting& setting, const SlidingState& open, const GivenContact& contact,
                          std::size_t obstacle) {
  const auto least = nearest_least_gap(
      setting, open, {.obstacle = obstacle, .at = {.strand = contact.strand, .s = contact.from}, .gap = 0.0});
  if (!least) return contact.from;
  const auto [from, to] = std::minmax(least->at.s, contact.from);
  return setting.body.elements_between(contact.strand, from, to) <= 1.0 ? least->at.s : contact.from;
}

class GivenLayout {
 public:
  GivenLayout(const SlidingSetting& setting, const SlidingState& open)
      : setting_(setting), open_(open), edit_(edit_of(setting.body, open)) {}

  void close(const GivenContact& contact) {
    const std::size_t obstacle = obstacle_of(setting_, open_, contact);
    if (contact.between == Span::pressed && reaches_both_ends(contact))
      return lay_down(setting_, contact.strand, obstacle, edit_);
    const auto from_tip = tip_at(setting_, contact.strand, contact.from, obstacle);
    const auto to_tip = tip_at(setting_, contact.strand, contact.to, obstacle);
    if (from_tip) close_tip(*from_tip, contact.force_at_from);
    if (!from_tip) {
      const double s = contact.is_part() ? contact.from : place_of_least_gap(setting_, open_, contact, obstacle);
      add_point(contact, obstacle, s, contact.force_at_from);
    }
    if (!contact.is_part()) return;
    const std::size_t first = last_;
    if (to_tip && to_tip != from_tip) close_tip(*to_tip, contact.force_at_to);
    if (!to_tip) add_point(contact, obstacle, contact.to, contact.force_at_to);
    if (!from_tip) {
      edit_.elements_behind(first) = elements(contact, edit_.place(first), contact.to);
      edit_.points[first].behind = contact.between;
    } else if (!to_tip) {
      edit_.points[last_].before = contact.between;
    }
  }

  State state() {
    divide_evenly(edit_);
    return mapped_onto(setting_, open_, edit_, layout_of(edit_));
  }

 private:
  // But for an element at each of them.
  bool reaches_both_ends(const GivenContact& contact) const {
    const double all = setting_.body.elements_between(contact.strand, 0.0, setting_.body.length(contact.strand));
    const double some = setting_.body.elements_between(contact.strand, contact.from, contact.to);
    return all - some <= 2.5;
  }

  void close_tip(std::size_t end, double force) {
    edit_.ends_closed[end] = 1;
    edit_.end_forces[end] = force;
  }

  void add_point(const GivenContact& contact, std::size_t obstacle, double s, double force) {
    const LayoutEdit::Part part = edit_.part_at(contact.strand, s);
    last_ = edit_.insert(
        {.point = {.obstacle = obstacle}, .strand = contact.strand, .s = s, .closed = true, .force = force},
        elements_asked(setting_.body, contact.strand, part.from, s, 2),
        elements_asked(setting_.body, contact.strand, s, part.to, 2));
  }

  int elements(const GivenContact& contact, double from, double to) const {
    const int fewest = contact.between == Span::pressed ? fewest_pressed(false) : 2;
    return elements_asked(setting_.body, contact.strand, from, to, fewest);
  }

  const SlidingSetting& setting_;
  const SlidingState& open_;
  LayoutEdit edit_;
  std::size_t last_ = 0;  // the point that was added last
};

State closed(const SlidingSetting& setting, const SlidingState& open, const std::vector<GivenContact>& contacts) {
  GivenLayout layout(setting, open);
  for (const GivenContact& contact : contacts) layout.close(contact);
  return layout.state();
}

bool flat_parts_lie_by_themselves(const SlidingSetting& setting, const SlidingState& at) {
  const auto& points = at.layout.points();
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].behind == Span::flat && !lies_by_itself(setting, at, k)) return false;
  return true;
}

}  // namespace

State with_given_contacts(const SlidingSetting& setting, const SlidingState& open,
                          const std::vector<GivenContact>& contacts) {
  State state = closed(setting, open, contacts);
  if (flat_parts_lie_by_themselves(setting, SlidingState(state))) return state;
  std::vector<GivenContact> pressed = contacts;
  for (GivenContact& contact : pressed)
    if (contact.between == Span::flat) contact.between = Span::pressed;
  return closed(setting, open, pressed);
}

}  // namespace arcwall::sliding
