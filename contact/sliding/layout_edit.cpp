#include "contact/sliding/layout_edit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
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

MeshSegment& LayoutEdit::segment(std::size_t point, std::size_t beyond) {
  return elements[static_cast<std::size_t>(strands[point])][segment_before(point) + beyond];
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

LayoutEdit::Run LayoutEdit::run_around(Index strand, std::size_t place) const {
  const std::vector<MeshSegment>& segments = elements[static_cast<std::size_t>(strand)];
  auto point = static_cast<std::size_t>(std::lower_bound(strands.begin(), strands.end(), strand) - strands.begin());
  Run run{.first = 0, .last = 0, .from = 0.0, .to = body.length(strand), .waiting = {}};
  for (; run.last + 1 < segments.size(); ++run.last) {
    const Index load = segments[run.last].load;
    if (load < 0 && points[point].waits()) {
      run.waiting.push_back(point++);
      continue;
    }
    const double end =
        load >= 0 ? body.point_loads(strand)[static_cast<std::size_t>(load)] : s[static_cast<Index>(point++)];
    if (place <= run.last) {
      run.to = end;
      return run;
    }
    run = {.first = run.last + 1, .last = run.last, .from = end, .to = run.to, .waiting = {}};
  }
  return run;
}

int LayoutEdit::undivided(Index strand, const Run& run) const {
  return run.waiting.empty() ? elements[static_cast<std::size_t>(strand)][run.first].elements
                             : points[run.waiting.front()].undivided;
}

void LayoutEdit::set_undivided(const Run& run, int elements_of_all) {
  for (const std::size_t point : run.waiting) points[point].undivided = elements_of_all;
}

int LayoutEdit::undivided_at(Index strand, double at) const {
  return undivided(strand, run_around(strand, part_at(strand, at).place));
}

int LayoutEdit::elements_without(std::size_t point) {
  const Run run = run_around(strands[point], segment_before(point));
  const bool alone = run.waiting.size() == 1 && run.waiting.front() == point;
  return alone ? points[point].undivided : elements_before(point) + elements_behind(point);
}

void LayoutEdit::give_node(Index strand, Index load) {
  const double there = body.point_loads(strand)[static_cast<std::size_t>(load)];
  const Part part = part_at(strand, there);
  const Run run = run_around(strand, part.place);
  const double undivided_density = undivided(strand, run) / (run.to - run.from);
  std::vector<MeshSegment>& segments = elements[static_cast<std::size_t>(strand)];
  int& behind = segments[part.place].elements;
  const double density = behind / (part.to - part.from);
  behind = rounded_elements(density * (part.to - there));
  insert_at(segments, part.place, MeshSegment(rounded_elements(density * (there - part.from)), load));
  set_undivided(run_around(strand, part.place), rounded_elements(undivided_density * (there - run.from)));
  set_undivided(run_around(strand, part.place + 1), rounded_elements(undivided_density * (run.to - there)));
}

void LayoutEdit::take_node(Index strand, Index load) {
  std::vector<MeshSegment>& segments = elements[static_cast<std::size_t>(strand)];
  const auto place = static_cast<std::size_t>(
      std::find_if(segments.begin(), segments.end(), [&](const MeshSegment& at) { return at.load == load; }) -
      segments.begin());
  const int both = undivided(strand, run_around(strand, place)) + undivided(strand, run_around(strand, place + 1));
  segments[place + 1].elements += segments[place].elements;
  erase_at(segments, place);
  set_undivided(run_around(strand, place), both);
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

std::optional<double> LayoutEdit::elements_to_point(Index strand, double place) const {
  std::optional<double> nearest;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (strands[k] != strand) continue;
    const double there = s[static_cast<Index>(k)];
    const double between = body.elements_between(strand, std::min(place, there), std::max(place, there));
    if (!nearest || between < *nearest) nearest = between;
  }
  return nearest;
}

namespace {

// Of a point that is not its strand's first.
void begins_nothing(SlidingContactLayout::Point& point) {
  point.before = Span::free;
  point.neutral_before = false;
}

}  // namespace

std::size_t LayoutEdit::insert(const Entry& entry, int elements_before, int elements_behind) {
  std::vector<MeshSegment>& in_strand = elements[static_cast<std::size_t>(entry.strand)];
  const std::size_t place = part_at(entry.strand, entry.s).place;
  in_strand[place].elements = elements_behind;
  insert_at(in_strand, place, MeshSegment(elements_before));
  std::size_t k = 0;
  while (k < points.size() &&
         (strands[k] < entry.strand || (strands[k] == entry.strand && s[static_cast<Index>(k)] <= entry.s)))
    ++k;
  SlidingContactLayout::Point point = entry.point;
  if (k < points.size() && strands[k] == entry.strand) begins_nothing(points[k]);
  if (k > 0 && strands[k - 1] == entry.strand) {
    points[k - 1].neutral_behind = false;
    begins_nothing(point);
  }
  insert_at(points, k, point);
  insert_at(strands, k, entry.strand);
  insert_at(closed, k, static_cast<std::uint8_t>(entry.closed));
  insert_at(forces, k, entry.force);
  insert_at(frictions, k, 0.0);
  insert_at(held, k, 0.0);
  s = inserted(s, k, entry.s);
  if (!entry.point.waits()) touch(k);
  return k;
}

std::size_t LayoutEdit::insert_near_end(const StrandEnd& end, double place, std::size_t obstacle,
                                        SlidingContactLayout::Span outer, SlidingContactLayout::Span inner,
                                        int elements_outside, double force) {
  const auto [strand, last] = end;
  const int rest = elements[static_cast<std::size_t>(strand)][part_at(strand, place).place].elements;
  const SlidingContactLayout::Point point{
      .obstacle = obstacle, .behind = last ? outer : inner, .before = last ? inner : outer};
  return insert({.point = point, .strand = strand, .s = place, .closed = true, .force = force},
                last ? rest : elements_outside, last ? elements_outside : rest);
}

// As many as they have together.
void LayoutEdit::settle_undivided(Index strand, std::size_t place) {
  const std::vector<MeshSegment>& segments = elements[static_cast<std::size_t>(strand)];
  const Run run = run_around(strand, place);
  int all = 0;
  for (std::size_t i = run.first; i <= run.last; ++i) all += segments[i].elements;
  set_undivided(run, all);
}

// What is before a strand's first point vanishes with it; otherwise the span behind a point does.
void LayoutEdit::erase(std::size_t point, int of_both) {
  const std::size_t before = segment_before(point);
  const Index strand = strands[point];
  if (is_first_of_strand(point) && point + 1 < points.size() && strands[point + 1] == strand) {
    points[point + 1].before = points[point].behind;
    points[point + 1].neutral_before = points[point].neutral_behind;
  }
  std::vector<MeshSegment>& in_strand = elements[static_cast<std::size_t>(strand)];
  int all = undivided(strand, run_around(strand, before));
  if (!points[point].waits()) {
    all += undivided(strand, run_around(strand, before + 1));
    all += of_both - in_strand[before].elements - in_strand[before + 1].elements;
  }
  in_strand[before + 1].elements = of_both;
  erase_at(in_strand, before);
  erase_at(points, point);
  erase_at(strands, point);
  erase_at(closed, point);
  erase_at(forces, point);
  erase_at(frictions, point);
  erase_at(held, point);
  s = erased(s, point);
  set_undivided(run_around(strand, before), std::max(1, all));
}

void LayoutEdit::press_up_to_end(std::size_t point, bool last, int elements_of_part) {
  const Index strand = strands[point];
  const std::size_t obstacle = points[point].obstacle, inner = last ? point - 1 : point + 1;
  const bool is_alone = inner >= points.size() || strands[inner] != strand;  // also of the first point
  erase(point, elements_of_part);
  if (is_alone) set_lying(strand, obstacle);
}

void LayoutEdit::touch(std::size_t point) {
  points[point].undivided = 0;
  const std::size_t before = segment_before(point);
  settle_undivided(strands[point], before);
  settle_undivided(strands[point], before + 1);
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
    edit.frictions.push_back(at.rubs(k) ? at.state.x[*at.index.friction(k)] : 0.0);
    edit.held.push_back(at.rubs(k) ? at.state.x[*at.index.place(k)] : 0.0);
  }
  for (std::size_t k = 0; k < edit.points.size(); ++k)
    if (edit.closed[k] && edit.points[k].waits()) edit.touch(k);
  for (std::size_t j = edit.points.size(); j < at.contacts(); ++j) {
    edit.ends_closed.push_back(at.is_closed(j));
    edit.end_forces.push_back(at.force(j));
    edit.end_rubbings.push_back(at.layout.rubbing(j));
    edit.end_frictions.push_back(at.rubs(j) ? at.state.x[*at.index.friction(j)] : 0.0);
    edit.ends_held.push_back(at.rubs(j) ? at.state.x[*at.index.place(j)] : 0.0);
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
      const auto nearest = edit.elements_to_point(strand, places[i]);
      const bool beside = nearest && *nearest <= nearest_node_of_load + landed;
      const bool far = !nearest || *nearest >= farthest_load_inside - landed;
      if (has_node && (on_wall || beside)) edit.take_node(strand, load);
      if (!has_node && !on_wall && far) edit.give_node(strand, load);
    }
  }
}

namespace {

// A segment, where it is and how it runs.
struct Part {
  MeshSegment* segment;
  Index strand;
  double from, to;
  bool has_point;  // at one of its ends
  bool between_points;
  int undivided;  // of a point that waits at its end; 0: none does
  bool waits;     // a point that waits is at one of its ends
  Span span;
  bool neutral;
};

std::vector<Part> parts_of(LayoutEdit& edit) {
  std::vector<Part> parts;
  std::size_t next = 0;  // point
  for (std::size_t strand = 0; strand < edit.elements.size(); ++strand) {
    std::vector<MeshSegment>& segments = edit.elements[strand];
    const std::vector<double>& loads = edit.body.point_loads(static_cast<Index>(strand));
    const auto ends_at_point = [&](const MeshSegment& at) { return !at.ends_at_load() && &at != &segments.back(); };
    Span span = !edit.lying.empty() && edit.lying[strand] ? Span::pressed : Span::free;
    bool neutral = false, from_point = false, from_waiting = false;
    if (std::any_of(segments.begin(), segments.end(), ends_at_point)) {
      span = edit.points[next].before;
      neutral = edit.points[next].neutral_before;
    }
    double from = 0.0;
    for (MeshSegment& segment : segments) {
      const bool to_point = ends_at_point(segment);
      double to = edit.body.length(static_cast<Index>(strand));
      if (segment.ends_at_load()) to = loads[static_cast<std::size_t>(segment.load)];
      if (to_point) to = edit.place(next);
      const int undivided = to_point ? edit.points[next].undivided : 0;
      parts.push_back({.segment = &segment,
                       .strand = static_cast<Index>(strand),
                       .from = from,
                       .to = to,
                       .has_point = from_point || to_point,
                       .between_points = from_point && to_point,
                       .undivided = undivided,
                       .waits = from_waiting || undivided > 0,
                       .span = span,
                       .neutral = neutral});
      from = to;
      from_point = to_point;
      from_waiting = undivided > 0;
      if (!to_point) continue;
      span = edit.points[next].behind;
      neutral = edit.points[next].neutral_behind;
      ++next;
    }
  }
  return parts;
}

// Neutral spans are held at the node in their middle.
void give_middles(const std::vector<Part>& parts) {
  for (const Part& part : parts)
    if (part.neutral) part.segment->elements += part.segment->elements % 2;
}

// A part without contacts has the elements that are asked for, whatever it was made of.
void give_asked(const LayoutEdit& edit, const std::vector<Part>& parts) {
  for (const Part& part : parts)
    if (!part.has_point && part.span == Span::free)
      part.segment->elements = elements_asked(edit.body, part.strand, part.from, part.to, 1);
}

double asked(const LayoutEdit& edit, const Part& part) {
  return edit.body.elements_between(part.strand, part.from, part.to);
}

// Points that wait divide the elements of the part which they divide by the lengths.
void share_out(const LayoutEdit& edit, const std::vector<Part>& parts) {
  constexpr double rounded_up = 0.48;  // so that halves are alike in whatever order they come
  for (auto first = parts.begin(); first != parts.end(); ++first) {
    if (first->undivided == 0) continue;
    const auto last = std::find_if(first, parts.end(), [](const Part& part) { return part.undivided == 0; });
    const double all = edit.body.elements_between(first->strand, first->from, last->to);
    const int elements = first->undivided;
    for (; first != last + 1; ++first) {
      const double share = elements * asked(edit, *first) / all;
      const double fewest = asked(edit, *first) / coarsest + landed;
      first->segment->elements =
          std::max({1, static_cast<int>(std::ceil(share - rounded_up)), static_cast<int>(std::ceil(fewest))});
    }
    --first;
  }
}

// Those of the parts that are of about one length with one of them, or with one that is, for each.
std::vector<std::vector<const Part*>> alike_among(const LayoutEdit& edit, std::vector<const Part*> left) {
  constexpr double landed_on = 1e-3;
  const auto compared = [&](const Part* part) { return ComparedPart{.span = part->span, .asked = asked(edit, *part)}; };
  const auto are_alike = [&](const Part* one, const Part* other) {
    const ComparedPart a = compared(one), b = compared(other);
    return a.may_be_like(b) && std::abs(std::log(a.asked / b.asked)) <= std::log(alike) + landed_on;
  };
  std::vector<std::vector<const Part*>> groups;
  while (!left.empty()) {
    std::vector<const Part*> same{left.back()};
    left.pop_back();
    for (std::size_t i = 0; i < same.size(); ++i) {
      const auto others =
          std::partition(left.begin(), left.end(), [&](const Part* b) { return !are_alike(same[i], b); });
      same.insert(same.end(), others, left.end());
      left.erase(others, left.end());
    }
    groups.push_back(std::move(same));
  }
  return groups;
}

int finest_of(const std::vector<const Part*>& parts) {
  int most = 0;
  for (const Part* part : parts) most = std::max(most, part->segment->elements);
  return most;
}

// Parts of about one length get equally many elements, those of the finest of them, but not more than twice those asked
// for. The layout's bounds tell where two come to be so, up to how exactly that is landed on.
void give_alike(const LayoutEdit& edit, const std::vector<const Part*>& parts) {
  for (const std::vector<const Part*>& same : alike_among(edit, parts)) {
    int each = finest_of(same);
    const auto has_each = [each](const Part* part) { return part->segment->elements == each; };
    if (std::all_of(same.begin(), same.end(), has_each)) continue;
    for (const Part* part : same) each = std::min(each, static_cast<int>(2.0 * asked(edit, *part)));
    if (std::any_of(same.begin(), same.end(), [](const Part* part) { return part->neutral; })) each += each % 2;
    for (const Part* part : same) part->segment->elements = each;
  }
}

// Parts beside points that wait get what others of about one length have, which do not change: where such points come
// and go, nothing else is to show it.
void give_alike_beside_waiting(const LayoutEdit& edit, const std::vector<Part>& parts) {
  std::vector<const Part*> with_points;
  for (const Part& part : parts)
    if (part.has_point) with_points.push_back(&part);
  for (const std::vector<const Part*>& same : alike_among(edit, std::move(with_points))) {
    std::vector<const Part*> others;
    std::copy_if(same.begin(), same.end(), std::back_inserter(others), [](const Part* part) { return !part->waits; });
    const int each = finest_of(others.empty() ? same : others);
    for (const Part* part : same)
      if (part->waits) part->segment->elements = each;
  }
}

// Says of the parts which are pressed, and gives them the loads that they hand on. One at the edge of a part is near
// the end of its segment, be it beyond.
void hand_loads_on(const LayoutEdit& edit, const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    const std::vector<double>& places = edit.body.point_loads(part.strand);
    part.segment->pressed = part.span == Span::pressed;
    const double edge = 0.5 * (part.to - part.from) / part.segment->elements;
    for (std::size_t i = 0; i < places.size() && part.segment->pressed; ++i)
      if (edit.handed_on[static_cast<std::size_t>(part.strand)][i] && part.from - edge < places[i] &&
          places[i] < part.to + edge)
        part.segment->handed_on.push_back(static_cast<Index>(i));
  }
}

}  // namespace

void divide_beside_waiting(LayoutEdit& edit) {
  const std::vector<Part> parts = parts_of(edit);
  share_out(edit, parts);
  give_alike_beside_waiting(edit, parts);
}

void divide_evenly(LayoutEdit& edit) {
  settle_loads(edit);
  const std::vector<Part> parts = parts_of(edit);
  give_asked(edit, parts);
  std::vector<const Part*> settled;
  for (const Part& part : parts)
    if (part.has_point && !part.waits) settled.push_back(&part);
  give_alike(edit, settled);
  divide_beside_waiting(edit);
}

std::shared_ptr<const SlidingContactLayout> layout_of(LayoutEdit edit) {
  settle_loads(edit);
  const std::vector<Part> parts = parts_of(edit);
  give_middles(parts);
  hand_loads_on(edit, parts);
  for (const Part& part : parts)
    part.segment->straight =
        part.segment->straight && part.between_points && part.span == Span::flat && part.segment->elements == 1;
  return std::make_shared<SlidingContactLayout>(edit.body, edit.body.mesh(edit.elements), edit.points, edit.s,
                                                edit.lying, edit.end_rubbings);
}

}  // namespace arcwall::sliding
