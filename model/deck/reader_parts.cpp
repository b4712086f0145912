#include "model/deck/reader_parts.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "core/text.hpp"

namespace arcwall::deck {

namespace {

std::vector<std::string> keys_of(const Value& root, std::string_view table) {
  std::vector<std::string> keys;
  const Value* found = find(root, table);
  if (found == nullptr || found->kind != Value::Kind::table) return keys;
  for (const Value& item : found->items) keys.push_back(item.key);
  return keys;
}

std::optional<double> number_from(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// The fraction must be one of 0, 1/n, 2/n, …, 1 with n the number of elements.
bool is_node(Cursor& table, std::string_view key, const Place& place, const Deck& deck) {
  constexpr double tolerance = 1e-9;  // of the member's length; a fraction written with nine digits is good enough
  const Member* member = find(deck.members, place.name);
  if (member == nullptr || member->elements < 1) return true;  // reported where the member is read
  const double n = member->elements;
  const double at = *place.fraction * n;
  if (std::abs(std::round(at) - at) <= tolerance * n) return true;
  const double below = std::floor(at);
  table.report(key, in_quotes(to_text(place)) + " is not a node: " + place.name + " has " + round_trip(n) + " elements",
               "the nearest are " + to_text({.name = place.name, .fraction = below / n}) + " and " +
                   to_text({.name = place.name, .fraction = (below + 1.0) / n}));
  return false;
}

bool read_point_place(Cursor& table, std::string_view key, const Reference& found, const Names& names, const Deck& deck,
                      Place& target) {
  if (!contains(names.points, found.text)) {
    std::vector<std::string> candidates = names.points;
    for (const std::string& member : names.members) candidates.push_back(member + ":0.5");
    table.report_unknown(found, table.path_of(key), "is neither a point nor member:fraction", candidates);
    return false;
  }
  if (!ends_a_member(deck, found.text)) {
    table.report(key, "no member ends at point " + found.text,
                 "name a point at the end of a member, or member:fraction");
    return false;
  }
  target = {.name = found.text, .position = found.position};
  return true;
}

}  // namespace

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Names names_in(const Value& root) {
  Names names{.materials = keys_of(root, "material"),
              .sections = keys_of(root, "section"),
              .points = keys_of(root, "point"),
              .members = keys_of(root, "member")};
  const Value* monitors = find(root, "monitor");
  if (monitors == nullptr) return names;
  for (const Value& monitor : monitors->items) {
    const Value* name = find(monitor, "name");
    if (name != nullptr && name->kind == Value::Kind::string) names.monitors.push_back(name->string);
  }
  return names;
}

bool read_name(Cursor& table, std::string_view key, const std::string& kind, const std::vector<std::string>& names,
               std::string& target) {
  Reference found;
  if (!table.reference(key, Presence::required, found)) return false;
  const bool known = contains(names, found.text);
  if (known) {
    target = found.text;
  } else {
    table.report_unknown(found, table.path_of(key), "is not " + kind + " of this deck", names);
  }
  return known;
}

bool read_place(Cursor& table, std::string_view key, const Names& names, const Deck& deck, Place& target) {
  Reference found;
  if (!table.reference(key, Presence::required, found)) return false;
  const std::size_t colon = found.text.find(':');
  if (colon == std::string::npos) return read_point_place(table, key, found, names, deck, target);

  const Place place{.name = found.text.substr(0, colon),
                    .fraction = number_from(found.text.substr(colon + 1)),
                    .position = found.position};
  if (!contains(names.members, place.name)) {
    table.report_unknown({place.name, found.position}, table.path_of(key), "is not a member of this deck",
                         names.members);
    return false;
  }
  if (!place.fraction || *place.fraction < 0.0 || *place.fraction > 1.0) {
    table.report(key, in_quotes(found.text, 60) + " has no fraction between 0 and 1",
                 "write it as in " + place.name + ":0.5");
    return false;
  }
  if (!is_node(table, key, place, deck)) return false;
  target = place;
  return true;
}

bool read_table_of_points(Cursor& table, std::vector<double>& x, std::vector<double>& z) {
  const bool has_x = table.numbers("x", Presence::required, x);
  const bool has_z = table.numbers("z", Presence::required, z);
  if (!has_x || !has_z) return false;
  const std::string counts = std::to_string(x.size()) + " x and " + std::to_string(z.size()) + " z";
  if (x.size() != z.size()) {
    table.report("z", counts + " do not go together", "give as many z as x");
  } else if (x.size() < 2) {
    table.report("x", counts + " make no curve", "give at least 2 points");
  } else {
    return true;
  }
  return false;
}

void refuse(Cursor& table, std::string_view key, const std::string& message, const std::string& cure) {
  if (table.find(key, Presence::optional) != nullptr) table.report(key, message, cure);
}

bool ends_a_member(const Deck& deck, const std::string& point) {
  return std::any_of(deck.members.begin(), deck.members.end(), [&point](const Member& member) {
    return member.from == point || member.to == point || member.from.empty() || member.to.empty();
  });
}

const Member* member_without_faces(const Deck& deck, const std::vector<const Member*>& members) {
  const auto has_no_faces = [&deck](const Member* member) {
    const Section* section = find(deck.sections, member->section);
    return section != nullptr && !properties(*section).height;
  };
  const auto found = std::find_if(members.begin(), members.end(), has_no_faces);
  return found == members.end() ? nullptr : *found;
}

}  // namespace arcwall::deck
