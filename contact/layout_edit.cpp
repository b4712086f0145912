#include "contact/layout_edit.hpp"

#include <algorithm>

namespace arcwall {

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
  return cut[static_cast<std::size_t>(strands[point])][points_before(strands, point) + beyond];
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
  std::vector<int>& elements = cut[static_cast<std::size_t>(entry.strand)];
  elements[before] = elements_before;
  insert_at(elements, before + 1, elements_behind);
  return k;
}

void LayoutEdit::erase(std::size_t point, int elements) {
  const std::size_t before = points_before(strands, point);
  std::vector<int>& in_run = cut[static_cast<std::size_t>(strands[point])];
  in_run[before] = elements;
  erase_at(in_run, before + 1);
  erase_at(points, point);
  erase_at(strands, point);
  erase_at(closed, point);
  erase_at(forces, point);
  s = erased(s, point);
}

}  // namespace arcwall
