#include "apps/output/contacts_csv.hpp"

#include <gtest/gtest.h>

#include "tests/apps/output/sample_record.hpp"

namespace arcwall::contacts_csv_test {
namespace {

TEST(ContactsCsv, HasARowForEachClosedContactOfEachPoint) {
  Record record = sample_record();
  record.force_unit = "kN";
  record.length_unit = "cm";
  const ContactLabel middle{.wall = "upper", .member = "column", .fraction = 0.5};
  record.points[1].forces = {{.label = middle, .x = 1.0, .force = 0.25, .pressure = 10.0}};
  record.points[2].forces = {{.label = middle, .x = 0.9, .force = 1.0 / 3.0, .pressure = std::nullopt},
                             {.label = {.wall = "a,b", .member = "m", .fraction = 0.1}, .x = 0.2}};
  EXPECT_EQ(contacts_csv(record, UnitLabels::shown),
            "branch,step,lambda,wall,member,fraction,x [cm],force [kN],pressure [kN/cm]\n"
            "0,1,0.1,upper,column,0.5,1,0.25,10\n"
            "0,2,0.05,upper,column,0.5,0.9,0.3333333333333333,\n"
            "0,2,0.05,\"a,b\",m,0.1,0.2,0,\n");
}

TEST(ContactsCsv, LeavesUnitsOutOnDemandAndWhereThereAreNone) {
  const std::string plain = "branch,step,lambda,wall,member,fraction,x,force,pressure\n";
  Record record = sample_record();
  EXPECT_EQ(contacts_csv(record, UnitLabels::shown), plain);
  record.force_unit = "kN";
  record.length_unit = "cm";
  EXPECT_EQ(contacts_csv(record, UnitLabels::left_out), plain);
}

}  // namespace
}  // namespace arcwall::contacts_csv_test
