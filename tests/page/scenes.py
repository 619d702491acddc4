"""Two scenes in which every control of every light and of the objects' own models has a visible effect."""

PERSPECTIVE = """
version = 1
[observer]
position = [0.4, 1.1, 3.6]
look_at = [0.0, -0.1, 0.0]
fov = 38.0
[image]
width = 160
height = 120
samples = 4
background = [30, 40, 60]
[shading]
model = "phong"
[reflection]
model = "blinn-phong"
[[light]]
name = "sky"
type = "hemisphere"
sky_color = [120, 150, 220]
ground_color = [90, 60, 40]
up = [0.2, 1.0, 0.1]
intensity = 0.8
[[light]]
name = "lamp"
type = "spot"
position = [-1.5, 2.4, 2.0]
direction = [0.6, -1.0, -0.8]
inner_angle = 8.0
outer_angle = 36.0
intensity = 3.0
attenuation = "offset-linear"
attenuation_offset = 0.4
[[light]]
name = "sun"
type = "directional"
direction = [-0.8, -0.7, -0.4]
intensity = 0.4
color = [255, 230, 200]
[[object]]
name = "floor"
type = "cube"
scale = [4.0, 0.1, 3.0]
position = [0.0, -0.9, 0.0]
color = [170, 165, 150]
reflection = "lambert"
[[object]]
name = "ball"
type = "sphere"
radius = 0.5
segments = 32
position = [-0.6, -0.2, 0.2]
color = [200, 60, 40]
[object.material]
ka = [0.2, 0.1, 0.3]
kd = 0.6
ks = 0.35
shininess = 20.0
[[object]]
name = "pot"
type = "teapot"
size = 0.7
segments = 8
position = [0.6, -0.3, 0.0]
color = [70, 120, 190]
shading = "gouraud"
[object.material]
kd = 0.55
ks = 0.4
"""

ORTHOGRAPHIC = """
version = 1
[observer]
position = [2.0, 2.5, 3.0]
look_at = [0.0, 0.0, 0.0]
projection = "orthographic"
height = 2.6
[image]
width = 120
height = 150
samples = 1
background = [10, 10, 10]
color_management = "none"
[shading]
model = "flat"
[reflection]
model = "ward"
[[light]]
type = "distributed"
position = [1.5, 2.0, 1.0]
edge_u = [1.0, 0.0, 0.5]
edge_v = [0.0, 0.5, 0.5]
samples_u = 4
samples_v = 2
intensity = 2.0
attenuation = "offset-linear"
attenuation_offset = 0.2
[[light]]
type = "ambient"
intensity = 0.7
color = [200, 220, 255]
[[light]]
type = "point"
position = [-1.5, 1.5, 2.0]
intensity = 1.5
attenuation = "offset-linear"
attenuation_offset = 0.3
[[object]]
type = "torus"
major_radius = 0.6
minor_radius = 0.25
segments = 24
position = [0.0, 0.0, 0.0]
rotation = [20.0, 0.0, 15.0]
color = [90, 160, 80]
[object.material]
kd = 0.6
ks = 0.25
"""

# Values that pictures give, next to the numbers that objects have whatever their reflection model. The ball hides the slab's far half.
TEXTURED = """
version = 1
[observer]
position = [0.0, 1.4, 4.0]
look_at = [0.0, -0.1, 0.0]
fov = 40.0
[image]
width = 160
height = 100
samples = 4
background = [40, 50, 70]
[constraints]
overlap = "allow"
[shadows]
enabled = true
[shading]
model = "phong"
[reflection]
model = "phong"
[[light]]
type = "point"
position = [-1.5, 3.0, 3.0]
intensity = 12.0
[[light]]
type = "ambient"
intensity = 0.4
[[object]]
name = "slab"
type = "cube"
scale = [4.0, 0.2, 3.0]
position = [0.0, -0.8, 0.0]
color = { texture = "waves.ppm" }
bump_map = { texture = "waves.ppm", height = 0.1 }
[[object]]
name = "pane"
type = "cube"
scale = [0.7, 1.0, 0.1]
position = [-1.0, 0.0, 0.3]
color = [250, 60, 40]
[object.material]
opacity = 0.4
[[object]]
name = "ball"
type = "sphere"
radius = 0.5
position = [0.1, 0.0, 0.2]
color = [200, 200, 180]
normal_map = { texture = "tilts.ppm", scale = 0.6 }
[object.material]
kd = { texture = "waves.ppm", channel = "g", scale = 0.8 }
emission = [40, 90, 30]
emission_strength = 0.8
[[object]]
name = "glowing"
type = "sphere"
radius = 0.4
position = [1.2, 0.0, 0.0]
[object.material]
emission = { texture = "waves.ppm" }
emission_strength = 0.5
"""


def picture(texel):
    """Sixteen by sixteen texels."""
    return b"P6\n16 16\n255\n" + b"".join(bytes(texel(x, y)) for y in range(16) for x in range(16))


WAVES = picture(lambda x, y: (128 + 14 * abs(x - 8), 200 - 12 * abs(y - 8), 60 + 8 * abs(x - y)))
TILTS = picture(lambda x, y: (128 + 6 * (abs(x - 8) - 4), 128 + 6 * (abs(y - 8) - 4), 250))

HOSTILE_NAMES = [
    "<img src=x onerror='window.hacked=1'>",
    "</script><script>window.hacked=2</script>",
    "\\\"><svg onload=window.hacked=3>",
    "two\\nlines & \\\"quotes\\\" & 'more' \\u2028",
    "K\\u00fcrbis \\u6f22\\u5b57 \\U0001f56f \\u202egnorw",
    "<!--<script>",
]


def hostile():
    lights = "".join(f'[[light]]\nname = "{name}"\ntype = "ambient"\n' for name in HOSTILE_NAMES)
    objects = "".join(
        f'[[object]]\nname = "{name}"\ntype = "cube"\nsize = 0.3\nposition = [{0.4 * i - 1.0:.1f}, 0.0, 0.0]\n'
        for i, name in enumerate(HOSTILE_NAMES))
    return f"""
version = 1
[observer]
position = [0.0, 1.0, 4.0]
look_at = [0.0, 0.0, 0.0]
[image]
width = 64
height = 48
[shading]
model = "phong"
[reflection]
model = "lambert"
{lights}{objects}"""
