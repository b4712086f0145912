#include <gtest/gtest.h>

#include <sstream>

#include "tests/apps/cli/program_fixture.hpp"

/// Large structures take time and memory in proportion to their size. Limits are of the processor's seconds and of
/// addresses, so that a busy machine does not matter; sanitizers need more of both, hence the names.
namespace arcwall::scale_test {
namespace {

class ScaleTest : public ProgramTest {
 protected:
  /// A row of members of one element each, with a load at its end; every second joint is raised.
  void put_members(int count, double raised = 0.0, const std::string& more = "") const {
    std::ostringstream deck;
    deck << "title = \"A row of members\"\nmaterial.s = { E = 1e5 }\n"
            "section.r = { shape = \"rectangle\", width = 0.1, height = 0.1 }\n[point]\n";
    for (int i = 0; i <= count; ++i) deck << "p" << i << " = [" << i << ", " << (i % 2) * raised << "]\n";
    deck << "[support]\np0 = [\"x\", \"z\"]\np" << count << " = [\"z\"]\n[member]\n";
    for (int i = 0; i < count; ++i)
      deck << "m" << i << " = { from = \"p" << i << "\", to = \"p" << i + 1
           << "\", theory = \"euler-bernoulli\", material = \"s\", section = \"r\", elements = 1 }\n";
    deck << "[[load]]\nat = \"p" << count << "\"\nforce = [-1, 0]\n[path]\nstep = 1e-9\nmax_points = 3\n" << more;
    put(work() / "row.toml", deck.str());
  }

  /// A slightly bent column of one member between two walls.
  void put_column(int elements, const std::string& contact) const {
    std::ostringstream deck;
    deck
        << "title = \"A long column\"\nmaterial.s = { E = 1e5 }\n"
           "section.r = { shape = \"rectangle\", width = 0.1, height = 0.1 }\n"
           "point = { a = [0, 0], b = ["
        << elements
        << ", 0] }\nsupport = { a = [\"x\", \"z\"], b = [\"z\"] }\n"
           "[member.m]\nfrom = \"a\"\nto = \"b\"\ntheory = \"euler-bernoulli\"\nmaterial = \"s\"\nsection = "
           "\"r\"\nelements = "
        << elements
        << "\nimperfection = { shape = \"sine\", amplitude = 0.01, waves = 1 }\n[[load]]\nat = \"b\"\nforce = [-1, 0]\n"
           "[[wall]]\nname = \"up\"\nside = \"above\"\ncontact_surface = \"axis\"\nprofile = { type = \"flat\", z = 1 "
           "}\n"
           "[[wall]]\nname = \"low\"\nside = \"below\"\ncontact_surface = \"axis\"\nprofile = { type = \"flat\", z = "
           "-1 }\n"
           "[contact]\npoints = \""
        << contact << "\"\n[path]\nstep = 1e-9\nmax_points = 2\n";
    put(work() / "column.toml", deck.str());
  }
};

// Names were looked for in lists: 8000 members took 1.4 s, 30 000 would take 19.
TEST_F(ScaleTest, MembersAreFoundByTheirNamesSlow) {
  put_members(30000);
  const Outcome outcome = shell("ulimit -t 9; \"$PROGRAM\" check row.toml");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// Each free end was compared with all before it: 30 000 members with a corner between any two took 6 s.
TEST_F(ScaleTest, EndsOfMembersAmongWallsAreFoundByTheirJointsSlow) {
  const char* walls =
      "[[wall]]\nname = \"up\"\nside = \"above\"\nprofile = { type = \"flat\", z = 1 }\n"
      "[[wall]]\nname = \"low\"\nside = \"below\"\nprofile = { type = \"flat\", z = -1 }\n";
  put_members(30000, 0.01, walls);
  const Outcome outcome = shell("ulimit -t 4; \"$PROGRAM\" check row.toml");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// Each candidate was compared with all before it.
TEST_F(ScaleTest, CandidatesOfWallsAreFoundByTheirNodesSlow) {
  put_column(100000, "nodes");
  const Outcome outcome = shell("ulimit -t 5; ulimit -v 800000; \"$PROGRAM\" check column.toml");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// Each element had a copy of all unknowns: 10 000 elements took 2.4 GB and 10 s, with contact at nodes 22 s.
TEST_F(ScaleTest, VerifyTakesMemoryInProportionToTheElementsSlow) {
  for (const char* contact : {"moving", "nodes"}) {
    put_column(10000, contact);
    ASSERT_EQ(run("run column.toml --quiet --force --no-pictures").status, 6) << contact;
    const Outcome outcome = shell("ulimit -t 6; ulimit -v 700000; \"$PROGRAM\" verify column --quiet");
    EXPECT_EQ(outcome.status, 0) << contact << outcome.err;
  }
}

// Each wall was held against each other one, and looked for among all candidates: 10 000 walls took 17 s.
TEST_F(ScaleTest, WallsAreFoundByTheirNamesAndHeightsSlow) {
  put_column(10, "moving");
  std::ofstream deck(work() / "column.toml", std::ios::app);
  for (int i = 0; i < 20000; ++i)
    deck << "[[wall]]\nname = \"w" << i
         << "\"\nside = \"below\"\ncontact_surface = \"axis\"\nprofile = { type = \"flat\", z = " << -2 - 1e-4 * i
         << " }\n";
  deck.close();
  for (const char* points : {"", " --set contact={}"}) {
    const Outcome outcome = shell("ulimit -t 6; \"$PROGRAM\" check column.toml" + std::string(points));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
}

}  // namespace
}  // namespace arcwall::scale_test
