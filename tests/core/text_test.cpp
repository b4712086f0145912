#include "core/text.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/types.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::text_test {

namespace {

double read(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

TEST(RoundTrip, ReadsBackAsTheSameBits) {
  test::Numbers numbers(1);
  std::vector<double> values{0.0, -0.0, 0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -2.2250738585072014e-308};
  for (int i = 0; i < 1000; ++i) values.push_back(std::ldexp(numbers(), static_cast<int>(300.0 * numbers())));
  for (const double value : values) {
    const double back = read(round_trip(value));
    EXPECT_EQ(std::memcmp(&back, &value, sizeof value), 0) << round_trip(value);
  }
}

TEST(RoundTrip, IsTheShortestDecimal) {
  EXPECT_EQ(round_trip(0.1), "0.1");
  EXPECT_EQ(round_trip(2.0), "2");
  EXPECT_EQ(round_trip(0.30000000000000004), "0.30000000000000004");
  EXPECT_EQ(round_trip(1e-7), "1e-07");
}

TEST(RoundTrip, NamesWhatIsNoNumber) {
  EXPECT_EQ(round_trip(infinity), "inf");
  EXPECT_EQ(round_trip(-infinity), "-inf");
  EXPECT_EQ(round_trip(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(round_trip(-std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Nearest, FindsTheWordThatWasMeant) {
  const std::vector<std::string> words{"spherical", "cylindrical", "displacement", "load"};
  EXPECT_EQ(nearest("sferical", words), "spherical");
  EXPECT_EQ(nearest("cilindrical", words), "cylindrical");
  EXPECT_EQ(nearest("laod", words), "load");
  EXPECT_EQ(nearest("load", words), "load");
}

TEST(Nearest, OfSeveralTakesTheFewestEdits) { EXPECT_EQ(nearest("axes", {"taxed", "axis", "axles"}), "axis"); }

TEST(Nearest, IsEmptyWhereNoneIsNear) {
  EXPECT_EQ(nearest("spherical", {"displacement", "load"}), "");
  EXPECT_EQ(nearest("spherical", {}), "");
  EXPECT_EQ(nearest("y", {"x", "z"}), "");
}

}  // namespace arcwall::text_test
