#include "tests/support/sliding_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/support/branch.hpp"
#include "tests/support/invariants.hpp"

namespace arcwall::test {

SlidingModel::SlidingModel(const StructureBuilder& builder, const std::vector<TestWall>& walls, double first_step,
                           ContinuumChoice continuum)
    : structure_(builder.build_sliding()) {
  const auto tied = builder.build();
  const double force = std::max(10.0 * tied->force_scale() * std::abs(first_step),
                                tied->force_roundoff() / TraceOptions{}.guard_tolerance);
  std::vector<SlidingObstacle> obstacles;
  for (const TestWall& wall : walls)
    obstacles.push_back(
        {.name = wall.name,
         .surface = wall.obstacle(),
         .on_face = !wall.on_axis,
         .strands = std::vector<std::uint8_t>(static_cast<std::size_t>(structure_->strands()), 1),
         .frictions = std::vector<double>(static_cast<std::size_t>(structure_->strands()), wall.friction)});
  contact_ = std::make_unique<SlidingContact>(*structure_, std::move(obstacles),
                                              ContactScales{.length = tied->length_scale(), .force = force}, continuum);
}

std::shared_ptr<const Observable> SlidingModel::at(const std::string& member, double fraction,
                                                   MemberObservable::Component component) const {
  return std::make_shared<PlaceObservable>(*structure_, structure_->find(member, fraction), component);
}

std::shared_ptr<const Observable> SlidingModel::joint(Index node, Dof which) const {
  return std::make_shared<JointObservable>(*structure_, structure_->dof(node, which), JointObservable::What::motion);
}

SlidingModel SlidingChannel::model() const {
  StructureBuilder builder;
  const double h = 0.1 * cm;
  const Section section{.E = 2.1e4 * kN / (cm * cm), .A = h * h, .I = h * h * h * h / 12.0, .height = h};
  const Index left = builder.add_joint({0.0, 0.0}), right = builder.add_joint({2.0 * cm, 0.0});
  Index from = left;
  Vec2 start(0.0, 0.0);
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Vec2 end(members[m].to * cm, 0.0);
    const Index to = m + 1 == members.size() ? right : builder.add_joint(end);
    builder.add_member({.name = std::to_string(m),
                        .from = reversed ? to : from,
                        .to = reversed ? from : to,
                        .axis = reversed ? straight_axis(end, start) : straight_axis(start, end),
                        .imperfection = m == 0 ? imperfection : std::vector<SineDeviation>{},
                        .theory = theory,
                        .order = 4,
                        .section = section,
                        .elements = members[m].elements});
    if (lateral != 0.0)
      builder.add_distributed_load(static_cast<Index>(m), {0.0, lateral * kN / cm}, LoadKind::proportional);
    from = to;
    start = end;
  }
  builder.fix(builder.dof(left, Dof::x));
  for (const Index end : {left, right}) {
    builder.fix(builder.dof(end, Dof::z));
    if (clamped) builder.fix(builder.shared_rotation(end).value());
  }
  builder.add_load(builder.dof(right, Dof::x), -kN, LoadKind::proportional);
  if (end_moment != 0.0)
    builder.add_load(builder.shared_rotation(left).value(), end_moment * kN * cm, LoadKind::proportional);
  std::vector<TestWall> walls;
  const auto wall = [&](double z) { return slope == 0.0 ? flat_profile(z * cm) : line_profile(z * cm, slope); };
  if (upper) walls.push_back({.name = "upper", .side = Side::above, .profile = wall(*upper + 0.05)});
  if (lower) walls.push_back({.name = "lower", .side = Side::below, .profile = wall(-*lower - 0.05)});
  return {builder, walls, first_step, continuum};
}

SlidingModel SlidingFoundation::model() const {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(2.0 * std::cos(turned), 2.0 * std::sin(turned));
  const Index left = builder.add_joint(a), right = builder.add_joint(b);
  builder.add_member({.name = "0",
                      .from = left,
                      .to = right,
                      .axis = straight_axis(a, b),
                      .section = {.E = 2.1e4, .A = 0.04, .I = 0.2 * 0.008 / 12.0, .height = 0.2},
                      .elements = elements});
  builder.fix(builder.dof(left, Dof::x));
  if (fixed) builder.fix(builder.dof(right, Dof::x));
  for (const Index end : {left, right}) builder.fix(builder.dof(end, Dof::z));
  builder.add_load(builder.shared_rotation(left).value(), -1.0, LoadKind::proportional);
  builder.add_load(builder.shared_rotation(right).value(), 1.0, LoadKind::proportional);
  return {builder,
          {{.name = "floor", .side = Side::below, .profile = line_profile(-0.18 / std::cos(turned), std::tan(turned))}},
          0.1};
}

SlidingModel SlidingCylinder::model() const {
  StructureBuilder builder;
  const Vec2 a(-10.0, 0.0), b(10.0, 0.0);
  const Index left = builder.add_joint(a), right = builder.add_joint(b);
  builder.add_member({.name = "strip",
                      .from = left,
                      .to = right,
                      .axis = straight_axis(a, b),
                      .theory = theory,
                      .order = 4,
                      .section = {.E = 2.1e4, .A = 0.1, .I = 0.001 / 12.0, .height = 0.1},
                      .elements = elements});
  builder.fix(builder.dof(left, Dof::x));
  for (const Index end : {left, right}) builder.fix(builder.dof(end, Dof::z));
  builder.add_load(builder.shared_rotation(left).value(), -1.0, LoadKind::proportional);
  builder.add_load(builder.shared_rotation(right).value(), 1.0, LoadKind::proportional);
  return {builder,
          {{.name = "cylinder", .side = Side::below, .profile = circle_profile({0.0, -20.55}, 20.0, Side::below)}},
          0.01};
}

std::vector<ExploredBranch> follow(const System& system, const State& start, const TraceOptions& options,
                                   std::vector<std::shared_ptr<const Observable>> preference,
                                   std::vector<Watch> watched) {
  Explorer explorer(system, start, options, std::move(watched),
                    {.policy = BranchPolicy::most_stable, .preference = std::move(preference)});
  std::vector<ExploredBranch> branches;
  std::size_t points = 0;
  while (auto step = explorer.next()) {
    branches.resize(static_cast<std::size_t>(step->branch) + 1);
    branches[static_cast<std::size_t>(step->branch)].arcs.push_back(std::move(step->arc));
    if (++points > 20'000) explorer.stop({.reason = EndReason::interrupted, .detail = "too long for a test"});
  }
  const double lambda_scale = Tracer(system, start, options).lambda_scale();  // that of the first branch, kept on all
  for (std::size_t i = 0; i < branches.size(); ++i) {
    branches[i].record = explorer.branches()[i];
    branches[i].lambda_scale = lambda_scale;
  }
  return branches;
}

std::vector<Event> events_of(const std::vector<ExploredBranch>& branches) {
  std::vector<Event> found;
  for (const ExploredBranch& branch : branches)
    for (const Arc& arc : branch.arcs)
      for (const Event& event : arc.events)
        if (event.kind != EventKind::start) found.push_back(event);
  return found;
}

std::vector<Event> SlidingPath::events() const { return events_of(branches); }

std::vector<EventKind> SlidingPath::kinds() const {
  std::vector<EventKind> found;
  for (const Event& event : events()) found.push_back(event.kind);
  return found;
}

void SlidingPath::expect_invariants() const {
  for (const ExploredBranch& branch : branches)
    expect_sliding_invariants(model.system(), branch.arcs, options, branch.lambda_scale, {.recount_every = 3});
}

SlidingPath sliding_path(SlidingModel model, double to, double step) {
  TraceOptions options;
  options.step.first = step;
  options.target_values = {stop_at_lambda(-1.0), stop_at_lambda(to)};
  auto branches = follow(model.system(), model.system().rest(), options);
  return {.model = std::move(model), .options = options, .branches = std::move(branches)};
}

Event event_of(const std::vector<ExploredBranch>& branches, EventKind kind, std::size_t n) {
  for (const Event& event : events_of(branches))
    if (event.kind == kind && n-- == 0) return event;
  ADD_FAILURE() << "no such event";
  return {};
}

}  // namespace arcwall::test
