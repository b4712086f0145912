#include "apps/output/files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/error.hpp"
#include "tests/apps/output/temporary_folder.hpp"

namespace arcwall::files_test {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

std::string refusal(const fs::path& folder, const std::string& deck) {
  try {
    require_usable(folder, deck, Foreign::refuse);
  } catch (const OutputError& problem) {
    return problem.what();
  }
  return {};
}

TEST(WriteWhole, ReplacesAFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  put(folder / "path.csv", "old and longer");

  write_whole(folder / "path.csv", "new");

  EXPECT_EQ(content(folder / "path.csv"), "new");
  EXPECT_EQ(names_in(folder.path()), Names{"path.csv"});
}

TEST(WriteWhole, NamesTheFileAndTheReasonWhenTheFolderIsMissing) {
  const TemporaryFolder folder;
  try {
    write_whole(folder / "gone" / "path.csv", "text");
    FAIL();
  } catch (const OutputError& problem) {
    EXPECT_EQ(problem.what(),
              (folder / "gone" / "path.csv").string() + ": cannot be written: No such file or directory");
  }
}

// By its superuser a program may rename a file to /dev/null.
TEST(WriteWhole, LeavesDevicesAndPipesInTheirPlaces) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(write_whole(pipe, "text"), OutputError);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(names_in(folder.path()), Names{"pipe"});
}

TEST(WriteWhole, LeavesNoTemporaryWhenItCannotReplace) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "path.csv");

  EXPECT_THROW(write_whole(folder / "path.csv", "text"), OutputError);

  EXPECT_EQ(names_in(folder.path()), Names{"path.csv"});
}

TEST(FileSet, PutsAllFilesInPlaceOrNone) {
  const TemporaryFolder folder;
  put(folder / "path.csv", "old");
  const OutputFolder output(folder.path(), "deck.toml", Foreign::overwrite);
  {
    FileSet files(output);
    files.write("path.csv", "new");
    EXPECT_THROW(files.write("gone/events.json", "new"), OutputError);
  }
  EXPECT_EQ(content(folder / "path.csv"), "old");
  EXPECT_EQ(names_in(folder.path()), (Names{folder_lock_name, "path.csv"}));

  FileSet files(output);
  files.write("path.csv", "new");
  files.write("events.json", "new too");
  files.put_in_place();
  EXPECT_EQ(content(folder / "path.csv"), "new");
  EXPECT_EQ(names_in(folder.path()), (Names{folder_lock_name, "events.json", "path.csv"}));
}

TEST(OutputFolder, IsMadeWithItsParents) {
  const TemporaryFolder folder;

  const OutputFolder output(folder / "a" / "b", "deck.toml", Foreign::refuse);
  output.write_whole("path.csv", "text");

  EXPECT_EQ(names_in(folder / "a" / "b"), (Names{folder_lock_name, "path.csv"}));
}

TEST(OutputFolder, GoesAwayIfNothingWasWritten) {
  const TemporaryFolder folder;
  { const OutputFolder output(folder / "new", "deck.toml", Foreign::refuse); }
  EXPECT_FALSE(fs::exists(folder / "new"));

  fs::create_directory(folder / "old");
  { const OutputFolder output(folder / "old", "deck.toml", Foreign::refuse); }
  EXPECT_TRUE(fs::exists(folder / "old"));
}

TEST(OutputFolder, ThatVanishesIsAnError) {
  const TemporaryFolder folder;
  const OutputFolder output(folder / "out", "deck.toml", Foreign::refuse);
  fs::remove_all(folder / "out");

  EXPECT_THROW(output.write_whole("path.csv", "text"), OutputError);
}

TEST(OutputFolder, BelowAFileIsAnErrorAtOnce) {
  const TemporaryFolder folder;
  put(folder / "file", "text");
  EXPECT_THROW(OutputFolder(folder / "file", "deck.toml", Foreign::overwrite), OutputError);
  EXPECT_THROW(OutputFolder(folder / "file" / "out", "deck.toml", Foreign::overwrite), OutputError);
}

TEST(OutputFolder, FilledByTheSameDeckIsUsedAgain) {
  const TemporaryFolder folder;
  put(folder / "result.json", R"({"deck": {"file": "deck.toml"}})");
  EXPECT_EQ(refusal(folder.path(), "deck.toml"), "");
}

TEST(OutputFolder, FilledByAnotherDeckIsRefused) {
  const TemporaryFolder folder;
  put(folder / "result.json", R"({"deck": {"file": "other.toml"}})");

  const std::string message = refusal(folder.path(), "deck.toml");

  EXPECT_NE(message.find("other.toml"), std::string::npos) << message;
  EXPECT_NE(message.find("--out"), std::string::npos) << message;
  EXPECT_NE(message.find("--force"), std::string::npos) << message;
  EXPECT_NO_THROW(require_usable(folder.path(), "deck.toml", Foreign::overwrite));
}

TEST(OutputFolder, WithFilesOfSomeoneElseIsRefused) {
  for (const char* result : {"", "{", "[1]", R"({"deck": 3})", R"({"deck": {"file": 3}})"}) {
    const TemporaryFolder folder;
    put(folder / "result.json", result);
    EXPECT_NE(refusal(folder.path(), "deck.toml"), "") << result;
  }
  const TemporaryFolder folder;
  put(folder / ".hidden", "");
  EXPECT_NE(refusal(folder.path(), "deck.toml"), "");
}

}  // namespace
}  // namespace arcwall::files_test
