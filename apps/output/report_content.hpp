#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/output/load_text.hpp"
#include "apps/output/overlay.hpp"
#include "apps/output/shape_pictures.hpp"
#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// What stands on the page beside the record.
struct ReportContent {
  std::string description{};                                 ///< the deck's
  std::string warning{};                                     ///< of the start; may be empty
  std::vector<LoadText> loads{};                             ///< those that λ multiplies
  std::vector<std::vector<LoadText>> loads_of_stages{};      ///< in each stage; empty without stages
  std::optional<std::size_t> force{};                        ///< first monitor that is a force or a moment
  std::vector<std::string> turning_known{};                  ///< monitors whose turning points are points of the path
  std::string deck_text{};                                   ///< with every default written out
  std::vector<std::pair<std::string, std::string>> facts{};  ///< name and value: counts, versions
  ShapePictures shapes{};
  std::vector<Overlay> overlays{};
  std::string branch_map{};                                        ///< section of the page; may be empty
  std::vector<std::pair<std::string, std::string>> key_numbers{};  ///< of the deck: name and value
};

ReportContent report_content(const Model& model, const Record& record, const DrawnScenes& drawn);

}  // namespace arcwall
