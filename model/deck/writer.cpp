#include "model/deck/writer.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/text.hpp"
#include "model/deck/value.hpp"
#include "model/deck/words.hpp"

namespace arcwall::deck {

namespace {

// With a point or an exponent, so that TOML takes it for a float.
std::string number(double value) {
  std::string text = round_trip(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

// The names of a deck are keys as they are, but a writer does not rely on what a reader has checked.
std::string name(const std::string& text) { return is_name(text) ? text : in_quotes(text); }

std::string vector(const Vector& v) { return "[" + number(v.x) + ", " + number(v.z) + "]"; }

// A few on a line: lines stay short however long the list is.
template <class List, class ToText>
std::string array(const List& list, ToText to_text) {
  constexpr std::size_t most_on_a_line = 8;
  std::string text = "[";
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) text += i % most_on_a_line == 0 ? ",\n  " : ", ";
    text += to_text(list[i]);
  }
  return text + "]";
}

std::string numbers(const std::vector<double>& values) { return array(values, number); }

std::string strings(const std::vector<std::string>& values) {
  return array(values, [](const std::string& value) { return in_quotes(value); });
}

// Builds the document line by line.
class Document {
 public:
  void table(const std::string& key) { text_ += "\n[" + key + "]\n"; }
  void table_of_array(const std::string& key) { text_ += "\n[[" + key + "]]\n"; }
  void comment(const std::string& text) { text_ += "# " + text + "\n"; }
  void set(std::string_view key, const std::string& value) { text_ += std::string(key) + " = " + value + "\n"; }
  void set(std::string_view key, double value) { set(key, number(value)); }
  void set(std::string_view key, const std::optional<double>& value) {
    if (value) set(key, *value);
  }
  void set_text(std::string_view key, const std::string& value) { set(key, in_quotes(value)); }
  void set_integer(std::string_view key, int value) { set(key, std::to_string(value)); }

  template <class Enum, std::size_t count>
  void set_word(std::string_view key, const Words<Enum, count>& words, Enum value) {
    set_text(key, text_of(words, value));
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_{};
};

void write_shape(Document& out, const Rectangle& shape) {
  out.set_word("shape", shape_words, ShapeWord::rectangle);
  out.set("width", shape.width);
  out.set("height", shape.height);
}

void write_shape(Document& out, const Circle& shape) {
  out.set_word("shape", shape_words, ShapeWord::circle);
  out.set("radius", shape.radius);
}

void write_shape(Document& out, const Tube& shape) {
  out.set_word("shape", shape_words, ShapeWord::tube);
  out.set("radius", shape.radius);
  out.set("thickness", shape.thickness);
}

void write_shape(Document& out, const General& shape) {
  out.set_word("shape", shape_words, ShapeWord::general);
  out.set("A", shape.A);
  out.set("I", shape.I);
  out.set("shear_area", shape.shear_area);
  out.set("height", shape.height);
}

void write_labels(Document& out, const Deck& deck) {
  out.set_text("title", deck.title);
  out.set_text("description", deck.description);
  out.table("units");
  out.set_text("length", deck.units.length);
  out.set_text("force", deck.units.force);
}

void write_materials_sections_points(Document& out, const Deck& deck) {
  for (const Material& material : deck.materials) {
    out.table("material." + name(material.name));
    out.set("E", material.E);
    out.set("nu", material.nu);
  }
  for (const Section& section : deck.sections) {
    out.table("section." + name(section.name));
    std::visit([&out](const auto& shape) { write_shape(out, shape); }, section.shape);
    out.set("shear_correction", section.shear_correction);
  }
  out.table("point");
  for (const Point& point : deck.points) out.set(name(point.name), vector(point.at));
}

void write_axis(Document&, const Straight&) {}

void write_axis(Document& out, const Arc& arc) { out.set("via", vector(arc.via)); }

void write_axis(Document& out, const SineAxis& sine) {
  out.set("sine", "{ rise = " + number(sine.rise) + ", waves = " + std::to_string(sine.waves) + " }");
}

void write_axis(Document& out, const Curve& curve) {
  out.set("curve.x", numbers(curve.x));
  out.set("curve.z", numbers(curve.z));
}

void write_imperfections(Document& out, const Member& member) {
  for (const Imperfection& imperfection : member.imperfections) {
    out.table_of_array("member." + name(member.name) + ".imperfection");
    out.set_word("shape", imperfection_words, ImperfectionWord::sine);
    out.set("amplitude", imperfection.amplitude);
    out.set_integer("waves", imperfection.waves);
  }
}

void write_member(Document& out, const Member& member) {
  out.table("member." + name(member.name));
  out.set_text("from", member.from);
  out.set_text("to", member.to);
  out.set_word("theory", theory_words, member.theory);
  if (member.order) out.set_integer("order", *member.order);
  if (member.theory == Theory::essenburg) out.set_word("along", along_words, member.along);
  if (member.theory == Theory::truss) out.set_word("strain", strain_words, member.strain);
  out.set_text("material", member.material);
  out.set_text("section", member.section);
  out.set_integer("elements", member.elements);
  std::visit([&out](const auto& axis) { write_axis(out, axis); }, member.axis);
  std::vector<std::string> hinges;
  if (member.hinge_from) hinges.emplace_back("from");
  if (member.hinge_to) hinges.emplace_back("to");
  if (!hinges.empty()) out.set("hinge", strings(hinges));
  write_imperfections(out, member);
}

void write_supports(Document& out, const Deck& deck) {
  out.table("support");
  for (const Support& support : deck.supports) {
    std::vector<std::string> directions;
    for (const Direction direction : support.directions) directions.push_back(text_of(direction_words, direction));
    out.set(name(support.point), strings(directions));
  }
}

void write_action(Document& out, const PointLoad& load) {
  out.set_text("at", to_text(load.at));
  out.set("force", vector(load.force));
  out.set("moment", load.moment);
}

void write_action(Document& out, const MemberLoad& load) {
  out.set_text("on", load.member);
  out.set("distributed", vector(load.distributed));
}

void write_loads(Document& out, const Deck& deck) {
  for (const Load& load : deck.loads) {
    out.table_of_array("load");
    std::visit([&out](const auto& action) { write_action(out, action); }, load.action);
    out.set("constant", load.constant ? "true" : "false");
  }
}

void write_profile(Document& out, const FlatProfile& profile) {
  out.set_word("profile.type", profile_words, ProfileWord::flat);
  out.set("profile.z", profile.z);
}

void write_profile(Document& out, const LineProfile& profile) {
  out.set_word("profile.type", profile_words, ProfileWord::line);
  out.set("profile.z", profile.z);
  out.set("profile.slope", profile.slope);
}

void write_profile(Document& out, const CircleProfile& profile) {
  out.set_word("profile.type", profile_words, ProfileWord::circle);
  out.set("profile.centre", vector(profile.centre));
  out.set("profile.radius", profile.radius);
}

void write_profile(Document& out, const ParabolaProfile& profile) {
  out.set_word("profile.type", profile_words, ProfileWord::parabola);
  out.set("profile.apex", vector(profile.apex));
  out.set("profile.curvature", profile.curvature);
}

void write_profile(Document& out, const SplineProfile& profile) {
  out.set_word("profile.type", profile_words, ProfileWord::spline);
  out.set("profile.x", numbers(profile.x));
  out.set("profile.z", numbers(profile.z));
}

void write_walls(Document& out, const Deck& deck) {
  for (const Wall& wall : deck.walls) {
    out.table_of_array("wall");
    out.set_text("name", wall.name);
    out.set_word("side", side_words, wall.side);
    out.set_word("acts_on", acts_on_words, wall.acts_on);
    if (!wall.members.empty()) out.set("members", strings(wall.members));
    std::visit([&out](const auto& profile) { write_profile(out, profile); }, wall.profile);
  }
}

// A default that depends on other keys is a comment: who reads the deck sees it, and it goes with the keys.
void write_contact(Document& out, const Deck& deck) {
  const Contact& contact = deck.contact;
  out.table("contact");
  out.set_word("method", contact_method_words, contact.method);
  if (contact.points) {
    out.set_word("points", contact_points_words, *contact.points);
  } else if (!deck.walls.empty()) {
    const PointsOfContact chosen = points_of_contact(deck);
    out.comment("points = " + in_quotes(text_of(contact_points_words, chosen.points)) + ": " + chosen.why);
  }
  out.set("penalty", contact.penalty);
  out.set("gap_tolerance", contact.gap_tolerance);
}

void write_path(Document& out, const Path& path) {
  out.table("path");
  out.set_word("method", path_method_words, path.method);
  for (const Landing& landing : path.land) out.set("land." + name(landing.name), numbers(landing.values));
  if (path.control) {
    out.set_text("control.at", to_text(path.control->at));
    out.set_word("control.component", component_words, path.control->component);
  }
  out.set("step", path.step);
  out.set("min_step", path.min_step);
  out.set("max_step", path.max_step);
  out.set_integer("max_points", path.max_points);
  out.set_word("branches", branches_words, path.branches);
  out.set_integer("depth", path.depth);
  out.set("watch", strings(path.watch));
  out.set_word("events", events_words, path.events);
  out.table("path.stop");
  for (const StopBounds& bounds : path.stop.bounds) {
    out.set(name(bounds.name), "[" + number(bounds.low) + ", " + number(bounds.high) + "]");
  }
  if (path.stop.contacts) out.set_integer("contacts", *path.stop.contacts);
  if (!path.stop.events.empty())
    out.set("event",
            array(path.stop.events, [](StopEvent event) { return in_quotes(text_of(stop_event_words, event)); }));
}

void write_monitors(Document& out, const Deck& deck) {
  for (const Monitor& monitor : deck.monitors) {
    out.table_of_array("monitor");
    out.set_text("name", monitor.name);
    out.set_text("at", to_text(monitor.at));
    out.set_word("component", component_words, monitor.component);
    out.set_integer("sign", monitor.sign);
  }
}

}  // namespace

std::string to_toml(const Deck& deck) {
  Document out;
  write_labels(out, deck);
  write_materials_sections_points(out, deck);
  for (const Member& member : deck.members) write_member(out, member);
  write_supports(out, deck);
  write_loads(out, deck);
  write_walls(out, deck);
  write_contact(out, deck);
  write_path(out, deck.path);
  write_monitors(out, deck);
  return out.text();
}

}  // namespace arcwall::deck
