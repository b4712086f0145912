#pragma once

namespace arcwall {

/// What a path does where equilibria form a continuum: several flat parts of a body on straight walls, of whose lengths
/// only the sum is determined.
enum class ContinuumChoice {
  symmetric,  ///< it goes on with the member whose neighbouring parts keep the difference of their lengths
  stop,       ///< it ends
};

}  // namespace arcwall
