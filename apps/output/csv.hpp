#pragma once

#include <string>

#include "model/run_description.hpp"

namespace arcwall {

/// RFC 4180: a cell with a comma, a quote or a line break stands in quotes, and its quotes are doubled. A text that a
/// spreadsheet would take for a formula (it begins with = + - @, a tab or a carriage return) gets an apostrophe in
/// front. Numbers are no texts.
std::string csv_cell(const std::string& text);

/// A column's name, with its unit where there is one and labels are shown.
std::string csv_title(const std::string& name, const std::string& unit, UnitLabels labels);

}  // namespace arcwall
