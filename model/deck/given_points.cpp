#include "model/deck/given_points.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/types.hpp"
#include "model/deck/smoothing.hpp"
#include "model/deck/toml_source.hpp"

namespace arcwall::deck {

namespace {

constexpr std::size_t most_points = 20000;

[[noreturn]] void refuse_file(const std::string& file, int line, const std::string& message, const std::string& cure) {
  throw InputError({Diagnostic{.file = file, .line = line, .message = message, .cure = cure}});
}

// The numbers of a line between commas, semicolons or spaces; empty if something else is in it.
std::vector<double> numbers_in(std::string line) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';' || c == '\t' || c == '\r'; }, ' ');
  std::vector<double> numbers;
  for (std::size_t at = line.find_first_not_of(' '); at != std::string::npos;) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    double number = 0.0;
    const auto read = std::from_chars(line.data() + at, line.data() + end, number);
    if (read.ec != std::errc() || read.ptr != line.data() + end || !std::isfinite(number)) return {};
    numbers.push_back(number);
    at = line.find_first_not_of(' ', end);
  }
  return numbers;
}

// Two numbers a line, below a line of titles if there is one; `#` begins a comment.
std::vector<Vec2> points_in_file(const std::string& file) {
  const std::string text = read_text_file(file);
  std::vector<Vec2> points;
  int line = 0;
  bool has_titles = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string row = text.substr(at, std::min(text.find('#', at), end) - at);
    at = end + 1;
    ++line;
    if (row.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::vector<double> numbers = numbers_in(row);
    if (numbers.empty() && points.empty() && !std::exchange(has_titles, true)) continue;
    if (numbers.size() != 2)
      refuse_file(file, line, "has no two numbers in " + in_quotes(row, 60),
                  "write x and z with decimal points, and a comma between them");
    if (points.size() == most_points)
      refuse_file(file, line, "has more than " + std::to_string(most_points) + " points", "give fewer");
    points.emplace_back(numbers[0], numbers[1]);
  }
  if (points.size() < 2) refuse_file(file, 0, "has fewer than 2 points", "give a line with x and z for each");
  return points;
}

std::string beside(const std::string& deck_file, const std::string& name) {
  return (std::filesystem::path(deck_file).parent_path() / name).string();
}

Value* child(Value& table, std::string_view key) { return const_cast<Value*>(find(table, key)); }

// The tables of profiles and outlines, with their keys.
template <class Use>
void each_shape(Value& root, Use use) {
  Value* const walls = child(root, "wall");
  if (walls == nullptr || walls->kind != Value::Kind::array) return;
  for (std::size_t i = 0; i < walls->items.size(); ++i)
    for (const char* key : {"profile", "outline"})
      if (Value* const shape = child(walls->items[i], key); shape != nullptr && shape->kind == Value::Kind::table)
        use(*shape, "wall." + std::to_string(i) + "." + key);
}

Value number_at(double number, const Position& position) {
  return {.kind = Value::Kind::number, .position = position, .number = number};
}

// Reads and replaces the points of one shape.
class GivenPoints {
 public:
  GivenPoints(Value& shape, std::string path, const std::string& deck_file, Findings& findings)
      : shape_(shape), path_(std::move(path)), deck_file_(deck_file), findings_(findings) {}

  void use() {
    const Value* const points = find(shape_, "points");
    if (points != nullptr) {
      if (find(shape_, "x") != nullptr || find(shape_, "z") != nullptr)
        return fail(*points, "points", "stand beside x and z", "keep one of them");
      std::vector<Value> x, z;
      if (!read(*points, x, z)) return;
      replace(std::move(x), std::move(z), *points);
      std::erase_if(shape_.items, [](const Value& item) { return item.key == "points"; });
    }
    if (find(shape_, "smoothing") != nullptr && smooth())
      std::erase_if(shape_.items, [](const Value& item) { return item.key == "smoothing"; });
  }

 private:
  void fail(const Value& at, const std::string& key, std::string message, std::string cure) {
    findings_.add_for_all_of(path_, at.position, path_ + "." + key, std::move(message), std::move(cure));
  }

  bool read(const Value& points, std::vector<Value>& x, std::vector<Value>& z) {
    if (points.kind == Value::Kind::string) return read_file(points, x, z);
    const auto is_point = [](const Value& item) { return item.kind == Value::Kind::array && item.items.size() == 2; };
    if (points.kind != Value::Kind::array || !std::all_of(points.items.begin(), points.items.end(), is_point))
      return fail(points, "points", shown(points) + " is no list of points",
                  "give [[x, z], …], or the name of a CSV file in quotes"),
             false;
    for (const Value& point : points.items) {
      x.push_back(point.items[0]);
      z.push_back(point.items[1]);
    }
    return true;
  }

  bool read_file(const Value& name, std::vector<Value>& x, std::vector<Value>& z) {
    if (name.position.assignment > 0)
      return fail(name, "points", "a file is named in the deck alone, which its results then contain",
                  "write the name into the deck, or give the points"),
             false;
    if (shown(name) != "\"" + name.string + "\"")  // it is not found in the text
      return fail(name, "points", shown(name) + " is not the name of a file",
                  "use a shorter name without special characters"),
             false;
    try {
      for (const Vec2& point : points_in_file(beside(deck_file_, name.string))) {
        x.push_back(number_at(point.x(), name.position));
        z.push_back(number_at(point.y(), name.position));
      }
      return true;
    } catch (const InputError& error) {
      const Diagnostic& found = error.diagnostics().front();
      const std::string line = found.line > 0 ? ":" + std::to_string(found.line) : "";
      fail(name, "points", found.file + line + " " + found.message,
           found.cure.empty() ? "name the file from the folder of the deck" : found.cure);
      return false;
    }
  }

  void replace(std::vector<Value> x, std::vector<Value> z, const Value& given) {
    for (auto* const list : {&x, &z}) {
      const std::string key = list == &x ? "x" : "z";
      Value array{
          .kind = Value::Kind::array, .position = given.position, .key = key, .key_position = given.key_position};
      array.items = std::move(*list);
      if (Value* const there = child(shape_, key))
        *there = std::move(array);
      else
        added_.push_back(std::move(array));
    }
    for (Value& array : added_) shape_.items.push_back(std::move(array));
    added_.clear();
  }

  bool smooth() {
    const Value& smoothing = *find(shape_, "smoothing");
    const Value *const x = find(shape_, "x"), *const z = find(shape_, "z"), *const type = find(shape_, "type");
    const std::string word = type != nullptr ? type->string : "";
    if (word != "spline" && word != "curve") return false;  // not a key of others
    const bool has_number = smoothing.kind == Value::Kind::integer || smoothing.kind == Value::Kind::number;
    if (!has_number || !(smoothing.number > 0.0) || !std::isfinite(smoothing.number))
      return fail(smoothing, "smoothing", shown(smoothing) + " is no tolerance", "give a number greater than 0"), false;
    std::vector<Vec2> points;
    if (x == nullptr || z == nullptr || x->items.size() != z->items.size() || x->items.size() < 2) return true;
    for (std::size_t i = 0; i < x->items.size(); ++i) {
      const Value &of_x = x->items[i], &of_z = z->items[i];
      for (const Value* one : {&of_x, &of_z})
        if (one->kind != Value::Kind::integer && one->kind != Value::Kind::number)
          return fail(*one, "smoothing", shown(*one) + " is no number", "smooth points that are numbers"), false;
      points.emplace_back(of_x.number, of_z.number);
    }
    const Value* const closed = find(shape_, "closed");
    const bool is_ring = closed != nullptr && closed->boolean;
    const AlongPoints along = word == "spline" ? AlongPoints::x : is_ring ? AlongPoints::ring : AlongPoints::chord;
    const auto increases = [](const Vec2& a, const Vec2& b) { return a.x() >= b.x(); };
    if (along == AlongPoints::x && std::adjacent_find(points.begin(), points.end(), increases) != points.end())
      return true;  // reported with the list
    const auto found = smoothed(points, smoothing.number, along);
    if (!found)
      return fail(smoothing, "smoothing",
                  "no curve with a third of the points stays within " + round_trip(smoothing.number) + " of them",
                  "give a greater tolerance, or leave out smoothing"),
             false;
    std::vector<Value> new_x, new_z;
    const Value given = *x;
    for (const Vec2& point : *found) {
      new_x.push_back(number_at(point.x(), given.position));
      new_z.push_back(number_at(point.y(), given.position));
    }
    replace(std::move(new_x), std::move(new_z), given);
    return true;
  }

  Value& shape_;
  std::string path_;
  const std::string& deck_file_;
  Findings& findings_;
  std::vector<Value> added_{};
};

std::size_t offset_of(const std::string& text, const Position& position) {
  std::size_t at = 0;
  for (int line = 1; line < position.line; ++line) at = text.find('\n', at) + 1;
  const bool has_mark = position.line == 1 && text.starts_with("\xEF\xBB\xBF");
  if (has_mark) at += 3;
  for (int column = 1; column < position.column; ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  }
  return at;
}

}  // namespace

void use_given_points(Value& root, const std::string& deck_file, Findings& findings) {
  each_shape(root, [&](Value& shape, const std::string& path) { GivenPoints(shape, path, deck_file, findings).use(); });
}

std::string read_deck_file(const std::string& file) {
  std::string text = read_text_file(file);
  std::vector<std::pair<std::size_t, std::string>> names;  // where they are in the text
  try {
    Value root = parse_deck(text, file);
    each_shape(root, [&](Value& shape, const std::string&) {
      const Value* const points = find(shape, "points");
      if (points != nullptr && points->kind == Value::Kind::string)
        names.emplace_back(offset_of(text, points->position), points->string);
    });
  } catch (const InputError&) {
    return text;  // for the reader to report
  }
  std::sort(names.rbegin(), names.rend());
  for (const auto& [at, name] : names) {
    const std::string_view rest = std::string_view(text).substr(at);
    std::size_t length = 0;
    for (const std::string quote : {"\"\"\"", "'''", "\"", "'"})
      if (length == 0 && rest.starts_with(quote + name + quote)) length = name.size() + 2 * quote.size();
    if (length == 0) continue;
    try {
      std::string list;
      for (const Vec2& point : points_in_file(beside(file, name)))
        list += (list.empty() ? "[" : ", [") + round_trip(point.x()) + ", " + round_trip(point.y()) + "]";
      text.replace(at, length, "[" + list + "]");
    } catch (const InputError&) {
      continue;
    }
  }
  return text;
}

}  // namespace arcwall::deck
