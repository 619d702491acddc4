// A scene that tests draw and modify.
#pragma once

#include <fmt/format.h>

#include <string>

/// A box under a lamp, as the text of a scene. The box's table is the last, so more of its keys may follow.
inline std::string box_scene(int width, int height) {
    return fmt::format(R"(version = 1
[observer]
position = [0.0, 1.0, 4.0]
look_at = [0.0, 0.0, 0.0]
[image]
width = {}
height = {}
[shading]
model = "phong"
[reflection]
model = "phong"
[[light]]
name = "lamp"
type = "point"
position = [0.0, 3.0, 2.0]
intensity = 9.0
[[object]]
name = "box"
type = "cube"
)",
                       width, height);
}
