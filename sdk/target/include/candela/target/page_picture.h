// A page's picture, drawn by a browser.
#pragma once

#include <filesystem>

#include "candela/target.h"

namespace candela::target {

/// Has headless Chromium draw the page, which puts the picture into itself when its URL ends in "#verify",
/// and writes it to a PNG file. Throws std::exception.
void draw_page(const std::filesystem::path& page, const std::filesystem::path& picture,
               ProgramRunner& programs);

}  // namespace candela::target
