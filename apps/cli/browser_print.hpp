#pragma once

#include <filesystem>
#include <string_view>

namespace arcwall {

/// What a browser without a window makes of a page.
enum class PrintFormat { pdf, png };

/// Writes the page as a PDF of its own paper size, or as a PNG of 1080 × 800 points in two pixels each, by Chromium.
/// Throws OutputError, which names Debian's package if there is no such browser.
void print_page(std::string_view page, PrintFormat format, const std::filesystem::path& file);

}  // namespace arcwall
