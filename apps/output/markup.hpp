#pragma once

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// Texts of users on a page: data, never markup.
namespace arcwall {

/// A text as one can show it: of UTF-8, at most `most` characters, then "…". Control characters other than line breaks
/// and tabs, marks that turn the direction of writing, and bytes that are not UTF-8 become U+FFFD.
std::string plain(std::string_view text, std::size_t most = std::numeric_limits<std::size_t>::max());

/// For the content of an element and for an attribute's value in quotes.
std::string escaped(std::string_view text);

/// JSON that can stand in a <script> element: ASCII, without <, > and &.
std::string script_json(const nlohmann::ordered_json& json);

}  // namespace arcwall
