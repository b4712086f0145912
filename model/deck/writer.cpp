#include "model/deck/writer.hpp"

#include <string>
#include <utility>

#include "model/deck/deck_keys.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

// A key as TOML has it. The names of a deck need no quotes, but a writer does not rely on what a reader has checked.
std::string written(std::string_view key) { return is_name(key) ? std::string(key) : in_quotes(key); }

// Writes the declared keys of a table behind a text. `before_keys` stands before each key of a dotted table, as the
// `profile.` of `profile.type`. With `only` no other key of the table is written.
class KeyWriter final : public Keys {
 public:
  KeyWriter(std::string& text, std::string path, std::string before_keys = {}, std::string_view only = {})
      : text_(text), path_(std::move(path)), before_keys_(std::move(before_keys)), only_(only) {}

  bool table(const Key& key, Form form, const std::function<void(Keys&)>& keys_of_table, std::string_view) override {
    if (!is_asked(key)) return false;
    switch (form) {
      case Form::header:
        write_table("[" + path_of(key) + "]", path_of(key), keys_of_table);
        break;
      case Form::dotted: {
        KeyWriter writer(text_, path_, before_keys_ + std::string(key.name) + ".");
        keys_of_table(writer);
        break;
      }
      case Form::in_line: {
        std::string lines;
        KeyWriter writer(lines, {});
        keys_of_table(writer);
        for (std::size_t end = lines.find('\n'); end + 1 < lines.size(); end = lines.find('\n', end + 2))
          lines.replace(end, 1, ", ");
        lines.back() = ' ';
        write(key.name, "{ " + lines + "}");
        break;
      }
    }
    return false;
  }

  bool applies(bool condition, const char*, const std::string&, const std::string&) override { return condition; }
  bool writes() const override { return true; }
  void comment(const std::string& text) override { text_ += "# " + text + "\n"; }

 protected:
  bool declare(const Key& key, const Target& target, const Declared& declared) override {
    if (!is_asked(key)) return false;
    if (const auto value = toml_text(target, declared)) write(key.name, *value);
    return false;
  }

  bool each_table(const Key& key, ListForm form, const std::vector<std::string>& names, const UseTable& use,
                  std::string_view) override {
    if (!is_asked(key)) return true;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const bool array = form == ListForm::array;
      const std::string path = path_of(key) + (array ? "" : "." + written(names[i]));
      const std::string header = array ? "[[" + path + "]]" : "[" + path + "]";
      write_table(header, path, [&](Keys& keys) { use(keys, {.index = i}); });
    }
    return true;
  }

  void each_entry(const std::vector<std::string>& names, const std::vector<std::string_view>&,
                  const UseKey& use) override {
    for (std::size_t i = 0; i < names.size(); ++i) use({names[i], Presence::required}, {.index = i});
  }

 private:
  bool is_asked(const Key& key) const { return only_.empty() || key.name == only_; }

  std::string path_of(const Key& key) const { return (path_.empty() ? "" : path_ + ".") + std::string(key.name); }

  void write(std::string_view key, const std::string& value) {
    text_ += before_keys_ + written(key) + " = " + value + "\n";
  }

  void write_table(const std::string& header, const std::string& path, const std::function<void(Keys&)>& keys) {
    text_ += "\n" + header + "\n";
    KeyWriter writer(text_, path);
    keys(writer);
  }

  std::string& text_;
  std::string path_, before_keys_;
  std::string_view only_;
};

}  // namespace

std::string to_toml(const Deck& deck, std::string_view only) {
  Deck copy = deck;  // the declarations serve readers as well
  std::string text;
  KeyWriter writer(text, {}, {}, only);
  declare_keys(writer, copy);
  return text;
}

}  // namespace arcwall::deck
