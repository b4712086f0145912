#pragma once

#include <optional>
#include <string>
#include <vector>

namespace arcwall {

/// What values on meshes tell of the value without an error of the mesh.
struct Extrapolation {
  std::optional<double> order{};  ///< exponent of the element length in the error; empty where it cannot be told
  double value = 0.0;  ///< with the error of the mesh taken out where the order is known; else the finest one
  std::optional<double> error{};  ///< how far off `value` may be; empty where one mesh alone speaks
  std::string irregular{};        ///< in words, why no order is trusted; empty where one is, or none is needed
};

/// Richardson's extrapolation of values on meshes of which each is `factor` times as fine as the one before, the finest
/// last (docs/theory.md, section 13); there is at least one. `unsure`: by how much each value is not sure, whatever the
/// mesh.
Extrapolation extrapolated(const std::vector<double>& values, double factor, double unsure);

}  // namespace arcwall
