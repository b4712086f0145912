#include "core/error.hpp"

#include <gtest/gtest.h>

namespace arcwall::error_test {

TEST(Diagnostic, NamesPlaceKeyMessageAndCure) {
  const Diagnostic diagnostic{.file = "column.toml",
                              .line = 7,
                              .column = 12,
                              .key = "member.column.elements",
                              .message = "0 is not above 0",
                              .cure = "use a whole number from 1"};
  EXPECT_EQ(to_text(diagnostic),
            "column.toml:7:12: member.column.elements: 0 is not above 0; use a whole number from 1");
}

TEST(Diagnostic, LeavesOutWhatIsUnknown) {
  EXPECT_EQ(to_text({.message = "wrong"}), "wrong");
  EXPECT_EQ(to_text({.file = "a.toml", .message = "wrong"}), "a.toml: wrong");
  EXPECT_EQ(to_text({.file = "a.toml", .line = 3, .message = "wrong"}), "a.toml:3: wrong");
  EXPECT_EQ(to_text({.file = "a.toml", .column = 3, .message = "wrong"}), "a.toml: wrong");
  EXPECT_EQ(to_text({.key = "path.step", .message = "wrong"}), "path.step: wrong");
  EXPECT_EQ(to_text({.line = 3, .message = "wrong"}), "line 3: wrong");
}

TEST(InputError, CarriesEveryDiagnosticOneALine) {
  const InputError error({{.file = "a.toml", .line = 1, .message = "first"}, {.message = "second", .cure = "do"}});
  EXPECT_STREQ(error.what(), "a.toml:1: first\nsecond; do");
  ASSERT_EQ(error.diagnostics().size(), 2U);
  EXPECT_EQ(error.diagnostics()[1].cure, "do");
}

TEST(InputError, MadeFromAMessageHasOneDiagnosticWithoutAPlace) {
  const InputError error("no such file");
  ASSERT_EQ(error.diagnostics().size(), 1U);
  EXPECT_EQ(error.diagnostics()[0].message, "no such file");
  EXPECT_EQ(error.diagnostics()[0].line, 0);
}

}  // namespace arcwall::error_test
