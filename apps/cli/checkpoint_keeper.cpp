#include "apps/cli/checkpoint_keeper.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <utility>

#include "core/error.hpp"

namespace arcwall {

CheckpointKeeper::CheckpointKeeper(const OutputFolder& folder, std::chrono::duration<double> pause, Bytes bytes)
    : folder_(folder),
      pause_(pause),
      bytes_(std::move(bytes)),
      next_(Clock::now() + std::chrono::milliseconds(pause.count() == 0.0 ? 0 : 100)) {}

void CheckpointKeeper::keep_now_and_then() {
  if (Clock::now() < next_) return;
  try {
    keep({});
  } catch (const OutputError& problem) {  // the files at the end may still find room
    if (!std::exchange(warned_, true)) std::cerr << "warning: no checkpoint: " << problem.what() << "\n";
  }
}

void CheckpointKeeper::keep(const std::optional<BranchEnd>& stopped) {
  constexpr double part = 0.05;  // of the time, at most
  const Clock::time_point before = Clock::now();
  folder_.write_durably("checkpoint", bytes_(stopped));
  const std::chrono::duration<double> taken = Clock::now() - before;
  next_ = Clock::now() + std::max(pause_, taken / part);
  if (pause_.count() == 0.0) next_ = before;
}

void CheckpointKeeper::drop() {
  std::error_code error;
  std::filesystem::remove(folder_.path() / "checkpoint", error);
  if (error) throw OutputError((folder_.path() / "checkpoint").string() + ": cannot be removed: " + error.message());
}

}  // namespace arcwall
