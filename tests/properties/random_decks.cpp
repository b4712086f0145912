#include "tests/properties/random_decks.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/types.hpp"
#include "model/deck/writer.hpp"

namespace arcwall::test {

namespace {

using deck::Deck;

constexpr double E = 1.0e4;

// With a material, one section of that height and unit width, and what all paths have in common.
Deck deck_of(const char* title, double height) {
  Deck deck{.source = {.file = "random.toml"}, .title = title, .units = {.length = "cm", .force = "kN"}};
  deck.materials.push_back({.name = "steel", .E = E, .nu = 0.3});
  deck.sections.push_back({.name = "bar", .shape = deck::Rectangle{.width = 1.0, .height = height}});
  deck.path.max_points = 80;
  deck.path.branches = BranchPolicy::primary;
  return deck;
}

void add_point(Deck& deck, const char* name, double x, double z) {
  deck.points.push_back({.name = name, .at = {.x = x, .z = z}});
}

deck::Member& add_member(Deck& deck, const char* name, const char* from, const char* to, Theory theory, int elements) {
  deck.members.push_back({.name = name,
                          .from = from,
                          .to = to,
                          .theory = theory,
                          .material = "steel",
                          .section = "bar",
                          .elements = elements});
  deck::Member& added = deck.members.back();
  if (theory == Theory::reissner || theory == Theory::essenburg) added.order = 2;
  if (theory == Theory::elastica) added.order = 6;
  return added;
}

void support(Deck& deck, const char* point, bool clamped) {
  deck.supports.push_back({.point = point, .directions = {Dof::x, Dof::z}});
  if (clamped) deck.supports.back().directions.push_back(Dof::rotation);
}

void load(Deck& deck, deck::Place at, double x, double z) {
  deck.loads.push_back({.action = deck::PointLoad{.at = std::move(at), .force = {.x = x, .z = z}}});
}

// Steps of that size in λ until it is so many times that.
void follow(Deck& deck, double step, double most = 60.0) {
  deck.path.step = step;
  deck.path.stop.bounds.push_back({.name = "lambda", .low = -most * step, .high = most * step});
}

Theory beam_theory() { return *rc::gen::element(Theory::euler_bernoulli, Theory::elastica, Theory::reissner); }

// A load down and a little aside, so that nothing is symmetric.
void push(Deck& deck, deck::Place at, double force) { load(deck, std::move(at), force * *between(-0.3, 0.3), -force); }

}  // namespace

rc::Gen<double> between(double low, double high) {
  constexpr int count = 1'000'000;
  return rc::gen::map(rc::gen::inRange(0, count + 1), [=](int i) { return low + (high - low) * i / count; });
}

rc::Gen<Deck> truss_deck() {
  return rc::gen::exec([] {
    const double left = *between(5.0, 15.0), right = *between(5.0, 15.0), rise = *between(0.3, 12.0);
    const auto strain = *rc::gen::element(TrussStrain::green, TrussStrain::engineering, TrussStrain::log);
    Deck deck = deck_of("Truss", 0.1);
    add_point(deck, "left", -left, 0.0);
    add_point(deck, "top", 0.0, rise);
    add_point(deck, "right", right, 0.0);
    add_member(deck, "west", "left", "top", Theory::truss, 1).strain = strain;
    add_member(deck, "east", "top", "right", Theory::truss, 1).strain = strain;
    support(deck, "left", false);
    support(deck, "right", false);
    push(deck, {.name = "top"}, 1.0);
    follow(deck, 0.05 * E * 0.1 * std::pow(rise / std::hypot(0.5 * (left + right), rise), 3.0));
    return deck;
  });
}

rc::Gen<Deck> toggle_deck() {
  return rc::gen::exec([] {
    const double left = *between(8.0, 12.0), right = *between(8.0, 12.0), rise = *between(0.3, 4.0);
    const double height = *between(0.1, 0.4);
    const int elements = *rc::gen::inRange(2, 5);
    const bool clamped = *rc::gen::arbitrary<bool>();
    Deck deck = deck_of("Toggle", height);
    add_point(deck, "left", -left, 0.0);
    add_point(deck, "top", 0.0, rise);
    add_point(deck, "right", right, 0.0);
    add_member(deck, "west", "left", "top", beam_theory(), elements);
    add_member(deck, "east", "top", "right", beam_theory(), elements);
    support(deck, "left", clamped);
    support(deck, "right", *rc::gen::arbitrary<bool>());
    push(deck, {.name = "top"}, 1.0);
    const double EI = E * std::pow(height, 3.0) / 12.0;
    follow(deck, EI * rise / 1000.0);
    return deck;
  });
}

rc::Gen<Deck> arch_deck() {
  return rc::gen::exec([] {
    const double span = 20.0, rise = *between(1.0, 8.0), height = *between(0.1, 0.4);
    const int elements = 2 * *rc::gen::inRange(2, 5);
    Deck deck = deck_of("Arch", height);
    add_point(deck, "left", 0.0, 0.0);
    add_point(deck, "right", span, 0.0);
    deck::Member& arch = add_member(deck, "arch", "left", "right", beam_theory(), elements);
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        arch.axis = deck::Arc{.via = {.x = 0.5 * span, .z = rise}};
        break;
      case 1:
        arch.axis = deck::SineAxis{.rise = rise, .waves = 1};
        break;
      default:
        arch.axis = deck::Curve{.x = {0.0, 5.0, 10.0, 15.0, span},
                                .z = {0.0, rise * *between(0.5, 0.8), rise, rise * *between(0.5, 0.8), 0.0}};
    }
    arch.imperfections.push_back({.amplitude = *between(-0.2, 0.2), .waves = 2});
    support(deck, "left", *rc::gen::arbitrary<bool>());
    support(deck, "right", *rc::gen::arbitrary<bool>());
    push(deck, {.name = "arch", .fraction = 0.5}, 1.0);
    const double EI = E * std::pow(height, 3.0) / 12.0;
    follow(deck, EI * rise / 800.0);
    return deck;
  });
}

rc::Gen<Deck> portal_deck() {
  return rc::gen::exec([] {
    const double width = *between(5.0, 15.0), left = *between(5.0, 15.0), right = *between(5.0, 15.0);
    const double height = *between(0.1, 0.5);
    const int elements = *rc::gen::inRange(1, 4);
    Deck deck = deck_of("Portal", height);
    add_point(deck, "A", 0.0, 0.0);
    add_point(deck, "B", *between(-1.0, 1.0), left);
    add_point(deck, "C", width, right);
    add_point(deck, "D", width, 0.0);
    const Theory theory = beam_theory();
    add_member(deck, "west", "A", "B", theory, elements);
    add_member(deck, "beam", "B", "C", theory, elements).hinge_to = *rc::gen::arbitrary<bool>();
    add_member(deck, "east", "C", "D", theory, elements);
    support(deck, "A", *rc::gen::arbitrary<bool>());
    support(deck, "D", true);
    push(deck, {.name = "B"}, 1.0);
    if (*rc::gen::arbitrary<bool>())
      deck.loads.push_back({.action = deck::MemberLoad{.member = "beam", .distributed = {.x = 0.0, .z = -0.01}}});
    const double EI = E * std::pow(height, 3.0) / 12.0;
    follow(deck, 0.2 * EI / (left * left));
    return deck;
  });
}

rc::Gen<Deck> walled_deck() {
  return rc::gen::exec([] {
    const double length = 20.0, height = *between(0.1, 0.4), gap = *between(0.2, 1.0);
    const int elements = 2 * *rc::gen::inRange(2, 5);
    const Theory theory = *rc::gen::element(Theory::euler_bernoulli, Theory::elastica, Theory::reissner);
    Deck deck = deck_of("Beam between walls", height);
    add_point(deck, "left", 0.0, 0.0);
    add_point(deck, "right", length, 0.0);
    add_member(deck, "beam", "left", "right", theory, elements)
        .imperfections.push_back({.amplitude = *between(-0.1, 0.1), .waves = 1});
    support(deck, "left", *rc::gen::arbitrary<bool>());
    support(deck, "right", *rc::gen::arbitrary<bool>());
    push(deck, {.name = "beam", .fraction = 0.5}, 1.0);
    const double depth = gap + 0.5 * height;
    deck::Wall floor{.name = "floor", .side = Side::below};
    if (*rc::gen::arbitrary<bool>()) {
      const double slope = *between(-0.02, 0.02);
      floor.profile = deck::LineProfile{.z = -depth - std::max(0.0, slope * length), .slope = slope};
    } else {
      const double radius = *between(30.0, 100.0);
      floor.profile = deck::CircleProfile{.centre = {.x = *between(8.0, 12.0), .z = -depth - radius}, .radius = radius};
    }
    deck.walls.push_back(floor);
    if (*rc::gen::arbitrary<bool>())
      deck.walls.push_back({.name = "roof", .side = Side::above, .profile = deck::LineProfile{.z = depth}});
    if (*rc::gen::arbitrary<bool>()) deck.contact.points = deck::ContactPoints::nodes;
    // It bends first; then it is a rope.
    const double EA = E * height, EI = E * std::pow(height, 3.0) / 12.0;
    follow(deck, (5.0 * EI * gap + EA * std::pow(gap, 3.0)) / std::pow(length, 3.0));
    return deck;
  });
}

rc::Gen<Deck> small_deck() {
  return rc::gen::oneOf(truss_deck(), toggle_deck(), arch_deck(), portal_deck(), walled_deck());
}

}  // namespace arcwall::test

namespace arcwall::deck {

void showValue(const Deck& deck, std::ostream& out) { out << "\n" << to_toml(deck); }

}  // namespace arcwall::deck
