#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace arcwall {

/// A value that is made when it is first asked for: of several that are offered, most may never be.
template <typename Value>
class Deferred {
 public:
  Deferred() : Deferred(Value{}) {}
  Deferred(Value value) : value_(std::move(value)) {}

  /// `make` owns what it needs, or names what outlives this.
  explicit Deferred(std::function<Value()> make) : make_(std::move(make)) {}

  /// Not from several threads at a time.
  const Value& get() const {
    if (!value_) value_ = make_();
    return *value_;
  }

 private:
  std::function<Value()> make_{};
  mutable std::optional<Value> value_{};
};

}  // namespace arcwall
