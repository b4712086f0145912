#include "apps/output/path_lines.hpp"

#include <map>

namespace arcwall {

namespace {

// Unstable directions on either side of the points with events.
struct Sides {
  std::optional<Index> before{}, after{};
};

std::map<std::size_t, Sides> sides_of_events(const Record& record) {
  std::map<std::size_t, Sides> sides;
  const std::vector<std::size_t> first = first_points(record);
  for (const RecordEvent& event : record.events) {
    const auto [place, added] = sides.try_emplace(point_of(event, first), Sides{.before = event.unstable_before});
    place->second.after = event.unstable_after;
  }
  return sides;
}

Stability stability_of(const std::optional<Index>& unstable) {
  if (!unstable) return Stability::undecided;
  return *unstable > 0 ? Stability::unstable : Stability::stable;
}

// Between two points. A point without an event lies inside the arc and knows best; an event knows its two sides.
Stability between(const Record& record, const std::map<std::size_t, Sides>& events, std::size_t to) {
  const auto from_event = events.find(to - 1), to_event = events.find(to);
  if (to_event == events.end()) return record.points[to].count.stability;
  if (from_event == events.end()) return record.points[to - 1].count.stability;
  return stability_of(to_event->second.before ? to_event->second.before : from_event->second.after);
}

}  // namespace

std::vector<PathLine> path_lines(const Record& record) {
  const std::map<std::size_t, Sides> events = sides_of_events(record);
  std::vector<PathLine> lines;
  for (std::size_t i = 1; i < record.points.size(); ++i) {
    const Index branch = record.points[i].branch;
    if (branch != record.points[i - 1].branch) continue;
    const Stability stability = between(record, events, i);
    const bool goes_on = !lines.empty() && lines.back().last == i - 1 && lines.back().stability == stability;
    if (goes_on)
      lines.back().last = i;
    else
      lines.push_back({.branch = branch, .stability = stability, .first = i - 1, .last = i});
  }
  return lines;
}

std::vector<std::size_t> first_points(const Record& record) {
  std::vector<std::size_t> first{0};
  for (const RecordBranch& branch : record.branches)
    first.push_back(first.back() + static_cast<std::size_t>(branch.points));
  return first;
}

std::size_t point_of(const RecordEvent& event, const std::vector<std::size_t>& first_points) {
  return first_points[static_cast<std::size_t>(event.branch)] + static_cast<std::size_t>(event.step);
}

}  // namespace arcwall
