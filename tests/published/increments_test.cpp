#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "continuation/load_increments.hpp"
#include "elements/incremental_structure.hpp"
#include "elements/updated_classic_beam.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/models.hpp"

// The incremental updated Lagrangian scheme of Selke & Kikuchi against the equations it approximates.
namespace arcwall {

namespace {

// The beam's model in increments, with its contacts.
class Incremental {
 public:
  explicit Incremental(const test::ContactModel& model, double stiffness)
      : model_(model), structure_(model.structure()) {
    std::vector<Candidate> candidates;
    for (const MemberMesh& mesh : model.structure().members())
      for (std::size_t k = 1; k + 1 < mesh.nodes.size(); ++k)
        candidates.emplace_back(std::make_unique<MemberPoint>(model.structure(), mesh, k, -0.1), flat_profile(-0.18),
                                Side::below,
                                ContactLabel{.wall = "foundation",
                                             .member = mesh.name,
                                             .fraction = mesh.fraction(k),
                                             .tributary = 2.0 / double(mesh.nodes.size() - 1)});
    contact_ = std::make_unique<MultiplierContact>(
        structure_, std::move(candidates), ContactScales{.length = 2.0, .force = 1.0},
        ContactLaw{.method = ContactLaw::Method::penalty, .stiffness = stiffness});
  }

  // Depth of the middle after equal increments to a moment.
  double depth(double moment, int increments) {
    LoadIncrements scheme(*contact_, {.x = Vector::Zero(structure_.size({})), .piece = contact_->open_piece()}, 1.0,
                          [this](const State& state) { structure_.advance(state.x.head(structure_.size({}))); });
    for (int i = 1; i <= increments; ++i) {
      const auto arc = scheme.to(moment * i / increments);
      if (!arc) {
        ADD_FAILURE() << "increment " << i << " fails";
        return 0.0;
      }
      last_ = arc->to;
    }
    EXPECT_EQ(scheme.unsettled(), 0);
    const MemberMesh& mesh = model_.structure().members()[0];
    return -model_.structure().current(last_.state.x, mesh.nodes[mesh.nodes.size() / 2]).y();
  }

  const PathPoint& last() const { return last_; }

 private:
  const test::ContactModel& model_;
  IncrementalStructure structure_;
  std::unique_ptr<MultiplierContact> contact_;
  PathPoint last_;
};

}  // namespace

// Before contact the beam is a circular arc, 1 − cos k over k deep, k = M/2.8: 0.0713072 at M = 0.4. The scheme does
// not iterate: it falls behind by what is of first order in the increment.
TEST(LoadIncrements, BendABeamWithAnErrorOfFirstOrderInTheIncrement) {
  const double k = 0.4 / 2.8, exact = (1.0 - std::cos(k)) / k;
  std::vector<double> sizes, errors;
  for (const int increments : {5, 10, 20, 40}) {
    const test::ContactModel model = test::foundation_beam(80);
    sizes.push_back(1.0 / increments);
    errors.push_back(Incremental(model, 1e9).depth(0.4, increments) - exact);
  }
  EXPECT_GE(test::observed_order(sizes, errors), 1.0);
  EXPECT_LE(std::abs(errors.back()), 1e-5);
  EXPECT_GE(std::abs(errors.front()), 1e-5) << "results depend on the increments";
}

// Their Table 1, classic theory: the printed depth of the middle at moments before contact and on the foundation.
TEST(LoadIncrements, FindTheClassicColumnOfTable1) {
  for (const auto& [moment, printed] :
       {std::pair{0.4, 0.0715}, {0.4475, 0.0799}, {0.5, 0.0800}, {2.5, 0.0800}, {5.0, 0.0800}}) {
    SCOPED_TRACE(moment);
    const test::ContactModel model = test::foundation_beam(80);
    EXPECT_NEAR(Incremental(model, 1e9).depth(moment, static_cast<int>(std::lround(moment / 0.0125))), printed, 2e-4);
  }
}

TEST(LoadIncrements, CarryTheirResidueIntoTheNextIncrement) {
  const test::ContactModel model = test::foundation_beam(20);
  Incremental once(model, 1e9);
  once.depth(0.3, 1);
  EXPECT_GE(once.last().residual, 1e-3);
  // Increments without load relax what is left.
  IncrementalStructure structure(model.structure());
  LoadIncrements relaxing(structure, {.x = Vector::Zero(structure.size({}))}, 1.0,
                          [&](const State& state) { structure.advance(state.x); });
  double before = infinity;
  for (int i = 0; i < 4; ++i) {
    const auto arc = relaxing.to(0.3);
    ASSERT_TRUE(arc);
    EXPECT_LE(arc->to.residual, 0.1 * before);
    before = arc->to.residual;
  }
}

// Increments are referred to the present chord: a rotation of the whole changes no stress, a stretch does by EA times
// Green's strain, brought to the new length.
TEST(UpdatedClassicBeam, CarriesItsStressesAlong) {
  const double EA = 210.0, EI = 0.175, l = 0.5;
  const Vec2 chord(l, 0.0);
  const double at_rest[6] = {};
  const UpdatedClassicBeam beam(at_rest, chord, {.N = -3.0, .M1 = 0.4, .M2 = -0.2}, EA, EI);
  const double angle = 0.7;
  const Vec2 turned = l * Vec2(std::cos(angle), std::sin(angle)) - chord;
  const double rigid[6] = {0.1, -0.2, angle, 0.1 + turned.x(), -0.2 + turned.y(), angle};
  const auto moved = beam.updated(rigid);
  const auto& stresses = dynamic_cast<const UpdatedClassicBeam&>(*moved).stresses();
  EXPECT_NEAR(stresses.N, -3.0, 1e-12);
  EXPECT_NEAR(stresses.M1, 0.4, 1e-14);
  EXPECT_NEAR(stresses.M2, -0.2, 1e-14);

  const double pulled[6] = {0.0, 0.0, 0.0, 0.01 * l, 0.0, 0.0};
  const auto longer = beam.updated(pulled);
  const double green = 0.01 + 0.5 * 0.01 * 0.01;
  EXPECT_NEAR(dynamic_cast<const UpdatedClassicBeam&>(*longer).stresses().N, (-3.0 + EA * green) * 1.01, 1e-12);

  const double bent[6] = {0.0, 0.0, -0.02, 0.0, 0.0, 0.03};
  const auto curved = beam.updated(bent);
  const auto& after = dynamic_cast<const UpdatedClassicBeam&>(*curved).stresses();
  EXPECT_NEAR(after.M1, 0.4 + EI / l * (4.0 * -0.02 + 2.0 * 0.03), 1e-14);
  EXPECT_NEAR(after.M2, -0.2 + EI / l * (2.0 * -0.02 + 4.0 * 0.03), 1e-14);
}

// The stiffness is the derivative of the forces of what follows, and symmetric; its energy is that of the increments.
TEST(UpdatedClassicBeam, IsLinearBetweenIncrements) {
  test::Numbers numbers(90);
  const double u0[6] = {0.1, 0.2, 0.3, 0.15, 0.1, -0.2};
  const UpdatedClassicBeam beam(u0, {0.4, 0.3}, {.N = 2.0, .M1 = 0.3, .M2 = 0.1}, 100.0, 1.0, 5.0);
  const Vector u = Eigen::Map<const Vector>(u0, 6) + 0.1 * numbers.vector(6);
  Vector f(6), f0(6);
  Matrix K(6, 6);
  EXPECT_DOUBLE_EQ(beam.evaluate(u0, f0.data(), K.data()), 5.0);
  EXPECT_LE((K - K.transpose()).norm(), 1e-12 * K.norm());
  const double U = beam.evaluate(u.data(), f.data(), nullptr);
  const Vector du = u - Eigen::Map<const Vector>(u0, 6);
  EXPECT_LE((f - f0 - K * du).norm(), 1e-12 * f.norm());
  EXPECT_NEAR(U, 5.0 + 0.5 * du.dot(f + f0), 1e-12);
}

}  // namespace arcwall
