#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// A smooth segment of a branch along which λ grows or falls all the way, contacts stay and so does the number of
/// unstable directions: one state of the structure, over a range of λ.
struct BranchMapSegment {
  Index branch = 0;
  std::size_t first = 0, last = 0;  ///< points of the record at its ends, `first` met first
  std::string contact_pattern{};    ///< its contacts, as of a jump
  std::optional<Index> unstable{};
  std::vector<Index> images{};  ///< branches on which an image of it in a mirror lies, which is no segment of its own
};

/// What leads from one segment to another.
struct BranchMapEdge {
  std::string kind{};  ///< of the event; `jump`, `reached_branch`, or `search` where a branch begins both ways
  double lambda = 0.0;
  std::vector<Index> events{};      ///< ids; none where it is no event
  std::size_t from = 0;             ///< segment
  std::optional<std::size_t> to{};  ///< segment; empty of a jump that no branch passes
};

/// A range of λ over which the same segments are there and the same stable one has the least energy.
struct BranchMapRange {
  double low = 0.0, high = 0.0;
  std::vector<std::size_t> states{}, stable{};  ///< segments
  std::optional<std::size_t> least{};           ///< of the stable ones that of least energy
};

/// How the branches of a run hang together.
struct BranchMap {
  std::vector<BranchMapSegment> segments{};
  std::vector<BranchMapEdge> edges{};
  std::vector<BranchMapRange> ranges{};  ///< by λ
};

/// Empty for a run in load increments or in stages. `record` is a run of `model`.
BranchMap branch_map_of(const Model& model, const Record& record);

/// The energy of a segment at a λ of its range, by cubics between its points with their slopes; next to a
/// turning point of λ by a parabola.
double energy_at(const BranchMapSegment& segment, const Record& record, double lambda);

}  // namespace arcwall
