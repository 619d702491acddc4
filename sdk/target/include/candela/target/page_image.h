// A page's picture, drawn by a browser.
#pragma once

#include <filesystem>

#include "candela/target.h"

namespace candela::target {

/// Makes headless Chromium draw the page, which embeds its picture in itself if its URL ends in "#verify",
/// and writes that picture to a PNG file. Throws std::exception.
void draw_page(const std::filesystem::path& page, const std::filesystem::path& image,
               ProgramRunner& programs);

}  // namespace candela::target
