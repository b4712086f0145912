#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/output/files.hpp"
#include "apps/output/load_text.hpp"
#include "apps/output/overlay.hpp"
#include "apps/output/report_parts.hpp"
#include "apps/output/shape_pictures.hpp"
#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// What stands on the page beside the record.
struct ReportContent {
  std::string description{};                                 ///< the deck's
  std::string warning{};                                     ///< of the start; may be empty
  std::vector<LoadText> loads{};                             ///< those that λ multiplies
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

/// report.html: one page that needs no other file and no network.
class ReportPage {
 public:
  /// `carried`: what stands in the page beside its own text; without scripts it is the contents of another page.
  ReportPage(const Record& record, const ReportContent& content, const ReportParts& carried = report_parts());
  ReportPage(const ReportPage&) = delete;
  ReportPage& operator=(const ReportPage&) = delete;

  /// A megabyte of it is what every page has. They live as long as this.
  const Pieces& pieces() const { return pieces_; }

  std::string text() const;

 private:
  std::map<std::string, std::string, std::less<>> fields_;
  Pieces pieces_;
};

/// One printed sheet A4: answers, curve, shapes, key numbers and tables; it has no scripts.
std::string sheet_html(const Record& record, const ReportContent& content);

/// The curve with its title, for a picture; it has no scripts.
std::string picture_html(const Record& record, const ReportContent& content);

/// The report's curve alone, with its legend, as an element that can stand in any page: λ, which multiplies these
/// loads, over a monitor, or over the arc length.
std::string curve_html(const Record& record, const std::vector<LoadText>& loads, std::optional<std::size_t> monitor);

}  // namespace arcwall
