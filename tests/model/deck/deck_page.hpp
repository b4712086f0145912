#pragma once

#include <string>

namespace arcwall::deck::test {

/// The page on decks with its tables of keys as the declarations have them. A table stands between two comments:
///
///     <!-- keys of contact -->
///     <!-- end of keys -->
///
/// Tables are called as in DeclaredKey::table, the root `deck`. `options of` a table are the words which say what else
/// stands in it. The table `other words` has the words and keys that are read as others.
std::string with_tables_of_keys(const std::string& page);

}  // namespace arcwall::deck::test
