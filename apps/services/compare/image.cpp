#include "compare/image.h"

#include <fmt/format.h>

std::string dimensions_text(const Image& image) { return fmt::format("{} x {}", image.width, image.height); }
