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

/// What the unknowns of a system mean where that changes along a path: a mesh whose nodes move, say. Immutable; only
/// the system that made it looks inside.
class Layout {
 public:
  virtual ~Layout() = default;
};

/// Which contacts are closed, per contact 0 (open) or 1 (closed), and what the unknowns mean. The equations are smooth
/// on one piece. Behind the contacts stand the *kinks* of laws of straight pieces: 0 up to a kink, 1 beyond it.
class Piece {
 public:
  Piece() = default;
  Piece(std::initializer_list<std::uint8_t> closed) : closed_(closed) {}
  Piece(std::size_t contacts, std::uint8_t closed, std::shared_ptr<const Layout> layout = nullptr)
      : closed_(contacts, closed), layout_(std::move(layout)) {}

  std::size_t size() const { return closed_.size(); }
  bool empty() const { return closed_.empty(); }
  std::uint8_t operator[](std::size_t contact) const { return closed_[contact]; }
  std::uint8_t& operator[](std::size_t contact) { return closed_[contact]; }
  auto begin() const { return closed_.begin(); }
  auto end() const { return closed_.end(); }

  /// Null where the unknowns always mean the same.
  const std::shared_ptr<const Layout>& layout() const { return layout_; }

  /// The same layout with no contact closed and all kinks ahead.
  Piece all_open() const {
    Piece piece(size(), 0, layout_);
    piece.kinks_ = kinks_;
    return piece;
  }

  /// Number of kinks, which stand last, and of what stands before them.
  std::size_t kinks() const { return kinks_; }
  std::size_t contacts() const { return size() - kinks_; }

  /// The same contacts and layout with these statuses of kinks behind them.
  Piece with_kinks(std::span<const std::uint8_t> status) const {
    Piece piece = *this;
    piece.closed_.resize(contacts());
    piece.closed_.insert(piece.closed_.end(), status.begin(), status.end());
    piece.kinks_ = status.size();
    return piece;
  }
  Piece with_kinks_of(const Piece& other) const {
    return with_kinks(std::span(other.closed_).subspan(other.contacts()));
  }

  /// Number of closed contacts.
  Index closed_count() const {
    return std::count(begin(), begin() + static_cast<std::ptrdiff_t>(contacts()), std::uint8_t{1});
  }

  bool operator==(const Piece&) const = default;

 private:
  std::vector<std::uint8_t> closed_;
  std::size_t kinks_ = 0;
  std::shared_ptr<const Layout> layout_;
};

/// All that varies along a path.
struct State {
  Vector x{};           ///< unknowns; their number depends on the piece
  double lambda = 0.0;  ///< the path parameter
  Piece piece{};        ///< empty for a system without guards

  friend bool operator==(const State& a, const State& b) {
    return a.piece == b.piece && a.lambda == b.lambda && a.x.size() == b.x.size() && a.x == b.x;
  }
};

/// A covector of (x, λ): the derivative of one scalar function of the state.
struct Row {
  Vector dx{};
  double dlambda = 0.0;
};

/// A vector of (x, λ): a tangent, or the difference of two states on one piece.
struct Direction {
  Vector dx{};
  double dlambda = 0.0;
};

/// The row applied to the direction.
inline double apply(const Row& row, const Direction& direction) {
  return row.dx.dot(direction.dx) + row.dlambda * direction.dlambda;
}

/// from + s · direction, on the piece of `from`.
inline State moved(const State& from, const Direction& direction, double s) {
  return {.x = from.x + s * direction.dx, .lambda = from.lambda + s * direction.dlambda, .piece = from.piece};
}

/// to − from; both on one piece.
inline Direction difference(const State& to, const State& from) {
  return {.dx = to.x - from.x, .dlambda = to.lambda - from.lambda};
}

}  // namespace arcwall
