#include <gtest/gtest.h>

#include "model/deck/reader.hpp"
#include "model/model.hpp"
#include "tests/support/deck_tables.hpp"

// Decks of theory "essenburg" made ready to be traced.
namespace arcwall::essenburg_model_test {

using namespace test::tables;

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

const std::string column = title("Column") + material("steel", 2.1e4, "nu = 0.29") + rectangle("square", 0.1, 0.1) +
                           points({{"A", 0.0, 0.0}, {"B", 2.0, 0.0}}) +
                           member("column", "A", "B", "essenburg", 4, "", "steel", "square") +
                           supports({{"A", "x z"}, {"B", "z"}}) + force("B", -1.0, 0.0) + channel(0.2) +
                           path("stop = { lambda = [-1.0, 1.0] }") + monitor("e", "A", "thickness") +
                           monitor("xi", "column:0.5", "thickness2");

Model model(const std::string& text) { return Model(deck::read_deck_text(text, "column.toml")); }

// Key and message of the only diagnostic.
std::pair<std::string, std::string> refusal(const std::string& text) {
  try {
    model(text);
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().size(), 1u);
    return {error.diagnostics().at(0).key, error.diagnostics().at(0).message};
  }
  ADD_FAILURE() << "not refused";
  return {};
}

}  // namespace

// Five unknowns at each of nine nodes but for three that are held; both faces touch at each.
TEST(EssenburgModel, HasFiveUnknownsANodeAndContactOnBothFacesAtMiddleNodesToo) {
  const Model quadratic = model(column);
  EXPECT_EQ(quadratic.structure().size({}), 42);
  EXPECT_EQ(quadratic.contact()->contact_count(), 18);
  EXPECT_EQ(quadratic.sliding(), nullptr);
  const Model linear = model(replaced(column, "elements = 4", "elements = 4\norder = 1"));
  EXPECT_EQ(linear.structure().size({}), 22);
  EXPECT_EQ(linear.contact()->contact_count(), 10);
}

TEST(EssenburgModel, SupportsMayHoldTheThicknessAndMonitorsReadIt) {
  const Model held = model(replaced(column, R"(A = ["x", "z"])", R"(A = ["x", "z", "thickness", "thickness2"])"));
  EXPECT_EQ(held.structure().size({}), 40);
  const Model free = model(column);
  State state{.x = Vector::Zero(free.system().size(free.system().open_active_set())),
              .active_set = free.system().open_active_set()};
  const MemberMesh& mesh = free.structure().members()[0];
  state.x[*free.structure().unknown(mesh.thickness[0].e)] = 0.25;
  state.x[*free.structure().unknown(mesh.thickness[2].xi)] = -3.0;
  EXPECT_EQ(free.monitors()[0].quantity->value(state), 0.25);
  EXPECT_EQ(free.monitors()[0].unit, "-");
  EXPECT_EQ(free.monitors()[1].quantity->value(state), -3.0);
}

TEST(EssenburgModel, TheShearCorrectionIsOneUnlessGiven) {
  const auto stiffness = [](const std::string& text) {
    const Model of = model(text);
    Linearization rest;
    of.structure().linearize({.x = Vector::Zero(of.structure().size({}))}, rest);
    const Index w = *of.structure().unknown(of.structure().dof(of.structure().members()[0].nodes[1], Dof::z));
    return rest.K.coeff(w, w);
  };
  const std::string given = replaced(column, "height = 0.1", "height = 0.1\nshear_correction = 0.5");
  EXPECT_NEAR(stiffness(given), 0.5 * stiffness(column), 1e-12 * stiffness(column));
}

// An arc of radius 0.04 through [0.04, 0.04] from [0, 0] to [0.08, 0], half of the section is 0.05.
TEST(EssenburgModel, AnAxisThatBendsWithinTheSectionIsRefused) {
  const std::string arc = replaced(replaced(column, "B = [2.0, 0.0]", "B = [0.08, 0.0]"), "elements = 4",
                                   "elements = 4\nvia = [0.04, 0.04]");
  EXPECT_EQ(refusal(arc).first, "member.column");
  EXPECT_NE(refusal(arc).second.find("at 0 of its length the axis has a radius of 0.04"), std::string::npos);
}

TEST(EssenburgModel, ThicknessOfOtherTheoriesIsRefused) {
  const std::string classic = replaced(column, "\"essenburg\"", "\"classic\"");
  const std::string without = replaced(classic, "component = \"thickness\"", "component = \"x\"");
  EXPECT_EQ(refusal(without).first, "monitor.component");
  const std::string held = replaced(replaced(without, "component = \"thickness2\"", "component = \"x\""),
                                    R"(B = ["z"])", R"(B = ["z", "thickness"])");
  EXPECT_EQ(refusal(held).first, "support.B");
  EXPECT_NE(refusal(held).second.find("there is no thickness to fix"), std::string::npos);
}

}  // namespace arcwall::essenburg_model_test
