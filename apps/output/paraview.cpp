#include "apps/output/paraview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <pugixml.hpp>
#include <set>
#include <string_view>
#include <system_error>

#include "apps/output/own_folder.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/build_contact.hpp"

namespace arcwall {

namespace fs = std::filesystem;

namespace {

// Three bytes are four characters of six bits each.
std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t groups = (bytes.size() + 2) / 3;
  std::string text(4 * groups, '=');
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - 3 * g);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < here; ++k)
      group |= std::uint32_t{static_cast<std::uint8_t>(bytes[3 * g + k])} << (16 - 8 * k);
    for (std::size_t k = 0; k <= here; ++k) text[4 * g + k] = digits[group >> (18 - 6 * k) & 63u];
  }
  return text;
}

template <class Value>
std::string_view bytes_of(const Value* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(Value)};
}

const char* name_of(double) { return "Float64"; }
const char* name_of(std::int64_t) { return "Int64"; }
const char* name_of(std::uint8_t) { return "UInt8"; }

// An array as `binary`: base64 of its size in bytes and its values, as the machine has them.
template <class Value>
pugi::xml_node add_array(pugi::xml_node to, const char* name, int components, const std::vector<Value>& values) {
  pugi::xml_node array = to.append_child("DataArray");
  array.append_attribute("type") = name_of(Value{});
  array.append_attribute("Name") = name;
  array.append_attribute("NumberOfComponents") = components;
  array.append_attribute("format") = "binary";
  const std::uint64_t size = values.size() * sizeof(Value);
  std::string bytes(bytes_of(&size, 1));
  bytes += bytes_of(values.data(), values.size());
  array.text() = base64(bytes).c_str();
  return array;
}

void add_field(pugi::xml_node to, const char* name, double value) {
  add_array(to, name, 1, std::vector<double>{value}).append_attribute("NumberOfTuples") = 1;
}

// <VTKFile> of a type.
pugi::xml_node add_file(pugi::xml_document& document, const char* type) {
  document.append_child(pugi::node_declaration).append_attribute("version") = "1.0";
  pugi::xml_node file = document.append_child("VTKFile");
  file.append_attribute("type") = type;
  file.append_attribute("version") = "1.0";
  file.append_attribute("byte_order") = "LittleEndian";
  file.append_attribute("header_type") = "UInt64";
  return file;
}

std::string to_text(const pugi::xml_document& document) {
  struct Writer final : pugi::xml_writer {
    std::string text{};
    void write(const void* data, std::size_t size) override { text.append(static_cast<const char*>(data), size); }
  } writer;
  document.save(writer, " ");
  return writer.text;
}

// A grid of poly lines: points in one list, line by line.
class PolyLines {
 public:
  void add_line(std::int64_t index) { indices_.push_back(index); }

  void add_point(const Vec2& position) {
    add_vector(position, points_);
    if (offsets_.size() < indices_.size()) offsets_.push_back(offsets_.empty() ? 0 : offsets_.back());
    ++offsets_.back();
  }

  static void add_vector(const Vec2& v, std::vector<double>& to) { to.insert(to.end(), {v.x(), v.y(), 0.0}); }

  // The grid's only piece, with points and cells; `index_name` is what a line's index is called.
  pugi::xml_node add_piece(pugi::xml_node grid, const char* index_name) const {
    constexpr std::uint8_t poly_line = 4;
    const std::size_t points = points_.size() / 3;
    std::vector<std::int64_t> connectivity(points);
    for (std::size_t i = 0; i < points; ++i) connectivity[i] = static_cast<std::int64_t>(i);
    pugi::xml_node piece = grid.append_child("Piece");
    piece.append_attribute("NumberOfPoints") = static_cast<unsigned long long>(points);
    piece.append_attribute("NumberOfCells") = static_cast<unsigned long long>(offsets_.size());
    add_array(piece.append_child("Points"), "Points", 3, points_);
    pugi::xml_node cells = piece.append_child("Cells");
    add_array(cells, "connectivity", 1, connectivity);
    add_array(cells, "offsets", 1, offsets_);
    add_array(cells, "types", 1, std::vector<std::uint8_t>(offsets_.size(), poly_line));
    add_array(piece.append_child("CellData"), index_name, 1, indices_);
    return piece;
  }

 private:
  std::vector<double> points_;
  std::vector<std::int64_t> offsets_, indices_;
};

// Walls with what a gap to them needs.
struct Surface {
  const deck::Wall& wall;
  std::shared_ptr<const Obstacle> obstacle;
  double lambda;  // at which gaps are asked for
};

std::vector<Surface> surfaces(const deck::Deck& deck, double lambda) {
  std::vector<Surface> all;
  for (const deck::Wall& wall : deck.walls)
    all.push_back({.wall = wall, .obstacle = obstacle_of(wall), .lambda = lambda});
  return all;
}

// To the nearest wall in the member's way, of the nearer face where faces touch; `most` where there is none as near.
double gap_at(const Vec2& position, double angle, double fraction, const MemberMesh& mesh,
              const std::vector<Surface>& surfaces, double most) {
  const Vec2 normal(-std::sin(angle), std::cos(angle));
  double least = most;
  for (const auto& [wall, obstacle, lambda] : surfaces) {
    if (!concerns(wall, mesh.name)) continue;
    const double half =
        wall.contact_surface == deck::ContactSurface::face ? 0.5 * mesh.height_at(fraction).value_or(0.0) : 0.0;
    if (wall.outline) {
      least = std::min(least, obstacle->gap_slope(position, lambda).value - half);
      continue;
    }
    for (const double offset : {-half, half}) {
      least = std::min(least, obstacle->gap_slope(position + offset * normal, lambda).value);
    }
  }
  return least;
}

// What the walls do at points of a member, one entry a point.
struct ContactArrays {
  std::vector<double> force{}, pressure{}, gap{};

  // `surfaces`, `most`: in the frame.
  void add(const Shape& shape, const MemberShape& member, const MemberMesh& mesh, const std::vector<Surface>& surfaces,
           const deck::Frame& frame, double most) {
    const std::size_t first = gap.size();
    for (const ShapePoint& point : member.points)
      gap.push_back(frame.factor() *
                    gap_at(frame.here(point.position), point.angle, point.fraction, mesh, surfaces, most));
    pressure.resize(gap.size(), 0.0);
    force.resize(3 * gap.size(), 0.0);
    for (const ContactMark& mark : shape.contacts) {
      if (mark.label.member != member.member) continue;
      const auto at = first + nearest(member.points, mark.label.fraction);
      force[3 * at] += mark.force.x();
      force[3 * at + 1] += mark.force.y();
      pressure[at] += mark.pressure.value_or(0.0);
    }
  }

 private:
  static std::size_t nearest(const std::vector<ShapePoint>& points, double fraction) {
    const auto closer = [fraction](const ShapePoint& a, const ShapePoint& b) {
      return std::abs(a.fraction - fraction) < std::abs(b.fraction - fraction);
    };
    return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), closer) - points.begin());
  }
};

}  // namespace

std::string shape_vtu(const Model& model, const RecordPoint& point, const Shape& shape) {
  const std::vector<Surface> walls = surfaces(model.deck(), point.lambda);
  PolyLines lines;
  std::vector<double> displacement, rotation, axial_force, moment;
  ContactArrays contact;
  for (std::size_t m = 0; m < shape.members.size(); ++m) {
    lines.add_line(static_cast<std::int64_t>(m));
    for (const ShapePoint& at : shape.members[m].points) {
      lines.add_point(at.position);
      PolyLines::add_vector(at.displacement, displacement);
      rotation.push_back(at.rotation);
      axial_force.push_back(at.axial_force);
      moment.push_back(at.moment);
    }
    if (!walls.empty())
      contact.add(shape, shape.members[m], model.structure().members()[m], walls, model.frame(),
                  model.structure().length_scale());
  }

  pugi::xml_document document;
  pugi::xml_node grid = add_file(document, "UnstructuredGrid").append_child("UnstructuredGrid");
  pugi::xml_node fields = grid.append_child("FieldData");
  add_field(fields, "lambda", point.lambda);
  add_field(fields, "branch", double(point.branch));
  add_field(fields, "step", double(point.step));
  pugi::xml_node data = lines.add_piece(grid, "member").append_child("PointData");
  add_array(data, "displacement", 3, displacement);
  add_array(data, "rotation", 1, rotation);
  add_array(data, "axial_force", 1, axial_force);
  add_array(data, "moment", 1, moment);
  if (!walls.empty()) {
    add_array(data, "contact_force", 3, contact.force);
    add_array(data, "pressure", 1, contact.pressure);
    add_array(data, "gap", 1, contact.gap);
  }
  return to_text(document);
}

std::string walls_vtu(const std::vector<WallShape>& walls) {
  PolyLines lines;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    lines.add_line(static_cast<std::int64_t>(w));
    for (const Vec2& at : walls[w].line) lines.add_point(at);
  }
  pugi::xml_document document;
  lines.add_piece(add_file(document, "UnstructuredGrid").append_child("UnstructuredGrid"), "wall");
  return to_text(document);
}

namespace {

const char* const walls_name = "walls.vtu";

std::string name_of_point(std::size_t point) { return fmt::format("{:04}.vtu", point); }

// Which files belong to which time. Parts that do not change are named at each.
std::string collection(std::size_t points, bool walls) {
  pugi::xml_document document;
  pugi::xml_node list = add_file(document, "Collection").append_child("Collection");
  const auto add = [&](std::size_t point, int part, const std::string& name) {
    pugi::xml_node set = list.append_child("DataSet");
    set.append_attribute("timestep") = static_cast<unsigned long long>(point);
    set.append_attribute("part") = part;
    set.append_attribute("file") = ("shapes/" + name).c_str();
  };
  for (std::size_t point = 0; point < points; ++point) {
    add(point, 0, name_of_point(point));
    if (walls) add(point, 1, walls_name);
  }
  return to_text(document);
}

// Files of an earlier run that this one has not written: 12345.vtu, walls.vtu. What else is there is somebody's own.
void remove_others(const OwnFolder& folder, const std::set<std::string>& written) {
  const auto is_ours = [](const std::string& name) {
    const std::string stem = name.substr(0, name.find('.'));
    return name == walls_name ||
           (name == stem + ".vtu" && stem.size() >= 4 && stem.find_first_not_of("0123456789") == std::string::npos);
  };
  for (const std::string& name : folder.names())
    if (is_ours(name) && !written.contains(name)) folder.remove(name);
}

}  // namespace

void remove_shapes(const OutputFolder& folder) {
  const fs::path shapes = folder.path() / "shapes";
  const auto folder_of_shapes = OwnFolder::open(shapes);
  if (!folder_of_shapes) return;
  remove_others(*folder_of_shapes, {});
  std::error_code error;
  fs::remove(shapes, error);  // fails if something is left in it, as it should
}

void write_shapes(const OutputFolder& folder, const Model& model, const Record& record, const DrawnScenes& drawn) {
  const fs::path shapes = folder.path() / "shapes";
  std::error_code error;
  fs::create_directories(shapes, error);
  if (error) throw OutputError(shapes.string() + ": cannot be made: " + error.message());
  const auto folder_of_shapes = OwnFolder::open(shapes);
  if (!folder_of_shapes) throw OutputError(shapes.string() + ": cannot be made: another process has removed it");
  std::set<std::string> written;
  const auto write = [&](const std::string& name, const std::string& text) {
    write_whole(shapes / name, text);
    written.insert(name);
  };
  if (record.has_walls) write(walls_name, walls_vtu(wall_shapes(model)));
  for (std::size_t i = 0; i < record.points.size(); ++i) {
    const RecordPoint& point = record.points[i];
    const Shape* known = drawn.shape_at(i);
    const Model& here = model.at_stage(record.stage_number(point.branch));
    write(name_of_point(i), shape_vtu(here, point, known != nullptr ? *known : shape_of(here, point.state)));
  }
  folder.write_whole("shapes.pvd", collection(record.points.size(), record.has_walls));
  remove_others(*folder_of_shapes, written);
}

}  // namespace arcwall
