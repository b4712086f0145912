#include "apps/output/key_names.hpp"

#include <sstream>

#include "model/deck/toml_source.hpp"

namespace arcwall {

using deck::Value;

std::string key_of(const std::string& before, const std::string& part) {
  return before.empty() ? part : before + "." + part;
}

std::string part_of_key(const Value& array, std::size_t index) {
  const Value& element = array.items[index];
  const Value* const named = element.kind == Value::Kind::table ? deck::find(element, "name") : nullptr;
  const std::string name = named != nullptr && named->kind == Value::Kind::string ? named->string : "";
  const bool is_it = deck::is_name(name) && deck::element_of(array, name) == &array.items[index];
  return is_it ? name : std::to_string(index);
}

std::string with_names(const Value& root, const std::string& key) {
  std::string named, part;
  const Value* at = &root;
  for (std::istringstream parts(key); std::getline(parts, part, '.');) {
    const bool in_array = at != nullptr && at->kind == Value::Kind::array;
    const Value* const next = at == nullptr ? nullptr : in_array ? deck::element_of(*at, part) : deck::find(*at, part);
    named =
        key_of(named, in_array && next != nullptr ? part_of_key(*at, static_cast<std::size_t>(next - at->items.data()))
                                                  : part);
    at = next;
  }
  return named;
}

}  // namespace arcwall
