// Members: theory, stress-free axis, imperfections, hinges.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/text.hpp"
#include "model/deck/deck_keys.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

constexpr int most_elements = 10'000'000;

struct Ends {
  Vector from{};
  Vector to{};
};

double distance(const Vector& a, const Vector& b) { return std::hypot(b.x - a.x, b.z - a.z); }

std::string point_text(const Vector& at) { return "[" + round_trip(at.x) + ", " + round_trip(at.z) + "]"; }

bool is_shear_flexible(Theory theory) { return theory == Theory::essenburg || theory == Theory::reissner; }

// Of a deck with many members each would else look through all of its points.
using PointsByName = std::unordered_map<std::string_view, const Point*>;

// The ends' coordinates if both are known and apart.
std::optional<Ends> end_keys(Keys& keys, const PointsByName& points, Member& member) {
  const bool from = keys.name("from", member.from, Named::point, "a point");
  const bool to = keys.name("to", member.to, Named::point, "a point at another place");
  if (!from || !to) return std::nullopt;
  if (member.from == member.to) {
    keys.report("to", in_quotes(member.to) + " is also the point it comes from", "name another point");
    return std::nullopt;
  }
  const auto first = points.find(member.from), second = points.find(member.to);
  if (first == points.end() || second == points.end()) return std::nullopt;  // reported where the points are read
  const Point *a = first->second, *b = second->second;
  if (!(distance(a->at, b->at) > 0.0)) {
    keys.report("to", "points " + a->name + " and " + b->name + " are both at " + point_text(a->at),
                "move one of them: a member needs a length");
    return std::nullopt;
  }
  return Ends{a->at, b->at};
}

void order_key(Keys& keys, Member& member) {
  const std::string theory = text_of(theory_words, member.theory);
  const bool has_order = is_shear_flexible(member.theory) || member.theory == Theory::elastica;
  if (!keys.applies(has_order, "order", "theory " + theory + " has no order",
                    "remove it, or take essenburg, reissner or elastica"))
    return;
  const int low = is_shear_flexible(member.theory) ? 1 : 4;
  const int high = is_shear_flexible(member.theory) ? 2 : 6;
  if (keys.reads()) member.order = high;
  const bool right =
      keys.integer(optional("order", "2, 6"), member.order, {},
                   "of `\"reissner\"` and `\"essenburg\"`: 1 (linear) or 2 (quadratic); of `\"elastica\"`: 4 "
                   "or 6, the order of convergence");
  if (right && member.order != low && member.order != high)
    keys.report("order", std::to_string(*member.order) + " is no order of theory " + theory,
                "give " + std::to_string(low) + " or " + std::to_string(high));
}

void theory_keys(Keys& keys, Member& member) {
  const bool right =
      keys.word("theory", member.theory, theory_words,
                "`\"euler-bernoulli\"`: bends and extends; `\"elastica\"`: the same at higher order; `\"reissner\"`: "
                "flexible in shear; `\"essenburg\"`: flexible in shear and thickness; `\"truss\"`: axial force only");
  if (keys.reads() && !right) return keys.ignore({"order", "along", "strain"});
  order_key(keys, member);
  if (keys.applies(member.theory == Theory::essenburg, "along", "belongs to theory essenburg", "remove it"))
    keys.word(optional("along"), member.along, along_words,
              "of `\"essenburg\"`: `\"fixed\"` or `\"director\"`, see below");
  if (keys.applies(member.theory == Theory::truss, "strain", "belongs to theory truss", "remove it"))
    keys.word(optional("strain"), member.strain, strain_words, "trusses: `\"green\"`, `\"engineering\"` or `\"log\"`");
}

void material_and_section_keys(Keys& keys, const Deck& deck, Member& member) {
  const bool named = keys.name("material", member.material, Named::material, "a name");
  const Material* material = find(deck.materials, member.material);
  const bool has_nu = material == nullptr || material->nu.has_value();
  if (named && is_shear_flexible(member.theory) && !has_nu)
    keys.report(
        "material",
        "material " + member.material + " has no nu, which theory " + text_of(theory_words, member.theory) + " needs",
        "add nu to material." + member.material);
  keys.name("section", member.section, Named::section, "a name");
  const Section* section = find(deck.sections, member.section);
  if (section == nullptr) return;
  const bool has_no_shape =
      std::holds_alternative<General>(section->shape) || std::holds_alternative<SectionTable>(section->shape);
  if (member.theory == Theory::essenburg && has_no_shape)
    keys.report("section",
                "section " + member.section + " has no shape over whose height theory essenburg could integrate",
                "take a rectangle, a circle or a tube");
  else if (tapers(*section) && (member.theory == Theory::essenburg || member.theory == Theory::truss))
    keys.report("section",
                "section " + member.section + " tapers, and theory " + text_of(theory_words, member.theory) +
                    " has members of one section",
                member.theory == Theory::truss ? "take a section without …_to"
                                               : "take a section without …_to, or theory \"reissner\"");
}

void arc_keys(Keys& keys, Arc& arc, const std::optional<Ends>& ends) {
  constexpr double tolerance = 1e-12;  // of the chord: below, the radius is beyond the resolution of the coordinates
  const bool right = keys.vector(optional("via", "straight"), arc.via, unit::place,
                                 "the axis is the circular arc from `from` through this point to `to`");
  if (!right || !ends) return;
  const double chord = distance(ends->from, ends->to);
  const Vector c{(ends->to.x - ends->from.x) / chord, (ends->to.z - ends->from.z) / chord};
  const Vector v{arc.via.x - ends->from.x, arc.via.z - ends->from.z};
  if (arc.via == ends->from || arc.via == ends->to) {
    keys.report("via", point_text(arc.via) + " is an end of the member", "give a point between its ends");
  } else if (std::abs(c.x * v.z - c.z * v.x) <= tolerance * std::max(chord, distance(ends->from, arc.via))) {
    keys.report("via", point_text(arc.via) + " is on the straight line through the ends",
                "leave it out, or move it off the line");
  }
}

void check_curve(Keys& keys, const Curve& curve, const Ends& ends) {
  const double tolerance = 1e-9 * distance(ends.from, ends.to);
  const Vector first{curve.x.front(), curve.z.front()};
  const Vector last{curve.x.back(), curve.z.back()};
  if (distance(first, ends.from) > tolerance) {
    keys.report("x", "the first point " + point_text(first) + " is not where the member begins",
                "begin at " + point_text(ends.from));
  }
  if (distance(last, ends.to) > tolerance) {
    keys.report("x", "the last point " + point_text(last) + " is not where the member ends",
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
    return keys.report("x",
                       "points " + std::to_string(i - 1) + " and " + std::to_string(i) + " are the same" +
                           (stretch(i) > 0.0 ? " to 9 digits of the curve's length" : ""),
                       "remove one of them");
  }
}

void axis_keys(Keys& keys, const std::optional<Ends>& ends, Member& member) {
  std::vector<std::string> given;
  for (const char* key : {"via", "sine", "curve"})
    if (keys.has(key)) given.emplace_back(key);
  if (given.size() > 1)
    keys.report(given[1], "a member has one axis, " + given[0] + " already gives it",
                "keep one of via, sine and curve");
  keys.alternative<Arc>("via", member.axis, [&](Arc& arc) { arc_keys(keys, arc, ends); });
  keys.alternative<SineAxis>("sine", member.axis, [&](SineAxis& sine) {
    keys.table(
        optional("sine", "straight"), Form::in_line,
        [&](Keys& of) {
          of.number("rise", sine.rise, unit::length, any_number, "");
          of.integer("waves", sine.waves, {.low = 1}, "half waves");
        },
        "the axis is rise · sin(waves π s/length) over the chord; half waves");
  });
  keys.alternative<Curve>("curve", member.axis, [&](Curve& curve) {
    keys.table(
        optional("curve", "straight"), Form::dotted,
        [&](Keys& of) {
          if (curve_keys(of, curve.x, curve.z) && ends) check_curve(of, curve, *ends);
        },
        "the axis is the interpolating cubic spline over the chord length, with \"not a knot\" ends");
  });
}

void imperfection_keys(Keys& keys, Imperfection& imperfection) {
  ImperfectionWord shape{};
  keys.word("shape", shape, imperfection_words, "");
  keys.number("amplitude", imperfection.amplitude, unit::length, any_number, "");
  keys.integer("waves", imperfection.waves, {.low = 1}, "half waves");
}

// An array of tables, or one table alone.
void imperfections_key(Keys& keys, Member& member) {
  const Key key = optional("imperfection", "none");
  const char* meaning = "a table, or an array of tables that add up; `shape` is `\"sine\"`";
  if (keys.holds_array(key.name)) {
    keys.tables(key, member.imperfections, imperfection_keys, meaning);
    return;
  }
  keys.table(
      key, Form::only_element,
      [&](Keys& one) {
        Imperfection imperfection{.position = one.position()};
        imperfection_keys(one, imperfection);
        member.imperfections.push_back(imperfection);
      },
      meaning);
}

void hinge_key(Keys& keys, Member& member) {
  enum class End { from, to };
  constexpr Words<End, 2> end_words{{{"from", End::from}, {"to", End::to}}};
  std::vector<End> ends;
  if (member.hinge_from) ends.push_back(End::from);
  if (member.hinge_to) ends.push_back(End::to);
  keys.words(optional("hinge", "none"), ends, end_words, "is no end of a member",
             "`[\"from\"]`, `[\"to\"]` or both: ends without moment");
  member.hinge_from = std::find(ends.begin(), ends.end(), End::from) != ends.end();
  member.hinge_to = std::find(ends.begin(), ends.end(), End::to) != ends.end();
}

void member_keys(Keys& keys, Member& member, const Deck& deck, const PointsByName& points) {
  if (keys.reads()) member.elements = 0;  // until they are read: no place is a node of the mesh before
  const std::optional<Ends> ends = end_keys(keys, points, member);
  theory_keys(keys, member);
  material_and_section_keys(keys, deck, member);
  keys.integer("elements", member.elements, {.low = 1, .high = most_elements},
               "number of elements, ≥ 1; a truss has 1, since more would be a chain of hinges");
  axis_keys(keys, ends, member);
  hinge_key(keys, member);
  imperfections_key(keys, member);
}

}  // namespace

bool curve_keys(Keys& keys, std::vector<double>& x, std::vector<double>& z) {
  const bool has_x = keys.numbers("x", x, unit::place_x, "");
  const bool has_z = keys.numbers("z", z, unit::place_z, "as many");
  if (!has_x || !has_z) return false;
  const std::string counts = std::to_string(x.size()) + " x and " + std::to_string(z.size()) + " z";
  if (x.size() != z.size()) {
    keys.report("z", counts + " do not go together", "give as many z as x");
  } else if (x.size() < 2) {
    keys.report("x", counts + " make no curve", "give at least 2 points");
  } else {
    return true;
  }
  return false;
}

const Member* member_without_faces(const Deck& deck, const std::vector<const Member*>& members) {
  const auto has_no_faces = [&deck](const Member* member) {
    const Section* section = find(deck.sections, member->section);
    return section != nullptr && !has_faces(*section);
  };
  const auto found = std::find_if(members.begin(), members.end(), has_no_faces);
  return found == members.end() ? nullptr : *found;
}

void declare_members(Keys& root, Deck& deck) {
  PointsByName points;
  for (const Point& point : deck.points) points.emplace(point.name, &point);
  const auto keys_of_member = [&](Keys& keys, Member& member) { member_keys(keys, member, deck, points); };
  const bool all_right = root.named_tables(optional("member"), deck.members, keys_of_member, "");
  if (all_right && deck.members.empty()) root.report("member", "there is no member", "add a table [member.NAME]");
}

}  // namespace arcwall::deck
