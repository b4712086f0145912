#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "apps/explore/traced_page.hpp"
#include "core/error.hpp"

/// The lines that a process of `explore` gives.
namespace arcwall::explore {

using Json = nlohmann::ordered_json;

inline constexpr std::size_t most_characters = 2000;  ///< of a message that a page shows

void give_json(const Json& json, const LineSink& give);

Json errors_json(const InputError& error);

/// Calls `body`, and gives what it throws as a line.
void give_or_say_why_not(const LineSink& give, const std::function<void()>& body);

}  // namespace arcwall::explore
