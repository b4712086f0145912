#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace arcwall {

/// The shortest decimal that reads back as the same double; `nan`, `inf`, `-inf` as such.
std::string round_trip(double value);

/// The candidate that differs from `word` by the fewest edits, or empty if none is near (more than a third of its
/// length).
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// What happened, and where: "a stretch closes: roof at column:0.25". The place may be empty.
inline std::string with_place(std::string_view what, std::string_view place) {
  std::string words(what);
  return place.empty() ? words : words.append(": ").append(place);
}

}  // namespace arcwall
