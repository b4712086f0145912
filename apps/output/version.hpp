#pragma once

#include <string>
#include <utility>
#include <vector>

namespace arcwall {

/// `0.1.0`.
std::string program_version();

/// Name and version of each library that the program was compiled with.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace arcwall
