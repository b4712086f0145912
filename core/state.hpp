#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/types.hpp"

namespace arcwall {

/// Identifies a layout of degrees of freedom that may change along a path, for example a mesh that follows contacts.
/// Immutable and opaque: only the system that created it reads it.
class Layout {
 public:
  virtual ~Layout() = default;
};

/// Stores an active set: one status a contact, 0 (open) or 1 (closed), and the layout of the degrees of freedom.
/// The equations are smooth as long as the active set is constant. The last entries are the *kinks* of piecewise linear
/// laws: 0 up to the kink, 1 beyond it.
class ActiveSet {
 public:
  ActiveSet() = default;
  ActiveSet(std::initializer_list<std::uint8_t> closed) : closed_(closed) {}
  ActiveSet(std::size_t contacts, std::uint8_t closed, std::shared_ptr<const Layout> layout = nullptr)
      : closed_(contacts, closed), layout_(std::move(layout)) {}

  std::size_t size() const { return closed_.size(); }
  bool empty() const { return closed_.empty(); }
  std::uint8_t operator[](std::size_t contact) const { return closed_[contact]; }
  std::uint8_t& operator[](std::size_t contact) { return closed_[contact]; }
  auto begin() const { return closed_.begin(); }
  auto end() const { return closed_.end(); }

  /// Returns the layout; null if the system has only one.
  const std::shared_ptr<const Layout>& layout() const { return layout_; }

  /// Returns the same layout with all contacts open and all kinks 0.
  ActiveSet all_open() const {
    ActiveSet active_set(size(), 0, layout_);
    active_set.kinks_ = kinks_;
    return active_set;
  }

  /// Return the numbers of kinks (last entries) and of contacts (entries before them).
  std::size_t kinks() const { return kinks_; }
  std::size_t contacts() const { return size() - kinks_; }

  /// Returns the same contacts and layout with other kink statuses, each 0 or 1.
  ActiveSet with_kinks(std::span<const std::uint8_t> status) const {
    ActiveSet active_set = *this;
    active_set.closed_.resize(contacts());
    active_set.closed_.insert(active_set.closed_.end(), status.begin(), status.end());
    active_set.kinks_ = status.size();
    return active_set;
  }
  ActiveSet with_kinks_of(const ActiveSet& other) const {
    return with_kinks(std::span(other.closed_).subspan(other.contacts()));
  }

  /// Returns the number of closed contacts.
  Index closed_count() const {
    return std::count(begin(), begin() + static_cast<std::ptrdiff_t>(contacts()), std::uint8_t{1});
  }

  bool operator==(const ActiveSet&) const = default;

 private:
  std::vector<std::uint8_t> closed_;
  std::size_t kinks_ = 0;
  std::shared_ptr<const Layout> layout_;
};

/// Stores one point of an equilibrium path.
struct State {
  Vector x{};              ///< unknowns; Equations::size(active_set) entries
  double lambda = 0.0;     ///< load factor λ [-]
  ActiveSet active_set{};  ///< active set; empty for a system without contacts

  friend bool operator==(const State& a, const State& b) {
    return a.active_set == b.active_set && a.lambda == b.lambda && a.x.size() == b.x.size() && a.x == b.x;
  }
};

/// Stores the derivative of a scalar function of the state by (x, λ).
struct Row {
  Vector dx{};
  double dlambda = 0.0;
};

/// Stores a vector of (x, λ): a tangent, or the difference of two states with one active set.
struct Direction {
  Vector dx{};
  double dlambda = 0.0;
};

/// Returns the directional derivative row · direction; both have the same size.
inline double apply(const Row& row, const Direction& direction) {
  return row.dx.dot(direction.dx) + row.dlambda * direction.dlambda;
}

/// Returns from + s · direction, with the active set of `from`.
inline State moved(const State& from, const Direction& direction, double s) {
  return {.x = from.x + s * direction.dx, .lambda = from.lambda + s * direction.dlambda, .active_set = from.active_set};
}

/// Returns to − from; both states have the same active set.
inline Direction difference(const State& to, const State& from) {
  return {.dx = to.x - from.x, .dlambda = to.lambda - from.lambda};
}

}  // namespace arcwall
