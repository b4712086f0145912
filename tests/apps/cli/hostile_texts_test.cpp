#include <gtest/gtest.h>

#include "core/printable.hpp"
#include "tests/apps/cli/program_fixture.hpp"

/// Texts of decks, command lines and file names reach terminals as characters to read, never as ones to obey.
namespace arcwall::hostile_texts_test {
namespace {

// One of each kind: NUL, backspace, carriage return, the escape of a colour, DEL, a new line and a control sequence of
// C1, a mark and an embedding of another direction, an isolate, a line separator.
const std::string in_toml = R"(a\u0000\u0008\r\u001b[31m\u007f\u0085\u009b31m\u200f\u202e\u2066\u2028z)";
const std::string in_file_names = "a\b\r\x1b[31m\x7f\u0085\u009b31m\u200f\u202e\u2066\u2028z";

struct Place {
  const char* what;
  std::string from{}, to{};  ///< of the deck's text: each occurrence is replaced
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

class HostileTextsTest : public ProgramTest {
 protected:
  static void expect_printable(const std::string& text, const std::string& of) {
    EXPECT_EQ(text, printable(text, LineBreaks::kept)) << of;
  }

  void expect_printable(const Outcome& outcome, const std::string& of) const {
    expect_printable(outcome.out, of + ", standard output");
    expect_printable(outcome.err, of + ", standard error");
  }
};

TEST_F(HostileTextsTest, OfADeckThatRuns) {
  const std::string deck = content(work() / "truss.toml");
  const std::string quoted = "\"" + in_toml + "\"";
  const std::vector<Place> places{
      {"title", "Two-bar truss past both peaks", in_toml},
      {"description", "[units]", "description = " + quoted + "\n[units]"},
      {"unit of length", "length = \"m\"", "length = " + quoted},
      {"unit of force", "force = \"kN\"", "force = " + quoted},
  };
  for (const Place& place : places) {
    put(work() / "hostile.toml", replaced(deck, place.from, place.to));
    const std::string of = place.what;
    const Outcome check = run("check hostile.toml");
    EXPECT_EQ(check.status, 0) << of << "\n" << check.err;
    expect_printable(check, of + ", check");
    expect_printable(run("run hostile.toml --force --max-points 30"), of + ", run");
    expect_printable(run("verify hostile"), of + ", verify");
    expect_printable(content(work() / "hostile" / "events.txt"), of + ", events.txt");
  }
}

TEST_F(HostileTextsTest, OfADeckThatIsWrong) {
  const std::string deck = content(work() / "truss.toml");
  const std::string quoted = "\"" + in_toml + "\"";
  const std::vector<Place> places{
      {"name of a monitor", "name = \"w\"", "name = " + quoted},
      {"name of a member", "member.left", "member." + quoted},
      {"name of a point", "to = \"top\"", "to = " + quoted},
      {"key", "step = 5.0", quoted + " = 5.0"},
      {"part", "[path.stop]", "[" + quoted + "]"},
      {"value of words", "strain = \"green\"", "strain = " + quoted},
      {"reference", "material = \"bar\"", "material = " + quoted},
      {"support", "right = [\"x\", \"z\"]", "right = [" + quoted + "]"},
      {"stop", "w = [-0.1, 1.2]", quoted + " = [-0.1, 1.2]"},
      {"syntax", "step = 5.0", "step = \"" + in_toml},
      {"raw", "step = 5.0", "step = " + in_file_names},
  };
  for (const Place& place : places) {
    put(work() / "hostile.toml", replaced(deck, place.from, place.to));
    const Outcome check = run("check hostile.toml");
    EXPECT_EQ(check.status, 2) << place.what << check.out;
    expect_printable(check, place.what);
  }
}

TEST_F(HostileTextsTest, OfCommandLinesAndFileNames) {
  const std::string name = "'" + in_file_names + "'";
  ASSERT_EQ(shell("cp truss.toml " + name + ".toml").status, 0);
  for (const std::string& command : {"run " + name + ".toml --max-points 3",
                                     "run " + name + ".toml --max-points 3",
                                     "resume " + name + " --max-points 2",
                                     "report " + name,
                                     "verify " + name,
                                     "check " + name + ".toml",
                                     "check " + name + ".gone",
                                     "resume " + name + ".gone",
                                     name,
                                     "--" + name,
                                     "run --" + name + " truss.toml",
                                     "run truss.toml --max-points " + name,
                                     "check truss.toml --set " + name,
                                     "check truss.toml --set " + name + "=1",
                                     "examples " + name,
                                     "sweep plan " + name + ".toml",
                                     "sweep " + name,
                                     "sweep run " + name,
                                     "sweep emit . --engine " + name,
                                     "run truss.toml --out truss.toml/" + name,
                                     "converge " + name + ".toml --levels 2"})
    expect_printable(run(command), printable(command));
}

}  // namespace
}  // namespace arcwall::hostile_texts_test
