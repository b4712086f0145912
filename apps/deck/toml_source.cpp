#include "apps/deck/toml_source.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "apps/deck/toml_precheck.hpp"

namespace {

/// The TOML library came upon a state it takes for impossible.
struct ParserDefect {};

constexpr void require(bool holds) {
  if (!holds) throw ParserDefect{};
}

}  // namespace

// Some invalid documents violate assertions of the library: an abort in a debug build, undefined behaviour in another
// one. An exception is neither. The library drops this definition under NDEBUG; nothing else in this file depends on
// it.
#undef NDEBUG
#define TOML_ASSERT(expression) require(static_cast<bool>(expression))
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

namespace arcwall::deck {

namespace {

[[noreturn]] void fail(Diagnostic diagnostic) { throw InputError(std::vector<Diagnostic>{std::move(diagnostic)}); }

Position position_of(const toml::source_region& region) {
  return {.line = static_cast<int>(region.begin.line), .column = static_cast<int>(region.begin.column)};
}

bool stands_before(const Value& a, const Value& b) {
  return std::pair(a.key_position.line, a.key_position.column) < std::pair(b.key_position.line, b.key_position.column);
}

// Depth is bounded by the limits of precheck().
Value converted(const toml::node& node) {
  Value value{.position = position_of(node.source())};
  if (const auto* table = node.as_table()) {
    for (const auto& [key, child] : *table) {
      Value& item = value.items.emplace_back(converted(child));
      item.key = key.str();
      item.key_position = position_of(key.source());
    }
    std::stable_sort(value.items.begin(), value.items.end(), stands_before);
  } else if (const auto* array = node.as_array()) {
    value.kind = Value::Kind::array;
    for (const toml::node& child : *array) value.items.push_back(converted(child));
  } else if (const auto* string = node.as_string()) {
    value.kind = Value::Kind::string;
    value.string = string->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = Value::Kind::integer;
    value.integer = integer->get();
    value.number = static_cast<double>(value.integer);
  } else if (const auto* number = node.as_floating_point()) {
    value.kind = Value::Kind::number;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = Value::Kind::boolean;
    value.boolean = boolean->get();
  } else {
    value.kind = Value::Kind::date;
  }
  return value;
}

bool upsets_the_parser(std::string_view text) {
  try {
    static_cast<void>(toml::parse(text));
  } catch (const ParserDefect&) {
    return true;
  } catch (const toml::parse_error&) {
  }
  return false;
}

// A defect carries no place. It appears as soon as its line is part of the text, so that line is found by bisection.
int line_of_defect(std::string_view text) {
  std::vector<std::size_t> ends;  // of the text through each line
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') ends.push_back(i + 1);
  }
  ends.push_back(text.size());
  const auto first = std::partition_point(ends.begin(), ends.end(),
                                          [text](std::size_t end) { return !upsets_the_parser(text.substr(0, end)); });
  return static_cast<int>(std::min(first - ends.begin() + 1, static_cast<std::ptrdiff_t>(ends.size())));
}

toml::table parsed(std::string_view text, const std::string& file) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  if (auto problem = precheck(text)) {
    problem->file = file;
    fail(*std::move(problem));
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const Position position = position_of(error.source());
    fail({.file = file,
          .line = position.line,
          .column = position.column,
          .message = "not valid TOML: " + on_one_line(std::string(error.description()))});
  } catch (const ParserDefect&) {
    fail({.file = file, .line = line_of_defect(text), .message = "not valid TOML", .cure = "check this line"});
  }
}

void set_positions(Value& value, const Position& position) {
  value.position = position;
  value.key_position = position;
  for (Value& item : value.items) set_positions(item, position);
}

/// `--set key=value`, taken apart.
struct Assignment {
  std::vector<std::string> key{};
  Value value{};
};

constexpr const char* how_to_assign =
    "write key=value, the value as in TOML (text in quotes: --set path.method='\"riks\"')";

toml::table parsed_assignment(const std::string& text, const std::string& origin) {
  try {
    return parsed(text, origin);
  } catch (const InputError& error) {
    Diagnostic diagnostic = error.diagnostics().front();
    diagnostic.line = 0;  // there is only one
    diagnostic.column = 0;
    diagnostic.cure = how_to_assign;
    fail(std::move(diagnostic));
  }
}

// Nothing if the text is TOML but not one key with one value.
std::optional<Assignment> taken_apart(const std::string& text, const std::string& origin) {
  const std::size_t begin = text.find_first_not_of(" \t");
  const bool is_header = begin != std::string::npos && text[begin] == '[';
  if (is_header || text.find('\n') != std::string::npos) return std::nullopt;
  const toml::table document = parsed_assignment(text, origin);
  Assignment result;
  const toml::node* node = &document;
  while (const auto* table = node->as_table()) {
    if (table != &document && table->is_inline()) break;
    if (table->size() != 1) return std::nullopt;
    result.key.emplace_back(table->begin()->first.str());
    node = &table->begin()->second;
  }
  result.value = converted(*node);
  return result;
}

Value* element(Value& array, const std::string& part) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (error != std::errc{} || end != part.data() + part.size() || index >= array.items.size()) return nullptr;
  return &array.items[index];
}

// The value with that key in a table (made if there is none) or an array, or null if there is no such place.
Value* child(Value& parent, const std::string& part, const Position& position) {
  if (parent.kind == Value::Kind::array) return element(parent, part);
  if (parent.kind != Value::Kind::table) return nullptr;
  for (Value& item : parent.items) {
    if (item.key == part) return &item;
  }
  return &parent.items.emplace_back(Value{.position = position, .key = part, .key_position = position});
}

}  // namespace

Value parse_toml(std::string_view text, const std::string& file) { return converted(parsed(text, file)); }

std::string read_text_file(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) {
    const bool missing = !error || error == std::errc::no_such_file_or_directory;
    fail({.file = file, .message = missing ? "there is no such file" : "cannot be read: " + error.message()});
  }
  if (fs::is_directory(status)) fail({.file = file, .message = "is a directory", .cure = "name the deck in it"});
  if (!fs::is_regular_file(status)) fail({.file = file, .message = "is not a regular file"});
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) fail({.file = file, .message = "cannot be read: " + error.message()});
  // One byte more than allowed is enough for precheck() to see that it is too much.
  std::string text(std::min<std::uintmax_t>(size, TextLimits{}.bytes + 1), '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(text.data(), static_cast<std::streamsize>(text.size()))) {
    fail({.file = file, .message = "cannot be read", .cure = "check its permissions"});
  }
  return text;
}

void assign(Value& root, const std::string& assignment, int number) {
  const std::string origin = origin_of(assignment);
  std::optional<Assignment> part = taken_apart(assignment, origin);
  if (!part) fail({.file = origin, .message = "is not one key=value", .cure = how_to_assign});

  const Position position{.assignment = number};
  Value* target = &root;
  std::string path;
  for (const std::string& key : part->key) {
    Value* next = child(*target, key, position);
    if (next == nullptr) {
      fail({.file = origin,
            .key = path,
            .message = shown(*target) + " has no part " + key_text(key),
            .cure = "name a key of the deck; elements of an array count from 0"});
    }
    target = next;
    path += (path.empty() ? "" : ".") + key_text(key);
  }
  part->value.key = target->key;
  set_positions(part->value, position);
  *target = std::move(part->value);
}

}  // namespace arcwall::deck
