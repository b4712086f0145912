#pragma once

#include "apps/verify/findings.hpp"
#include "apps/verify/plain_wall.hpp"
#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall::verify {

/// Whether no wall was passed through from one point of a branch to the next, by moving contact points: the way forth
/// along a member before and back along it behind goes round no place inside a wall.
void check_passages(const Model& model, const std::vector<PlainWall>& walls, const RecordPoint& from,
                    const RecordPoint& to, Findings& findings);

}  // namespace arcwall::verify
