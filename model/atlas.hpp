#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// A smooth arc of a branch along which λ grows or falls all the way, contacts stay and so does the number of unstable
/// directions: one state of the structure, over a range of λ.
struct AtlasNode {
  Index branch = 0;
  std::size_t first = 0, last = 0;  ///< points of the record at its ends, `first` met first
  std::string word{};               ///< its contacts, as of a landing
  std::optional<Index> unstable{};
  std::vector<Index> images{};   ///< branches on which an image of it in a mirror lies, which is no node of its own
  std::vector<double> slopes{};  ///< of the energy by λ at its points [force·length]
};

/// What leads from one node to another.
struct AtlasEdge {
  std::string kind{};  ///< of the event; `landing`, `joined`, or `found` where a branch begins both ways
  double lambda = 0.0;
  std::vector<Index> events{};      ///< ids; none where it is no event
  std::size_t from = 0;             ///< node
  std::optional<std::size_t> to{};  ///< node; empty of a landing that no branch passes
};

/// A range of λ over which the same nodes are there and the same stable one has the least energy.
struct AtlasRange {
  double low = 0.0, high = 0.0;
  std::vector<std::size_t> nodes{}, stable{};
  std::optional<std::size_t> least{};  ///< of the stable ones that of least energy
};

/// How the branches of a run hang together.
struct Atlas {
  std::vector<AtlasNode> nodes{};
  std::vector<AtlasEdge> edges{};
  std::vector<AtlasRange> ranges{};  ///< by λ
};

/// Empty for a run in load increments or in stages. `record` is a run of `model`.
Atlas atlas_of(const Model& model, const Record& record);

/// The energy of a node at a λ of its range, by a cubic through its points with their slopes.
double energy_at(const AtlasNode& node, const Record& record, double lambda);

}  // namespace arcwall
