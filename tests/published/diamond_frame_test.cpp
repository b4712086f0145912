#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/convergence.hpp"
#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// A square frame on its corner, hinged where it is pulled apart or pressed together, rigid at its sides (Jenkins, Seitz
// & Przemieniecki 1966). By symmetry a quarter of it is a cantilever; its tip moves by u towards the root and w along
// the load, by shooting with adaptive Taylor series, EA = 1000.
namespace arcwall::diamond_frame_test {

namespace {

using test::BeamTheory;

struct Sample {
  double load, u, w;  // λ; horizontally, along the load
};

const std::vector<Sample> tension = {{1.0, -0.1392338882316943, 0.11325021615356089},
                                     {3.0, -0.2938124316789438, 0.19443491351307204},
                                     {5.0, -0.37242892369957986, 0.22384113207312842},
                                     {10.0, -0.46495955504333636, 0.2531416125490754}};
const std::vector<Sample> compression = {{1.0, 0.17000685974640636, -0.24763827137425096},
                                         {3.0, 0.2053506175722694, -0.8323652628473649},
                                         {5.0, 0.0777677974491002, -1.0920702473445307},
                                         {10.0, -0.12674257708327802, -1.312872039677461}};

// The frame at these loads, of which `sign` says whether they pull.
std::vector<Sample> followed(const BeamTheory& beam, int elements, double sign, const std::vector<Sample>& expected) {
  const auto frame = test::DiamondFrame{.elements = elements, .beam = beam}.structure();
  TraceOptions options;
  options.step.first = 0.05 * sign;
  for (const Sample& sample : expected) {
    options.target_values.push_back(test::stop_at_lambda(sign * sample.load));
    options.target_values.back().stops = sample.load == expected.back().load;
  }
  const test::Branch branch = test::trace(*frame, options);
  std::vector<Sample> found;
  for (const Arc& arc : branch.arcs) {
    if (found.size() == expected.size() || arc.to.state.lambda != sign * expected[found.size()].load) continue;
    const Vec2 side = test::displacement_of(*frame, arc.to.state, 1),
               other = test::displacement_of(*frame, arc.to.state, 3);
    const Vec2 top = test::displacement_of(*frame, arc.to.state, 2);
    EXPECT_NEAR(side.x(), -other.x(), 1e-9);
    EXPECT_NEAR(side.y(), 0.5 * top.y(), 1e-9);
    found.push_back({.load = expected[found.size()].load, .u = side.x(), .w = 0.5 * top.y()});
  }
  EXPECT_EQ(found.size(), expected.size()) << branch.end.detail;
  found.resize(expected.size());
  return found;
}

void expect_table(double sign, const std::vector<Sample>& expected) {
  for (const BeamTheory& beam : test::elastica_theories()) {
    SCOPED_TRACE(beam.name);
    std::vector<std::vector<Sample>> meshes;
    for (const int elements : {8, 16, 32, 64}) meshes.push_back(followed(beam, elements, sign, expected));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      SCOPED_TRACE(expected[i].load);
      std::vector<double> us, ws, distances;
      for (const auto& mesh : meshes) {
        us.push_back(mesh[i].u);
        ws.push_back(mesh[i].w);
        distances.push_back(std::hypot(us.back() - expected[i].u, ws.back() - expected[i].w));
      }
      test::expect_order(distances, beam.convergence);
      EXPECT_NEAR(test::extrapolated(us, beam.convergence), expected[i].u, 1e-7);
      EXPECT_NEAR(test::extrapolated(ws, beam.convergence), expected[i].w, 1e-7);
    }
  }
}

}  // namespace

TEST(DiamondFrame, PulledApartFollowsTheElastica) { expect_table(1.0, tension); }

TEST(DiamondFrame, PressedTogetherFollowsTheElastica) { expect_table(-1.0, compression); }

}  // namespace arcwall::diamond_frame_test
