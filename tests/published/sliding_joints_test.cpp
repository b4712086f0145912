#include <gtest/gtest.h>

#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <functional>

#include "tests/support/sliding_models.hpp"

// Contact that slides to a joint of two members in line that are not alike. References are closed forms of beams with
// small slopes.
namespace arcwall::sliding_joints_test {

namespace {

using test::SlidingModel;

constexpr auto closes = EventKind::contact_closes, spreads = EventKind::contact_spreads,
               passes = EventKind::contact_transfers, branches = EventKind::branch_point;

constexpr double L = 2.0, gap = 1e-3;           // of the beam; between its lower face and the wall
constexpr double small_slopes = 5.0 * gap / L;  // the squares of slopes are less than a thousandth of this

// A member of a beam on two supports, of which the right one slides along x.
struct Part {
  double EI, height;
};

struct Beam {
  Part left, right;
  double joint;         // where they meet
  int elements = 40;    // of both
  double moment = 0.0;  // on the right end, times λ: the beam bends towards a wall below it
  double thrust = 0.0;  // there, times λ: the wall is above

  SlidingModel beside_a_wall() const {
    StructureBuilder builder;
    const Index a = builder.add_joint({0.0, 0.0}), b = builder.add_joint({joint, 0.0}), c = builder.add_joint({L, 0.0});
    const auto add_member = [&](const std::string& name, Index from, Index to, double begin, double end, Part part) {
      builder.add_member({.name = name,
                          .from = from,
                          .to = to,
                          .axis = straight_axis({begin, 0.0}, {end, 0.0}),
                          .theory = Theory::elastica,
                          .order = 6,
                          .section = {.E = 1.0, .A = 1e5, .I = part.EI, .height = part.height},
                          .elements = static_cast<int>(std::lround(elements * (end - begin) / L))});
    };
    add_member("left", a, b, 0.0, joint, left);
    add_member("right", b, c, joint, L, right);
    builder.fix(builder.dof(a, Dof::x));
    for (const Index end : {a, c}) builder.fix(builder.dof(end, Dof::z));
    if (moment != 0.0) builder.add_load(*builder.shared_rotation(c), moment, LoadKind::proportional);
    if (thrust != 0.0) builder.add_load(builder.dof(c, Dof::x), -thrust, LoadKind::proportional);
    const double z = gap + 0.5 * left.height;
    const test::TestWall below{.name = "wall", .side = Side::below, .profile = flat_profile(-z)},
        above{.name = "wall", .side = Side::above, .profile = flat_profile(z)};
    return {builder, {thrust == 0.0 ? below : above}, 0.05};
  }
};

double root_of(const std::function<double(double)>& f, double from, double to) {
  std::uintmax_t most = 200;
  const auto [a, b] =
      boost::math::tools::toms748_solve(f, from, to, boost::math::tools::eps_tolerance<double>(48), most);
  return 0.5 * (a + b);
}

ContactPoint only_contact(const test::SlidingPath& path) {
  const auto contacts = path.model.system().closed_contacts(path.last());
  EXPECT_EQ(contacts.size(), 1U);
  return contacts.empty() ? ContactPoint{} : contacts.front();
}

}  // namespace

// Two members that are alike are one strand. Contact at their joint has one name, on whichever side of it round-off is.
TEST(SlidingJoints, ArePlacesOfTheMemberBeforeThem) {
  const SlidingModel model =
      Beam{.left = {1.0, 0.01}, .right = {1.0, 0.01}, .joint = 0.8, .moment = 1.0}.beside_a_wall();
  const auto label_at = [&](double s) { return model.structure().label({.strand = 0, .s = s}); };
  for (const double s : {0.8 - 1e-12, 0.8, 0.8 + 1e-12}) {
    EXPECT_EQ(label_at(s).first, "left");
    EXPECT_NEAR(label_at(s).second, 1.0, 1e-9);
    EXPECT_LE(label_at(s).second, 1.0);
  }
  EXPECT_EQ(label_at(0.8 + 1e-3).first, "right");
}

// The contact at x divides the beam into two spans that are clamped there and sink by g: the left one, which has a part
// of the right member from the joint at a on, bears M = 3 g x/[a³/EI₁ + (x³ − a³)/EI₂] there, the right one 3 EI₂ g/(L
// − x)² less half of the moment on its other end. Both are the same at λ = 2 (3 EI₂ g/(L − x)² − M)/M₀. The contact
// comes to the joint where x = a; what is there is one state, whichever of the members has the contact.
TEST(SlidingJoints, LetContactPassToAMemberOfAnotherStiffness) {
  constexpr double a = 0.62 * L, moment = 2.6e-3;
  for (const double EI : {0.7, 1.0, 1.4}) {
    SCOPED_TRACE(EI);
    const auto lambda_at = [&](double x) {
      const double held = 3.0 * gap * x / (a * a * a + (x * x * x - a * a * a) / EI);
      return 2.0 * (3.0 * EI * gap / ((L - x) * (L - x)) - held) / moment;
    };
    const double to = 1.5 * lambda_at(a);
    // Of one stiffness, but of another material, the member is another one, too.
    const Beam beam{.left = {.EI = 1.0, .height = 0.01},
                    .right = {.EI = EI == 1.0 ? 1.0 + 1e-15 : EI, .height = 0.01},
                    .joint = a,
                    .moment = moment};
    const test::SlidingPath path = test::sliding_path(beam.beside_a_wall(), to, 0.05);
    const auto events = path.events();
    ASSERT_EQ(path.kinds(), (std::vector{closes, passes, passes}));
    EXPECT_NEAR(events[1].state.lambda, lambda_at(a), small_slopes * lambda_at(a));
    EXPECT_NEAR(events[2].state.lambda, events[1].state.lambda, 1e-9);
    const double x = root_of([&](double at) { return lambda_at(at) - to; }, a, 0.8 * L);
    const ContactPoint contact = only_contact(path);
    EXPECT_EQ(contact.label.member, "right");
    EXPECT_NEAR(contact.place.x(), x, small_slopes * x);
    path.expect_invariants();
  }
}

// Where the right member is thinner, its lower face stays above the floor: the left one touches with its corner at the
// joint. The end moment M sinks the place a by M a (L² − a²)/(6 L EI), the contact force p lifts it by p a² (L −
// a)²/(3 L EI).
TEST(SlidingJoints, AreCornersOfThickerMembers) {
  constexpr double a = 0.62 * L, moment = 2.6e-3, to = 3.0;
  const Beam beam{
      .left = {.EI = 1.0, .height = 0.01}, .right = {.EI = 1.0, .height = 0.005}, .joint = a, .moment = moment};
  const test::SlidingPath path = test::sliding_path(beam.beside_a_wall(), to, 0.05);
  ASSERT_EQ(path.kinds(), (std::vector{closes, passes}));
  const double comes = 6.0 * gap * (1.0 / ((L - a) * (L - a)) - 1.0 / (a * a)) / moment;
  EXPECT_NEAR(path.events()[1].state.lambda, comes, small_slopes * comes);
  const ContactPoint contact = only_contact(path);
  EXPECT_NEAR(contact.place.x(), a, small_slopes * a);
  const double sunk = to * moment * a * (L * L - a * a) / (6.0 * L);
  const double force = (sunk - gap) * 3.0 * L / (a * a * (L - a) * (L - a));
  EXPECT_NEAR(contact.force, force, small_slopes * force);
  path.expect_invariants();
}

// A column on a wall: its flat part ends half a wave from the right end, and so comes to the corner at P Λ = π² EI/(L −
// a)², Λ = 1 − P/EA. There it lifts off between its other edge and the corner, which soon becomes unstable.
TEST(SlidingJoints, TakeTheEdgeOfAFlatPart) {
  constexpr double a = 0.7 * L;
  const Beam column{.left = {.EI = 1.0, .height = 0.01},
                    .right = {.EI = 1.0, .height = 0.005},
                    .joint = a,
                    .moment = 0.0,
                    .thrust = 1.0};
  const double comes = pi * pi / ((L - a) * (L - a));
  const test::SlidingPath path = test::sliding_path(column.beside_a_wall(), 1.005 * comes, 0.5);
  const auto events = path.events();
  ASSERT_EQ(path.kinds(), (std::vector{branches, closes, spreads, passes}));
  EXPECT_NEAR(events[3].state.lambda, comes, (small_slopes + comes / 1e5) * comes);
  const auto contacts = path.model.system().closed_contacts(path.last());
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_NEAR(contacts[1].place.x(), a, small_slopes * a);
  EXPECT_GE(path.model.system().least_gap(path.last(), 10), -1e-9);
}

}  // namespace arcwall::sliding_joints_test
