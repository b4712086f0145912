#include "apps/output/report_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/output/event_marks.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/jump_rows.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/path_lines.hpp"
#include "apps/output/report_chart.hpp"
#include "apps/output/report_data.hpp"
#include "apps/output/report_head.hpp"
#include "apps/output/shape_svg.hpp"
#include "apps/output/shown_number.hpp"

namespace arcwall {

namespace {

bool concerns_all(const ShapePictures& shapes, const DrawnWall& wall) {
  const auto is_concerned = [&](const DrawnMember& member) {
    return std::find(wall.members.begin(), wall.members.end(), member.name) != wall.members.end();
  };
  return wall.members.empty() || std::all_of(shapes.members.begin(), shapes.members.end(), is_concerned);
}

std::string first_members(const ShapePictures& shapes) {
  std::string text;
  for (std::size_t i = 0; i < shapes.classes.size(); ++i)
    if (shapes.classes[i] == "member")
      text += fmt::format("<path class=\"first member\" data-member=\"{}\" d=\"{}\"/>", i,
                          shapes.pictures.front().paths[i]);
  return text;
}

const ShapePicture* picture_at(const ShapePictures& shapes, std::size_t point) {
  const auto found = std::lower_bound(shapes.pictures.begin(), shapes.pictures.end(), point,
                                      [](const ShapePicture& picture, std::size_t at) { return picture.point < at; });
  return found != shapes.pictures.end() && found->point == point ? &*found : nullptr;
}

std::string strip_figure(const ShapePictures& shapes, const ShapePicture& picture, const std::string& place,
                         const std::string& label, const std::string& caption) {
  return fmt::format(
      "<figure {}><svg class=\"shape\" viewBox=\"{}\" role=\"img\" aria-label=\"Shape {}\">"
      "<use href=\"#walls\"/>{}</svg><figcaption>{}</figcaption></figure>",
      place, view_box(shapes), label, shape_paths(shapes, picture), caption);
}

}  // namespace

// A body hides the half of its surface's line that lies in it, and of the lines of others all that does.
std::string wall_paths(const ShapePictures& shapes) {
  std::string text = "<g id=\"walls\">";
  const auto light = [&](std::size_t i) { return concerns_all(shapes, shapes.walls[i]) ? "" : "light "; };
  for (std::size_t i = 0; i < shapes.surfaces.size(); ++i)
    text += fmt::format("<path class=\"{}surface\" d=\"{}\"/>", light(i), shapes.surfaces[i]);
  for (std::size_t i = 0; i < shapes.bodies.size(); ++i)
    text += fmt::format("<path class=\"{}body\" d=\"{}\"/>", light(i), shapes.bodies[i]);
  return text + "</g>";
}

std::string stage(const ShapePictures& shapes) {
  if (shapes.pictures.empty()) return "";
  return fmt::format(
      "<svg id=\"stage\" class=\"shape\" viewBox=\"{0}\" data-whole=\"{0}\" role=\"img\" aria-label=\"Deformed "
      "shape\">{1}<g>{2}</g>"
      "<g id=\"drawn-forces\"></g><g id=\"shown\">{3}</g><g id=\"named-points\"></g></svg>",
      view_box(shapes), wall_paths(shapes), first_members(shapes), shape_paths(shapes, shapes.pictures.front()));
}

std::string shape_notes(const Record& record, const ShapePictures& shapes) {
  std::vector<std::string> notes;
  if (shapes.greatest_force > 0.0)
    notes.push_back(fmt::format(
        "Arrows at the walls: their forces on the structure. Arrow scale: {}{}{}, the maximum of the run.",
        shown_number(shapes.greatest_force, 4), record.force_unit.empty() ? "" : " ", shown_name(record.force_unit)));
  if (shapes.pictures.size() < record.points.size())
    notes.push_back(fmt::format("Shapes are kept of {} of the {} points; a point without one shows the nearest.",
                                shapes.pictures.size(), record.points.size()));
  std::string text;
  for (const std::string& note : notes) text += (text.empty() ? "" : " ") + escaped(note);
  return text;
}

std::vector<const RecordEvent*> events_of_strip(const Record& record) {
  constexpr std::size_t most = 12;
  std::vector<const RecordEvent*> events;
  std::set<std::pair<Index, Index>> places;
  for (const RecordEvent& event : record.events)
    if (places.insert({event.branch, event.step}).second) events.push_back(&event);
  if (events.size() <= most) return events;
  std::vector<const RecordEvent*> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(events[i * (events.size() - 1) / (most - 1)]);
  return chosen;
}

std::string strip(const Record& record, const ShapePictures& shapes, const std::vector<const RecordEvent*>& events) {
  const std::vector<std::size_t> first = first_points(record);
  const std::vector<Jump> all = jumps(record);
  std::string text;
  for (const RecordEvent* event : events) {
    const std::size_t point = point_of(*event, first);
    const ShapePicture* picture = picture_at(shapes, point);
    if (picture == nullptr) continue;
    text +=
        strip_figure(shapes, *picture, fmt::format("data-point=\"{}\"", point), fmt::format("at event {}", event->id),
                     fmt::format("{}<b>{} {}</b><span>λ = {}</span>", svg_mark(event->kind), event->id,
                                 words(event->kind), shown_lambda(*event, 6)));
    for (std::size_t i = 0; i < std::min(all.size(), shapes.after_jumps.size()); ++i)
      if (all[i].event == event && !all[i].returns)
        text += strip_figure(
            shapes, shapes.after_jumps[i], fmt::format("data-jump=\"{}\"", i),
            fmt::format("after the jump from event {}", event->id),
            fmt::format("{}<b>after the jump</b><span>from event {}</span>", svg_arrow(jump_colour), event->id));
  }
  return text;
}

}  // namespace arcwall
