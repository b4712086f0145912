#include "model/deck/writer.hpp"

#include <string>
#include <utility>

#include "model/deck/deck_keys.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

// A key as TOML has it. The names of a deck need no quotes, but a writer does not rely on what a reader has checked.
std::string written(std::string_view key) { return is_name(key) ? std::string(key) : in_quotes(key); }

// Where a table is written: the path of its header, what stands before each of its keys (the `profile.` of
// `profile.type`), and what their keys as in `--set` have before them.
struct TablePlace {
  std::string path{}, before_keys{}, key{};
};

// Writes the declared keys of a table behind a text. With `only` no other key of the table is written.
class KeyWriter final : public Keys {
 public:
  KeyWriter(std::string& text, const Formulas& formulas, TablePlace place = {}, std::string_view only = {})
      : text_(text), formulas_(formulas), place_(std::move(place)), only_(only) {}

  bool table(const Key& key, Form form, const std::function<void(Keys&)>& keys_of_table, std::string_view) override {
    if (!is_asked(key)) return false;
    const std::string inner = key_of(key) + ".";
    switch (form) {
      case Form::header:
        write_table("[" + path_of(key) + "]", {.path = path_of(key), .key = inner}, keys_of_table);
        break;
      case Form::dotted: {
        const std::string before_keys = place_.before_keys + std::string(key.name) + ".";
        KeyWriter writer(text_, formulas_, {.path = place_.path, .before_keys = before_keys, .key = inner});
        keys_of_table(writer);
        break;
      }
      case Form::in_line:
      case Form::only_element: {
        std::string lines;
        KeyWriter writer(lines, formulas_, {.key = inner});
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
  // A number that is not a formula's any more is written as it is.
  bool declare(const Key& key, const Target& target, const Declared& declared) override {
    if (!is_asked(key)) return false;
    const auto formula_of = [&](const std::string& part, double value) {
      const auto found = formulas_.find(key_of(key) + part);
      return found != formulas_.end() && found->second.value == value ? found->second.text : std::string();
    };
    const auto value = formulas_.empty() ? toml_text(target, declared) : toml_text(target, declared, formula_of);
    if (value) write(key.name, *value);
    return false;
  }

  bool each_table(const Key& key, ListForm form, const std::vector<std::string>& names, const UseTable& use,
                  std::string_view) override {
    if (!is_asked(key)) return true;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const bool array = form == ListForm::array;
      const std::string path = path_of(key) + (array ? "" : "." + written(names[i]));
      const std::string header = array ? "[[" + path + "]]" : "[" + path + "]";
      const std::string inner = key_of(key) + "." + (array ? std::to_string(i) : names[i]) + ".";
      write_table(header, {.path = path, .key = inner}, [&](Keys& keys) { use(keys, {.index = i}); });
    }
    return true;
  }

  void each_entry(const std::vector<std::string>& names, const std::vector<std::string_view>&,
                  const UseKey& use) override {
    for (std::size_t i = 0; i < names.size(); ++i) use({names[i], Presence::required}, {.index = i});
  }

 private:
  bool is_asked(const Key& key) const { return only_.empty() || key.name == only_; }

  std::string path_of(const Key& key) const {
    return (place_.path.empty() ? "" : place_.path + ".") + std::string(key.name);
  }
  std::string key_of(const Key& key) const { return place_.key + std::string(key.name); }

  void write(std::string_view key, const std::string& value) {
    text_ += place_.before_keys + written(key) + " = " + value + "\n";
  }

  void write_table(const std::string& header, TablePlace place, const std::function<void(Keys&)>& keys) {
    text_ += "\n" + header + "\n";
    KeyWriter writer(text_, formulas_, std::move(place));
    keys(writer);
  }

  std::string& text_;
  const Formulas& formulas_;
  TablePlace place_;
  std::string_view only_;
};

}  // namespace

std::string to_toml(const Deck& deck, std::string_view only) {
  Deck copy = deck;  // the declarations serve readers as well
  std::string text;
  KeyWriter writer(text, deck.formulas, {}, only);
  declare_keys(writer, copy);
  return text;
}

}  // namespace arcwall::deck
