#pragma once

#include <string>

namespace arcwall {

/// Returns the version of the library and its programs: `0.1.0`.
std::string program_version();

}  // namespace arcwall
