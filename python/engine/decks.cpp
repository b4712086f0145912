#include <variant>

#include "model/deck/given_points.hpp"
#include "model/deck/numbers.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/toml_source.hpp"
#include "model/deck/writer.hpp"
#include "model/model.hpp"
#include "python/engine/python.hpp"

namespace arcwall::python {

namespace {

using Assignments = std::vector<std::string>;

py::object python_value(const deck::Value& value) {
  switch (value.kind) {
    case deck::Value::Kind::boolean:
      return py::bool_(value.boolean);
    case deck::Value::Kind::integer:
      return py::int_(value.integer);
    case deck::Value::Kind::number:
      return py::float_(value.number);
    case deck::Value::Kind::string:
    case deck::Value::Kind::date:  // no deck has one; a text serves to show it
      return py::str(value.kind == deck::Value::Kind::date ? "a date" : value.string);
    case deck::Value::Kind::array: {
      py::list list;
      for (const deck::Value& item : value.items) list.append(python_value(item));
      return list;
    }
    case deck::Value::Kind::table:
      break;
  }
  py::dict dict;
  for (const deck::Value& item : value.items) dict[py::str(item.key)] = python_value(item);
  return dict;
}

deck::Value document(const std::string& text, const std::string& file, const Assignments& assignments) {
  deck::Value root = deck::parse_deck(text, file);
  int number = 0;
  for (const std::string& assignment : assignments) deck::assign(root, assignment, ++number);
  return root;
}

// The deck with every default written out.
std::string written(const std::string& text, const std::string& file, const Assignments& assignments) {
  return deck::to_toml(deck::read_deck_text(text, file, assignments));
}

// What is wrong with a deck, and what its user should know: diagnostics, and sentences.
py::tuple check(const std::string& text, const std::string& file, const Assignments& assignments) {
  try {
    const Model model(deck::read_deck_text(text, file, assignments));
    return py::make_tuple(py::list(), model.warnings());
  } catch (const InputError& error) {
    return py::make_tuple(to_python(error.diagnostics()), py::list());
  }
}

// The value behind a key as in --set: what the deck says, else the default.
py::object value(const std::string& text, const std::string& file, const Assignments& assignments,
                 const std::string& key) {
  const deck::Value given = document(text, file, assignments);
  const auto stands = deck::part_of(given, key);
  if (const auto* part = std::get_if<deck::DeckPart>(&stands)) return python_value(*part->value);
  const deck::Value whole = deck::parse_toml(written(text, file, assignments), file);
  const auto found = deck::part_of(whole, key);
  if (const auto* part = std::get_if<deck::DeckPart>(&found)) return python_value(*part->value);
  const auto& none = std::get<deck::NoNumber>(found);
  // The cure of a number that is not there speaks of numbers; here any value is asked for.
  const bool names_another = none.cure.rfind("did you mean", 0) == 0;
  throw py::key_error(key + " " + none.message + (names_another ? "; " + none.cure : ""));
}

}  // namespace

void bind_decks(py::module_& module) {
  module.def(
      "require_toml",
      [](const std::string& text, const std::string& file, const Assignments& assignments) {
        document(text, file, assignments);
      },
      py::arg("text"), py::arg("file"), py::arg("assignments"));
  module.def("read_deck_file", &deck::read_deck_file, py::arg("file"));
  module.def("written", &written, py::arg("text"), py::arg("file"), py::arg("assignments"));
  module.def("check", &check, py::arg("text"), py::arg("file"), py::arg("assignments"));
  module.def("value", &value, py::arg("text"), py::arg("file"), py::arg("assignments"), py::arg("key"));
  module.def(
      "document",
      [](const std::string& text, const std::string& file, const Assignments& assignments) {
        return python_value(document(text, file, assignments));
      },
      py::arg("text"), py::arg("file"), py::arg("assignments"));
}

}  // namespace arcwall::python
