#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/essenburg_models.hpp"
#include "tests/support/invariants.hpp"

// Selke & Kikuchi's first example with their higher-order theory [kN, cm]. Linear values are those of the five
// differential equations of Essenburg's theory, solved exactly in the free zone and in the zone of contact. Large
// rotations: an independent finite element program with quadratic elements, two points along the axis and an exact
// active set; converged values with 320 elements on the half, the digits that do not move with the mesh.
namespace arcwall::essenburg_foundation_test {

namespace {

using test::EssenburgFoundation;

// What the tables list, at one moment.
struct Listed {
  double moment, w, R, phi_end, c = 0.0, q0 = 0.0;
};

// A path that is read at given moments.
class FoundationPath {
 public:
  FoundationPath(const EssenburgFoundation& described, const std::vector<double>& moments, double last)
      : model_(described.model()), scale_(described.scale) {
    TraceOptions options;
    options.step.first = described.first_step;
    for (const double moment : moments)
      options.target_values.push_back({.quantity = std::make_shared<ParameterValue>(), .value = moment});
    options.target_values.push_back(test::stop_at_lambda(last));
    branch_ = test::trace(model_.system(), options);
    EXPECT_EQ(branch_.end.reason, EndReason::stop);
  }

  const test::Branch& branch() const { return branch_; }
  double first_contact() const { return events_of(branch_, EventKind::contact_closes).at(0).state.lambda; }

  // Where the contact at the middle opens; 0 if it does not.
  double separation() const {
    for (const Event& event : events_of(branch_, EventKind::contact_opens))
      for (const Index j : event.guards)
        if (model_.system().candidate(j).label().fraction == 0.0) return event.state.lambda;
    return 0.0;
  }

  // All in the units of the problem that is not scaled down.
  Listed at(double moment) const {
    const State& state = state_at(moment);
    const MultiplierContact& system = model_.system();
    const MemberMesh& mesh = model_.structure().members()[0];
    Listed row{.moment = moment,
               .w = model_.structure().current(state, mesh.nodes.front()).y() / scale_,
               .R = 0.0,
               .phi_end = model_.structure().value(state, *mesh.rotations.back()) / scale_};
    for (Index j = 0; j < system.contact_count(); ++j) {
      row.R += 2.0 * system.force(state, j) / scale_;
      if (state.active_set[static_cast<std::size_t>(j)]) row.c = system.candidate(j).label().fraction;
    }
    row.q0 = *system.contact(state, 0).pressure() / scale_;
    return row;
  }

  double bottom(double moment) const {
    return MemberPoint(model_.structure(), model_.structure().members()[0], 0, -0.1).position(state_at(moment)).y() +
           0.1;
  }

 private:
  const State& state_at(double moment) const {
    for (const Arc& arc : branch_.arcs)
      if (std::abs(arc.to.state.lambda - moment) <= 1e-12) return arc.to.state;
    ADD_FAILURE() << "no point at " << moment;
    return branch_.last().state;
  }

  test::ContactModel model_;
  double scale_;
  test::Branch branch_;
};

}  // namespace

// Loads and clearance a thousand times smaller: the linear theory, in which the contact begins at M = 8 EI d/(L² − ν
// h²) and the middle lifts off at 3.90072322 (80 quadratic elements of the other program: 3.8992). The edge of the
// contact is known to an element, 0.0125, the pressure at the middle to a few per cent near it.
TEST(EssenburgFoundation, SmallLoadsHaveTheExactLinearSolutionSlow) {
  const std::vector<Listed> exact{{.moment = 0.5,
                                   .w = -0.0802637688,
                                   .R = 0.1480405183,
                                   .phi_end = 0.165392230,
                                   .c = 0.0092759102,
                                   .q0 = 8.15215051},
                                  {.moment = 1.0,
                                   .w = -0.0803272093,
                                   .R = 1.615012381,
                                   .phi_end = 0.213537890,
                                   .c = 0.0645140401,
                                   .q0 = 14.4192177},
                                  {.moment = 1.5,
                                   .w = -0.0802088642,
                                   .R = 3.118480376,
                                   .phi_end = 0.260374410,
                                   .c = 0.1620360929,
                                   .q0 = 9.78286464},
                                  {.moment = 2.0,
                                   .w = -0.0800907542,
                                   .R = 4.776752135,
                                   .phi_end = 0.303210533,
                                   .c = 0.2807266167,
                                   .q0 = 4.37054742},
                                  {.moment = 2.5,
                                   .w = -0.0800384763,
                                   .R = 6.638174546,
                                   .phi_end = 0.341927608,
                                   .c = 0.3655442949,
                                   .q0 = 1.90244725},
                                  {.moment = 3.0,
                                   .w = -0.0800153479,
                                   .R = 8.679273609,
                                   .phi_end = 0.377737313,
                                   .c = 0.4276025294,
                                   .q0 = 0.79368282},
                                  {.moment = 3.5,
                                   .w = -0.0800040861,
                                   .R = 10.87924338,
                                   .phi_end = 0.411412048,
                                   .c = 0.4755025440,
                                   .q0 = 0.24711019}};
  std::vector<double> moments;
  for (const Listed& row : exact) moments.push_back(row.moment);
  const FoundationPath path({.elements = 160, .scale = 1e-3}, moments, 4.0);
  EXPECT_NEAR(path.first_contact(), 0.4493029786, 2e-7);  // κ² of what is left of large rotations
  EXPECT_NEAR(path.separation(), 3.90072322, 0.002);      // from below, as with the other program's elements
  for (const Listed& row : exact) {
    SCOPED_TRACE(row.moment);
    const Listed found = path.at(row.moment);
    EXPECT_NEAR(found.w, row.w, 3e-7);
    EXPECT_NEAR(found.R, row.R, 3e-4);
    EXPECT_NEAR(found.phi_end, row.phi_end, 2e-5);
    EXPECT_NEAR(found.c, row.c, 0.0125);
    EXPECT_NEAR(found.q0, row.q0, 0.02 * row.q0 + 0.05);
  }
}

TEST(EssenburgFoundation, LargeRotationsAgreeWithTheConvergedSolutionSlow) {
  const std::vector<Listed> converged{
      {.moment = 0.4, .w = -0.07129846434751, .R = 0.0, .phi_end = 0.14284422327394},
      {.moment = 0.4475, .w = -0.07972851733491, .R = 0.0, .phi_end = 0.15980321807422},
      {.moment = 0.5, .w = -0.08026889689299, .R = 0.14563547, .phi_end = 0.16567589941411},
      {.moment = 1.0, .w = -0.08033107078550, .R = 1.62192771, .phi_end = 0.21422414251339},
      {.moment = 2.5, .w = -0.08003796597269, .R = 6.72392679, .phi_end = 0.34615086234765},
      {.moment = 3.5, .w = -0.08000332868768, .R = 11.0979460, .phi_end = 0.42050099582137},
      {.moment = 5.0, .w = -0.07997813124842, .R = 18.8971818, .phi_end = 0.52620298115822},
      {.moment = 7.0, .w = -0.07991438079995, .R = 31.3913141, .phi_end = 0.67778478909246}};
  const std::vector<double> bottom{-0.07108695291778, -0.07949130630605, -0.08, -0.08, -0.08, -0.08,
                                   -0.07998188154683, -0.07991980912494};
  std::vector<double> moments;
  for (const Listed& row : converged) moments.push_back(row.moment);
  const FoundationPath path({.elements = 160}, moments, 7.0);
  EXPECT_NEAR(path.first_contact(), 0.45037723841, 1e-9);
  EXPECT_NEAR(path.separation(), 3.8275, 0.0015);
  for (std::size_t k = 0; k < converged.size(); ++k) {
    const Listed& row = converged[k];
    SCOPED_TRACE(row.moment);
    const Listed found = path.at(row.moment);
    // The edges of the contact move in steps of half an element: 1e-5 in forces, more behind the separation.
    const bool separated = row.moment > 3.9;
    EXPECT_NEAR(found.w, row.w, row.moment > 5.0 ? 3e-7 : 1.5e-7);
    EXPECT_NEAR(path.bottom(row.moment), bottom[k], row.moment > 5.0 ? 3e-7 : 5e-8);
    EXPECT_NEAR(found.R, row.R, separated ? 5e-4 : 1e-4);
    EXPECT_NEAR(found.phi_end, row.phi_end, separated ? 1e-5 : 2e-6);
  }
}

// The same moments of separation as the other program finds on the same meshes, 4 digits printed; they rise to 3.8275.
TEST(EssenburgFoundation, TheMiddleLiftsOffWhereItDoesOnTheSameMeshesElsewhereSlow) {
  struct Mesh {
    int order, elements;
    double separation;
  };
  for (const Mesh& mesh :
       {Mesh{.order = 1, .elements = 20, .separation = 3.579}, Mesh{.order = 1, .elements = 40, .separation = 3.770},
        Mesh{.order = 1, .elements = 80, .separation = 3.8134}, Mesh{.order = 2, .elements = 40, .separation = 3.8133},
        Mesh{.order = 2, .elements = 80, .separation = 3.8239}}) {
    const FoundationPath path({.elements = mesh.elements, .beams = {.order = mesh.order}}, {}, 4.0);
    EXPECT_NEAR(path.separation(), mesh.separation, 1e-3) << mesh.order << ", " << mesh.elements;
  }
}

// The shear correction 5/6 moves the first contact from 0.45037724 to 0.45034379: the shift to the rounding of both and
// of where the other program has it. (Uniform bending shears only by the fixed direction of the quadratic term.)
TEST(EssenburgFoundation, FirstContactWithAShearCorrection) {
  const FoundationPath path({.elements = 80, .beams = {.shear_correction = 5.0 / 6.0}}, {}, 0.46);
  EXPECT_NEAR(path.first_contact() - 0.45037723841, -3.345e-5, 2e-8);
}

TEST(EssenburgFoundation, ThePathKeepsItsContract) {
  for (const int order : {1, 2}) {
    const test::ContactModel model = EssenburgFoundation{.elements = 20, .beams = {.order = order}}.model();
    TraceOptions options;
    options.step.first = 0.05;
    options.target_values.push_back(test::stop_at_lambda(5.0));
    const test::Branch branch = test::trace(model.system(), options);
    expect_branch_invariants(model.system(), branch, options, {.recount_every = 5});
  }
}

// A thin beam, 0.02 high, on the parabola z = −h/2 − d + ½ k x² under small end moments. A classic beam conforms to it
// for M > EI k + 6 EI (d − k/2), over |x| < c with 1 − c = √(6 EI (d − k/2)/(M − EI k)), and the forces at the edges
// are (M − EI k)/(1 − c) each. Thickness and mesh shift that by some h.
TEST(EssenburgFoundation, AThinBeamConformsToAParabolaSlow) {
  constexpr double h = 0.02, d = 8e-4, k = 5e-4, EI = 21000.0 * 0.2 * h * h * h / 12.0;
  StructureBuilder builder;
  builder.add_joint({0.0, 0.0});
  builder.add_joint({1.0, 0.0});
  builder.add_member({.name = "beam",
                      .from = 0,
                      .to = 1,
                      .axis = straight_axis({0.0, 0.0}, {1.0, 0.0}),
                      .theory = Theory::essenburg,
                      .section = test::essenburg_section(21000.0, 0.29, 0.2, h),
                      .elements = 80});
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.shared_rotation(0).value());
  builder.fix(builder.dof(1, Dof::z));
  builder.add_load(builder.shared_rotation(1).value(), 1e-5, LoadKind::proportional);
  const test::ContactModel model(
      builder.build(), {{.name = "wall", .side = Side::below, .profile = parabola_profile({0.0, -0.5 * h - d}, k)}},
      0.1);
  TraceOptions options;
  options.step.first = 0.1;
  options.target_values.push_back(test::stop_at_lambda(6.0));
  const test::Branch branch = test::trace(model.system(), options);
  ASSERT_EQ(branch.end.reason, EndReason::stop);
  const State& state = branch.last().state;
  double edge = 0.0, force = 0.0;
  for (Index j = 0; j < model.system().contact_count(); ++j) {
    force += model.system().force(state, j);
    if (state.active_set[static_cast<std::size_t>(j)]) edge = model.system().candidate(j).label().fraction;
  }
  const double bending = 6e-5 - EI * k, free = std::sqrt(6.0 * EI * (d - 0.5 * k) / bending);
  EXPECT_NEAR(edge, 1.0 - free, h);
  EXPECT_NEAR(force, bending / free, h * bending / free);
}

}  // namespace arcwall::essenburg_foundation_test
