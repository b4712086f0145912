// Strain energies of single elements against closed forms, and of whole models against what the library's elements say.
#include "apps/verify/strain_energy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "apps/verify/differences.hpp"
#include "apps/verify/potentials.hpp"
#include "apps/verify/verify.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/stored_files_of.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::verify::strain_energy_test {

using namespace test::tables;

namespace {

using test::TracedDeck;

constexpr double EA = 300.0, GA = 80.0, EI = 2.0, L = 1.5;

SectionAlong uniform() {
  return [](double) { return PlainStiffness{.EA = EA, .GA = GA, .EI = EI}; };
}

// --- bars -----------------------------------------------------------------------------------------------------------

}  // namespace

TEST(StrainEnergy, OfABarIsThatOfItsMeasure) {
  const Vec2 chord = L * Vec2(0.6, 0.8), away = 0.3 * Vec2(0.6, 0.8);
  const double l = L + 0.3;
  Vector u(4);
  u << 0.1, -0.2, 0.1 + away.x(), -0.2 + away.y();
  const std::vector<std::pair<TrussStrain, double>> strains{{TrussStrain::green, 0.5 * (l * l - L * L) / (L * L)},
                                                            {TrussStrain::engineering, (l - L) / L},
                                                            {TrussStrain::log, std::log(l / L)}};
  for (const auto& [measure, strain] : strains)
    for (const double free : {0.0, 0.05})
      EXPECT_NEAR(bar_energy(chord, EA, measure, free, u).energy, 0.5 * EA * L * std::pow(strain - free, 2), 1e-12);
}

// --- slender beams --------------------------------------------------------------------------------------------------

namespace {

// A stretch of a circle that turns by an angle over its length, or a straight one.
Stretch arc(double turn, double direction = 0.3) {
  Stretch out{.length = L};
  for (std::size_t k = 0; k < 4; ++k) out.angles[k] = direction + turn * (double(k) / 3.0 - 0.5);
  const double chord = turn == 0.0 ? L : 2.0 * L / turn * std::sin(0.5 * turn);
  out.chord = chord * Vec2(std::cos(direction), std::sin(direction));
  return out;
}

// The motion from one stretch to another, which moves and turns as a whole, too.
EndsMotion motion_to(const Stretch& from, const Stretch& to) {
  const Vec2 first(0.7, -0.4);
  return {.first = first,
          .second = first + to.chord - from.chord,
          .turn1 = to.angles.front() - from.angles.front(),
          .turn2 = to.angles.back() - from.angles.back() + 2.0 * pi};
}

constexpr std::array<AxisAngle, 3> axis_angles{AxisAngle::expanded, AxisAngle::quadratic, AxisAngle::cubic};

}  // namespace

TEST(StrainEnergy, OfASlenderBeamStretchedIsHalfEAStrainSquared) {
  for (const AxisAngle angle : axis_angles) {
    const SlenderElement element{.stretch = arc(0.0), .angle = angle, .section = uniform()};
    Stretch longer = arc(0.0, 1.1);
    longer.chord *= 1.02;
    EXPECT_NEAR(slender_energy(element, motion_to(element.stretch, longer)).energy, 0.5 * EA * L * 4e-4, 1e-13);
  }
}

namespace {

// The strain that (2.4) leaves of an arc of the turn α: x/sin x = 1 + x²/6 + 7x⁴/360 + 31x⁶/15120 + …, x = α/2, of
// which it has three terms; a tenth for the next.
double strain_left(double turn) { return 1.1 * 31.0 / 15120.0 * std::pow(0.5 * turn, 6); }

}  // namespace

// Circles bend into circles without any strain of the axis: ½ EI α²/L of the change of the turn.
TEST(StrainEnergy, OfASlenderBeamBentToACircleIsHalfEICurvatureSquared) {
  for (const AxisAngle angle : axis_angles)
    for (const double before : {0.0, 0.4})
      for (const double after : {-0.3, 0.1, 0.6}) {
        const SlenderElement element{.stretch = arc(before), .angle = angle, .section = uniform()};
        const double energy = slender_energy(element, motion_to(element.stretch, arc(after, -2.0))).energy;
        const double exact = 0.5 * EI / L * std::pow(after - before, 2);
        const double strain = strain_left(after) + strain_left(before);
        EXPECT_NEAR(energy, exact, 1e-13 + (angle == AxisAngle::expanded ? 0.5 * EA * L * strain * strain : 0.0))
            << before << " to " << after;
      }
}

// Held at rest and heated: ½ EA e² h, and ½ EI κ² h of what wants to bend; free: nothing.
TEST(StrainEnergy, OfAHeatedBeamIsThatOfWhatIsHeldBack) {
  constexpr double strain = 0.01, curvature = 0.2;
  for (const AxisAngle angle : axis_angles) {
    SlenderElement element{.stretch = arc(0.0), .angle = angle, .section = uniform(), .free = {.strain = strain}};
    EXPECT_NEAR(slender_energy(element, {}).energy, 0.5 * EA * L * strain * strain, 1e-13);
    element.free = {.curvature = curvature};
    const double left = angle == AxisAngle::expanded ? 0.5 * EA * L * std::pow(strain_left(curvature * L), 2) : 0.0;
    EXPECT_NEAR(slender_energy(element, {}).energy, 0.5 * EI * L * curvature * curvature, 1e-13 + left);
    element.free = {.strain = strain, .curvature = curvature};
    Stretch bent = arc(curvature * L);
    bent.chord *= 1.0 + strain;
    EXPECT_NEAR(slender_energy(element, motion_to(element.stretch, bent)).energy, 0.0, 1e-13 + left);
  }
}

// One axial force all along: ½ Δ²/∫ dS/EA, with ∫ = L ln(EA₂/EA₁)/(EA₂ − EA₁) where EA is linear. Seven points give
// this to 10⁻¹¹ where EA is half as much again at the end.
TEST(StrainEnergy, OfATaperingBeamStretchedFollowsItsSofterEnd) {
  const auto section = [](double xi) { return PlainStiffness{.EA = EA * (1.0 + 0.5 * xi), .EI = EI}; };
  for (const AxisAngle angle : {AxisAngle::quadratic, AxisAngle::cubic}) {
    const SlenderElement element{.stretch = arc(0.0), .angle = angle, .section = section};
    Stretch longer = arc(0.0);
    longer.chord *= 1.02;
    const double softness = L * std::log(1.5) / (0.5 * EA), growth = 0.02 * L;
    EXPECT_NEAR(slender_energy(element, motion_to(element.stretch, longer)).energy, 0.5 * growth * growth / softness,
                1e-11);
  }
}

// Small rotations t₁, t₂ of the ends of a thin beam whose EI is linear, EI (1 + 2τ x): θ′ = b + 2σ x of Hermite's
// cubic gives ½ EI/L [b² + σ²/3 + ⅔ τ b σ]. The cubic angle may change it to bend where the beam is softer.
TEST(StrainEnergy, OfATaperingBeamBentIsThatOfTheCubicDeflection) {
  constexpr double taper = 0.25, thin = 1e9, t1 = 2e-5, t2 = 5e-5;
  const SlenderElement element{.stretch = arc(0.0), .angle = AxisAngle::quadratic, .section = [](double xi) {
                                 return PlainStiffness{.EA = thin, .EI = EI * (1.0 + 2.0 * taper * (xi - 0.5))};
                               }};
  const double b = t2 - t1, sigma = 3.0 * (t1 + t2);
  // The chord is shorter by ∫ ½ θ².
  EndsMotion motion{.turn1 = t1, .turn2 = t2};
  motion.second = -(b * b / 24.0 + sigma * sigma / 360.0) * element.stretch.chord;
  const double exact = 0.5 * EI / L * (b * b + sigma * sigma / 3.0 + 2.0 / 3.0 * taper * b * sigma);
  EXPECT_NEAR(slender_energy(element, motion).energy, exact, 1e-7 * exact);
  SlenderElement freer = element;
  freer.angle = AxisAngle::cubic;
  EXPECT_LT(slender_energy(freer, motion).energy, 0.999 * exact);
}

// --- beams with shear -----------------------------------------------------------------------------------------------

namespace {

NodesAlong straight_nodes(int order) {
  NodesAlong nodes;
  for (int i = 0; i <= order; ++i) {
    nodes.places.emplace_back(L * i / order, 0.0);
    nodes.arcs.push_back(L * i / order);
  }
  return nodes;
}

// Unknowns from a field of (u, w, …) by the distance along.
Vector from_field(const NodesAlong& nodes, int unknowns, const std::function<Vector(double)>& field) {
  Vector u(unknowns * (nodes.order() + 1));
  for (int a = 0; a <= nodes.order(); ++a)
    u.segment(unknowns * a, unknowns) = field(nodes.arcs[static_cast<std::size_t>(a)]);
  return u;
}

}  // namespace

// Timoshenko's states: uniform stretch and shear ½ GA γ² L with sections that do not turn, and ½ EI κ² L with sections
// that turn across an axis as long as before. Order 1 does not bend its axis: its chord takes the middle's turn.
TEST(StrainEnergy, OfAReissnerBeamIsThatOfItsThreeStrains) {
  constexpr double strain = 0.02, shear = 0.3, kappa = 0.4;
  for (const int order : {1, 2}) {
    const NodesAlong nodes = straight_nodes(order);
    const Vector sheared =
        from_field(nodes, 3, [&](double s) { return Vector(Eigen::Vector3d(strain * s, shear * s, 0.0)); });
    EXPECT_NEAR(reissner_energy(nodes, uniform(), {}, sheared).energy,
                0.5 * L * (EA * strain * strain + GA * shear * shear), 1e-13);
    EXPECT_NEAR(reissner_energy(nodes, uniform(), {.strain = strain}, sheared).energy, 0.5 * L * GA * shear * shear,
                1e-13);
  }
  const double turn = kappa * L;
  Vector bent(6);
  bent << 0.0, 0.0, 0.0, L * std::cos(0.5 * turn) - L, L * std::sin(0.5 * turn), turn;
  EXPECT_NEAR(reissner_energy(straight_nodes(1), uniform(), {}, bent).energy, 0.5 * EI * kappa * kappa * L, 1e-13);
  EXPECT_NEAR(reissner_energy(straight_nodes(1), uniform(), {.curvature = kappa}, bent).energy, 0.0, 1e-13);
}

namespace {

constexpr double width = 0.7, height = 0.3, E = 120.0, nu = 0.25, k = 0.8;

EssenburgMaterial rectangle(QuadraticTerm quadratic) {
  EssenburgMaterial of{.E = E, .nu = nu, .shear_correction = k, .heights = {}, .quadratic = quadratic};
  for (const auto& [at, weight] : gauss_rule_of(5))
    of.heights.emplace_back((at - 0.5) * height, weight * width * height);
  return of;
}

std::vector<PlainDirector> upright(std::size_t nodes) { return std::vector<PlainDirector>(nodes); }

}  // namespace

// (2.15) by hand: a state of one deformation gradient (stretch, thickening and shear), and the order 1 of a bent
// beam, where in its one point along the axis f₁ = (1 − κz) e₁ and f₃ = cos(α/2) e₃, κ = 2 sin(α/2)/L.
TEST(StrainEnergy, OfAnEssenburgBeamIsThatOfGreensStrain) {
  const double A = width * height, C = E / (1.0 - nu * nu), G = E / (2.0 * (1.0 + nu));
  constexpr double a = 0.03, thicker = -0.02, shear = 0.1;
  for (const QuadraticTerm quadratic : {QuadraticTerm::fixed, QuadraticTerm::director})
    for (const int order : {1, 2}) {
      const NodesAlong nodes = straight_nodes(order);
      const Vector u = from_field(nodes, 5, [&](double s) {
        Vector here(5);
        here << a * s, shear * s, 0.0, thicker, 0.0;
        return here;
      });
      const double E11 = 0.5 * ((1.0 + a) * (1.0 + a) + shear * shear - 1.0);
      const double E33 = 0.5 * ((1.0 + thicker) * (1.0 + thicker) - 1.0), gamma = shear * (1.0 + thicker);
      EXPECT_NEAR(essenburg_energy(nodes.places, upright(nodes.places.size()), rectangle(quadratic), u).energy,
                  0.5 * A * L * (C * (E11 * E11 + E33 * E33 + 2.0 * nu * E11 * E33) + k * G * gamma * gamma), 1e-13);
    }
  constexpr double turn = 0.5;
  const double kappa = 2.0 * std::sin(0.5 * turn) / L, E33 = -0.5 * std::pow(std::sin(0.5 * turn), 2);
  Vector bent(10);  // the sections' ends turn by ∓α/2
  bent << 0.0, 0.0, -0.5 * turn, 0.0, 0.0, 0.0, 0.0, 0.5 * turn, 0.0, 0.0;
  const double z2 = A * height * height / 12.0, z4 = A * std::pow(height, 4) / 80.0;
  const double squared = kappa * kappa * z2 + 0.25 * std::pow(kappa, 4) * z4, mean = 0.5 * kappa * kappa * z2;
  EXPECT_NEAR(essenburg_energy(straight_nodes(1).places, upright(2), rectangle(QuadraticTerm::fixed), bent).energy,
              0.5 * C * L * (squared + A * E33 * E33 + 2.0 * nu * E33 * mean), 1e-13);
}

// --- derivatives ----------------------------------------------------------------------------------------------------

namespace {

void expect_derivatives(const std::function<LocalEnergy(const Vector&)>& energy, const Vector& u) {
  const LocalEnergy here = energy(u);
  constexpr double step = 1e-3;
  const double force = here.stiffness.cwiseAbs().maxCoeff();
  for (Index i = 0; i < u.size(); ++i) {
    const auto moved = [&](double by) { return energy(u + by * Vector::Unit(u.size(), i)); };
    EXPECT_NEAR(derivative([&](double by) { return moved(by).energy; }, step), here.gradient[i], 1e-7 * force) << i;
    const Vector column = derivative([&](double by) { return Vector(moved(by).gradient); }, step);
    EXPECT_LT((column - here.stiffness.col(i)).cwiseAbs().maxCoeff(), 1e-6 * force) << i;
  }
}

Vector random_unknowns(Index size, double greatest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-greatest, greatest);
  Vector u(size);
  for (double& one : u) one = within(random);
  return u;
}

EndsMotion motion_of(const Vector& u) {
  return {.first = u.head<2>(), .second = u.segment<2>(3), .turn1 = u[2], .turn2 = u[5]};
}

}  // namespace

TEST(StrainEnergy, HasTheForcesAndStiffnessThatDifferencesTell) {
  for (const AxisAngle angle : axis_angles) {
    const SlenderElement element{
        .stretch = arc(0.3), .angle = angle, .section = uniform(), .free = {.strain = 0.01, .curvature = -0.1}};
    const Vector u = random_unknowns(6, 0.05, 1);
    expect_derivatives([&](const Vector& at) { return slender_energy(element, motion_of(at)); }, u);
    const PlaceInside place = place_inside(element, motion_of(u), 0.3);
    for (Index i = 0; i < 6; ++i) {
      const auto offset = [&](double by) {
        const EndsMotion moved = motion_of(u + by * Vector::Unit(6, i));
        return Vec2(moved.first + place_inside(element, moved, 0.3).offset);
      };
      EXPECT_LT((derivative(offset, 1e-3) - place.gradient.col(i)).norm(), 1e-8);
    }
  }
  for (const TrussStrain measure : {TrussStrain::green, TrussStrain::engineering, TrussStrain::log})
    expect_derivatives(
        [&](const Vector& at) {
          return bar_energy({1.2, 0.5}, EA, measure, 0.01, at);
        },
        random_unknowns(4, 0.2, 2));
  for (const int order : {1, 2}) {
    const NodesAlong nodes = straight_nodes(order);
    expect_derivatives([&](const Vector& at) { return reissner_energy(nodes, uniform(), {}, at); },
                       random_unknowns(3 * (order + 1), 0.3, 3));
    for (const QuadraticTerm quadratic : {QuadraticTerm::fixed, QuadraticTerm::director})
      expect_derivatives(
          [&](const Vector& at) {
            return essenburg_energy(nodes.places, upright(nodes.places.size()), rectangle(quadratic), at);
          },
          random_unknowns(5 * (order + 1), 0.2, 4));
  }
}

// --- whole models ---------------------------------------------------------------------------------------------------

namespace {

// A member over an obstacle's length, with all that its theory may have along it.
struct Kind {
  std::string name, theory, section = R"(shape = "rectangle", width = 0.5, height = 0.2)", axis{}, more{};
};

const std::string heat = table("[[load]]", R"(on = "m"; temperature = 30.0)") +
                         table("[[load]]", R"(on = "m"; temperature = 0.0; gradient = 15.0; constant = true)");
const std::string lines = distributed("m", 0.3, -0.8, "distributed_to = [0.1, -0.2]") +
                          distributed("m", 0.0, -0.5, R"(frame = "member"; constant = true)") +
                          distributed("m", 0.0, -0.5, R"(per = "x")");
const std::string pressed = R"([[load]]
on = "m"
pressure = 0.7
)";
const std::string bedded =
    table("[[spring]]", R"(on = "m"; foundation = { x = 3.0, z = 8.0 })") +
    table(
        "[[spring]]",
        R"(on = "m"; law = { direction = "z", displacement = [-0.4, 0.0, 0.2, 0.5], force = [-2.0, 0.0, 3.0, 4.0] })");

std::vector<Kind> kinds() {
  const std::string table = R"(shape = "table", at = [0.0, 0.3, 1.0], A = [0.2, 0.1, 0.15], I = [2e-3, 1e-3, 3e-3])";
  const std::string taper = R"(shape = "rectangle", width = 0.5, height = 0.2, width_to = 0.4, height_to = 0.1)";
  const std::string wave = R"(imperfection = { shape = "sine", amplitude = 0.03, waves = 3 })";
  const std::string via = R"(via = [2.0, 1.0])";
  const std::string spline = R"(curve = { x = [0.0, 1.5, 2.5, 4.0], z = [0.0, 0.6, 0.5, 0.0] })";
  std::vector<Kind> all;
  for (const std::string theory :
       {"theory = \"euler-bernoulli\"", "theory = \"elastica\"\norder = 4", "theory = \"elastica\"\norder = 6",
        "theory = \"reissner\"\norder = 1", "theory = \"reissner\"\norder = 2"}) {
    all.push_back({.name = "straight", .theory = theory});
    all.push_back({.name = "wavy", .theory = theory, .axis = wave, .more = heat + lines});
    all.push_back({.name = "arc", .theory = theory, .axis = via, .more = pressed + bedded + lines});
    all.push_back({.name = "spline", .theory = theory, .axis = spline, .more = heat + lines + bedded});
    all.push_back({.name = "taper", .theory = theory, .section = taper, .axis = via, .more = heat});
    all.push_back({.name = "table", .theory = theory, .section = table, .axis = wave, .more = lines});
    all.push_back({.name = "tube",
                   .theory = theory,
                   .section = R"(shape = "tube", radius = 0.2, thickness = 0.03, radius_to = 0.15)"});
  }
  for (const std::string theory : {"theory = \"essenburg\"\norder = 1", "theory = \"essenburg\"\norder = 2",
                                   "theory = \"essenburg\"\norder = 2\nalong = \"director\""}) {
    all.push_back({.name = "straight", .theory = theory, .more = pressed + bedded + lines});
    all.push_back({.name = "circle", .theory = theory, .section = R"(shape = "circle", radius = 0.1)", .axis = wave});
    all.push_back({.name = "tube",
                   .theory = theory,
                   .section = R"(shape = "tube", radius = 0.1, thickness = 0.02)",
                   .axis = via,
                   .more = lines});
  }
  return all;
}

std::string deck_of(const Kind& kind) {
  return R"(title = "one member"
material.m = { E = 2.0e4, nu = 0.3, expansion = 1.2e-5 }
section.s = { )" +
         kind.section + R"( }
point = { a = [0.0, 0.0], b = [4.0, 0.0] }
support = { a = ["x", "z"], b = ["z"] }
[member.m]
from = "a"
to = "b"
material = "m"
section = "s"
elements = 8
)" + kind.theory +
         "\n" + kind.axis + R"(
[[load]]
at = "b"
force = [-1.0, 0.0]
)" + kind.more;
}

// What is off, of the greatest, between potentials and the library's system.
struct Deviation {
  double energy = 0.0, force = 0.0, stiffness = 0.0;
};

Deviation deviation(const Model& model, const State& state) {
  const PlainMembers members(model);
  double energy = -work_of_point_loads(model, state), sizes = std::abs(energy);
  Vector F = -point_loads(model, state), parts = F.cwiseAbs();
  Matrix K = Matrix::Zero(F.size(), F.size());
  for (const Potential& one : potentials(model, members, state)) {
    energy += one.energy;
    sizes += std::abs(one.energy);
    for (std::size_t i = 0; i < one.unknowns.size(); ++i) {
      if (one.unknowns[i] < 0) continue;
      F[one.unknowns[i]] += one.gradient[static_cast<Index>(i)];
      parts[one.unknowns[i]] += std::abs(one.gradient[static_cast<Index>(i)]);
      for (std::size_t j = 0; j < one.unknowns.size(); ++j)
        if (one.unknowns[j] >= 0)
          K(one.unknowns[i], one.unknowns[j]) += one.stiffness(static_cast<Index>(i), static_cast<Index>(j));
    }
  }
  Linearization of;
  model.structure().linearize(state, of);
  const Matrix lower(of.K), whole = Matrix(lower.selfadjointView<Eigen::Lower>());
  return {.energy = std::abs(energy - model.structure().energy(state)) / sizes,
          .force = (F - of.F).cwiseAbs().maxCoeff() / parts.maxCoeff(),
          .stiffness = (K - whole).cwiseAbs().maxCoeff() / whole.cwiseAbs().maxCoeff()};
}

}  // namespace

namespace {

// At three states at random.
void expect_as_library(const Model& model, double greatest) {
  ASSERT_EQ(model.sliding(), nullptr);
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Vector x = random_unknowns(model.structure().size({}), greatest, seed);
    const Deviation here = deviation(model, {.x = x, .lambda = 0.4 + 0.2 * seed});
    EXPECT_LT(here.energy, 1e-13);
    EXPECT_LT(here.force, 1e-13);
    EXPECT_LT(here.stiffness, 1e-12);
  }
}

}  // namespace

// The library's elements are written with derivatives by hand.
TEST(StrainEnergy, IsThatOfTheLibraryInModelsOfAllTheories) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name + ", " + kind.theory);
    expect_as_library(Model(deck::read_deck_text(deck_of(kind), "deck.toml")), 0.03);
  }
}

TEST(StrainEnergy, IsThatOfTheLibraryInTrusses) {
  for (const std::string strain : {"green", "engineering", "log"}) {
    SCOPED_TRACE(strain);
    const std::string bar =
        R"(theory = "truss", material = "m", section = "s", elements = 1, strain = ")" + strain + "\"";
    const std::string deck = R"(title = "two bars"
material.m = { E = 2.0e4, expansion = 1.2e-5 }
section.s = { shape = "circle", radius = 0.1 }
point = { a = [0.0, 0.0], b = [4.0, 0.0], top = [1.5, 1.0] }
support = { a = ["x", "z"], b = ["x", "z"] }
load = [{ at = "top", force = [0.0, -1.0] }, { on = "left", temperature = 20.0 }, { on = "right", distributed = [0.1, -0.4] }]
member.left = { from = "a", to = "top", )" +
                             bar + R"( }
member.right = { from = "top", to = "b", )" +
                             bar + " }\n";
    expect_as_library(Model(deck::read_deck_text(deck, "deck.toml")), 0.1);
  }
}

namespace {

// The checks that refuse the states of a run where its material is changed, as an element of the library would have it
// whose energy is wrong by as much.
std::vector<std::string> refusals(const TracedDeck& traced, const std::string& deck, const std::string& change) {
  const Model other(deck::read_deck_text(deck, "deck.toml", {change}));
  const Verdict verdict = verify(other, traced.record(), stored_files_of(traced.record()), "checkpoint");
  std::vector<std::string> refusals;
  for (const CheckSummary& check : verdict.findings.checks())
    if (check.failures > 0) refusals.push_back(check.name);
  return refusals;
}

// A strip that its load bends onto a floor.
const std::string touching = flat_wall("floor", "below", -0.02, on_axis);

}  // namespace

TEST(StrainEnergy, OfAnElementThatIsALittleStifferIsRefused) {
  const std::string path = R"(
[path]
step = 0.1
[path.stop]
lambda = [-1.0, 0.3]
)";
  for (const std::string theory :
       {"theory = \"euler-bernoulli\"", "theory = \"elastica\"", "theory = \"reissner\"", "theory = \"essenburg\""})
    for (const std::string& wall : {std::string(), touching}) {
      SCOPED_TRACE(theory + wall);
      const std::string deck = deck_of({.name = "", .theory = theory, .more = lines}) + wall + path;
      const TracedDeck traced(deck);
      EXPECT_EQ(traced.record().points.back().contacts > 0, !wall.empty());
      EXPECT_TRUE(refusals(traced, deck, "material.m.E=20000.0").empty());
      // The energy shows a millionth; forces may be off by the corrector's distance times the greatest stiffness.
      for (const auto& [change, check] : {std::pair("material.m.E=20000.02", "path.csv matches the states"),
                                          std::pair("material.m.E=20002.0", "forces balance at nodes")}) {
        const std::vector<std::string> found = refusals(traced, deck, change);
        EXPECT_NE(std::find(found.begin(), found.end(), check), found.end()) << check;
      }
    }
}

}  // namespace arcwall::verify::strain_energy_test
