#include "contact/sliding/layout_edit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/sliding/spans.hpp"

namespace arcwall::sliding {

namespace {

using Span = SlidingContactLayout::Span;

constexpr double landed = 1e-4;  // elements by which a bound is missed

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

int rounded_elements(double elements) { return std::max(1, static_cast<int>(std::lround(elements))); }

// How many points of a strand lie before one of them.
std::size_t points_before(const std::vector<Index>& strands, std::size_t point) {
  return static_cast<std::size_t>(
      std::count(strands.begin(), strands.begin() + static_cast<std::ptrdiff_t>(point), strands[point]));
}

}  // namespace

// Segments that end at a point are those that do not end at a load.
std::size_t LayoutEdit::segment_before(std::size_t point) const {
  const std::vector<MeshSegment>& segments = elements[static_cast<std::size_t>(strands[point])];
  std::size_t others = points_before(strands, point), place = 0;
  while (segments[place].ends_at_load() || others-- > 0) ++place;
  return place;
}

int& LayoutEdit::segment(std::size_t point, std::size_t beyond) {
  return elements[static_cast<std::size_t>(strands[point])][segment_before(point) + beyond].elements;
}

LayoutEdit::Part LayoutEdit::part_at(Index strand, double place) const {
  const std::vector<MeshSegment>& segments = elements[static_cast<std::size_t>(strand)];
  Index point = 0;
  while (point < s.size() && strands[static_cast<std::size_t>(point)] < strand) ++point;
  Part part{.from = 0.0, .to = 0.0, .place = 0};
  for (;; ++part.place) {
    if (part.place + 1 == segments.size()) {
      part.to = body.length(strand);
      return part;
    }
    const Index load = segments[part.place].load;
    part.to = load >= 0 ? body.point_loads(strand)[static_cast<std::size_t>(load)] : s[point++];
    if (place < part.to) return part;
    part.from = part.to;
  }
}

void LayoutEdit::give_node(Index strand, Index load) {
  const double there = body.point_loads(strand)[static_cast<std::size_t>(load)];
  const Part part = part_at(strand, there);
  std::vector<MeshSegment>& segments = elements[static_cast<std::size_t>(strand)];
  int& behind = segments[part.place].elements;
  const double density = behind / (part.to - part.from);
  behind = rounded_elements(density * (part.to - there));
  insert_at(segments, part.place, MeshSegment(rounded_elements(density * (there - part.from)), load));
}

void LayoutEdit::take_node(Index strand, Index load) {
  std::vector<MeshSegment>& segments = elements[static_cast<std::size_t>(strand)];
  const auto place = static_cast<std::size_t>(
      std::find_if(segments.begin(), segments.end(), [&](const MeshSegment& at) { return at.load == load; }) -
      segments.begin());
  segments[place + 1].elements += segments[place].elements;
  erase_at(segments, place);
}

bool LayoutEdit::has_node(Index strand, Index load) const {
  const std::vector<MeshSegment>& segments = elements[static_cast<std::size_t>(strand)];
  return std::any_of(segments.begin(), segments.end(), [&](const MeshSegment& at) { return at.load == load; });
}

void LayoutEdit::set_lying(Index strand, std::optional<std::size_t> obstacle) {
  lying.resize(static_cast<std::size_t>(body.strands()));
  lying[static_cast<std::size_t>(strand)] = obstacle;
}

double LayoutEdit::depth_in_part(Index strand, double place, Span span) const {
  if (!lying.empty() && lying[static_cast<std::size_t>(strand)]) return span == Span::pressed ? infinity : -infinity;
  double deepest = -infinity;
  const auto elements_to = [&](double to) {
    return body.elements_between(strand, std::min(place, to), std::max(place, to));
  };
  const auto look_at = [&](Span of_part, std::optional<double> from, std::optional<double> to) {
    if (of_part != span) return;
    double depth = infinity;
    if (from) depth = std::min(depth, std::copysign(elements_to(*from), place - *from));
    if (to) depth = std::min(depth, std::copysign(elements_to(*to), *to - place));
    deepest = std::max(deepest, depth);
  };
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (strands[k] != strand) continue;
    const bool is_first = is_first_of_strand(k);
    const bool is_last = k + 1 == points.size() || strands[k + 1] != strand;
    const auto at = [&](std::size_t point) { return s[static_cast<Index>(point)]; };
    if (is_first) look_at(points[k].before, std::nullopt, at(k));
    look_at(points[k].behind, at(k), is_last ? std::nullopt : std::optional(at(k + 1)));
  }
  return deepest;
}

std::optional<LayoutEdit::NearestPoint> LayoutEdit::nearest_point(Index strand, double place) const {
  std::optional<NearestPoint> nearest;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (strands[k] != strand) continue;
    const double there = s[static_cast<Index>(k)];
    const double between = body.elements_between(strand, std::min(place, there), std::max(place, there));
    if (!nearest || between < nearest->elements) nearest = NearestPoint{.point = k, .elements = between};
  }
  return nearest;
}

void LayoutEdit::even_out_beside_load(std::size_t point, Index load) {
  const Index strand = strands[point];
  const bool first = is_first_of_strand(point);
  const Span span_before = first ? points[point].before : points[point - 1].behind;
  const bool neutral_before = first ? points[point].neutral_before : points[point - 1].neutral_behind;
  const bool both_free = span_before == Span::free && points[point].behind == Span::free;
  if (!both_free || neutral_before || points[point].neutral_behind) return;
  const double there = body.point_loads(strand)[static_cast<std::size_t>(load)];
  const double from = part_at(strand, std::nextafter(place(point), 0.0)).from, to = part_at(strand, place(point)).to;
  if (!(from < there && there < to)) return;
  int &before = elements_before(point), &behind = elements_behind(point);
  const double density = (before + behind) / body.elements_between(strand, from, to);
  const auto as_fine = [&](double a, double b) {
    const int even = rounded_elements(density * body.elements_between(strand, a, b));
    return std::max(even, fewest_elements(body, strand, a, b));
  };
  before = as_fine(from, there);
  behind = as_fine(there, to);
}

std::size_t LayoutEdit::insert(const Entry& entry, int elements_before, int elements_behind) {
  std::vector<MeshSegment>& in_strand = elements[static_cast<std::size_t>(entry.strand)];
  const std::size_t place = part_at(entry.strand, entry.s).place;
  in_strand[place].elements = elements_behind;
  insert_at(in_strand, place, MeshSegment(elements_before));
  std::size_t k = 0;
  while (k < points.size() &&
         (strands[k] < entry.strand || (strands[k] == entry.strand && s[static_cast<Index>(k)] < entry.s)))
    ++k;
  if (k < points.size() && strands[k] == entry.strand) points[k].neutral_before = false;
  if (k > 0 && strands[k - 1] == entry.strand) points[k - 1].neutral_behind = false;
  insert_at(points, k, entry.point);
  insert_at(strands, k, entry.strand);
  insert_at(closed, k, static_cast<std::uint8_t>(entry.closed));
  insert_at(forces, k, entry.force);
  s = inserted(s, k, entry.s);
  return k;
}

void LayoutEdit::erase(std::size_t point, int of_both) {
  const std::size_t before = segment_before(point);
  std::vector<MeshSegment>& in_strand = elements[static_cast<std::size_t>(strands[point])];
  in_strand[before + 1].elements = of_both;
  erase_at(in_strand, before);
  erase_at(points, point);
  erase_at(strands, point);
  erase_at(closed, point);
  erase_at(forces, point);
  s = erased(s, point);
}

LayoutEdit edit_of(const SlidingBody& body, const SlidingState& at) {
  LayoutEdit edit{.body = body,
                  .elements = at.mesh.elements_per_segment(),
                  .points = at.layout.points(),
                  .s = at.now.s,
                  .lying = at.layout.lying()};
  for (Index strand = 0; strand < body.strands(); ++strand) {
    std::vector<MeshSegment>& segments = edit.elements[static_cast<std::size_t>(strand)];
    std::vector<std::uint8_t>& loads = edit.handed_on.emplace_back(body.point_loads(strand).size());
    for (MeshSegment& segment : segments) {
      for (const Index load : segment.handed_on) loads[static_cast<std::size_t>(load)] = 1;
      segment.handed_on.clear();
    }
  }
  for (std::size_t k = 0; k < edit.points.size(); ++k) {
    edit.strands.push_back(at.mesh.breakpoint(static_cast<Index>(k)).first);
    edit.closed.push_back(at.is_closed(k));
    edit.forces.push_back(at.force(k));
  }
  for (std::size_t j = edit.points.size(); j < at.contacts(); ++j) {
    edit.ends_closed.push_back(at.is_closed(j));
    edit.end_forces.push_back(at.force(j));
  }
  return edit;
}

void settle_loads(LayoutEdit& edit) {
  for (Index strand = 0; strand < edit.body.strands(); ++strand) {
    const std::vector<double>& places = edit.body.point_loads(strand);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto load = static_cast<Index>(i);
      std::uint8_t& handed_on = edit.handed_on[static_cast<std::size_t>(strand)][i];
      const double pressed = edit.depth_in_part(strand, places[i], Span::pressed);
      if (std::abs(pressed) > 2.0 * edge_behind_load) handed_on = pressed > 0.0;
      const bool on_wall = handed_on || edit.depth_in_part(strand, places[i], Span::flat) > 0.0;
      const bool has_node = edit.has_node(strand, load);
      const auto nearest = edit.nearest_point(strand, places[i]);
      const bool beside = nearest && nearest->elements <= nearest_node_of_load + landed;
      const bool far = !nearest || nearest->elements >= farthest_load_inside - landed;
      if (has_node && (on_wall || beside)) edit.take_node(strand, load);
      if (has_node && !on_wall && beside) edit.even_out_beside_load(nearest->point, load);
      if (!has_node && !on_wall && far) edit.give_node(strand, load);
    }
  }
}

namespace {

// Neutral spans are held at the node in their middle.
void give_middles(LayoutEdit& edit) {
  const auto make_even = [](int& number) { number += number % 2; };
  for (std::size_t k = 0; k < edit.points.size(); ++k) {
    const bool is_first = k == 0 || edit.strands[k - 1] != edit.strands[k];
    if (is_first && edit.points[k].neutral_before) make_even(edit.elements_before(k));
    if (edit.points[k].neutral_behind) make_even(edit.elements_behind(k));
  }
}

// Says of the segments which are pressed, and gives them the loads that they hand on. One at the edge of a part is near
// the end of its segment, be it beyond.
void hand_loads_on(LayoutEdit& edit) {
  std::size_t next = 0;  // point
  for (std::size_t strand = 0; strand < edit.elements.size(); ++strand) {
    std::vector<MeshSegment>& segments = edit.elements[strand];
    const auto ends_at_point = [&](const MeshSegment& at) { return !at.ends_at_load() && &at != &segments.back(); };
    Span span = !edit.lying.empty() && edit.lying[strand] ? Span::pressed : Span::free;
    if (std::any_of(segments.begin(), segments.end(), ends_at_point)) span = edit.points[next].before;
    const std::vector<double>& places = edit.body.point_loads(static_cast<Index>(strand));
    double from = 0.0;
    for (MeshSegment& segment : segments) {
      double to = edit.body.length(static_cast<Index>(strand));
      if (segment.ends_at_load()) to = places[static_cast<std::size_t>(segment.load)];
      if (ends_at_point(segment)) to = edit.place(next);
      segment.pressed = span == Span::pressed;
      const double edge = 0.5 * (to - from) / segment.elements;
      for (std::size_t i = 0; i < places.size() && segment.pressed; ++i)
        if (edit.handed_on[strand][i] && from - edge < places[i] && places[i] < to + edge)
          segment.handed_on.push_back(static_cast<Index>(i));
      if (ends_at_point(segment)) span = edit.points[next++].behind;
      from = to;
    }
  }
}

}  // namespace

std::shared_ptr<const SlidingContactLayout> layout_of(LayoutEdit edit) {
  settle_loads(edit);
  give_middles(edit);
  hand_loads_on(edit);
  return std::make_shared<SlidingContactLayout>(edit.body, edit.body.mesh(edit.elements), edit.points, edit.s,
                                                edit.lying);
}

}  // namespace arcwall::sliding
