#include "apps/output/markup.hpp"

#include <gtest/gtest.h>

namespace arcwall::markup_test {
namespace {

TEST(Markup, PlainKeepsWhatCanBeShown) {
  EXPECT_EQ(plain("Träger λ → 1\n\tand 𝛌"), "Träger λ → 1\n\tand 𝛌");
  EXPECT_EQ(plain(""), "");
}

TEST(Markup, PlainReplacesControlsAndMarksOfDirection) {
  EXPECT_EQ(plain(std::string_view("a\0b\x1b[31m\x7f", 8)), "a\uFFFDb\uFFFD[31m");
  EXPECT_EQ(plain("\u202Egnp.exe\u2066\u200F\u061C"), "\uFFFDgnp.exe\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(plain("a\u2028b\u2029c\u0085"), "a\uFFFDb\uFFFDc\uFFFD");
}

// Table 3-7 of the Unicode standard: well-formed UTF-8.
TEST(Markup, PlainReplacesBytesThatAreNoUtf8) {
  EXPECT_EQ(plain("\xff"), "\uFFFD");
  EXPECT_EQ(plain("\xc3"), "\uFFFD");                                // ends early
  EXPECT_EQ(plain("\xc0\xaf"), "\uFFFD\uFFFD");                      // '/' in two bytes
  EXPECT_EQ(plain("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");            // a surrogate
  EXPECT_EQ(plain("\xf4\x90\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD");  // beyond U+10FFFF
  EXPECT_EQ(plain("\xe2\x82x"), "\uFFFD\uFFFDx");
}

TEST(Markup, PlainCutsByCharacters) {
  EXPECT_EQ(plain("λλλ", 3), "λλλ");
  EXPECT_EQ(plain("λλλλ", 3), "λλλ…");
}

TEST(Markup, EscapedTextIsNoMarkup) {
  EXPECT_EQ(escaped(R"(<a href="x" on='y'>&amp;)"), "&lt;a href=&quot;x&quot; on=&#39;y&#39;&gt;&amp;amp;");
}

TEST(Markup, ScriptJsonEndsNoScriptAndReadsBack) {
  const nlohmann::ordered_json json{{"a", "</script><!--&]]>\u2028\u2029λ"}, {"b", 0.1}};

  const std::string text = script_json(json);

  EXPECT_EQ(text.find_first_of("<>&"), std::string::npos);
  EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f; }));
  EXPECT_EQ(nlohmann::ordered_json::parse(text), json);
  EXPECT_TRUE(nlohmann::ordered_json::accept(script_json("\xff")));
}

}  // namespace
}  // namespace arcwall::markup_test
