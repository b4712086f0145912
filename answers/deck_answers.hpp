#pragma once

#include "model/path_answers.hpp"

namespace arcwall {

/// Answers all that a deck asks: `path.sensitivity`, `path.jumps`, `path.search`, and jumps of `path.branches`.
const Answers& deck_answers();

}  // namespace arcwall
