#include "model/deck/toml_source.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::deck::toml_source_test {

namespace {

using namespace std::string_literals;

// The only diagnostic, or one without a message if the text is read.
Diagnostic refusal(const std::string& text) {
  try {
    parse_toml(text, "bad.toml");
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().size(), 1u);
    EXPECT_EQ(error.diagnostics().front().file, "bad.toml");
    return error.diagnostics().front();
  }
  return {};
}

void expect_refused(const std::string& text, int line, const std::string& message) {
  const Diagnostic found = refusal(text);
  EXPECT_EQ(found.line, line) << text.substr(0, 80) << ": " << found.message;
  EXPECT_NE(found.message.find(message), std::string::npos) << text.substr(0, 80) << ": " << found.message;
}

std::string repeated(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

std::string file_refusal(const std::string& file) {
  try {
    read_text_file(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Any outcome but a table or an InputError is a defect.
bool is_read(const std::string& text) {
  try {
    read_deck_text(text, "mutated.toml");
    return true;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.diagnostics().empty());
    return false;
  }
}

// A directory of this process that is gone after the test.
class TomlFile : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(directory_); }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  std::string written(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

 private:
  std::filesystem::path directory_ =
      std::filesystem::path(::testing::TempDir()) /
      ("arcwall-toml-"s + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace

TEST(TomlSource, KeepsKindsPlacesAndOrder) {
  const Value root = parse_toml("z = 1\na = 2.5\n[t]\ns = 'text'\nb = true\nl = [1, 'x']\nd = 1979-05-27\n", "a.toml");

  ASSERT_EQ(root.items.size(), 3u);
  EXPECT_EQ(root.items[0].key, "z");
  EXPECT_EQ(root.items[0].kind, Value::Kind::integer);
  EXPECT_EQ(root.items[0].number, 1.0);
  EXPECT_EQ(root.items[1].kind, Value::Kind::number);
  EXPECT_EQ(root.items[1].position.line, 2);
  EXPECT_EQ(root.items[1].position.column, 5);
  EXPECT_EQ(root.items[1].key_position.column, 1);
  const Value& table = root.items[2];
  EXPECT_EQ(table.items.at(0).string, "text");
  EXPECT_TRUE(table.items.at(1).boolean);
  EXPECT_EQ(table.items.at(2).items.at(1).string, "x");
  EXPECT_EQ(table.items.at(3).kind, Value::Kind::date);
}

TEST(TomlSource, AcceptsAnEmptyTextAByteOrderMarkAndBothLineEndings) {
  EXPECT_TRUE(parse_toml("", "a.toml").items.empty());
  EXPECT_TRUE(parse_toml("\xEF\xBB\xBF", "a.toml").items.empty());
  EXPECT_EQ(parse_toml("\xEF\xBB\xBF"s + "a = 1\r\nb = 2\r\n", "a.toml").items.at(1).position.line, 2);
  EXPECT_TRUE(is_read("\xEF\xBB\xBF" + std::string(column_deck)));
  std::string windows;
  for (const char c : column_deck) windows += c == '\n' ? "\r\n"s : std::string(1, c);
  EXPECT_TRUE(is_read(windows));
}

TEST(TomlSource, RefusesBytesThatAreNoText) {
  expect_refused("a = 1\nb = \0"s, 2, "NUL");
  expect_refused("a = 1\n# bell \a\n", 2, "control character");
  expect_refused("a = 1\rb = 2\n", 1, "control character");
  expect_refused("a = '\x7F'", 1, "control character");
  for (const char* bytes : {"\xFF", "\x80", "\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF0\x80\x80\xAF",
                            "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "\xE2\x82"}) {
    expect_refused("a = 1\n\nb = \"" + std::string(bytes) + "\"", 3, "UTF-8");
  }
  EXPECT_EQ(parse_toml("a = \"é λ € 𝄞\"", "a.toml").items.at(0).string, "é λ € 𝄞");
}

TEST(TomlSource, RefusesWhatIsTooLargeOrTooDeep) {
  expect_refused("\n\na = \"" + std::string(2'000'000, 'x') + "\"", 3, "longer than 1048576");
  expect_refused(std::string(2'000'000, 'x'), 1, "longer than 1048576");
  expect_refused(std::string(17u << 20u, '\n'), 0, "larger than 16 MB");
  expect_refused("\na = " + std::string(60'000, '['), 2, "nested deeper");
  expect_refused("a = " + repeated("[", 33) + repeated("]", 33), 1, "nested deeper");
  expect_refused("a = " + repeated("{a=", 5000), 1, "nested deeper");
  expect_refused("a = " + repeated("[\n", 100'000), 33, "nested deeper");
  expect_refused("[" + repeated("a.", 20'000) + "a]", 1, "key of more than");
  expect_refused(repeated("a.", 32) + "a = 1", 1, "key of more than");
  expect_refused(repeated("'a' . ", 32) + "a = 1", 1, "key of more than");
}

TEST(TomlSource, AcceptsWhatIsJustWithinItsLimits) {
  EXPECT_EQ(refusal("a = " + repeated("[", 32) + repeated("]", 32)).message, "");
  EXPECT_EQ(refusal(repeated("a.", 31) + "a = 1").message, "");
  EXPECT_EQ(refusal("a = '" + std::string(65'000, 'x') + "'").message, "");
  EXPECT_EQ(refusal("# " + repeated("[", 1000)).message, "");
  EXPECT_EQ(refusal("a = '" + repeated("[", 1000) + "'").message, "");
  EXPECT_EQ(refusal("a = \"\\\"" + repeated("{", 1000) + "\"").message, "");
  EXPECT_EQ(refusal("a = '''\n" + repeated("[.", 1000) + "\n'''''").message, "");
  EXPECT_EQ(refusal("a = \"\"\"\\\"\"" + repeated("[.", 1000) + "\"\"\"").message, "");
  EXPECT_EQ(refusal(repeated("[[a]]\nb.c = [1.5, 2.5]\n", 1000)).message, "");
}

TEST(TomlSource, RefusesWhatIsNotToml) {
  expect_refused("a = 1\na = 2", 2, "cannot redefine");
  expect_refused("[a]\n[a]", 2, "cannot redefine");
  expect_refused("a = \"unterminated", 1, "");
  expect_refused("a = \"unterminated\nb = 1", 1, "");
  expect_refused("a = '''unterminated\n\n", 2, "end-of-file");
  expect_refused("a = [1, 2", 1, "");
  expect_refused("a = {b = 1", 1, "");
  expect_refused("a = \"\\uD800\"", 1, "");
  expect_refused("a = \"\\uDFFF\\uD800\"", 1, "");
  expect_refused("a = \"\\U00110000\"", 1, "");
  expect_refused("a = \"\\q\"", 1, "");
  expect_refused("a = 1e400", 1, "1e400");
  expect_refused("a = 99999999999999999999", 1, "");
  expect_refused("a = " + std::string(300, '9'), 1, "");
  expect_refused("a = 1" + std::string(300, '0') + ".0", 1, "");
  expect_refused("a = 1979-13-41", 1, "");
  expect_refused("a 1", 1, "");
  expect_refused("a =", 1, "");
  expect_refused("= 1", 1, "");
}

TEST(TomlSource, KeepsMessagesOnOneLine) {
  const Diagnostic found = refusal("a = tru\nb = 1");

  EXPECT_EQ(found.line, 1);
  EXPECT_EQ(to_text(found).find('\n'), std::string::npos) << to_text(found);
}

// Invalid documents on which the parser's own assertions fail.
TEST(TomlSource, SurvivesWhatTheParserTakesForImpossible) {
  expect_refused("a = 1\n[=]", 2, "table header");
  expect_refused("a = 1\n[[ = ]]", 2, "table header");
  expect_refused("a = 1\n[\n", 2, "table header");
  expect_refused("a = 1\nb = [ } ]\n", 2, "not valid TOML");
  expect_refused("a = 1\nb = [ 1, } ]\nc = 2\n", 2, "not valid TOML");
  expect_refused("a = { b = ] }\n", 1, "not valid TOML");
  expect_refused("a.\n", 1, "");
  expect_refused("a.=1\n", 1, "");
  expect_refused("[a.]\n", 1, "");
  expect_refused("a = +", 1, "");
  expect_refused("a = 0x", 1, "");
  expect_refused("a = -_1", 1, "");
}

// Letters from U+00A1 to U+0499 and from U+FB26 on where the parser asks whether they are spaces.
TEST(TomlSource, TakesLettersBeyondAsciiForNoSpaces) {
  for (const char* letter : {"é", "λ", "ﭐ"}) {
    expect_refused("title = 1\n" + "n"s + letter + " = 2\n", 2, "not valid TOML");
    expect_refused("title = 1"s + letter + "\n", 1, "not valid TOML");
    const Value root = parse_toml("title = \"\"\"a \\\n  "s + letter + "\"\"\"\n", "deck.toml");
    EXPECT_EQ(find(root, "title")->string, "a "s + letter);
  }
}

TEST(TomlSource, AssignsToTablesArraysAndNewPlaces) {
  Value root = parse_toml("[t]\na = 1\n[[l]]\nb = 1\n", "a.toml");

  assign(root, "t.a = 'new'", 1);
  assign(root, "l.0.b=2", 2);
  assign(root, "x.y.\"z w\"=[1, {q = 2}]", 3);

  EXPECT_EQ(root.items.at(0).items.at(0).string, "new");
  EXPECT_EQ(root.items.at(0).items.at(0).key, "a");
  EXPECT_EQ(root.items.at(0).items.at(0).position.assignment, 1);
  EXPECT_EQ(root.items.at(0).position.assignment, 0);
  EXPECT_EQ(root.items.at(1).items.at(0).items.at(0).integer, 2);
  const Value& made = root.items.at(2).items.at(0).items.at(0);
  EXPECT_EQ(made.key, "z w");
  EXPECT_EQ(made.items.at(1).items.at(0).position.assignment, 3);
}

TEST(TomlSource, RefusesAssignmentsThatMakeNoSense) {
  for (const char* assignment :
       {"", "a", "a=", "=1", "a=b", "a=1\nb=2", "[a]", "[[a]]", "a=1 b=2", "# comment", "a.b.=1", "l.1.b=1", "l.b=1",
        "l.-1.b=1", "t.a.b=1", "a=[}]", "a=\x01", "a=\"\xFF\"", "a=nan nan"}) {
    Value root = parse_toml("[t]\na = 1\n[[l]]\nb = 1\n", "a.toml");
    EXPECT_THROW(assign(root, assignment, 1), InputError) << assignment;
  }
}

TEST_F(TomlFile, ReadsTheBytesOfARegularFile) {
  EXPECT_EQ(read_text_file(written("a.toml", "a = 1\r\n")), "a = 1\r\n");
  EXPECT_EQ(read_text_file(written("empty.toml", "")), "");
  EXPECT_EQ(read_deck(written("deck.toml", std::string(column_deck))).title, "Column");
}

TEST_F(TomlFile, RefusesWhatIsNoRegularFile) {
  EXPECT_NE(file_refusal(path("")).find("is a directory"), std::string::npos);
  EXPECT_NE(file_refusal(path("missing.toml")).find("no such file"), std::string::npos);
  EXPECT_NE(file_refusal("").find("no such file"), std::string::npos);
  EXPECT_NE(file_refusal(written("a", "") + "/b"), "");
  EXPECT_NE(file_refusal("/dev/null").find("not a regular file"), std::string::npos);
  EXPECT_THROW(read_deck(path("empty.toml")), InputError);
}

TEST_F(TomlFile, RefusesAFileThatIsTooLargeWithoutReadingIt) {
  const std::string file = written("large.toml", "");
  std::filesystem::resize_file(file, 1ull << 36u);  // sparse: nothing is stored

  EXPECT_THROW(read_deck(file), InputError);
}

// Whatever bytes of a deck change, it is read or refused. Seeds are fixed, so a failure comes again.
TEST(TomlSource, SurvivesMutatedDecks) {
  constexpr std::string_view bytes = "[]{}=.,\"'#\\\n\r\t -+_0123456789eEaxXinfu:TZ\x01\x7F\xC3\xA9\xFF";
  std::mt19937 random(20240611);
  const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int read = 0;
  for (int round = 0; round < 1500; ++round) {
    std::string text(full_deck);
    for (std::size_t change = 0; change <= below(4); ++change) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = bytes[below(bytes.size())];
          break;
        case 1:
          text.insert(at, 1, bytes[below(bytes.size())]);
          break;
        case 2:
          text.erase(at, 1 + below(20));
          break;
        default:
          text.insert(at, text.substr(below(text.size()), 1 + below(40)));
      }
    }
    if (is_read(text)) ++read;
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, 1500);
}

TEST(TomlSource, SurvivesEveryTruncationOfADeck) {
  for (std::size_t length = 0; length < column_deck.size(); ++length) {
    is_read(std::string(column_deck.substr(0, length)));
  }
}

}  // namespace arcwall::deck::toml_source_test
