#include "apps/output/csv.hpp"

#include <string_view>

namespace arcwall {

namespace {

bool is_formula(const std::string& text) {
  return !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (is_formula(text)) return csv_cell("'" + text);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csv_title(const std::string& name, const std::string& unit, UnitLabels labels) {
  const bool with_unit = labels == UnitLabels::shown && !unit.empty();
  return csv_cell(with_unit ? name + " [" + unit + "]" : name);
}

}  // namespace arcwall
