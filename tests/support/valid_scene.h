// A valid scene that uses every table and every kind of value, for tests that break one thing in it.
#pragma once

inline constexpr const char* k_valid_scene = R"(version = 1

[room]
width  = 10.0
height = 8.0
depth  = 12.0

[observer]
position   = [0.0, 0.5, 5.0]
look_at    = [0.0, 0.0, 0.0]
up         = [0.0, 1.0, 0.0]
projection = "perspective"
fov        = 40.0

[image]
width      = 64
height     = 48
samples    = 4
background = [10, 20, 30]
color_management = "srgb"

[shading]
model = "phong"

[reflection]
model = "phong"

[[light]]
name      = "lamp"
type      = "point"
color     = [250, 240, 230]
intensity = 20.0
position  = [1.0, 2.0, 3.0]
attenuation        = "offset-linear"
attenuation_offset = 0.5

[[light]]
name        = "beam"
type        = "spot"
position    = [0.0, 3.5, 0.25]
direction   = [0.0, -1.0, 0.0]
inner_angle = 15.0
outer_angle = 35.0
falloff     = "linear"

[[light]]
name      = "sun"
type      = "directional"
direction = [0, -1, -1]

[[light]]
name  = "sky"
type  = "ambient"
color = [30, 30, 40]

[[object]]
name     = "box"
type     = "cube"
size     = 1.5
position = [-2.0, 0.0, 0.0]
rotation = [0.0, 30.0, 0.0]
scale    = [1.0, 0.5, 1.0]
color    = [200, 60, 40]
shading    = "flat"
reflection = "blinn-phong"

[object.material]
ka = 0.1
kd = 0.7
ks = [0.3, 0.2, 0.1]
shininess = 31.0

[[object]]
name     = "ball"
type     = "sphere"
radius   = 0.75
segments = 20
position = [0.0, -1.0, 0.0]

[object.material]
ka = 0.2
kd = 0.6
ks = 0.4
shininess = 8

[[object]]
name = "ring"
type = "torus"
major_radius = 0.8
minor_radius = 0.3
segments     = 12
position     = [2.0, 0.25, 0.0]

[[object]]
name = "wedge"
type = "mesh"
file = "wedge.obj"
position = [0.0, 1.0, -3.0]
)";

/// The mesh that the scene names: a closed tetrahedron with edges of about 1.
inline constexpr const char* k_valid_mesh =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
