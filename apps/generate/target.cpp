#include "target.h"

#include <fmt/format.h>

#include <array>

using candela::Error;
using candela::ErrorCategory;

namespace generate {

namespace {

constexpr std::array k_targets = {
    Target{"cpp", "one C++17 file without dependencies: a small software renderer to read", "scene.cpp",
           cpp_program},
    Target{"opengl", "C++ with OpenGL 3.3: a window to look around in, or a picture without a display",
           "scene.cpp", opengl_program},
    Target{"webgl", "one HTML page with WebGL 2: look around, switch models, move sliders", "scene.html",
           webgl_page},
};

}  // namespace

std::span<const Target> targets() { return k_targets; }

const Target& target_called(const std::string& name) {
    std::vector<std::string> names;
    for (const Target& target : k_targets) {
        if (target.name == name) return target;
        names.emplace_back(target.name);
    }
    const auto near = candela::closest(name, names);
    throw Error(ErrorCategory::bad_request,
                fmt::format("there is no target '{}'{} (possible: cpp, opengl, webgl)", name,
                            near ? fmt::format("; did you mean '{}'?", *near) : ""));
}

}  // namespace generate
