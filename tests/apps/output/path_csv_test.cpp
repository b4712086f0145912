#include "apps/output/path_csv.hpp"

#include <gtest/gtest.h>

#include "tests/apps/output/sample_record.hpp"

namespace arcwall::path_csv_test {
namespace {

TEST(PathCsv, HasTheColumnsOfTheContractAndNumbersThatReadBack) {
  EXPECT_EQ(path_csv(sample_record(), UnitLabels::shown),
            "branch,step,arc,lambda,mid [cm],turn [rad],unstable,stability,contacts,energy [kN cm],iterations,event\n"
            "0,0,0,0,0,-0,0,stable,0,0,1,start\n"
            "0,1,0.30000000000000004,0.1,0.3333333333333333,1e-300,,undecided,3,-2.5,4,contact-limit-point\n"
            "0,2,0.5,0.05,0.2,inf,1,unstable,3,-3,2,end\n");
}

TEST(PathCsv, LeavesUnitsOutOnDemandAndWhereThereAreNone) {
  const std::string plain = "branch,step,arc,lambda,mid,turn,unstable,stability,contacts,energy,iterations,event\n";
  Record record = sample_record();
  record.points.clear();
  EXPECT_EQ(path_csv(record, UnitLabels::left_out), plain);

  record.columns = {{"mid", ""}, {"turn", ""}};
  record.energy_unit.clear();
  EXPECT_EQ(path_csv(record, UnitLabels::shown), plain);
}

TEST(PathCsv, QuotesUnitsThatWouldBreakTheHeader) {
  Record record;
  record.columns = {{"mid", "a,\"b\""}};
  EXPECT_EQ(path_csv(record, UnitLabels::shown),
            "branch,step,arc,lambda,\"mid [a,\"\"b\"\"]\",unstable,stability,contacts,energy,iterations,event\n");
}

}  // namespace
}  // namespace arcwall::path_csv_test
