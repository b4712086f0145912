#pragma once

#include <string>
#include <vector>

#include "apps/sweep/collection.hpp"
#include "apps/sweep/load_map.hpp"

namespace arcwall::sweep {

/// One map for each load that a case has: that of the snap, of the first contact, and of the first event of each kind.
/// `keys`: one or two of the varied keys.
std::vector<LoadMap> load_maps(const Collection& collection, const std::vector<std::string>& keys);

/// report.html: one page that needs no network and, but for the choice of the map, no script.
std::string report_html(const Collection& collection, const std::vector<std::string>& keys);

}  // namespace arcwall::sweep
