#include "contact/sliding/layout_edit.hpp"

#include <algorithm>

namespace arcwall::sliding {

namespace {

template <typename T>
void insert_at(std::vector<T>& values, std::size_t at, T value) {
  values.insert(values.begin() + static_cast<std::ptrdiff_t>(at), value);
}

template <typename T>
void erase_at(std::vector<T>& values, std::size_t at) {
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(at));
}

Vector inserted(const Vector& s, std::size_t at, double value) {
  const auto k = static_cast<Index>(at);
  Vector out(s.size() + 1);
  out << s.head(k), value, s.tail(s.size() - k);
  return out;
}

Vector erased(const Vector& s, std::size_t at) {
  const auto k = static_cast<Index>(at);
  Vector out(s.size() - 1);
  out << s.head(k), s.tail(s.size() - k - 1);
  return out;
}

// How many points of a strand lie before one of them.
std::size_t points_before(const std::vector<Index>& strands, std::size_t point) {
  return static_cast<std::size_t>(
      std::count(strands.begin(), strands.begin() + static_cast<std::ptrdiff_t>(point), strands[point]));
}

}  // namespace

int& LayoutEdit::segment(std::size_t point, std::size_t beyond) {
  return elements[static_cast<std::size_t>(strands[point])][points_before(strands, point) + beyond];
}

std::size_t LayoutEdit::insert(const Entry& entry, int elements_before, int elements_behind) {
  std::size_t k = 0;
  while (k < points.size() &&
         (strands[k] < entry.strand || (strands[k] == entry.strand && s[static_cast<Index>(k)] < entry.s)))
    ++k;
  insert_at(points, k, entry.point);
  insert_at(strands, k, entry.strand);
  insert_at(closed, k, static_cast<std::uint8_t>(entry.closed));
  insert_at(forces, k, entry.force);
  s = inserted(s, k, entry.s);
  const std::size_t before = points_before(strands, k);
  std::vector<int>& in_strand = elements[static_cast<std::size_t>(entry.strand)];
  in_strand[before] = elements_before;
  insert_at(in_strand, before + 1, elements_behind);
  return k;
}

void LayoutEdit::erase(std::size_t point, int of_both) {
  const std::size_t before = points_before(strands, point);
  std::vector<int>& in_strand = elements[static_cast<std::size_t>(strands[point])];
  in_strand[before] = of_both;
  erase_at(in_strand, before + 1);
  erase_at(points, point);
  erase_at(strands, point);
  erase_at(closed, point);
  erase_at(forces, point);
  s = erased(s, point);
}

LayoutEdit edit_of(const SlidingState& at) {
  LayoutEdit edit{.elements = at.mesh.elements_per_segment(), .points = at.layout.points(), .s = at.now.s};
  for (std::size_t k = 0; k < edit.points.size(); ++k) {
    edit.strands.push_back(at.mesh.breakpoint(static_cast<Index>(k)).first);
    edit.closed.push_back(at.is_closed(k));
    edit.forces.push_back(at.force(k));
  }
  return edit;
}

std::shared_ptr<const SlidingContactLayout> layout_of(const SlidingBody& body, const LayoutEdit& edit) {
  return std::make_shared<SlidingContactLayout>(body, body.mesh(edit.elements), edit.points, edit.s);
}

}  // namespace arcwall::sliding
