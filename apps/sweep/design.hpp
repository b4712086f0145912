#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/deck/deck.hpp"

/// Which values a parameter study gives to the keys that it varies.
namespace arcwall::sweep {

/// A value as JSON has it: a number, a text, true or false, or an array or object of such.
using Json = nlohmann::ordered_json;

enum class Spacing { linear, log };

/// Two ends of what a key goes through; of one sign where the spacing is logarithmic.
struct Range {
  double from = 0.0;
  double to = 0.0;
  Spacing spacing = Spacing::linear;
};

/// The value at a fraction 0 … 1 of a range: both ends exactly, what lies between rounded to 12 digits. So 0.3 is 0.3
/// and not a neighbour of it, and the last bit of a machine's exp() and log() does not show.
double value_at(const Range& range, double fraction);

/// As many values of a range, its ends among them; at least 2.
std::vector<double> values(const Range& range, int count);

/// A number as JSON: an integer if it is one, so that keys that want an integer take it.
Json number(double value);

/// Every combination of the values of each key; those of the last key change fastest.
std::vector<std::vector<Json>> grid(const std::vector<std::vector<Json>>& values);

/// Latin hypercube: each range is cut into as many equal parts (of its logarithm where it is logarithmic) as there are
/// samples, and each part holds one sample, at a random place. Same seed, same numbers, on every machine: the integers
/// are those of std::mt19937_64, and what is made of them is written out here. Further ranges change nothing in the
/// values of the first.
std::vector<std::vector<Json>> latin_hypercube(const std::vector<Range>& ranges, int samples, std::uint64_t seed);

}  // namespace arcwall::sweep
