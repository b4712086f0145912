#pragma once

#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "model/deck/cursor.hpp"
#include "model/deck/keys.hpp"

namespace arcwall::deck {

/// Names in the deck's order.
class NameList {
 public:
  NameList() = default;
  explicit NameList(std::vector<std::string> names) : names_(std::move(names)), set_(names_.begin(), names_.end()) {}

  bool contains(const std::string& name) const { return set_.contains(name); }
  const std::vector<std::string>& all() const { return names_; }

 private:
  std::vector<std::string> names_{};
  std::unordered_set<std::string> set_{};
};

/// Every name the deck declares, also on tables with errors of their own, so that one error is not reported as two.
struct Names {
  NameList materials{}, sections{}, points{}, members{}, walls{}, springs{}, monitors{};
  NameList columns{};  ///< the monitors and lambda
};

Names names_in(const Value& root);

/// Reads the declared keys of a table, and reports what is wrong with them.
class KeyReader final : public Keys {
 public:
  /// All must outlive this; `deck` is what was read so far.
  KeyReader(Cursor& table, const Names& names, const Deck& deck) : table_(table), names_(names), deck_(deck) {}

  bool table(const Key& key, Form form, const std::function<void(Keys&)>& keys_of_table,
             std::string_view meaning) override;
  bool applies(bool condition, const char* key, const std::string& message, const std::string& cure) override;
  bool reads() const override { return true; }
  bool has(std::string_view key) const override { return table_.has(key); }
  bool holds_array(std::string_view key) const override;
  bool holds_table(std::string_view key) const override;
  Position position() const override { return table_.position(); }
  void report(std::string_view key, const std::string& message, const std::string& cure) override;
  void report_key(const Key& key, const std::string& message, const std::string& cure) override;
  bool refers(const Key& key, Named of) override;
  void ignore(std::initializer_list<std::string_view> keys) override;
  void give_up() override { is_complete_ = false; }

  /// Reports the keys that were not declared.
  void finish();

 protected:
  bool declare(const Key& key, const Target& target, const Declared& declared) override;
  bool each_table(const Key& key, ListForm form, const std::vector<std::string>& names, const UseTable& use,
                  std::string_view meaning) override;
  void each_entry(const std::vector<std::string>& names, const std::vector<std::string_view>& without,
                  const UseKey& use) override;
  void when_chosen(std::string_view key, bool has_it, const DeclareKeys& keys) override;

 private:
  bool is_one_of(const Reference& found, const std::string& path, Named of);
  bool name(const Key& key, Named of, std::string& value);
  bool list(const Key& key, const Declared& declared, std::vector<std::string>& values);
  bool word(const Key& key, const std::vector<std::string>& words, std::optional<std::string>& value);
  bool place(const Key& key, Place& value);
  bool point(std::string_view key, const Reference& found, Place& value);
  bool is_node(std::string_view key, const Place& at);

  Cursor& table_;
  const Names& names_;
  const Deck& deck_;
  bool is_complete_ = true;  // what is not declared is no key of the table
};

/// True if a member ends at that point, or if that cannot be told because a member has errors.
bool ends_a_member(const Deck& deck, const std::string& point);

}  // namespace arcwall::deck
