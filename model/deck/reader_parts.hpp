#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/deck/cursor.hpp"
#include "model/deck/deck.hpp"

/// The parts of the reader: each reads and checks some tables of the root into the deck. Later parts look up what
/// earlier ones read, in the order below.
namespace arcwall::deck {

/// Every name the deck declares, also on tables with errors of their own, so that one error is not reported as two.
struct Names {
  std::vector<std::string> materials{};
  std::vector<std::string> sections{};
  std::vector<std::string> points{};
  std::vector<std::string> members{};
  std::vector<std::string> monitors{};
};

Names names_in(const Value& root);
bool contains(const std::vector<std::string>& names, std::string_view name);

void read_labels(Cursor& root, Deck& deck);
void read_materials(Cursor& root, Deck& deck);
void read_sections(Cursor& root, Deck& deck);
void read_points(Cursor& root, Deck& deck);
void read_members(Cursor& root, const Names& names, Deck& deck);
void read_supports(Cursor& root, const Names& names, Deck& deck);
void read_loads(Cursor& root, const Names& names, Deck& deck);
void read_walls(Cursor& root, const Names& names, Deck& deck);
void read_contact(Cursor& root, Deck& deck);
void read_monitors(Cursor& root, const Names& names, Deck& deck);
void read_path(Cursor& root, const Names& names, Deck& deck);

/// A key whose text must be one of `names`; `kind` says what is named ("a member").
bool read_name(Cursor& table, std::string_view key, const std::string& kind, const std::vector<std::string>& names,
               std::string& target);

/// A required key that names a point which ends a member, or "member:fraction" which is a node.
bool read_place(Cursor& table, std::string_view key, const Names& names, const Deck& deck, Place& target);

/// The keys x and z: two arrays of the same length, at least 2.
bool read_table_of_points(Cursor& table, std::vector<double>& x, std::vector<double>& z);

/// Marks `key` as known; if it is there, reports it with `message`.
void refuse(Cursor& table, std::string_view key, const std::string& message, const std::string& cure);

/// True if a member ends at that point, or if that cannot be told because a member has errors.
bool ends_a_member(const Deck& deck, const std::string& point);

/// The first of these members whose section has no height, or null.
const Member* member_without_faces(const Deck& deck, const std::vector<const Member*>& members);

}  // namespace arcwall::deck
