// Labels, materials, sections and points: what refers to nothing else.
#include <string>

#include "core/text.hpp"
#include "model/deck/reader_parts.hpp"

namespace arcwall::deck {

namespace {

constexpr Requirement poisson_ratio{[](double v) { return v > -1.0 && v < 0.5; },
                                    "a number greater than -1 and less than 0.5"};

Rectangle read_rectangle(Cursor& table) {
  Rectangle shape;
  table.number("width", Presence::required, positive, shape.width);
  table.number("height", Presence::required, positive, shape.height);
  return shape;
}

Circle read_circle(Cursor& table) {
  Circle shape;
  table.number("radius", Presence::required, positive, shape.radius);
  return shape;
}

Tube read_tube(Cursor& table) {
  Tube shape;
  const bool radius = table.number("radius", Presence::required, positive, shape.radius);
  const bool thickness = table.number("thickness", Presence::required, positive, shape.thickness);
  if (radius && thickness && shape.thickness > shape.radius) {
    table.report("thickness",
                 round_trip(shape.thickness) + " is more than the outer radius " + round_trip(shape.radius),
                 "give at most the outer radius");
  }
  return shape;
}

General read_general(Cursor& table) {
  General shape;
  table.number("A", Presence::required, positive, shape.A);
  table.number("I", Presence::required, positive, shape.I);
  table.number("shear_area", Presence::optional, positive, shape.shear_area);
  table.number("height", Presence::optional, positive, shape.height);
  return shape;
}

Section read_section(Cursor& table) {
  Section section{.name = table.name(), .position = table.position()};
  table.number("shear_correction", Presence::optional, positive, section.shear_correction);
  ShapeWord shape{};
  if (!table.word("shape", Presence::required, shape_words, shape)) return section;
  switch (shape) {
    case ShapeWord::rectangle:
      section.shape = read_rectangle(table);
      break;
    case ShapeWord::circle:
      section.shape = read_circle(table);
      break;
    case ShapeWord::tube:
      section.shape = read_tube(table);
      break;
    case ShapeWord::general:
      section.shape = read_general(table);
      break;
  }
  table.finish();
  return section;
}

}  // namespace

void read_labels(Cursor& root, Deck& deck) {
  root.text("title", Presence::required, deck.title);
  root.text("description", Presence::optional, deck.description);
  if (auto units = root.table("units", Presence::optional)) {
    units->text("length", Presence::required, deck.units.length);
    units->text("force", Presence::required, deck.units.force);
    units->finish();
  }
}

void read_materials(Cursor& root, Deck& deck) {
  for (Cursor& table : root.named_tables("material")) {
    Material material{.name = table.name(), .position = table.position()};
    table.number("E", Presence::required, positive, material.E);
    table.number("nu", Presence::optional, poisson_ratio, material.nu);
    table.finish();
    deck.materials.push_back(material);
  }
}

void read_sections(Cursor& root, Deck& deck) {
  for (Cursor& table : root.named_tables("section")) deck.sections.push_back(read_section(table));
}

void read_points(Cursor& root, Deck& deck) {
  auto table = root.table("point", Presence::required);
  if (!table) return;
  for (const Value& item : table->value().items) {
    if (!is_name(item.key)) {
      table->findings().add(item.key_position, table->path_of(item.key), "is no name",
                            "use letters, digits, _ and - only");
    }
    Point point{.name = item.key, .position = item.key_position};
    if (table->vector(item.key, Presence::required, point.at)) deck.points.push_back(point);
  }
}

}  // namespace arcwall::deck
