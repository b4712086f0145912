#pragma once

#include <memory>

#include "core/observable.hpp"
#include "model/build_monitors.hpp"

namespace arcwall {

/// Returns what a support exerts on a degree of freedom of the structure [force or force·length]: the internal less the
/// external forces there, and less what walls exert on the point that it holds. 0 where the degree of freedom is free.
std::shared_ptr<const Observable> support_reaction(const Measured& from, Index dof);

}  // namespace arcwall
