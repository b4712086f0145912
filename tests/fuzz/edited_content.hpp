#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <nlohmann/json.hpp>

namespace arcwall::fuzz {

/// The content of a checkpoint with some numbers, blocks, entries and lists changed, removed or repeated.
nlohmann::json edited(nlohmann::json content, FuzzedDataProvider& data);

}  // namespace arcwall::fuzz
