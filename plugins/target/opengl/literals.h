// Texts within a generated OpenGL program.
#pragma once

#include <fmt/format.h>

#include <string>

namespace candela::opengl_target {

/// A raw string literal whose delimiter does not occur in the text.
inline std::string raw(const std::string& text) {
    std::string mark = "glsl";
    while (text.find(")" + mark + "\"") != std::string::npos) mark += "_";
    return fmt::format("R\"{0}({1}){0}\"", mark, text);
}

}  // namespace candela::opengl_target
