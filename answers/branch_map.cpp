#include "answers/branch_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "answers/contact_pattern.hpp"
#include "core/nearly_equal.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

bool parts_segments(const RecordEvent& event) {
  const bool turns = event.kind == EventKind::limit_point || event.kind == EventKind::contact_limit_point ||
                     event.kind == EventKind::branch_point;
  return !event.unconfirmed && (turns || changes_contact(event.kind));
}

std::pair<double, double> lambdas(const BranchMapSegment& segment, const Record& record) {
  return std::minmax(record.points[segment.first].lambda, record.points[segment.last].lambda);
}

// Just behind a point.
const std::optional<RecordRates>& rates_behind(const RecordPoint& point) {
  return point.rates_after ? point.rates_after : point.rates;
}

// dΠ/dλ along a path, which is ∂Π/∂λ: the unknowns do no work. Empty where λ changes more slowly than `least`: Π, whose
// rate is one of differences, hardly changes either.
std::optional<double> energy_slope(const std::optional<RecordRates>& rates, double least) {
  if (!rates || !(std::abs(rates->lambda) > least)) return std::nullopt;
  return rates->energy / rates->lambda;
}

constexpr double standing = 1e-4;  // of the mean rate of λ between two points: λ turns at one of them
constexpr double tiny = 1e-300;

class Maker {
 public:
  Maker(const Model& model, const Record& record) : model_(model), record_(record) {
    for (const RecordBranch& branch : record.branches) {
      first_points_.push_back(first_points_.empty() ? 0
                                                    : first_points_.back() + static_cast<std::size_t>(points_before_));
      points_before_ = branch.points;
    }
  }

  BranchMap make() {
    for (const RecordBranch& branch : record_.branches) add_segments(branch);
    for (const RecordBranch& branch : record_.branches) add_start(branch);
    for (const RecordEvent& event : record_.events) {
      if (event.jump) add_jump(event, *event.jump);
      if (event.branch_end && event.branch_end->reason == EndReason::reached_branch && event.branch_end->partner)
        add_join(event);
    }
    merge_images();
    add_ranges();
    return std::move(map_);
  }

 private:
  std::size_t point_of(const RecordEvent& event) const {
    return first_points_[static_cast<std::size_t>(event.branch)] + static_cast<std::size_t>(event.step);
  }

  std::vector<const RecordEvent*> events_at(std::size_t point) const {
    std::vector<const RecordEvent*> found;
    for (const RecordEvent& event : record_.events)
      if (point_of(event) == point && event.branch == record_.points[point].branch && parts_segments(event))
        found.push_back(&event);
    return found;
  }

  bool turns_at(std::size_t point) const {
    const auto lambda = [&](std::size_t i) { return record_.points[i].lambda; };
    return (lambda(point) - lambda(point - 1)) * (lambda(point + 1) - lambda(point)) < 0.0;
  }

  void add_segments(const RecordBranch& branch) {
    if (branch.points < 2) return;
    const std::size_t begin = first_points_[static_cast<std::size_t>(branch.id)];
    const std::size_t end = begin + static_cast<std::size_t>(branch.points) - 1;
    std::set<std::size_t> parting;
    for (const RecordEvent& event : record_.events)
      if (event.branch == branch.id && parts_segments(event)) parting.insert(point_of(event));
    std::size_t first = begin;
    for (std::size_t i = begin + 1; i <= end; ++i) {
      if (i < end && !parting.contains(i) && !turns_at(i)) continue;
      map_.segments.push_back(segment(branch.id, first, i));
      if (first > begin) add_passage(first);
      first = i;
    }
  }

  // Inside of it, where there is a point inside: at an event contacts are neither of what is before nor behind.
  BranchMapSegment segment(Index branch, std::size_t first, std::size_t last) const {
    const bool begins_at_event = record_.points[first].event.has_value();
    const RecordPoint& inside = record_.points[last - first > 1 ? (first + last) / 2 : begins_at_event ? last : first];
    BranchMapSegment made{.branch = branch, .first = first, .last = last};
    made.contact_pattern = contact_pattern_of(stretches_of(model_, inside.state));
    made.unstable = inside.count.unstable;
    const auto events = events_at(first);
    if (!events.empty() && events.back()->unstable_after) made.unstable = events.back()->unstable_after;
    return made;
  }

  // From the segment before the last one to the last one.
  void add_passage(std::size_t point) {
    BranchMapEdge edge{.kind = to_text_of_turn(), .lambda = record_.points[point].lambda};
    for (const RecordEvent* const event : events_at(point)) {
      edge.events.push_back(event->id);
      if (edge.events.size() == 1 || !changes_contact(event->kind)) edge.kind = std::string(to_text(event->kind));
    }
    edge.from = map_.segments.size() - 2;
    edge.to = map_.segments.size() - 1;
    map_.edges.push_back(std::move(edge));
  }

  static std::string to_text_of_turn() { return std::string(to_text(EventKind::limit_point)); }

  // The last segment of a branch that has a point, or the first behind it.
  std::optional<std::size_t> segment_with(std::size_t point, bool behind) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < map_.segments.size(); ++i) {
      const BranchMapSegment& segment = map_.segments[i];
      if (segment.branch != record_.points[point].branch || point < segment.first || point > segment.last) continue;
      if (!found || behind) found = i;
    }
    return found;
  }

  // Where a branch leaves another, or begins with another one at a state that was found.
  void add_start(const RecordBranch& branch) {
    if (branch.points < 2) return;
    const auto first = segment_with(first_points_[static_cast<std::size_t>(branch.id)], false);
    if (!first) return;
    if (branch.origin && !branch.after_jump) {
      const RecordEvent& origin = record_.events[static_cast<std::size_t>(*branch.origin)];
      if (const auto from = segment_with(point_of(origin), false))
        map_.edges.push_back({.kind = std::string(to_text(origin.kind)),
                              .lambda = origin.lambda,
                              .events = {origin.id},
                              .from = *from,
                              .to = first});
    }
    for (const RecordSearch& search : record_.searches)
      for (const RecordFound& found : search.found) {
        if (found.fate != FoundFate::traced || found.branches.size() != 2 || found.branches[1] != branch.id) continue;
        if (const auto other = segment_with(first_points_[static_cast<std::size_t>(found.branches[0])], false))
          map_.edges.push_back({.kind = "search", .lambda = search.lambda, .from = *other, .to = first});
      }
  }

  void add_jump(const RecordEvent& event, const RecordJump& jump) {
    for (const RecordJump& one : jump.destinations) add_jump(event, one);
    if (!jump.reason.empty()) return;
    const auto from = segment_with(point_of(event), false);
    if (!from) return;
    BranchMapEdge edge{.kind = "jump", .lambda = event.lambda, .events = {event.id}, .from = *from};
    if (jump.on_branch) {
      const bool begins_there = record_.points[jump.point].arc == jump.arc;
      edge.to = segment_with(begins_there ? jump.point : jump.point + 1, false);
    }
    map_.edges.push_back(std::move(edge));
  }

  // To the segment of the other branch that has the λ, of several that of the energy.
  void add_join(const RecordEvent& event) {
    const auto from = segment_with(point_of(event), true);
    if (!from) return;
    const RecordPoint& last = record_.points[point_of(event)];
    std::optional<std::size_t> nearest;
    double least = infinity;
    for (std::size_t i = 0; i < map_.segments.size(); ++i) {
      const auto [low, high] = lambdas(map_.segments[i], record_);
      if (map_.segments[i].branch != *event.branch_end->partner || i == *from) continue;
      const double lambda = std::clamp(last.lambda, low, high);
      const double off =
          std::abs(energy_at(map_.segments[i], record_, lambda) - last.energy) +
          std::abs(lambda - last.lambda) *
              std::abs(energy_slope(rates_behind(record_.points[map_.segments[i].first]), 0.0).value_or(0.0));
      if (off >= least) continue;
      least = off;
      nearest = i;
    }
    map_.edges.push_back(
        {.kind = "reached_branch", .lambda = last.lambda, .events = {event.id}, .from = *from, .to = nearest});
  }

  bool are_images(const BranchMapSegment& a, const BranchMapSegment& b) const {
    if (a.branch == b.branch || a.unstable != b.unstable) return false;
    const auto ends = [&](const BranchMapSegment& segment) {
      std::pair low(record_.points[segment.first].lambda, record_.points[segment.first].energy);
      std::pair high(record_.points[segment.last].lambda, record_.points[segment.last].energy);
      if (low > high) std::swap(low, high);
      return std::array{low.first, low.second, high.first, high.second};
    };
    const auto of_a = ends(a), of_b = ends(b);
    return std::equal(of_a.begin(), of_a.end(), of_b.begin(), nearly_equal);
  }

  // Of segments that are images of each other the first stays.
  void merge_images() {
    std::vector<std::size_t> now(map_.segments.size());
    std::vector<BranchMapSegment> kept;
    for (std::size_t i = 0; i < map_.segments.size(); ++i) {
      const auto same = std::find_if(
          kept.begin(), kept.end(), [&](const BranchMapSegment& other) { return are_images(other, map_.segments[i]); });
      now[i] = static_cast<std::size_t>(same - kept.begin());
      if (same != kept.end())
        same->images.push_back(map_.segments[i].branch);
      else
        kept.push_back(map_.segments[i]);
    }
    map_.segments = std::move(kept);
    for (BranchMapEdge& edge : map_.edges) {
      edge.from = now[edge.from];
      if (edge.to) edge.to = now[*edge.to];
    }
  }

  std::optional<std::size_t> least_of(const std::vector<std::size_t>& stable, double lambda) const {
    if (stable.empty()) return std::nullopt;
    const auto energy = [&](std::size_t i) { return energy_at(map_.segments[i], record_, lambda); };
    return *std::min_element(stable.begin(), stable.end(),
                             [&](std::size_t a, std::size_t b) { return energy(a) < energy(b); });
  }

  void add_ranges() {
    std::vector<double> bounds;
    for (const BranchMapSegment& segment : map_.segments) {
      const auto [low, high] = lambdas(segment, record_);
      bounds.insert(bounds.end(), {low, high});
    }
    std::sort(bounds.begin(), bounds.end());
    const double apart = bounds.empty() ? 0.0 : same_value * (bounds.back() - bounds.front());
    const auto is_one = [&](double a, double b) { return b - a <= apart; };
    bounds.erase(std::unique(bounds.begin(), bounds.end(), is_one), bounds.end());
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
      BranchMapRange range{.low = bounds[i], .high = bounds[i + 1]};
      const double middle = 0.5 * (range.low + range.high);
      for (std::size_t k = 0; k < map_.segments.size(); ++k) {
        const auto [low, high] = lambdas(map_.segments[k], record_);
        if (middle <= low || middle >= high) continue;
        range.states.push_back(k);
        if (map_.segments[k].unstable == Index{0}) range.stable.push_back(k);
      }
      add_exchanges(range);
    }
  }

  // The range in parts, where another state comes to have the least energy inside of it.
  void add_exchanges(BranchMapRange range) {
    for (std::size_t parts = 0;; ++parts) {
      range.least = least_of(range.stable, range.low);
      const auto at_high = least_of(range.stable, range.high);
      if (range.least == at_high || parts > range.stable.size()) break;
      double a = range.low, b = range.high;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (a + b);
        (least_of(range.stable, middle) == range.least ? a : b) = middle;
      }
      BranchMapRange part = range;
      part.high = b;
      if (b >= range.high || b <= range.low) break;
      map_.ranges.push_back(part);
      range.low = b;
    }
    map_.ranges.push_back(std::move(range));
  }

  const Model& model_;
  const Record& record_;
  std::vector<std::size_t> first_points_;  // of each branch
  Index points_before_ = 0;
  BranchMap map_;
};

}  // namespace

BranchMap branch_map_of(const Model& model, const Record& record) {
  if (model.in_increments() || !record.stages.empty()) return {};
  return Maker(model, record).make();
}

double energy_at(const BranchMapSegment& segment, const Record& record, double lambda) {
  const bool grows = record.points[segment.last].lambda > record.points[segment.first].lambda;
  std::size_t i = segment.first;
  while (i + 1 < segment.last && (record.points[i + 1].lambda < lambda) == grows) ++i;
  const RecordPoint &a = record.points[i], &b = record.points[i + 1];
  const double h = b.lambda - a.lambda;
  if (h == 0.0) return a.energy;
  const double straight = (b.energy - a.energy) / h, turning = standing * std::abs(h) / std::max(b.arc - a.arc, tiny);
  const std::optional<double> from = energy_slope(rates_behind(a), turning), to = energy_slope(b.rates, turning);
  const double slope_a = from.value_or(to ? 2.0 * straight - *to : straight);
  const double slope_b = to.value_or(from ? 2.0 * straight - *from : straight);
  const double t = (lambda - a.lambda) / h, u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * a.energy + t * t * (3.0 - 2.0 * t) * b.energy +
         h * t * u * (u * slope_a - t * slope_b);
}

}  // namespace arcwall
