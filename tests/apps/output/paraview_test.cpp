#include "apps/output/paraview.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <pugixml.hpp>
#include <sstream>

#include "core/error.hpp"
#include "tests/apps/output/temporary_folder.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::paraview_test {

namespace {

using test::example;
using test::TracedDeck;

// A Python that has meshio where one has.
std::string python() {
  for (const std::string candidate : {"python3", "/usr/bin/python3"})
    if (std::system((candidate + " -c 'import meshio' >/dev/null 2>&1").c_str()) == 0) return candidate;
  return "python3";
}

// Arrays of a .vtu file as another program reads them.
std::map<std::string, std::vector<double>> arrays_of(const std::filesystem::path& file, const TemporaryFolder& folder) {
  const std::string command = python() + " '" READ_VTU_SCRIPT "' '" + file.string() + "' >'" +
                              (folder / "arrays").string() + "' 2>'" + (folder / "how").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << content(folder / "how");
  std::cout << file.filename().string() << ": " << content(folder / "how");
  std::map<std::string, std::vector<double>> arrays;
  std::istringstream lines(content(folder / "arrays"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, word;
    words >> name >> word;
    while (words >> word) arrays[name].push_back(std::strtod(word.c_str(), nullptr));
  }
  return arrays;
}

// Four digits.
std::string last_file(const Record& record) {
  const std::string number = std::to_string(record.points.size() - 1);
  return std::string(4 - number.size(), '0') + number + ".vtu";
}

OutputFolder outputs(const TemporaryFolder& folder) { return {folder / "out", "deck.toml", Foreign::refuse}; }

}  // namespace

// Every double comes back as it was.
TEST(Paraview, AnotherProgramReadsTheSameNumbers) {
  const TracedDeck traced(example("channel"));
  const TemporaryFolder folder;
  const OutputFolder out = outputs(folder);
  write_shapes(out, traced.model(), traced.record());
  const RecordPoint& point = traced.record().points.back();
  auto arrays = arrays_of(out.path() / "shapes" / last_file(traced.record()), folder);
  const Shape shape = shape_of(traced.model(), point.state);
  const std::vector<ShapePoint>& column = shape.members.at(0).points;
  ASSERT_EQ(arrays["Points"].size(), 3 * column.size());
  ASSERT_EQ(arrays["gap"].size(), column.size());
  Vec2 wall = Vec2::Zero();
  for (std::size_t i = 0; i < column.size(); ++i) {
    EXPECT_EQ(arrays["Points"][3 * i], column[i].position.x());
    EXPECT_EQ(arrays["Points"][3 * i + 1], column[i].position.y());
    EXPECT_EQ(arrays["Points"][3 * i + 2], 0.0);
    EXPECT_EQ(arrays["displacement"][3 * i + 1], column[i].displacement.y());
    EXPECT_EQ(arrays["rotation"][i], column[i].rotation);
    EXPECT_EQ(arrays["axial_force"][i], column[i].axial_force);
    EXPECT_EQ(arrays["moment"][i], column[i].moment);
    wall += Vec2(arrays["contact_force"][3 * i], arrays["contact_force"][3 * i + 1]);
    EXPECT_GE(arrays["gap"][i], -1e-6);
  }
  Vec2 expected = Vec2::Zero();
  for (const ContactMark& mark : shape.contacts) expected += mark.force;
  EXPECT_NEAR((wall - expected).norm(), 0.0, 1e-14);
  // The column touches both walls at the end: half a section of 0.1 from 0.2.
  EXPECT_NEAR(*std::min_element(arrays["gap"].begin(), arrays["gap"].end()), 0.0, 1e-6);
  EXPECT_EQ(arrays["offsets"], std::vector<double>{double(column.size())});
  EXPECT_EQ(arrays["types"], std::vector<double>{4.0});  // VTK_POLY_LINE
  EXPECT_EQ(arrays["connectivity"].back(), double(column.size() - 1));
  EXPECT_EQ(arrays["member"], std::vector<double>{0.0});
  EXPECT_EQ(arrays["lambda"], std::vector<double>{point.lambda});
  EXPECT_EQ(arrays["step"], std::vector<double>{double(point.step)});

  const auto walls = arrays_of(out.path() / "shapes" / "walls.vtu", folder);
  EXPECT_EQ(walls.at("wall"), (std::vector<double>{0.0, 1.0}));
}

TEST(Paraview, StructuresWithoutWallsHaveNeitherContactNorGap) {
  const TracedDeck traced(example("truss"));
  const TemporaryFolder folder;
  const OutputFolder out = outputs(folder);
  write_shapes(out, traced.model(), traced.record());
  const auto arrays = arrays_of(out.path() / "shapes" / "0001.vtu", folder);
  EXPECT_EQ(arrays.count("gap"), 0u);
  EXPECT_EQ(arrays.count("contact_force"), 0u);
  EXPECT_EQ(arrays.at("member"), (std::vector<double>{0.0, 1.0}));
  EXPECT_FALSE(std::filesystem::exists(out.path() / "shapes" / "walls.vtu"));
}

TEST(Paraview, TheCollectionListsAFileForEachPointAndTheWallsWithIt) {
  const TracedDeck traced(example("cylinder"));
  const TemporaryFolder folder;
  const OutputFolder out = outputs(folder);
  write_shapes(out, traced.model(), traced.record());
  pugi::xml_document collection;
  ASSERT_TRUE(collection.load_file((out.path() / "shapes.pvd").c_str()));
  std::size_t points = 0, walls = 0;
  for (const pugi::xml_node set : collection.child("VTKFile").child("Collection").children("DataSet")) {
    EXPECT_TRUE(std::filesystem::exists(out.path() / set.attribute("file").value()));
    EXPECT_EQ(set.attribute("timestep").as_ullong(), set.attribute("part").as_int() == 0 ? points++ : walls++);
  }
  EXPECT_EQ(points, traced.record().points.size());
  EXPECT_EQ(walls, points);
}

TEST(Paraview, FilesOfALongerRunAreRemovedAndOthersAreLeft) {
  const TracedDeck traced(example("cylinder"));
  const TemporaryFolder folder;
  const OutputFolder out = outputs(folder);
  write_shapes(out, traced.model(), traced.record());
  put(out.path() / "shapes" / "notes.txt", "mine");
  put(out.path() / "shapes" / "12.vtu", "mine");
  put(out.path() / "shapes" / "12345.vtu", "of a longer run");
  Record shorter = traced.record();
  shorter.points.resize(2);
  write_shapes(out, traced.model(), shorter);
  EXPECT_EQ(names_in(out.path() / "shapes"),
            (std::set<std::string>{"0000.vtu", "0001.vtu", "12.vtu", "notes.txt", "walls.vtu"}));
}

TEST(Paraview, AFolderThatCannotBeMadeIsNamed) {
  const TracedDeck traced(example("truss"));
  const TemporaryFolder folder;
  const OutputFolder out = outputs(folder);
  put(out.path() / "shapes", "a file");
  try {
    write_shapes(out, traced.model(), traced.record());
    FAIL() << "not refused";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("shapes"), std::string::npos);
  }
}

}  // namespace arcwall::paraview_test
