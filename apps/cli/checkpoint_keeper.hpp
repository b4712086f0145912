#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "apps/output/files.hpp"
#include "continuation/path_point.hpp"

namespace arcwall {

/// Writes checkpoints into a folder now and then, so seldom that they take a small part of the time. What takes a
/// moment needs none on its way.
class CheckpointKeeper {
 public:
  /// The bytes of a checkpoint of what is traced; its argument is the reason from outside for which that ends, if there
  /// is one.
  using Bytes = std::function<std::string(const std::optional<BranchEnd>&)>;

  /// `pause`: at least, between two checkpoints; 0 for one whenever it is asked.
  CheckpointKeeper(const OutputFolder& folder, std::chrono::duration<double> pause, Bytes bytes);

  /// Where files cannot be written a warning says so, once.
  void keep_now_and_then();

  /// Throws OutputError.
  void keep(const std::optional<BranchEnd>& stopped);

  /// Takes the checkpoint away. Throws OutputError.
  void drop();

 private:
  using Clock = std::chrono::steady_clock;

  const OutputFolder& folder_;
  std::chrono::duration<double> pause_;
  Bytes bytes_;
  std::chrono::time_point<Clock, std::chrono::duration<double>> next_;  // however far ahead
  bool warned_ = false;
};

}  // namespace arcwall
