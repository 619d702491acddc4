module;

#include <string_view>

module candela.scene;

namespace candela {

std::string_view default_scene_text() noexcept {
    return R"(version = 1

[observer]
position = [0.6, 1.3, 3.0]
look_at  = [0.0, -0.6, -1.0]

[shading]
model = "phong"

[reflection]
model = "phong"

[[light]]
name      = "lamp"
type      = "point"
position  = [0.0, 0.0, 0.0]
intensity = 2.5

[[object]]
name     = "cube"
type     = "cube"
size     = 1.2
position = [0.0, -0.9, -1.2]
rotation = [0.0, 35.0, 0.0]
color    = [235, 120, 40]
)";
}

}  // namespace candela
