#include <gtest/gtest.h>

#include <functional>

#include "tests/support/explore.hpp"
#include "tests/support/models.hpp"

// What is found depends on no step size: first and greatest steps of a quarter and of four times the usual ones give
// the same branches, events, contacts and counts, at the same λ to 1e-8.
namespace arcwall::step_size_test {

namespace {

using test::ContactModel;
using test::Graph;
using test::PathModel;
using test::SameEvents;

struct Scaled {
  double first, greatest;
};

// Traces with the usual steps and with others; `run` takes the options with the steps filled in.
void expect_same_with_any_step(const TraceOptions& usual, const std::function<Graph(const TraceOptions&)>& run,
                               const SameEvents& how = {}) {
  const Graph expected = run(usual);
  for (const Scaled& scaled : {Scaled{0.25, 1.0}, Scaled{4.0, 1.0}, Scaled{0.25, 0.25}, Scaled{4.0, 4.0}}) {
    SCOPED_TRACE("first step times " + std::to_string(scaled.first) + ", greatest times " +
                 std::to_string(scaled.greatest));
    TraceOptions options = usual;
    options.step.first *= scaled.first;
    options.step.max *= scaled.greatest;
    test::expect_same_graphs(run(options), expected, how);
  }
}

void expect_same_with_any_step(const PathModel& model, BranchPolicy policy = BranchPolicy::primary,
                               const SameEvents& how = {}) {
  const auto run = [&](const TraceOptions& options) {
    return test::explore(*model.structure, options, {.policy = policy, .depth = 1}, model.watched());
  };
  expect_same_with_any_step(model.options(), run, how);
}

PathModel path_of(std::unique_ptr<Structure> structure, double first_step, double lowest, Index loaded = 1) {
  const TargetValue stop = test::stop_at(*structure, loaded, Dof::z, lowest);
  return {.structure = std::move(structure),
          .loaded = loaded,
          .first_step = first_step,
          .target_values = {stop},
          .watch = true};
}

// Guards are scaled by the usual first step whatever the step that is taken.
void expect_same_with_any_step(const ContactModel& model, double until, BranchPolicy policy) {
  TraceOptions usual;
  usual.step.first = 0.05;
  usual.target_values = {test::stop_at_lambda(-1.0), test::stop_at_lambda(until)};
  usual.node_contacts.assign(static_cast<std::size_t>(model.system().contact_count()), 1);
  const MemberMesh& mesh = model.structure().members()[0];
  const auto middle = std::make_shared<MemberObservable>(model.structure(), mesh, (mesh.nodes.size() - 1) / 2,
                                                         MemberObservable::Component::z);
  expect_same_with_any_step(usual, [&](const TraceOptions& options) {
    return test::explore(model.system(), options, {.policy = policy, .depth = 1, .preference = {middle}});
  });
}

}  // namespace

TEST(StepSize, DoesNotMatterToTrusses) {
  for (const TrussStrain strain : {TrussStrain::green, TrussStrain::engineering, TrussStrain::log}) {
    SCOPED_TRACE(static_cast<int>(strain));
    const test::VonMisesTruss shallow{.EA = 1e4, .strain = strain};
    expect_same_with_any_step(path_of(shallow.structure(), 0.3, -2.5));
    const test::VonMisesTruss steep{.half_span = 1.0, .rise = 5.0, .strain = strain};
    expect_same_with_any_step(path_of(steep.structure(), 0.005, -4.5), BranchPolicy::all);
  }
}

TEST(StepSize, DoesNotMatterToFrames) {
  expect_same_with_any_step(path_of(test::williams_toggle(20), 2.0, -0.8));
  expect_same_with_any_step(path_of(test::lee_frame(20), 0.1, -90.0, 2));
}

TEST(StepSize, DoesNotMatterToArchesThatSway) {
  expect_same_with_any_step(path_of(test::shallow_arch(24), 60.0, -1050.0), BranchPolicy::all);
  expect_same_with_any_step(path_of(test::pinned_semicircle(24), 1.0, -150.0), BranchPolicy::all);
}

// Round-off: EA/(EI/R²) = 1e6, so the place at which the crown turns is known to 1e-9 of the radius, and λ there
// changes with the place; the turn at 8.7 is small against the 897 of the limit load.
TEST(StepSize, DoesNotMatterToTheDeepArch) {
  PathModel model{.structure = test::deep_arch(32), .first_step = 20.0, .watch = true};
  model.target_values = {test::stop_at_lambda(-100.0), test::stop_at_lambda(1200.0)};
  expect_same_with_any_step(model, BranchPolicy::primary, {.at_displacement_limits = 5e-7});
}

TEST(StepSize, DoesNotMatterToTheFreeColumn) {
  const ContactModel column = test::Channel{.elements = 20, .walls = false}.model();
  expect_same_with_any_step(column, 8.0, BranchPolicy::primary);
  expect_same_with_any_step(column, 8.0, BranchPolicy::all);
  // At 0.94 its ends meet, and from there the stable way goes round about them without end.
  expect_same_with_any_step(column, 0.9, BranchPolicy::most_stable);
}

TEST(StepSize, DoesNotMatterToTheBeamOnItsFoundation) {
  expect_same_with_any_step(test::foundation_beam(80), 10.0, BranchPolicy::primary);
}

TEST(StepSize, DoesNotMatterInTheChannelSlow) {
  const auto snapping = test::Channel{.imperfection = test::snapping_imperfection()}.model();
  expect_same_with_any_step(snapping, 10.0, BranchPolicy::most_stable);
  expect_same_with_any_step(snapping, 10.0, BranchPolicy::primary);
  expect_same_with_any_step(test::Channel{}.model(), 10.0, BranchPolicy::most_stable);
}

}  // namespace arcwall::step_size_test
