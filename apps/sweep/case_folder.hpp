#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace arcwall::sweep {

/// The folder with the results of a case, below that of the sweep: `cases/00042`. Where it is, it is whole.
std::filesystem::path case_folder(const std::filesystem::path& sweep_folder, int number);

/// Whether the case has results.
bool is_complete(const std::filesystem::path& sweep_folder, int number);

/// Takes the results of a case away, if there are any. Throws OutputError.
void forget(const std::filesystem::path& sweep_folder, int number);

/// Makes of the results of a case a draft again, from which the next process that claims the case can go on. Throws
/// OutputError.
void reopen(const std::filesystem::path& sweep_folder, int number);

/// Of which cases drafts are there: they are being run, or were begun and can go on.
std::vector<int> begun_cases(const std::filesystem::path& sweep_folder);

/// The folder of a case that is being run: hidden, held by this process alone, and gone in the end unless it was
/// published or left for another process to go on with.
class CaseDraft {
 public:
  /// Empty if another process holds the case, or has published it meanwhile. What a process left that was stopped is in
  /// it. Throws OutputError.
  static std::optional<CaseDraft> claim(const std::filesystem::path& sweep_folder, int number);

  CaseDraft(CaseDraft&& other) noexcept;
  CaseDraft& operator=(CaseDraft&&) = delete;
  CaseDraft(const CaseDraft&) = delete;
  ~CaseDraft();

  const std::filesystem::path& path() const { return path_; }

  /// Descriptor that carries the lock. A process that works on the case inherits it: when this one is killed, the case
  /// is free once that has ended, too, and nothing of it can appear in the folder of the next.
  int lock_descriptor() const { return descriptor_; }

  /// Takes away what is in it. Throws OutputError.
  void clear() const;

  /// Gives the folder its name, in one step.
  void publish();

  /// The folder stays as it is, for whoever claims the case next.
  void leave() { path_.clear(); }

 private:
  CaseDraft(std::filesystem::path path, std::filesystem::path target, int descriptor)
      : path_(std::move(path)), target_(std::move(target)), descriptor_(descriptor) {}

  std::filesystem::path path_, target_;
  int descriptor_;  // of the folder; the lock ends with the processes that have it, whatever ends them
};

}  // namespace arcwall::sweep
