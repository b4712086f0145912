#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace arcwall {

/// A value that is made when it is first asked for: of several that are offered, most may never be. Copies from before
/// that make their own.
template <typename Value>
class Deferred {
 public:
  Deferred() : Deferred(Value{}) {}
  Deferred(Value value) : value_(std::move(value)) {}

  /// `make` owns what it needs, or names what outlives this.
  explicit Deferred(std::function<Value()> make) : make_(std::move(make)) {}

  /// Not from several threads at a time.
  const Value& get() const {
    if (!value_) value_ = std::exchange(make_, nullptr)();
    return *value_;
  }

 private:
  mutable std::function<Value()> make_{};  // none once there is a value
  mutable std::optional<Value> value_{};
};

}  // namespace arcwall
