#pragma once

#include <string>

namespace arcwall {

/// The script that completes the command lines of `trace-path` in bash, made from the tables of its commands.
std::string bash_completion();

/// trace-path(1) for man, made from the same tables.
std::string man_page();

}  // namespace arcwall
