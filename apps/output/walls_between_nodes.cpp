#include "apps/output/walls_between_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace arcwall {

namespace {

// Candidates of one member and one obstacle at neighbouring nodes.
struct Neighbours {
  std::size_t member = 0;
  Index first = 0, second = 0;
};

std::vector<Neighbours> neighbours_of(const Model& model) {
  const MultiplierContact& contact = *model.contact();
  std::unordered_map<std::string, std::size_t> number;  // of the members
  for (const deck::Member& member : model.deck().members) number.emplace(member.name, number.size());
  std::map<std::pair<std::size_t, const Obstacle*>, std::vector<Index>> rows;
  for (Index j = 0; j < contact.contact_count(); ++j) {
    const Candidate& candidate = contact.candidate(j);
    rows[{number.at(candidate.label().member), &candidate.obstacle()}].push_back(j);
  }
  std::vector<Neighbours> all;
  const auto fraction = [&](Index j) { return contact.candidate(j).label().fraction; };
  for (auto& [of, row] : rows) {
    std::sort(row.begin(), row.end(), [&](Index a, Index b) { return fraction(a) < fraction(b); });
    for (std::size_t i = 1; i < row.size(); ++i)
      all.push_back({.member = of.first, .first = row[i - 1], .second = row[i]});
  }
  return all;
}

struct Depth {
  double depth = 0.0, between = 0.0;  ///< of the member inside the wall; of the nodes [length]
  std::string member{}, wall{};
};

// The stretches of a member's axis from one fraction to another, ascending.
std::vector<MemberStretch> stretches_between(const Model& model, const State& state, std::size_t member, double from,
                                             double to) {
  constexpr double same = 1e-9;  // of an element
  const auto elements = model.body().elements(member);
  const auto count = double(elements->elements(state));
  std::vector<MemberStretch> stretches;
  for (auto e = static_cast<Index>(from * count + same); double(e) < to * count - same; ++e)
    elements->add_stretches(state, e, stretches);
  std::sort(stretches.begin(), stretches.end(),
            [](const MemberStretch& a, const MemberStretch& b) { return a.from < b.from; });
  return stretches;
}

Vec2 axis_at(const std::vector<MemberStretch>& stretches, double fraction) {
  const auto here = std::find_if(stretches.begin(), stretches.end(),
                                 [&](const MemberStretch& stretch) { return fraction <= stretch.to; });
  const MemberStretch& stretch = here == stretches.end() ? stretches.back() : *here;
  return stretch.now.position((fraction - stretch.from) / (stretch.to - stretch.from));
}

// Whether the wall's surface turns so little between two nodes that they tell where it is.
bool is_told_by(const Obstacle& wall, const Vec2& a, const Vec2& b, double lambda) {
  constexpr double most_turn = 0.3;  // [rad]
  const LinearField at_a = wall.gap_slope(a, lambda), at_b = wall.gap_slope(b, lambda);
  const Vec2 out_a(at_a.x, at_a.z), out_b(at_b.x, at_b.z);
  return !out_a.isZero(0.0) && !out_b.isZero(0.0) && std::abs(turn_between(out_a, out_b)) <= most_turn;
}

// How deep the member's surface is inside a narrow wall between two open contacts.
Depth depth_between(const Model& model, const State& state, const Neighbours& nodes) {
  constexpr int looked_at = 16;  // places
  const MultiplierContact& contact = *model.contact();
  const Candidate &first = contact.candidate(nodes.first), &second = contact.candidate(nodes.second);
  const double from = first.label().fraction, to = second.label().fraction;
  const Vec2 a = first.point().position(state), b = second.point().position(state);
  Depth deepest{.between = (b - a).norm(), .member = first.label().member, .wall = first.label().wall};
  if (is_told_by(first.obstacle(), a, b, state.lambda)) return deepest;
  const auto stretches = stretches_between(model, state, nodes.member, from, to);
  const Vec2 offset_a = a - axis_at(stretches, from), offset_b = b - axis_at(stretches, to);
  for (int i = 1; i < looked_at; ++i) {
    const double t = double(i) / looked_at;
    const Vec2 place = axis_at(stretches, from + t * (to - from)) + (1.0 - t) * offset_a + t * offset_b;
    deepest.depth = std::max(deepest.depth, -first.obstacle().gap_slope(place, state.lambda).value);
  }
  return deepest;
}

Depth deepest_of(const Model& model, const State& state, const std::vector<Neighbours>& neighbours) {
  Depth deepest;
  for (const Neighbours& nodes : neighbours) {
    const auto is_closed = [&](Index j) { return state.active_set[static_cast<std::size_t>(j)] != 0; };
    if (is_closed(nodes.first) || is_closed(nodes.second)) continue;
    Depth here = depth_between(model, state, nodes);
    if (here.depth * deepest.between > deepest.depth * here.between || deepest.between == 0.0)
      deepest = std::move(here);
  }
  return deepest;
}

}  // namespace

std::string warning_of_walls_between_nodes(const Model& model, const Record& record) {
  constexpr double deep = 1e-3;    // of the distance of the nodes
  constexpr Index looked_at = 10;  // points of a branch
  if (model.in_increments()) return {};
  std::map<Index, std::vector<Neighbours>> neighbours;  // of the stages
  for (const RecordPoint& point : record.points) {
    const RecordBranch& branch = record.branches[static_cast<std::size_t>(point.branch)];
    const Index stage = record.stage_number(point.branch);
    const Model& now = model.at_stage(stage);
    if (now.contact() == nullptr || now.sliding() != nullptr) return {};
    if (point.step % std::max(branch.points / looked_at, Index{1}) != 0) continue;
    if (!neighbours.contains(stage)) neighbours[stage] = neighbours_of(now);
    const Depth deepest = deepest_of(now, point.state, neighbours[stage]);
    if (deepest.depth <= deep * deepest.between) continue;
    const double factor = now.frame().factor();
    return fmt::format(
        "on branch {} at λ = {:.4g} {} is inside {} by {:.2g} between two nodes, which are {:.3g} apart and do not "
        "touch it: contact is at nodes, and the wall is not felt there. Give the member more elements, or a theory "
        "whose contacts move",
        point.branch, point.lambda, deepest.member, deepest.wall, factor * deepest.depth, factor * deepest.between);
  }
  return {};
}

}  // namespace arcwall
