module;

#include <string_view>

module candela.scene;

namespace candela {

std::string_view default_scene_text() noexcept {
    return R"(version = 1

[observer]
position = [2.4, 1.6, 3.6]
look_at  = [0.0, -0.85, -0.3]

[shading]
model = "phong"

[reflection]
model = "phong"

[[light]]
name      = "lamp"
type      = "point"
position  = [0.0, 0.0, 0.0]
intensity = 1.6

[[object]]
name     = "cube"
type     = "cube"
size     = 1.2
position = [0.0, -1.1, -0.3]
rotation = [0.0, 30.0, 0.0]
color    = [235, 120, 40]
)";
}

}  // namespace candela
