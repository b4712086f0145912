#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/output/overlay.hpp"
#include "apps/output/shape_pictures.hpp"
#include "model/record.hpp"

namespace arcwall {

/// The colour of a branch, from Okabe and Ito's palette for readers with any colour vision.
std::string branch_colour(Index branch);

/// A name or a unit of the deck as pictures and tables show it: plain, cut where it is very long.
std::string shown_name(const std::string& name);

/// `mid [cm]`.
std::string shown_title(const RecordColumn& column);

/// The colour of one of the runs and measured points that are drawn into another run's curves.
std::string overlay_colour(std::size_t number);

nlohmann::ordered_json overlays_json(const std::vector<Overlay>& overlays);

/// What the script of report.html knows of a run: the curves, the events and the shapes.
nlohmann::ordered_json report_data(const Record& record, const ShapePictures& shapes);

}  // namespace arcwall
