#include "core/printable.hpp"

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

namespace arcwall::printable_test {
namespace {

using namespace std::string_view_literals;

TEST(Printable, KeepsWhatALineCanShow) {
  EXPECT_EQ(printable("Träger λ → 1, 𝛌 \\n"), "Träger λ → 1, 𝛌 \\n");
  EXPECT_EQ(printable(""), "");
}

// What a terminal obeys, or what makes its line read otherwise than it is written (ECMA-48; the Unicode standard,
// annex 9; table 3-7 for bytes that are no UTF-8).
TEST(Printable, EscapesWhatATerminalObeys) {
  const std::vector<std::tuple<std::string_view, std::string_view>> texts{
      {"a\0b"sv, "a\\u0000b"},
      {"\x1b[31m", "\\u001B[31m"},
      {"\a\b\v\f", "\\u0007\\u0008\\u000B\\u000C"},
      {"over\rwritten", "over\\u000Dwritten"},
      {"\x7f", "\\u007F"},
      {"\u0085\u009b31m", "\\u0085\\u009B31m"},
      {"\u202egnp.exe\u2066\u200f\u061c", "\\u202Egnp.exe\\u2066\\u200F\\u061C"},
      {"a\u2028b\u2029", "a\\u2028b\\u2029"},
      {"\xff\xc3", "\\xFF\\xC3"},
      {"\xc0\xaf", "\\xC0\\xAF"},
      {"\xed\xa0\x80", "\\xED\\xA0\\x80"},
  };
  for (const auto& [text, shown] : texts) EXPECT_EQ(printable(text), shown);
}

TEST(Printable, LineBreaksStayInATextOfSeveralLinesAlone) {
  EXPECT_EQ(printable("a\n\tb"), "a\\n\\tb");
  EXPECT_EQ(printable("a\n\tb\r", LineBreaks::kept), "a\n\tb\\u000D");
}

}  // namespace
}  // namespace arcwall::printable_test
