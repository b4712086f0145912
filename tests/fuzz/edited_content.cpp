#include "tests/fuzz/edited_content.hpp"

#include <cstdint>
#include <cstring>
#include <vector>

#include "tests/fuzz/odd_numbers.hpp"

namespace arcwall::fuzz {

namespace {

using nlohmann::json;

// The way down ends at what is no list, and one time in eight at a list.
json& any_place(json& content, FuzzedDataProvider& data) {
  json* place = &content;
  while (place->is_array() && !place->empty() && data.ConsumeIntegralInRange(0, 7) > 0) place = &one_of(*place, data);
  return *place;
}

// Of numbers, as a rule: one of them, or the last bytes.
void change(json::binary_t& block, FuzzedDataProvider& data) {
  const std::size_t count = block.size() / sizeof(double);
  if (count == 0 || data.ConsumeIntegralInRange(0, 7) == 0) {
    block.resize(data.ConsumeIntegralInRange<std::size_t>(0, block.size() + sizeof(double)),
                 data.ConsumeIntegral<std::uint8_t>());
    return;
  }
  std::uint8_t* at = block.data() + sizeof(double) * data.ConsumeIntegralInRange<std::size_t>(0, count - 1);
  double number = 0.0;
  std::memcpy(&number, at, sizeof number);
  number = odd_number(number, data);
  std::memcpy(at, &number, sizeof number);
}

void change_list(json& list, FuzzedDataProvider& data) {
  const auto entry = list.begin() + data.ConsumeIntegralInRange<std::ptrdiff_t>(0, std::ssize(list) - 1);
  if (data.ConsumeBool())
    list.erase(entry);
  else
    list.insert(entry, json(*entry));
}

void change(json& value, FuzzedDataProvider& data) {
  if (value.is_binary()) {
    change(value.get_binary(), data);
  } else if (value.is_number_float()) {
    value = odd_number(value.get<double>(), data);
  } else if (value.is_number_integer()) {
    value =
        data.ConsumeBool() ? data.ConsumeIntegralInRange<std::int64_t>(-1, 20) : data.ConsumeIntegral<std::int64_t>();
  } else if (value.is_boolean()) {
    value = !value.get<bool>();
  } else if (value.is_string()) {
    value = data.ConsumeRandomLengthString(8);
  } else if (value.is_array() && !value.empty()) {
    change_list(value, data);
  } else if (value.is_null()) {
    value = json::array({json::array()});
  }
}

}  // namespace

json edited(json content, FuzzedDataProvider& data) {
  constexpr int most_edits = 4;
  for (int i = 0; i < most_edits && data.remaining_bytes() > 0; ++i) {
    json& value = any_place(content, data);
    switch (data.ConsumeIntegralInRange(0, 9)) {
      case 0:
        value = nullptr;
        break;
      case 1: {
        json other = any_place(content, data);
        value = std::move(other);
        break;
      }
      default:
        change(value, data);
    }
  }
  return content;
}

}  // namespace arcwall::fuzz
