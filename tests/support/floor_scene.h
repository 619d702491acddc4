// A scene from the lecture notes whose one pixel is known, for targets.
#pragma once

#include <string>

/// The floor that floor_scene() draws.
inline constexpr const char* k_floor_obj = "v 5 0 -5\nv -5 0 -5\nv -5 0 5\nv 5 0 5\nf 1 2 3 4\n";

/// RE example 2: a floor with N = (0, 1, 0) in floor.obj, seen from (20, 5, 0), lit from (-10, 10, 0).
inline std::string floor_scene(const std::string& reflection, const std::string& material) {
    return R"(version = 1
shading = {model = "phong"}
room = {width = 50, height = 50, depth = 50}
observer = {position = [20, 5, 0], look_at = [0, 0, 0], fov = 0.01}
image = {width = 9, height = 9, color_management = "none"}
reflection = {model = ")" +
           reflection + R"("}
[[light]]
type = "point"
position = [-10, 10, 0]
attenuation = "none"
[[object]]
type = "mesh"
file = "floor.obj"
color = [255, 255, 255]
[object.material]
)" + material;
}
