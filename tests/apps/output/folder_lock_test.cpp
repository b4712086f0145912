#include "apps/output/folder_lock.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>

#include "apps/output/files.hpp"
#include "core/error.hpp"
#include "tests/apps/output/temporary_folder.hpp"

namespace arcwall::folder_lock_test {
namespace {

std::string refusal(const std::filesystem::path& folder) {
  try {
    const FolderLock lock(folder);
  } catch (const OutputError& problem) {
    return problem.what();
  }
  return {};
}

TEST(FolderLock, HoldsOthersOffAndNamesItsProcess) {
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    const std::string message = refusal(folder.path());
    EXPECT_NE(message.find("process " + std::to_string(::getpid()) + " is writing into this folder"), std::string::npos)
        << message;
  }
  EXPECT_EQ(refusal(folder.path()), "");
  EXPECT_TRUE(names_in(folder.path()).empty());
}

// A killed process leaves the file, and the system lets go of the lock.
TEST(FolderLock, OfAProcessThatIsGoneHoldsNobodyOff) {
  const TemporaryFolder folder;
  put(folder / folder_lock_name, "1 elsewhere\n");
  EXPECT_EQ(refusal(folder.path()), "");
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(FolderLock, OfAFileOfAnotherKindIsRefused) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / folder_lock_name);
  EXPECT_NE(refusal(folder.path()), "");
}

// Before it, the second of two runs removed what the first was writing.
TEST(FolderLock, LeftoversGoUnderItAlone) {
  const TemporaryFolder folder;
  put(folder / ".path.csv.1", "half a table");
  put(folder / ".notes.txt.1", "somebody's own");
  std::optional<FolderLock> lock(std::in_place, folder.path());
  EXPECT_THROW(OutputFolder(folder.path(), "deck.toml", Foreign::overwrite), OutputError);
  EXPECT_EQ(names_in(folder.path()).count(".path.csv.1"), 1u);
  lock.reset();
  { const OutputFolder output(folder.path(), "deck.toml", Foreign::overwrite); }
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{".notes.txt.1"});
}

}  // namespace
}  // namespace arcwall::folder_lock_test
