// Supports and loads.
#include <algorithm>
#include <string>
#include <vector>

#include "model/deck/reader_parts.hpp"

namespace arcwall::deck {

namespace {

Support read_support(Cursor& table, const Value& item, const Names& names, const Deck& deck) {
  Support support{.point = item.key, .position = item.key_position};
  const bool known = std::find(names.points.begin(), names.points.end(), item.key) != names.points.end();
  if (!known) {
    table.report_unknown({item.key, item.key_position}, table.path_of(item.key), "is not a point of this deck",
                         names.points);
  } else if (!ends_a_member(deck, item.key)) {
    table.findings().add(item.key_position, table.path_of(item.key), "no member ends at this point",
                         "support the end of a member");
  }
  std::vector<Reference> directions;
  table.references(item.key, Presence::required, directions);
  for (const Reference& direction : directions) {
    if (const auto found = from_text(direction_words, direction.text)) {
      support.directions.push_back(*found);
    } else {
      table.report_unknown(direction, table.path_of(item.key), "is no direction", texts(direction_words));
    }
  }
  return support;
}

PointLoad read_point_load(Cursor& table, const Names& names, const Deck& deck) {
  PointLoad load;
  read_place(table, "at", names, deck, load.at);
  table.vector("force", Presence::optional, load.force);
  table.number("moment", Presence::optional, any_number, load.moment);
  refuse(table, "distributed", "belongs to a load on a member", "write `on` instead of `at`");
  if (!table.has("force") && !table.has("moment")) {
    table.report("force", "the load has neither force nor moment", "give at least one of them");
  }
  return load;
}

MemberLoad read_member_load(Cursor& table, const Names& names) {
  MemberLoad load;
  read_name(table, "on", "a member", names.members, load.member);
  table.vector("distributed", Presence::required, load.distributed);
  for (const char* key : {"force", "moment"}) {
    refuse(table, key, "belongs to a load at a point", "write `at` instead of `on`, or give distributed");
  }
  return load;
}

Load read_load(Cursor& table, const Names& names, const Deck& deck) {
  Load load{.position = table.position()};
  table.flag("constant", Presence::optional, load.constant);
  const bool at = table.has("at");
  const bool on = table.has("on");
  if (at == on) {
    table.report(at ? "on" : "at", at ? "the load has both `at` and `on`" : "the load has neither `at` nor `on`",
                 "give `at` for a point or `on` for a member");
    return load;
  }
  if (at) {
    load.action = read_point_load(table, names, deck);
  } else {
    load.action = read_member_load(table, names);
  }
  table.finish();
  return load;
}

bool is_zero(const PointLoad& load) { return load.force == Vector{} && load.moment == 0.0; }
bool is_zero(const MemberLoad& load) { return load.distributed == Vector{}; }

bool follows_lambda(const Load& load) {
  return !load.constant && std::visit([](const auto& action) { return !is_zero(action); }, load.action);
}

}  // namespace

void read_supports(Cursor& root, const Names& names, Deck& deck) {
  auto table = root.table("support", Presence::optional);
  if (!table) return;
  for (const Value& item : table->value().items) deck.supports.push_back(read_support(*table, item, names, deck));
}

void read_loads(Cursor& root, const Names& names, Deck& deck) {
  const std::size_t findings_before = root.findings().count();
  for (Cursor& table : root.tables("load")) deck.loads.push_back(read_load(table, names, deck));
  if (root.findings().count() > findings_before) return;  // what a wrong load would have been cannot be told
  if (std::any_of(deck.loads.begin(), deck.loads.end(), follows_lambda)) return;
  if (deck.loads.empty()) return root.report("load", "there is no load", "add a [[load]] with at and force");
  root.report("load", "no load is multiplied by λ: all are constant or zero", "add a [[load]] that is neither");
}

}  // namespace arcwall::deck
