#pragma once

#include <map>
#include <string>
#include <string_view>

#include "apps/output/files.hpp"

namespace arcwall {

using PageFields = std::map<std::string, std::string, std::less<>>;
using PageConstants = std::map<std::string_view, std::string_view>;  ///< what every page has: a megabyte

/// The page with `{{name}}` replaced, as views of the arguments. What is filled in is not looked at again.
Pieces filled(std::string_view page, const PageConstants& constants, const PageFields& fields);

std::string joined_pieces(const Pieces& pieces);

}  // namespace arcwall
