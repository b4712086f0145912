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

}  // namespace arcwall
