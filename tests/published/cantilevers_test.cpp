#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/published/path_checks.hpp"
#include "tests/support/convergence.hpp"
#include "tests/support/models.hpp"

// Cantilevers of length 1 and EI = 1 far beyond small displacements.
namespace arcwall::cantilevers_test {

namespace {

using test::BeamTheory;
using test::Cantilever;

// Of the tip, at one load.
struct Tip {
  double load, descent, shortening, rotation;  // along z, against x
};

Tip tip_of(const Structure& structure, const State& state) {
  const Vec2 moved = test::displacement_of(structure, state, 1);
  return {state.lambda, moved.y(), -moved.x(), test::joint_rotation(structure, 1)->value(state)};
}

// The tip at loads that rise from zero.
std::vector<Tip> tips(const Cantilever& cantilever, const std::vector<double>& loads) {
  const auto structure = cantilever.structure();
  TraceOptions options;
  options.step.first = 0.1;
  for (const double load : loads) {
    options.target_values.push_back(test::stop_at_lambda(load));
    options.target_values.back().stops = load == loads.back();
  }
  std::vector<Tip> found;
  for (const Arc& arc : test::trace(*structure, options).arcs)
    if (found.size() < loads.size() && std::abs(arc.to.state.lambda - loads[found.size()]) < 1e-9)
      found.push_back(tip_of(*structure, arc.to.state));
  EXPECT_EQ(found.size(), loads.size());
  found.resize(loads.size());
  return found;
}

// A transverse load at the tip, inextensible, by elliptic integrals (Bisshopp & Drucker 1945; the table of Mattiasson
// 1981 has its digits rounded to five): P L²/EI, w/L, u/L, θ.
const std::vector<Tip> transverse = {{0.2, 0.066364482144830495982, 0.0026465483405227686058, 0.099636163037401853918},
                                     {0.4, 0.13097524208521435437, 0.010353921549037579936, 0.19715462370320762711},
                                     {0.6, 0.19235027968744871172, 0.022487667979028046595, 0.29073776684116548308},
                                     {0.8, 0.24945154202800206379, 0.038165613240481237189, 0.37906300761322154194},
                                     {1.0, 0.30172077379981352954, 0.056433236283376883091, 0.46135194971187896071},
                                     {1.5, 0.41097821124825799585, 0.10794150068355924734, 0.63953982615077832743},
                                     {2.0, 0.49345748039671182041, 0.16064172082516723621, 0.78174983155654304442},
                                     {3.0, 0.60325344112997735181, 0.25442018456418709514, 0.98601694671135408515},
                                     {4.0, 0.66996418127766675053, 0.32894124224684595709, 1.1212393474875763453},
                                     {5.0, 0.71379152361191272809, 0.38762836072442987186, 1.2153681176116810959},
                                     {6.0, 0.74457114888951527587, 0.43458882868190513025, 1.2836972858012450698},
                                     {7.0, 0.76736909974046338784, 0.47292742838633688887, 1.3349598574718553546},
                                     {8.0, 0.78498237495331454192, 0.50482773213353163343, 1.3744315067013926662},
                                     {9.0, 0.79905552747084022143, 0.53182056267252725223, 1.4054653336239528066},
                                     {10.0, 0.81060902488029645323, 0.55499559775375126957, 1.430285538803857529}};

std::vector<double> loads_of(const std::vector<Tip>& table) {
  std::vector<double> loads;
  for (const Tip& row : table) loads.push_back(row.load);
  return loads;
}

Cantilever pulled_across(const BeamTheory& beam, int elements, double flexibility) {
  return {.EA = 1.0 / flexibility, .elements = elements, .tip_force = 1.0, .GA = 1.0 / flexibility, .beam = beam};
}

}  // namespace

TEST(CantileverUnderATipForce, HasTheTableOfTheEllipticIntegrals) {
  for (const BeamTheory& beam : test::all_beam_theories()) {
    if (beam.convergence < 4) continue;
    SCOPED_TRACE(beam.name);
    const auto found = tips(pulled_across(beam, 40, 1e-8), loads_of(transverse));
    for (std::size_t i = 0; i < transverse.size(); ++i) {
      EXPECT_NEAR(found[i].descent, transverse[i].descent, 1e-6);
      EXPECT_NEAR(found[i].shortening, transverse[i].shortening, 1e-6);
      EXPECT_NEAR(found[i].rotation, transverse[i].rotation, 1e-6);
    }
  }
}

// 1/EA = 1/GA → 0 by extrapolation.
TEST(CantileverUnderATipForce, Converges) {
  const std::vector<Tip> expected = {transverse[4], transverse[9], transverse[14]};
  for (const BeamTheory& beam : test::all_beam_theories()) {
    SCOPED_TRACE(beam.name);
    std::map<double, std::vector<std::vector<Tip>>> found;  // by flexibility, then mesh
    constexpr double s = 1e-5;
    for (const double flexibility : {s, 0.5 * s, 0.25 * s})
      for (const int elements : {8, 16, 32, 64})
        found[flexibility].push_back(tips(pulled_across(beam, elements, flexibility), loads_of(expected)));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      SCOPED_TRACE(expected[i].load);
      const auto over_meshes = [&](double Tip::*what) {
        std::vector<double> values;
        for (std::size_t mesh = 0; mesh < 4; ++mesh)
          values.push_back(test::at_zero([&](double of) { return found.at(of)[mesh][i].*what; }, s));
        return values;
      };
      std::vector<double> distances(4, 0.0);
      for (const auto what : {&Tip::descent, &Tip::shortening, &Tip::rotation}) {
        const auto values = over_meshes(what);
        for (std::size_t mesh = 0; mesh < 4; ++mesh)
          distances[mesh] = std::hypot(distances[mesh], values[mesh] - expected[i].*what);
        EXPECT_NEAR(test::extrapolated(values, beam.convergence), expected[i].*what, 1e-7);
      }
      test::expect_order(distances, beam.convergence);
    }
  }
}

// End moment m = M L/EI: x/L = sin m/m, y/L = (1 − cos m)/m, θ = m. There are no forces, so EA and GA do not enter.
TEST(CantileverUnderAnEndMoment, ConvergesToTheCircle) {
  for (const BeamTheory& beam : test::all_beam_theories()) {
    SCOPED_TRACE(beam.name);
    for (const double m : {0.25 * pi, 0.5 * pi, pi}) {
      SCOPED_TRACE(m);
      std::vector<double> xs, zs;
      for (const int elements : {4, 8, 16, 32}) {
        const Cantilever cantilever{.EA = 1e3, .elements = elements, .tip_moment = 1.0, .GA = 400.0, .beam = beam};
        const Tip tip = tips(cantilever, {m})[0];
        EXPECT_NEAR(tip.rotation, m, 1e-10);  // exact on any mesh
        xs.push_back(1.0 - tip.shortening - std::sin(m) / m);
        zs.push_back(tip.descent - (1.0 - std::cos(m)) / m);
      }
      std::vector<double> errors;
      for (std::size_t i = 0; i < xs.size(); ++i) errors.push_back(std::hypot(xs[i], zs[i]));
      if (beam.on_circles == 0) {
        EXPECT_LT(*std::max_element(errors.begin(), errors.end()), 1e-10);
        continue;
      }
      test::expect_order(errors, beam.on_circles, 1e-12);
      EXPECT_NEAR(test::extrapolated(xs, beam.on_circles), 0.0, 1e-7);
      EXPECT_NEAR(test::extrapolated(zs, beam.on_circles), 0.0, 1e-7);
    }
  }
}

// The whole circle, and every eighth of the way.
TEST(CantileverUnderAnEndMoment, RollsUp) {
  std::vector<double> moments;
  for (int eighth = 1; eighth <= 8; ++eighth) moments.push_back(0.25 * pi * eighth);
  for (const BeamTheory& beam : test::all_beam_theories()) {
    if (beam.convergence < 4) continue;
    SCOPED_TRACE(beam.name);
    const auto found = tips({.EA = 1e3, .elements = 40, .tip_moment = 1.0, .GA = 400.0, .beam = beam}, moments);
    for (std::size_t i = 0; i < moments.size(); ++i) {
      const double m = moments[i], tolerance = beam.on_circles == 0 || beam.on_circles >= 6 ? 1e-8 : 3e-6;
      EXPECT_NEAR(found[i].rotation, m, 1e-9);
      EXPECT_NEAR(1.0 - found[i].shortening, std::sin(m) / m, tolerance);
      EXPECT_NEAR(found[i].descent, (1.0 - std::cos(m)) / m, tolerance);
    }
  }
}

// Pushed along its axis by λ with a thousandth of it across, EA = 1200: far behind the Euler load π²/4 the deflection
// turns. By shooting with adaptive Taylor series.
TEST(PushedCantilever, ItsDeflectionTurnsWhereThatOfTheElasticaDoes) {
  const auto model = [](int elements, const BeamTheory& beam) {
    const Cantilever cantilever{.EA = 1200.0, .elements = elements, .tip_force = 1e-3, .tip_push = 1.0, .beam = beam};
    test::PathModel path{.structure = cantilever.structure(), .first_step = 0.1, .watch = true};
    path.target_values = {test::stop_at_lambda(8.0)};
    return path;
  };
  const std::vector<test::PathEvent> expected = {
      {EventKind::turning_point, 4.322683039787027, {-0.808198639148663, 0.8060399566916872}}};
  for (const BeamTheory& beam : test::elastica_theories())
    test::expect_points_converge(beam, 8, model, expected, {.limit_in_lambda = 1e-7, .limit_in_displacement = 1e-7});
}

}  // namespace arcwall::cantilevers_test
