#pragma once

#include <cstddef>
#include <string>

#include "model/deck/value.hpp"

/// Keys as in `--set`, as people read them.
namespace arcwall {

/// A key and a part behind it.
std::string key_of(const std::string& before, const std::string& part);

/// The part of a key that means an element of an array: the name of a table, where it names this one alone; else its
/// index.
std::string part_of_key(const deck::Value& array, std::size_t index);

/// The key with the names of tables in arrays for their indices.
std::string with_names(const deck::Value& root, const std::string& key);

}  // namespace arcwall
