#include "apps/output/csv.hpp"

namespace arcwall {

std::string csv_cell(const std::string& text) {
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
