// Four elements of a mesh that slides, side by side.
#include <algorithm>

#include "elements/sliding_mesh.hpp"

namespace arcwall {

void SlidingStructureMesh::number_fours() {
  Index breakpoint = 0;  // the next one
  for (Index r = 0; r < structure_.strands(); ++r) {
    const std::vector<MeshSegment>& segments = cut_[static_cast<std::size_t>(r)];
    Index first = 0, before = held;
    for (std::size_t segment = 0; segment < segments.size(); ++segment) {
      const bool last = segment + 1 == segments.size();
      const Index behind = last || segments[segment].ends_at_load() ? held : breakpoint++;
      const int n = segments[segment].elements;
      if (segments[segment].straight) {  // its element is of another kind
        first += n;
        before = behind;
        continue;
      }
      for (int i = 0; i < n; i += Lanes::count) {
        Four four{.strand = r,
                  .position = first + i,
                  .count = std::min(Lanes::count, n - i),
                  .breakpoint = {before, behind},
                  .from_first = {},
                  .shifted = false,
                  .inside = false};
        for (int k = 0; k <= Lanes::count; ++k) four.from_first[static_cast<std::size_t>(k)] = double(i + k) / n;
        const bool has_displaced =
            has_displaced_end(r, four.position) || has_displaced_end(r, four.position + four.count - 1);
        if (!structure_.at(r).beams || has_displaced) {
          for (int k = 0; k < four.count; ++k) others_.emplace_back(r, four.position + k);
          continue;
        }
        const Index block = mesh_of(r).first_element + four.position;
        if (four.count == Lanes::count) {
          four.shifted = assembly_.are_shifted(std::array{block, block + 1, block + 2, block + 3});
          four.inside = four.position > 0 && four.position + Lanes::count < mesh_of(r).elements;
        }
        fours_.push_back(four);
      }
      first += n;
      before = behind;
    }
  }
}

// What they are at rest is found once at each node.
template <typename Visit>
void SlidingStructureMesh::for_each_four(const MeshState& now, const Visit& visit) const {
  const Four* before = nullptr;
  Rest behind;  // from where that one ends
  for (const Four& four : fours_) {
    const Index last = four.count - 1;
    if (last + 1 < Lanes::count) {  // the last stands in for those that are missing
      const Rest first = rest_from(four.strand, four.position, four.position + last, now);
      visit(four, first, rest_from(four.strand, four.position + 1, four.position + 1 + last, now));
      before = nullptr;
      continue;
    }
    const Index most = mesh_of(four.strand).elements, end = four.position + Lanes::count;
    const bool goes_on =
        before != nullptr && before->strand == four.strand && before->position + Lanes::count == four.position;
    const Rest first = goes_on ? behind : rest_from(four.strand, four.position, most, now);
    behind = rest_from(four.strand, end, most, now);
    visit(four, first, SlidingBeamLanes::next_of(first, behind));
    before = &four;
  }
}

// The forces of fours, and where `out` is not null the derivatives of these.
void SlidingStructureMesh::add_fours(const MeshState& now, Eigen::Ref<Vector> F, Linearization* out) const {
  for_each_four(
      now, [&](const Four& four, const Rest& first, const Rest& second) { add(four, first, second, now, F, out); });
}

double SlidingStructureMesh::energy_of_fours(const MeshState& now) const {
  double energy = 0.0;
  for_each_four(now, [&](const Four& four, const Rest& first, const Rest& second) {
    const Lanes of_elements = respond(four, first, second, now, SlidingBeamLanes::Wanted::energy).energy;
    for (int lane = 0; lane < four.count; ++lane) energy += of_elements[lane];
  });
  return energy;
}

// At four nodes from one on; at the node `most` for those beyond it.
SlidingBeamLanes::Rest SlidingStructureMesh::rest_from(Index strand, Index position, Index most,
                                                       const MeshState& now) const {
  const SlidingStructure::Run& described = structure_.at(strand);
  const std::vector<Coordinate>& nodes = mesh_of(strand).nodes;
  const auto at = [&](Index k) {
    return described.offset + nodes[static_cast<std::size_t>(std::min(position + k, most))].at(now.s);
  };
  return described.beams->rest_at(Lanes(at(0), at(1), at(2), at(3)));
}

SlidingBeamLanes::Response SlidingStructureMesh::respond(const Four& four, const Rest& at_first, const Rest& at_second,
                                                         const MeshState& now, SlidingBeamLanes::Wanted wanted) const {
  SlidingBeamLanes::End first{.rest = at_first, .x = 0.0, .z = 0.0, .angle = 0.0}, second = first;
  second.rest = at_second;
  if (four.inside) {
    const double* const at = now.x.data() + node_unknowns(four.strand, four.position)[0];
    const auto from = [at](int k) { return Lanes(at[k], at[k + 3], at[k + 6], at[k + 9]); };
    first.x = from(0);
    first.z = from(1);
    first.angle = from(2);
    second.x = from(3);
    second.z = from(4);
    second.angle = from(5);
  } else {
    for (int lane = 0; lane < Lanes::count; ++lane)
      for (SlidingBeamLanes::End* end : {&first, &second}) {
        const Index k = std::min(lane, four.count - 1) + (end == &second ? 1 : 0);
        const AxisPlace place = node(four.strand, four.position + k, now);
        end->x.set(lane, place.position.x());
        end->z.set(lane, place.position.y());
        end->angle.set(lane, place.angle);
      }
  }
  SlidingBeamLanes::Response response;
  structure_.at(four.strand).beams->respond(first, second, wanted, response);
  return response;
}

void SlidingStructureMesh::add(const Four& four, const Rest& at_first, const Rest& at_second, const MeshState& now,
                               Eigen::Ref<Vector> F, Linearization* out) const {
  using Wanted = SlidingBeamLanes::Wanted;
  const bool between_breakpoints = four.breakpoint[0] != held || four.breakpoint[1] != held;
  const Wanted wanted = out == nullptr ? Wanted::force : between_breakpoints ? Wanted::rates : Wanted::stiffness;
  const SlidingBeamLanes::Response response = respond(four, at_first, at_second, now, wanted);
  add_nodal(four, response.force, F.data());
  if (out == nullptr) return;
  const auto entry_of = [&](Index entry, std::size_t lane) {
    return response.stiffness[entry][static_cast<int>(lane)];
  };
  const Index block = mesh_of(four.strand).first_element + four.position;
  if (four.count == Lanes::count) {
    assembly_.add_entries<6>(std::array{block, block + 1, block + 2, block + 3}, four.shifted, out->K.valuePtr(),
                             entry_of);
  } else {
    for (int lane = 0; lane < four.count; ++lane)
      assembly_.add_entries(block + lane, 1.0, out->K.valuePtr(),
                            [&](Index entry) { return entry_of(entry, static_cast<std::size_t>(lane)); });
  }
  for (std::size_t b = 0; b < 2; ++b) {
    if (four.breakpoint[b] == held) continue;
    const auto weights = [&](std::size_t k) {
      const auto& r = four.from_first;
      const Lanes second_part(r[k], r[k + 1], r[k + 2], r[k + 3]);
      return b == 0 ? 1.0 - second_part : second_part;
    };
    const Lanes weight1 = weights(0), weight2 = weights(1);
    Lanes rates[6];
    for (int i = 0; i < 6; ++i) rates[i] = weight1 * response.force_rate[0][i] + weight2 * response.force_rate[1][i];
    add_nodal(four, rates, out->B.col(four.breakpoint[b]).data());
  }
}

// What the elements of a four give their nodes, in x1, z1, angle1, x2, z2, angle2.
void SlidingStructureMesh::add_nodal(const Four& four, const Lanes* of_elements, double* to) const {
  if (four.inside) {
    double* const at = to + node_unknowns(four.strand, four.position)[0];
    for (int i = 0; i < 3; ++i) {
      const Lanes first = of_elements[i], second = of_elements[3 + i];
      at[i] += first[0];
      for (int k = 1; k < Lanes::count; ++k) at[3 * k + i] += second[k - 1] + first[k];
      at[3 * Lanes::count + i] += second[Lanes::count - 1];
    }
    return;
  }
  for (int lane = 0; lane < four.count; ++lane) {
    const auto unknowns = assembly_.unknowns(mesh_of(four.strand).first_element + four.position + lane);
    for (std::size_t i = 0; i < 6; ++i)
      if (unknowns[i] != held) to[unknowns[i]] += of_elements[i][lane];
  }
}

}  // namespace arcwall
