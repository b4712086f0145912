// Labels, variables, materials, sections and points: what refers to nothing else.
#include <algorithm>
#include <functional>

#include "core/text.hpp"
#include "model/deck/deck_keys.hpp"
#include "model/deck/formula.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

constexpr Requirement poisson_ratio{[](double v) { return v > -1.0 && v < 0.5; },
                                    "a number greater than -1 and less than 0.5"};

void unit_keys(Keys& keys, Units& units) {
  keys.text("length", units.length, "a label, e.g. `\"cm\"`");
  keys.text("force", units.force, "a label, e.g. `\"kN\"`");
}

// Names that formulas can have and that `--set` takes for nothing else.
bool variable_key(Keys& keys, const Key& key, Variable& variable) {
  const std::string name(key.name);
  const std::vector<std::string>& words = words_of_formulas();
  const auto is_part = [&](const DeclaredKey& declared) { return declared.table.empty() && declared.name == name; };
  if (keys.reads() && !is_formula_name(name))
    keys.report_key(key, "is no name of a variable", "begin with a letter; then use letters, digits and _ only");
  else if (keys.reads() && std::find(words.begin(), words.end(), name) != words.end())
    keys.report_key(key, "has another meaning in formulas", "give the variable another name");
  else if (keys.reads() && std::any_of(declared_keys().begin(), declared_keys().end(), is_part))
    keys.report_key(key, "is the name of a part of the deck", "give the variable another name");
  return keys.number(key, variable.value, unit::none, any_number, "number, or formula in quotes");
}

void material_keys(Keys& keys, Material& material) {
  keys.number("E", material.E, unit::stress, positive, "Young's modulus, > 0");
  keys.number(
      optional("nu", "none"), material.nu, unit::none, poisson_ratio,
      "Poisson's ratio, in (−1, ½); needed by the theories `\"reissner\"` and `\"essenburg\"`: G = E/(2(1 + ν))");
  keys.number(optional("expansion", "none"), material.expansion, unit::none, any_number,
              "thermal expansion, strain per degree; needed for a temperature");
  keys.number(optional("allowable", "none"), material.allowable, unit::stress, positive,
              "allowable stress; needed by the monitor `utilisation`");
}

// A size at the end of a member.
bool size_to(Keys& keys, const char* key, std::optional<double>& size) {
  return keys.number(optional(key), size, unit::length, positive, "at the member's end");
}

void tube_keys(Keys& keys, Tube& tube) {
  const bool radius = keys.number("radius", tube.radius, unit::length, positive, "outer");
  const bool thickness = keys.number("thickness", tube.thickness, unit::length, positive, "at most the radius");
  size_to(keys, "radius_to", tube.radius_to);
  size_to(keys, "thickness_to", tube.thickness_to);
  if (!radius || !thickness) return;
  const double outer = tube.radius_to.value_or(tube.radius), wall = tube.thickness_to.value_or(tube.thickness);
  const auto is_more = [](double a, double b) {
    return round_trip(a) + " is more than the outer radius " + round_trip(b);
  };
  if (tube.thickness > tube.radius)
    keys.report("thickness", is_more(tube.thickness, tube.radius), "give at most the outer radius");
  else if (wall > outer)
    keys.report(tube.thickness_to ? "thickness_to" : "radius_to", is_more(wall, outer) + " at the member's end",
                "give at most the outer radius there");
}

// The values of a table, which are as many as its places.
void column_key(Keys& keys, const Key& key, std::vector<double>& values, const Dimension& unit,
                std::optional<std::size_t> count, std::string_view meaning) {
  if (!keys.numbers(key, values, unit, meaning) || !count) return;
  if (values.size() != *count)
    keys.report(key.name,
                std::to_string(values.size()) + " values and " + std::to_string(*count) + " places do not go together",
                "give one value for each place in at");
  else if (std::any_of(values.begin(), values.end(), [](double value) { return !(value > 0.0); }))
    keys.report(key.name, "a value is not greater than 0", "give values greater than 0");
}

void table_keys(Keys& keys, SectionTable& table) {
  const bool right = keys.numbers("at", table.at, unit::none, "fractions of the member's length, from 0 to 1");
  const bool ascends = std::adjacent_find(table.at.begin(), table.at.end(), std::greater_equal<>()) == table.at.end();
  if (right && (table.at.size() < 2 || table.at.front() != 0.0 || table.at.back() != 1.0 || !ascends))
    keys.report("at", "the places do not ascend from 0 to 1", "give places such as [0.0, 0.5, 1.0]");
  const auto count = right ? std::optional(table.at.size()) : std::nullopt;
  column_key(keys, "A", table.A, unit::area, count, "as many");
  column_key(keys, "I", table.I, unit::second_moment, count, "as many");
  column_key(keys, optional("shear_area"), table.shear_area, unit::area, count, "");
  column_key(keys, optional("height"), table.height, unit::length, count, "");
}

void section_keys(Keys& keys, Section& section) {
  const Option<Rectangle> rectangle{"rectangle", "", [&](Rectangle& shape) {
                                      keys.number("width", shape.width, unit::length, positive, "out of plane");
                                      keys.number("height", shape.height, unit::length, positive,
                                                  "depth in the plane of bending");
                                      size_to(keys, "width_to", shape.width_to);
                                      size_to(keys, "height_to", shape.height_to);
                                    }};
  const Option<Circle> circle{"circle", "", [&](Circle& shape) {
                                keys.number("radius", shape.radius, unit::length, positive, "");
                                size_to(keys, "radius_to", shape.radius_to);
                              }};
  const Option<Tube> tube{"tube", "", [&](Tube& shape) { tube_keys(keys, shape); }};
  const Option<General> general{
      "general", "", [&](General& shape) {
        keys.number("A", shape.A, unit::area, positive, "area");
        keys.number("I", shape.I, unit::second_moment, positive, "second moment of area for bending in the plane");
        keys.number(optional("shear_area"), shape.shear_area, unit::area, positive, "");
        keys.number(optional("height"), shape.height, unit::length, positive, "between the faces");
      }};
  const Option<SectionTable> table{"table", "", [&](SectionTable& shape) { table_keys(keys, shape); }};
  keys.one_of("shape", section.shape, "one of the following", rectangle, circle, tube, general, table);
  keys.number(optional("shear_correction", "by theory"), section.shear_correction, unit::none, positive,
              "factor on the shear stiffness");
}

bool point_key(Keys& keys, const Key& key, Point& point) {
  if (!is_name(key.name)) keys.report_key(key, "is no name", "use letters, digits, _ and - only");
  return keys.vector(key, point.at, unit::place, "`[x, z]`");
}

}  // namespace

void declare_sections(Keys& root, Deck& deck) {
  root.text("title", deck.title, "text");
  root.text(optional("description"), deck.description, "text");
  root.table(
      optional("units"), Form::header, [&](Keys& keys) { unit_keys(keys, deck.units); }, "labels of outputs");
  if (!root.writes() || !deck.variables.empty())
    root.table(
        optional("variables"), Form::header,
        [&](Keys& keys) {
          keys.entries(deck.variables, &Variable::name,
                       [&](const Key& key, Variable& variable) { return variable_key(keys, key, variable); });
        },
        "");
  root.named_tables(optional("material"), deck.materials, material_keys, "");
  root.named_tables(optional("section"), deck.sections, section_keys, "");
  root.table(
      "point", Form::header,
      [&](Keys& keys) {
        keys.entries(deck.points, &Point::name,
                     [&](const Key& key, Point& point) { return point_key(keys, key, point); });
      },
      "");
}

}  // namespace arcwall::deck
