#include "compare/picture.h"

#include <fmt/format.h>

std::string dimensions_text(const Picture& picture) {
    return fmt::format("{} x {}", picture.width, picture.height);
}
