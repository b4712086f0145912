#pragma once

#include <filesystem>

namespace arcwall {

/// The file that marks a folder as one that a process writes into. It holds the process's id and machine.
inline constexpr const char* folder_lock_name = ".lock";

/// While it lives, no other process has one of the same folder. The system lets go of it when this process ends,
/// whatever ends it. On file systems that cannot lock it holds nobody off.
class FolderLock {
 public:
  /// Throws OutputError, which names the process that has the folder, if there is one, or the system's reason. The
  /// folder is there.
  explicit FolderLock(std::filesystem::path folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// The file goes away.
  ~FolderLock();

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace arcwall
