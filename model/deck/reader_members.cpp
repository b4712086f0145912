// Members: theory, stress-free axis, imperfections, hinges.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "model/deck/reader_parts.hpp"

namespace arcwall::deck {

namespace {

constexpr int most_elements = 10'000'000;

struct Ends {
  Vector from{};
  Vector to{};
};

double distance(const Vector& a, const Vector& b) { return std::hypot(b.x - a.x, b.z - a.z); }

std::string point_text(const Vector& at) { return "[" + round_trip(at.x) + ", " + round_trip(at.z) + "]"; }

bool is_shear_flexible(Theory theory) { return theory == Theory::essenburg || theory == Theory::exact; }

// The ends' coordinates if both are known and apart.
std::optional<Ends> read_ends(Cursor& table, const Names& names, const Deck& deck, Member& member) {
  const bool from = read_name(table, "from", "a point", names.points, member.from);
  const bool to = read_name(table, "to", "a point", names.points, member.to);
  if (!from || !to) return std::nullopt;
  if (member.from == member.to) {
    table.report("to", in_quotes(member.to) + " is also the point it comes from", "name another point");
    return std::nullopt;
  }
  const Point* a = find(deck.points, member.from);
  const Point* b = find(deck.points, member.to);
  if (a == nullptr || b == nullptr) return std::nullopt;  // reported where the points are read
  if (!(distance(a->at, b->at) > 0.0)) {
    table.report("to", "points " + a->name + " and " + b->name + " are both at " + point_text(a->at),
                 "move one of them: a member needs a length");
    return std::nullopt;
  }
  return Ends{a->at, b->at};
}

void read_order(Cursor& table, Member& member) {
  if (member.theory == Theory::classic || member.theory == Theory::truss) {
    refuse(table, "order", "theory " + text_of(theory_words, member.theory) + " has no order",
           "remove it, or take essenburg, exact or elastica");
    return;
  }
  const int low = is_shear_flexible(member.theory) ? 1 : 4;
  const int high = is_shear_flexible(member.theory) ? 2 : 6;
  member.order = high;
  int order = high;
  if (!table.integer("order", Presence::optional, {}, order)) return;
  if (order != low && order != high) {
    table.report("order", std::to_string(order) + " is no order of theory " + text_of(theory_words, member.theory),
                 "give " + std::to_string(low) + " or " + std::to_string(high));
  }
  member.order = order;
}

void read_theory(Cursor& table, Member& member) {
  if (!table.word("theory", Presence::required, theory_words, member.theory)) {
    for (const char* key : {"order", "along", "strain"}) table.find(key, Presence::optional);
    return;
  }
  read_order(table, member);
  if (member.theory == Theory::essenburg) {
    table.word("along", Presence::optional, along_words, member.along);
  } else {
    refuse(table, "along", "belongs to theory essenburg", "remove it");
  }
  if (member.theory == Theory::truss) {
    table.word("strain", Presence::optional, strain_words, member.strain);
  } else {
    refuse(table, "strain", "belongs to theory truss", "remove it");
  }
}

void read_material_and_section(Cursor& table, const Names& names, const Deck& deck, Member& member) {
  read_name(table, "section", "a section", names.sections, member.section);
  const Section* section = find(deck.sections, member.section);
  if (member.theory == Theory::essenburg && section != nullptr && std::holds_alternative<General>(section->shape)) {
    table.report("section",
                 "section " + member.section + " has no shape over whose height theory essenburg could integrate",
                 "take a rectangle, a circle or a tube");
  }
  if (!read_name(table, "material", "a material", names.materials, member.material)) return;
  const Material* material = find(deck.materials, member.material);
  const bool has_nu = material == nullptr || material->nu.has_value();
  if (is_shear_flexible(member.theory) && !has_nu) {
    table.report(
        "material",
        "material " + member.material + " has no nu, which theory " + text_of(theory_words, member.theory) + " needs",
        "add nu to material." + member.material);
  }
}

Arc read_arc(Cursor& table, const std::optional<Ends>& ends) {
  constexpr double tolerance = 1e-12;  // of the chord: below, the radius is beyond the resolution of the coordinates
  Arc arc;
  if (!table.vector("via", Presence::required, arc.via) || !ends) return arc;
  const double chord = distance(ends->from, ends->to);
  const Vector c{(ends->to.x - ends->from.x) / chord, (ends->to.z - ends->from.z) / chord};
  const Vector v{arc.via.x - ends->from.x, arc.via.z - ends->from.z};
  if (arc.via == ends->from || arc.via == ends->to) {
    table.report("via", point_text(arc.via) + " is an end of the member", "give a point between its ends");
  } else if (std::abs(c.x * v.z - c.z * v.x) <= tolerance * std::max(chord, distance(ends->from, arc.via))) {
    table.report("via", point_text(arc.via) + " is on the straight line through the ends",
                 "leave it out, or move it off the line");
  }
  return arc;
}

SineAxis read_sine(Cursor table) {
  SineAxis sine;
  table.number("rise", Presence::required, any_number, sine.rise);
  table.integer("waves", Presence::required, {.low = 1}, sine.waves);
  table.finish();
  return sine;
}

void check_curve(Cursor& table, const Curve& curve, const Ends& ends) {
  const double tolerance = 1e-9 * distance(ends.from, ends.to);
  const Vector first{curve.x.front(), curve.z.front()};
  const Vector last{curve.x.back(), curve.z.back()};
  if (distance(first, ends.from) > tolerance) {
    table.report("x", "the first point " + point_text(first) + " is not where the member begins",
                 "begin at " + point_text(ends.from));
  }
  if (distance(last, ends.to) > tolerance) {
    table.report("x", "the last point " + point_text(last) + " is not where the member ends",
                 "end at " + point_text(ends.to));
  }
  // A spline through points between which a stretch is lost in the digits of the whole cannot be computed.
  constexpr double least_stretch = 1e-9;
  const auto stretch = [&curve](std::size_t i) {
    return distance({curve.x[i - 1], curve.z[i - 1]}, {curve.x[i], curve.z[i]});
  };
  double whole = 0.0;
  for (std::size_t i = 1; i < curve.x.size(); ++i) whole += stretch(i);
  for (std::size_t i = 1; i < curve.x.size(); ++i) {
    if (stretch(i) > least_stretch * whole) continue;
    table.report("x",
                 "points " + std::to_string(i - 1) + " and " + std::to_string(i) + " are the same" +
                     (stretch(i) > 0.0 ? " to 9 digits of the curve's length" : ""),
                 "remove one of them");
  }
}

Curve read_curve(Cursor table, const std::optional<Ends>& ends) {
  Curve curve;
  if (read_table_of_points(table, curve.x, curve.z) && ends) check_curve(table, curve, *ends);
  table.finish();
  return curve;
}

void read_axis(Cursor& table, const std::optional<Ends>& ends, Member& member) {
  std::vector<std::string> given;
  for (const char* key : {"via", "sine", "curve"}) {
    if (table.find(key, Presence::optional) != nullptr) given.emplace_back(key);
  }
  if (given.size() > 1) {
    table.report(given[1], "a member has one axis, " + given[0] + " already gives it",
                 "keep one of via, sine and curve");
  }
  if (table.has("via")) member.axis = read_arc(table, ends);
  if (table.has("sine")) {
    if (auto sine = table.table("sine", Presence::optional)) member.axis = read_sine(*sine);
  }
  if (table.has("curve")) {
    if (auto curve = table.table("curve", Presence::optional)) member.axis = read_curve(*curve, ends);
  }
}

Imperfection read_imperfection(Cursor table) {
  Imperfection imperfection{.position = table.position()};
  ImperfectionWord shape{};
  table.word("shape", Presence::required, imperfection_words, shape);
  table.number("amplitude", Presence::required, any_number, imperfection.amplitude);
  table.integer("waves", Presence::required, {.low = 1}, imperfection.waves);
  table.finish();
  return imperfection;
}

void read_imperfections(Cursor& table, Member& member) {
  const Value* found = table.find("imperfection", Presence::optional);
  if (found == nullptr) return;
  if (found->kind == Value::Kind::array) {
    for (Cursor& one : table.tables("imperfection")) member.imperfections.push_back(read_imperfection(one));
  } else if (auto one = table.table("imperfection", Presence::optional)) {
    member.imperfections.push_back(read_imperfection(*one));
  }
}

void read_hinges(Cursor& table, Member& member) {
  std::vector<Reference> ends;
  table.references("hinge", Presence::optional, ends);
  for (const Reference& end : ends) {
    if (end.text == "from") {
      member.hinge_from = true;
    } else if (end.text == "to") {
      member.hinge_to = true;
    } else {
      table.report_unknown(end, table.path_of("hinge"), "is no end of a member", {"from", "to"});
    }
  }
}

Member read_member(Cursor& table, const Names& names, const Deck& deck) {
  Member member{.name = table.name(), .position = table.position(), .elements = 0};
  const std::optional<Ends> ends = read_ends(table, names, deck, member);
  read_theory(table, member);
  read_material_and_section(table, names, deck, member);
  table.integer("elements", Presence::required, {.low = 1, .high = most_elements}, member.elements);
  read_axis(table, ends, member);
  read_imperfections(table, member);
  read_hinges(table, member);
  table.finish();
  return member;
}

}  // namespace

void read_members(Cursor& root, const Names& names, Deck& deck) {
  for (Cursor& table : root.named_tables("member")) deck.members.push_back(read_member(table, names, deck));
  if (deck.members.empty() && names.members.empty()) {
    root.report("member", "there is no member", "add a table [member.NAME]");
  }
}

}  // namespace arcwall::deck
