#include "apps/output/overlay.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <sstream>

#include "apps/output/path_lines.hpp"
#include "core/error.hpp"

namespace arcwall {

namespace {

[[noreturn]] void fail(const std::string& file, int line, const std::string& message, const std::string& cure) {
  throw InputError({Diagnostic{.file = file, .line = line, .message = message, .cure = cure}});
}

std::string trimmed(const std::string& text) {
  constexpr const char* blank = " \t\r\"";
  const std::size_t first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line + ",");
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(trimmed(cell));
  return cells;
}

// `mid [cm]` → `mid`, `λ` → `lambda`.
std::string name_in(const std::string& title) {
  const std::string name = trimmed(title.substr(0, title.find('[')));
  return name == "λ" ? "lambda" : name;
}

// NaN for an empty cell.
double number_in(const std::string& cell, const std::string& file, int line) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size())
    fail(file, line, "\"" + cell.substr(0, 60) + "\" is no number",
         "write numbers with a decimal point, and commas between them");
  return value;
}

std::string listed(const std::vector<RecordColumn>& columns) {
  std::string text = "lambda";
  for (const RecordColumn& column : columns) text += ", " + column.name;
  return text;
}

}  // namespace

Overlay overlay_of(const Record& record, const std::string& name) {
  Overlay overlay{.name = name};
  std::vector<double>& lambda = overlay.values["lambda"];
  for (const RecordPoint& point : record.points) lambda.push_back(point.lambda);
  for (std::size_t i = 0; i < record.columns.size(); ++i) {
    std::vector<double>& values = overlay.values[record.columns[i].name];
    for (const RecordPoint& point : record.points) values.push_back(point.monitors[i]);
  }
  overlay.firsts = first_points(record);
  if (!overlay.firsts.empty()) overlay.firsts.pop_back();  // the end of the last branch
  return overlay;
}

Overlay measured_points(const std::string& text, const std::string& file, const std::vector<RecordColumn>& columns) {
  Overlay overlay{.name = std::filesystem::path(file).filename().string(), .measured = true, .firsts = {0}};
  std::istringstream stream(text);
  std::string line;
  int number = 1;
  if (!std::getline(stream, line)) fail(file, 0, "is empty", "give a line with names, then lines with numbers");
  std::vector<std::string> names;
  for (const std::string& title : cells_of(line)) names.push_back(name_in(title));
  const auto is_known = [&](const std::string& name) {
    const auto same = [&](const RecordColumn& column) { return column.name == name; };
    return name == "lambda" || std::any_of(columns.begin(), columns.end(), same);
  };
  if (std::count_if(names.begin(), names.end(), is_known) < 2)
    fail(file, 1, "names fewer than two columns of the run", "name columns of " + listed(columns));
  while (std::getline(stream, line)) {
    ++number;
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != names.size())
      fail(file, number, "has " + std::to_string(cells.size()) + " cells instead of " + std::to_string(names.size()),
           "give one a column");
    for (std::size_t i = 0; i < names.size(); ++i)
      if (is_known(names[i])) overlay.values[names[i]].push_back(number_in(cells[i], file, number));
  }
  if (overlay.values.empty()) fail(file, number, "has no line with numbers", "give some below the names");
  return overlay;
}

}  // namespace arcwall
