"""Scenes with shadows that together have solid, open and enclosing objects; every kind of light, with samples that vary from pixel to
pixel and that are fixed; light evaluated per pixel, at vertices and for faces; all flags of lights and objects; ambient occlusion; and
sizes from a millimetre to a kilometre."""

FRAME = """version = 1
[image]
width = 320
height = 240
samples = {samples}
background = [40, 60, 80]
[room]
width = 1e5
height = 1e5
depth = 1e5
[constraints]
overlap = "allow"
[shadows]
enabled = true
pattern = "{pattern}"
[observer]
"""

SEEN = "position = [1.2, 2.6, 5.2]\nlook_at = [0, 0.5, 0]\nfov = 42\n"
SEEN_FLAT = 'position = [1.2, 3.2, 5.2]\nlook_at = [0, 0.5, 0]\nprojection = "orthographic"\nheight = 4.6\n'

AMBIENT = '[[light]]\ntype = "ambient"\nintensity = 0.25\n'
POINT = '[[light]]\nname = "lamp"\ntype = "point"\nposition = [1.6, 3.1, 1.9]\nintensity = 11\n'
SUN = '[[light]]\ntype = "directional"\ndirection = [0.8, -1, -0.55]\nintensity = 0.5\n'
SPOT = ('[[light]]\ntype = "spot"\nposition = [-2.2, 3.6, 1.4]\ndirection = [0.6, -1, -0.4]\nintensity = 16\ninner_angle = 14\n'
        'outer_angle = 33\n')
PANEL = ('[[light]]\ntype = "distributed"\nposition = [-0.6, 3.3, 1.2]\nintensity = 12\nedge_u = [1.4, 0, 0.4]\nedge_v = [0, 0, 0.9]\n'
         'samples_u = 4\nsamples_v = 3\n')
TUBE = '[[light]]\ntype = "distributed"\nposition = [2, 1.9, 1.5]\nintensity = 4\nedge_u = [0, 0.9, 0]\nsamples_u = 5\n'


def grid(columns, size):
    """A square floor of that many squares a side, facing up."""
    places = [(size * (i / columns - 0.5), size * (0.5 - k / columns)) for k in range(columns + 1) for i in range(columns + 1)]
    lines = [f"v {x:.5f} 0 {z:.5f}" for x, z in places]
    for k in range(columns):
        for i in range(columns):
            a = k * (columns + 1) + i + 1
            lines.append(f"f {a} {a + 1} {a + columns + 2} {a + columns + 1}")
    return "\n".join(lines) + "\n"


# A screen of separate strips, open, with a normal towards +z.
SCREEN = "".join(f"v {x} 0 0\nv {x + 0.12:.2f} 0 0\nv {x + 0.12:.2f} 1 0\nv {x} 1 0\n" for x in (-0.5, -0.25, 0, 0.25)) + "".join(
    f"f {i} {i + 1} {i + 2} {i + 3}\n" for i in (1, 5, 9, 13))

# A light that is not data, and says how far away it is: an object beyond it does not block it.
LANTERN = """/// # Lantern
/// A lamp that is brighter towards the side.
struct LanternLight {
    vec3 position;    /// point in m: where it is
    float intensity;  /// = 8 [0, inf): at one metre
};

KERNEL Incident lantern_illuminate(LanternLight light, Receiver r) {
    vec3 to_source = light.position - r.position;
    float square = max(dot(to_source, to_source), 1.0e-8f);
    vec3 to_light = to_source * inversesqrt(square);
    vec3 sent = vec3(light.intensity * (1.5f - to_light.y * to_light.y) / square);
    return Incident(to_light, sent, sent);
}

KERNEL float lantern_distance(LanternLight light, Receiver r) {
    return length(light.position - r.position);
}
"""


def files():
    """The files that the scenes use, by name. The floor of two triangles also reaches behind the observer."""
    return {name: text.encode() for name, text in {
        "floor.obj": grid(1, 30), "fine.obj": grid(90, 9), "screen.obj": SCREEN, "lantern.kernel": LANTERN}.items()}


def thing(text, color=(210, 190, 170), shading="phong", reflection="phong", more=""):
    return f'[[object]]\n{text}color = {list(color)}\nshading = "{shading}"\nreflection = "{reflection}"\n{more}'


def floor(file="floor.obj", **choice):
    return thing(f'name = "floor"\ntype = "mesh"\nfile = "{file}"\n', (235, 235, 235), **choice)


def ball(x, z, radius=0.45, segments=20, **choice):
    return thing(f'type = "sphere"\nradius = {radius}\nsegments = {segments}\nposition = [{x}, {radius + 0.05:.3f}, {z}]\n', (230, 120, 90), **choice)


def box(x, z, **choice):
    return thing(f'type = "cube"\nsize = 0.7\nrotation = [0, 33, 0]\nposition = [{x}, 0.36, {z}]\n', (120, 190, 230), **choice)


def ring(x, z, **choice):
    return thing(f'type = "torus"\nmajor_radius = 0.5\nminor_radius = 0.17\nsegments = 24\nposition = [{x}, 0.75, {z}]\nrotation = [65, 0, 25]\n',
                 (150, 220, 140), **choice)


def pot(x, z, **choice):
    return thing(f'type = "teapot"\nsize = 0.6\nsegments = 8\nposition = [{x}, 0.32, {z}]\n', (225, 215, 120), **choice)


def screen(x, z, turn=0, **choice):
    return thing(f'type = "mesh"\nfile = "screen.obj"\nposition = [{x}, 0.02, {z}]\nrotation = [0, {turn}, 0]\n', (200, 150, 220), **choice)


def still_life(**choice):
    return box(-1.3, 0.1, **choice) + ball(0, 0.4, **choice) + ring(1.2, -0.5, **choice) + pot(-0.1, -1.1, **choice)


HALL = thing('name = "hall"\ntype = "cube"\nsize = 14\nposition = [0, 6.9, 0]\nencloses = true\n', (220, 220, 210), reflection="lambert")
SHADE = thing('type = "cube"\nsize = 0.5\nposition = [1.6, 3.1, 1.9]\nencloses = true\n', (250, 240, 200), reflection="lambert")

def of_size(by):
    """A view and a scene whose lengths are multiples of that."""
    lengths = [f"{by * x:.9g}" for x in (1.2, 2.6, 5.2, 1.6, 3.1, 1.9, 0.45, 0.5, 0.7, -1.1, 0.4)]
    return "position = [{0}, {1}, {2}]\nlook_at = [0, 0, 0]\nfov = 42\n".format(*lengths), (
        AMBIENT + '[[light]]\ntype = "point"\nposition = [{3}, {4}, {5}]\nattenuation = "none"\nintensity = 0.8\n'.format(*lengths) +
        floor(more=f"scale = {by}\n") +
        thing('type = "sphere"\nradius = {6}\nsegments = 20\nposition = [0, {7}, 0]\n'.format(*lengths), (230, 120, 90)) +
        thing('type = "teapot"\nsize = {8}\nsegments = 8\nposition = [{9}, {10}, 0]\n'.format(*lengths), (225, 215, 120)))


SCENES = [
    ("point and ambient", 1, "varied", SEEN, AMBIENT + POINT + floor() + still_life() + screen(1.1, 1.2, 20)),
    ("spot and sun, four samples", 4, "varied", SEEN, AMBIENT + SPOT + SUN + floor() + still_life() + screen(-1.4, 1.3, -30)),
    ("vertices and faces", 1, "varied", SEEN,
     AMBIENT + POINT + SUN + floor("fine.obj", shading="gouraud") + still_life(shading="gouraud") + ball(1.2, 1.3, shading="flat") +
     screen(-1.2, 1.2, 15, shading="flat")),
    ("faces in penumbras", 1, "varied", SEEN_FLAT, AMBIENT + PANEL + floor("fine.obj", shading="gouraud") + still_life(shading="flat")),
    ("penumbras that vary", 1, "varied", SEEN_FLAT, AMBIENT + PANEL + TUBE + floor() + still_life() + screen(1.1, 1.2, 20)),
    ("penumbras in steps, four samples", 4, "fixed", SEEN, AMBIENT + PANEL + TUBE + floor() + still_life()),
    ("inside of a hall, and a shade around a lamp", 1, "varied", SEEN,
     AMBIENT + POINT + SPOT + HALL + SHADE + still_life(reflection="half-lambert") + screen(1.1, 1.2, 20, reflection="gooch")),
    ("flags", 1, "varied", SEEN,
     AMBIENT + POINT + SUN + "casts_shadows = false\n" + TUBE + floor() + ball(0, 0.4, more="casts_shadows = false\n") +
     box(-1.3, 0.1, more="receives_shadows = false\n") + ring(1.2, -0.5) + pot(-0.1, -1.1, more="receives_shadows = false\n")),
    ("ambient occlusion", 1, "varied", SEEN,
     AMBIENT + "ambient_occlusion_rays = 16\nambient_occlusion_distance = 1.5\n" + POINT +
     '[[light]]\ntype = "hemisphere"\nsky_color = [90, 110, 160]\nground_color = [60, 50, 40]\nambient_occlusion_rays = 9\n'
     "ambient_occlusion_distance = 0.6\n" + floor() + still_life() + screen(1.1, 1.2, 20)),
    ("models that light beyond the horizon", 1, "fixed", SEEN_FLAT,
     AMBIENT + "ambient_occlusion_rays = 8\nambient_occlusion_distance = 1\n" + SUN + SPOT + floor() + still_life(reflection="half-lambert") +
     ball(1.4, 1.2, segments=8, reflection="gooch")),
    ("a light of another author", 1, "varied", SEEN,
     AMBIENT + '[[light]]\ntype = "lantern.kernel"\nposition = [1.6, 3.1, 1.9]\nintensity = 9\n' + floor() + still_life() +
     thing('type = "cube"\nsize = 0.6\nposition = [1.75, 3.6, 2.05]\n')),
    ("a millimetre", 1, "varied", *of_size(0.001)),
    ("a kilometre", 1, "varied", *of_size(1000)),
]


def scene_text(number):
    """The TOML of a scene."""
    _, samples, pattern, view, content = SCENES[number]
    return FRAME.format(samples=samples, pattern=pattern) + view + content
