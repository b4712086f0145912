#include "apps/output/filled_page.hpp"

#include <cassert>

namespace arcwall {

Pieces filled(std::string_view page, const PageConstants& constants, const PageFields& fields) {
  Pieces pieces;
  for (std::size_t open = page.find("{{"); open != std::string_view::npos; open = page.find("{{")) {
    const std::size_t close = page.find("}}", open);
    assert(close != std::string_view::npos);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    pieces.push_back(page.substr(0, open));
    const auto constant = constants.find(name);
    const auto field = fields.find(name);
    assert(constant != constants.end() || field != fields.end());
    pieces.push_back(constant != constants.end() ? constant->second : std::string_view(field->second));
    page.remove_prefix(close + 2);
  }
  pieces.push_back(page);
  return pieces;
}

std::string joined_pieces(const Pieces& pieces) {
  std::string text;
  for (const std::string_view piece : pieces) text += piece;
  return text;
}

}  // namespace arcwall
