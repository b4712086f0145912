#pragma once

#include <string>

namespace arcwall {

/// The version of this library and of the programs that are built with it: `0.1.0`.
std::string program_version();

}  // namespace arcwall
