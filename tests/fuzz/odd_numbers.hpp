#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <cstddef>

namespace arcwall::fuzz {

/// A number that is zero, extreme, a little or much off the old one, or any.
double odd_number(double old, FuzzedDataProvider& data);

/// An entry that the data choose; the list must have one.
template <class List>
auto& one_of(List& list, FuzzedDataProvider& data) {
  return list[data.ConsumeIntegralInRange<std::size_t>(0, list.size() - 1)];
}

}  // namespace arcwall::fuzz
