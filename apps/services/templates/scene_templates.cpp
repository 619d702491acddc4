#include "templates/scene_templates.h"

#include <string>
#include <string_view>

namespace {

constexpr std::string_view k_picture =
    R"(# A scene for Candela. Text after a # is for people; change the numbers and render again.
#
#   candela render scene.toml -o scene.png     makes the picture (.ppm, .exr, .jpg ... work as well)
#   candela check scene.toml                   says what is wrong with a scene
#   candela list                               all lights, shapes and models that are installed
#   candela describe light/spot                what one of them does, and all its parameters
#
# Lengths are in metres, angles in degrees. x points to the right, y up, z towards you.
version = 1

# All things lie in a room around the origin.
[room]
height = 10.0                        # y from -5 to 5
width  = 10.0                        # x from -5 to 5
depth  = 10.0                        # z from -5 to 5

# Where the scene is seen from.
[observer]
position   = [0.0, 2.0, 4.9]
look_at    = [0.0, 0.38, 0.0]        # the centre of the picture
fov        = 31.0                    # the angle from the bottom to the top: a smaller one zooms in
projection = "perspective"           # or "orthographic", with height = 2.0 (metres) instead of fov

[image]
width      = 800
height     = 500
samples    = 8                       # per pixel: 1 is fast, 4, 8 and 16 smooth the edges
background = [24, 26, 34]            # red, green, blue, 0 to 255 each

# Objects block light. Without this table light is local, and passes through them: assumption AS3 of the lighting model.
[shadows]
enabled = true

# How the surface between vertices is shaded: "flat" shows faces, "gouraud" shades vertices, "phong" pixels.
[shading]
model = "phong"

# How surfaces reflect light: "lambert" is matt, "half-lambert" soft, "phong" and "blinn-phong" have highlights.
[reflection]
model = "blinn-phong"

# Lights: any number. A name helps in messages, and with --set light.lamp.intensity=40
[[light]]
name      = "lamp"
type      = "point"                  # shines in all directions; others: "spot", "directional", "ambient"
position  = [-2.2, 3.4, 2.6]
color     = [255, 236, 208]          # warm white
intensity = 19.0                     # at one metre; a quarter of that at two

[[light]]
name      = "sky"
type      = "ambient"                # comes from everywhere, so that no side is black
color     = [120, 140, 190]
intensity = 2.0

# Objects: any number. They may not overlap.
[[object]]
name     = "ball"
type     = "sphere"                  # others: "cube", "torus", "teapot", "mesh" (with file = "bunny.obj")
radius   = 0.6
position = [-0.75, 0.61, 0.2]        # its centre
color    = [205, 64, 44]
[object.material]                    # parameters of the object's reflection model
kd = 0.6                             # how much light is scattered, 0 to 1
ks = 0.4                             # how strong the highlight is, 0 to 1
shininess = 60.0                     # how small the highlight is: 5 is satin, 200 is polished
ka = 0.2                             # how much of the ambient light comes back, 0 to 1

[[object]]
name         = "ring"
type         = "torus"
major_radius = 0.5                   # to the middle of the tube
minor_radius = 0.17                  # of the tube
position     = [0.85, 0.68, -0.2]
rotation     = [90.0, -25.0, 0.0]    # about x, then y, then z: upright, and turned a little
color        = [226, 172, 60]
[object.material]
kd = 0.6
ks = 0.4
shininess = 25.0
ka = 0.2

[[object]]
name       = "table"
type       = "cube"
scale      = [3.8, 0.1, 2.4]         # a cube of one metre, stretched and flattened
position   = [0.0, -0.06, 0.0]
color      = [138, 150, 160]
reflection = "lambert"               # overrides [reflection]; shading = "flat" also works here
[object.material]
kd = 0.8
ka = 0.2
)";

constexpr std::string_view k_film = R"(
# The animation: candela animate scene.toml -o film.mp4, or -o frames/%04d.png for the frames.
[animation]
frames = 96                          # numbered from 0
fps    = 24.0                        # frames per second: four seconds

# The observer goes once around the point it looks at, and is back after the last frame.
[animation.orbit]
turns = 1.0                          # 2.0 is twice, -1.0 the other way round

# Every value that --set can set can change over time: any number of tracks.
[[animation.track]]
path = "light.lamp.intensity"
keys = [[0.0, 19.0], [2.0, 6.0], [4.0, 19.0]]  # the time in seconds, and the value
interpolation = "smooth"             # between keys; or "linear", or "step"
)";

}  // namespace

std::string starter_scene(Starter starter) {
    std::string scene(k_picture);
    if (starter == Starter::film) scene += k_film;
    return scene;
}
