#pragma once

#include <string>
#include <utility>
#include <vector>

namespace arcwall {

/// Name and version of each library that the program was compiled with.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace arcwall
