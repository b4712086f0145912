#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace arcwall {

/// Characters of a UTF-8 text, each taken to be one column wide.
std::size_t display_width(std::string_view text);

/// A column of a table for people: its title, and the side its cells keep to.
struct TableColumn {
  enum class Side { left, right };
  std::string title{};
  Side side = Side::left;
};

/// Titles, then rows, in aligned columns two blanks apart; every row has one cell a column. Lines end without blanks.
/// Cells stay on their lines: what is not printable in them is escaped, see printable().
std::string text_table(const std::vector<TableColumn>& columns, std::vector<std::vector<std::string>> rows);

}  // namespace arcwall
