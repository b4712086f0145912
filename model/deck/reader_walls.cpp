// Walls and the treatment of contact.
#include <algorithm>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "model/deck/reader_parts.hpp"

namespace arcwall::deck {

namespace {

FlatProfile read_flat(Cursor& table) {
  FlatProfile profile;
  table.number("z", Presence::required, any_number, profile.z);
  return profile;
}

LineProfile read_line(Cursor& table) {
  LineProfile profile;
  table.number("z", Presence::required, any_number, profile.z);
  table.number("slope", Presence::required, any_number, profile.slope);
  return profile;
}

CircleProfile read_circle_profile(Cursor& table) {
  CircleProfile profile;
  table.vector("centre", Presence::required, profile.centre);
  table.number("radius", Presence::required, positive, profile.radius);
  return profile;
}

ParabolaProfile read_parabola(Cursor& table) {
  ParabolaProfile profile;
  table.vector("apex", Presence::required, profile.apex);
  table.number("curvature", Presence::required, any_number, profile.curvature);
  return profile;
}

SplineProfile read_spline(Cursor& table) {
  SplineProfile profile;
  if (!read_table_of_points(table, profile.x, profile.z)) return profile;
  for (std::size_t i = 1; i < profile.x.size(); ++i) {
    if (profile.x[i] > profile.x[i - 1]) continue;
    table.report("x", round_trip(profile.x[i]) + " follows " + round_trip(profile.x[i - 1]),
                 "give x in increasing order");
    return profile;
  }
  // Between such points slopes are quotients of what is lost in the digits of the whole.
  constexpr double least_step = 1e-9;
  for (std::size_t i = 1; i < profile.x.size(); ++i) {
    if (profile.x[i] - profile.x[i - 1] > least_step * (profile.x.back() - profile.x.front())) continue;
    table.report("x",
                 round_trip(profile.x[i]) + " and " + round_trip(profile.x[i - 1]) +
                     " are the same to 9 digits of the wall's length",
                 "remove one of them");
    break;
  }
  return profile;
}

void read_profile(Cursor table, Wall& wall) {
  ProfileWord type{};
  if (!table.word("type", Presence::required, profile_words, type)) return;
  switch (type) {
    case ProfileWord::flat:
      wall.profile = read_flat(table);
      break;
    case ProfileWord::line:
      wall.profile = read_line(table);
      break;
    case ProfileWord::circle:
      wall.profile = read_circle_profile(table);
      break;
    case ProfileWord::parabola:
      wall.profile = read_parabola(table);
      break;
    case ProfileWord::spline:
      wall.profile = read_spline(table);
      break;
  }
  table.finish();
}

void read_wall_name(Cursor& table, const Deck& deck, Wall& wall) {
  if (!table.text("name", Presence::required, wall.name)) return;
  if (!is_name(wall.name)) {
    table.report("name", in_quotes(wall.name, 60) + " is no name", "use letters, digits, _ and - only");
  } else if (find(deck.walls, wall.name) != nullptr) {
    table.report("name", in_quotes(wall.name) + " is the name of another wall", "give each wall its own");
  }
}

void read_wall_members(Cursor& table, const Names& names, Wall& wall) {
  std::vector<Reference> members;
  table.references("members", Presence::optional, members);
  for (const Reference& member : members) {
    if (std::find(names.members.begin(), names.members.end(), member.text) != names.members.end()) {
      wall.members.push_back(member.text);
    } else {
      table.report_unknown(member, table.path_of("members"), "is not a member of this deck", names.members);
    }
  }
}

void check_faces(Cursor& table, const Deck& deck, const Wall& wall) {
  std::vector<const Member*> members;
  for (const Member& member : deck.members) {
    const bool named = std::find(wall.members.begin(), wall.members.end(), member.name) != wall.members.end();
    if (wall.members.empty() || named) members.push_back(&member);
  }
  const Member* without = member_without_faces(deck, members);
  if (wall.acts_on == ActsOn::axis || without == nullptr) return;
  table.report(
      "acts_on",
      "the wall acts on faces, but section " + without->section + " of member " + without->name + " has no height",
      "give the section a height, or write acts_on = \"axis\"");
}

Wall read_wall(Cursor& table, const Names& names, const Deck& deck) {
  Wall wall{.position = table.position()};
  read_wall_name(table, deck, wall);
  table.word("side", Presence::required, side_words, wall.side);
  table.word("acts_on", Presence::optional, acts_on_words, wall.acts_on);
  read_wall_members(table, names, wall);
  if (auto profile = table.table("profile", Presence::required)) read_profile(*profile, wall);
  check_faces(table, deck, wall);
  table.finish();
  return wall;
}

}  // namespace

void read_walls(Cursor& root, const Names& names, Deck& deck) {
  for (Cursor& table : root.tables("wall")) deck.walls.push_back(read_wall(table, names, deck));
}

void read_contact(Cursor& root, Deck& deck) {
  auto table = root.table("contact", Presence::optional);
  if (!table) return;
  Contact& contact = deck.contact;
  table->word("method", Presence::optional, contact_method_words, contact.method);
  ContactPoints points{};
  if (table->word("points", Presence::optional, contact_points_words, points)) contact.points = points;
  table->number("penalty", Presence::optional, positive, contact.penalty);
  table->number("gap_tolerance", Presence::optional, positive, contact.gap_tolerance);
  if (contact.method != ContactMethod::multiplier && !table->has("penalty")) {
    table->report("penalty", "is missing: method " + text_of(contact_method_words, contact.method) + " needs it",
                  "add penalty, a number greater than 0");
  }
  table->finish();
}

}  // namespace arcwall::deck
