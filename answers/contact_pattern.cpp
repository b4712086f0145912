#include "answers/contact_pattern.hpp"

#include <cmath>
#include <optional>

namespace arcwall {

namespace {

using Span = SlidingContactLayout::Span;

// Closed nodes that follow each other are one stretch on a wall.
std::vector<RecordStretch> stretches_of_nodes(const Model& model, const State& state) {
  std::vector<RecordStretch> stretches;
  std::optional<ContactLabel> last;
  const auto follows = [&](const ContactLabel& label) {
    if (!last || last->wall != label.wall || last->member != label.member) return false;
    const double apart = std::abs(last->fraction - label.fraction) * 0.999;
    for (const MemberMesh& mesh : model.structure().members())
      if (mesh.name == label.member) return apart <= 1.0 / double(mesh.nodes.size() - 1);
    return false;
  };
  for (const ContactPoint& contact : model.contacts()->closed_contacts(state)) {
    if (follows(contact.label)) {
      stretches.back().is_zone = true;
      stretches.back().force += contact.force;
    } else {
      stretches.push_back({.label = contact.label, .force = contact.force});
    }
    last = contact.label;
  }
  return stretches;
}

// So are tracked points with a part on the wall between them, and a strand that lies on it from end to end. The nodes
// that are pressed inside bear a part of the force.
std::vector<RecordStretch> stretches_that_slide(const SlidingContact& contact, const State& state) {
  const SlidingContactLayout& layout = sliding_layout(state.active_set);
  std::vector<RecordStretch> stretches;
  std::vector<std::size_t> of_point(layout.points().size());
  for (std::size_t k = 0; k < state.active_set.contacts(); ++k) {
    if (state.active_set[k] == 0) continue;
    const ContactPoint here = contact.contact(state, static_cast<Index>(k));
    const bool is_point = k < layout.points().size();
    if (is_point && k > 0 && layout.points()[k - 1].behind != Span::free) {
      stretches.back().is_zone = true;
      stretches.back().force += here.force;
    } else {
      stretches.push_back({.label = here.label, .force = here.force});
    }
    if (is_point) of_point[k] = stretches.size() - 1;
  }
  std::vector<std::optional<std::size_t>> lying(static_cast<std::size_t>(contact.body().strands()));
  const std::vector<ContactPoint> pressed = contact.pressed_nodes(state);
  for (std::size_t i = 0; i < layout.pressed_nodes().size(); ++i) {
    const SlidingContactLayout::Segment& part = layout.segments()[layout.pressed_nodes()[i].segment];
    std::optional<std::size_t>& whole = lying[static_cast<std::size_t>(part.strand)];
    if (!part.has_point() && !whole) {
      whole = stretches.size();
      stretches.push_back({.label = pressed[i].label});
    }
    RecordStretch& stretch = stretches[part.has_point() ? of_point[part.end_point()] : *whole];
    stretch.is_zone = true;
    stretch.force += pressed[i].force;
  }
  return stretches;
}

}  // namespace

std::vector<RecordStretch> stretches_of(const Model& model, const State& state) {
  if (model.contacts() == nullptr) return {};
  return model.sliding() != nullptr ? stretches_that_slide(*model.sliding(), state) : stretches_of_nodes(model, state);
}

std::string contact_pattern_of(const std::vector<RecordStretch>& stretches) {
  std::string word;
  for (const RecordStretch& one : stretches)
    word += (word.empty() ? "" : " ") + one.label.wall + (one.is_zone ? "=" : "");
  return word;
}

}  // namespace arcwall
