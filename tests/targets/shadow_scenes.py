"""Scenes in which objects block light: solid, open and enclosing ones, evaluated per pixel, at vertices and for faces, under lights of all
kinds, with and without casting or receiving shadows and ambient occlusion."""

import random

SCENES = 4

# Seen and lit from both sides: a floor of two triangles, and a wall that stands on it, bent in the middle.
FLOOR = "v -4 0 -4\nv -4 0 4\nv 4 0 4\nv 4 0 -4\nf 1 2 3 4\n"
# Its normals are interpolated across the bend.
WALL = ("v -0.6 0 0.2\nv 0 0 0\nv 0.6 0 0.2\nv -0.6 1 0.2\nv 0 1 0\nv 0.6 1 0.2\n"
        "f 1 2 5 4\nf 2 3 6 5\n")
# A wall whose bend is sharp.
SCREEN = ("v -0.6 0 0.2\nv 0 0 0\nv 0 1 0\nv -0.6 1 0.2\nv 0 0 0\nv 0.6 0 0.2\nv 0.6 1 0.2\nv 0 1 0\n"
          "vn 0.31623 0 0.94868\nvn -0.31623 0 0.94868\nf 1//1 2//1 3//1 4//1\nf 5//2 6//2 7//2 8//2\n")

# A name, a shape, and a place above the floor; they overlap nowhere.
OBJECTS = (
    ("ball", 'type = "sphere"\nradius = 0.5\nsegments = {segments}\n', (-1.5, 0.62, 0.4)),
    ("ring", 'type = "torus"\nmajor_radius = 0.42\nminor_radius = 0.15\nsegments = {segments}\nrotation = [{tilt}, 20, 0]\n', (1.5, 0.75, 0.6)),
    ("box", 'type = "cube"\nsize = 0.6\nrotation = [0, {tilt}, 0]\n', (-0.5, 0.302, 1.4)),
    ("upper", 'type = "sphere"\nradius = 0.35\nsegments = {segments}\n', (0.1, 1.5, -0.3)),
    ("wall", 'type = "mesh"\nfile = "{wall}.obj"\n', (0, 0.001, -1.4)),
    ("pot", 'type = "teapot"\nsize = 0.7\nsegments = 6\nrotation = [0, {tilt}, 0]\n', (0.5, 0.4, 2.1)),
    ("shade", 'type = "cube"\nsize = 0.5\nencloses = true\n', (-1.6, 1.8, -0.5)),
)

LIGHTS = (
    'type = "ambient"\ncolor = [70, 75, 90]\n',
    'name = "sun"\ntype = "directional"\ndirection = [{x}, -1, -0.4]\nintensity = 0.25\n',
    'type = "point"\nposition = [{x}, 2.8, 1.8]\nintensity = 3\n',
    'type = "spot"\nposition = [2.2, 3, {x}]\ndirection = [-1.2, -2, 0.2]\nintensity = 5\ninner_angle = 15\nouter_angle = 40\n',
    'type = "distributed"\nposition = [{x}, 3.1, 1]\nedge_u = [1.4, 0, 0]\nedge_v = [0, 0, 0.8]\nsamples_u = 3\nsamples_v = 2\nintensity = 3\n',
    'name = "inside"\ntype = "point"\nposition = [-1.6, 1.8, -0.5]\nintensity = 0.3\n',  # within the shade
)

# Data say where a light is; one that is not data says how far away it is.
LAMP = """/// # Lamp
/// A light that fades faster than others.
struct LampLight {
    vec3 position;    /// point in m: where it is
    float intensity;  /// = 1 [0, inf): at one metre
};

KERNEL float lamp_distance(LampLight light, Receiver r) {
    return length(light.position - r.position);
}

KERNEL Incident lamp_illuminate(LampLight light, Receiver r) {
    float fading = 1.0f / max(lamp_distance(light, r), 0.01f);
    return point_source(light.position, vec3(fading), light.intensity, 0, 0.0f, r);
}
"""


def files():
    return {"lamp.kernel": LAMP.encode(), "floor.obj": FLOOR.encode(), "wall.obj": WALL.encode(), "screen.obj": SCREEN.encode()}


def objects_text(reflections, shadings, number, is_exact, chance):
    text = '[[object]]\nname = "floor"\ntype = "mesh"\nfile = "floor.obj"\nreflection = "lambert"\nshading = "phong"\n'
    for place, (name, shape, position) in enumerate(OBJECTS):
        # POV-Ray does not smooth the shadow of an open surface on itself.
        if is_exact and name == "pot":
            continue
        values = {"segments": chance.choice([9, 14, 24]), "tilt": chance.randrange(15, 60), "wall": "screen" if is_exact else "wall"}
        text += (f'[[object]]\nname = "{name}"\n{shape.format(**values)}position = [{position[0]}, {position[1]}, {position[2]}]\n'
                 f'color = {[chance.randrange(80, 256) for _ in range(3)]}\n')
        # In POV-Ray, the parts of an object that is not convex always block each other's light.
        receives = (place + number) % 5 != 2 or (is_exact and name not in ("ball", "box", "upper"))
        model = reflections[(place + 3 * number) % len(reflections)]
        shading = shadings[(place + number) % len(shadings)]
        text += f'reflection = "{model}"\nshading = "{shading}"\n'
        if (place + number) % 5 == 4:
            text += "casts_shadows = false\n"
        if not receives:
            text += "receives_shadows = false\n"
    return text


def scene_text(reflections, number, is_exact):
    """The TOML of a scene; it needs files(). `is_exact`: without what POV-Ray only approximates."""
    chance = random.Random(number)
    size = ("perspective", "fov = 50") if number != 1 else ("orthographic", "height = 4.4")
    samples = 4 if number == 3 and not is_exact else 1
    pattern = "fixed" if is_exact or number % 2 == 1 else "varied"
    text = (f'version = 1\n[shadows]\nenabled = true\npattern = "{pattern}"\n[observer]\nposition = [0.4, 2.6, 4.4]\nlook_at = [0, 0.5, 0]\n'
            f'projection = "{size[0]}"\n{size[1]}\n[image]\nwidth = 320\nheight = 220\nsamples = {samples}\nbackground = [20, 30, 60]\n'
            f'color_management = "{"none" if number == 2 else "srgb"}"\n[room]\nwidth = 9\nheight = 9\ndepth = 9\n')
    for kind, light in enumerate(LIGHTS):
        text += "[[light]]\n" + light.format(x=round(chance.uniform(-1, 1), 2))
        if kind == 0 and number % 2 == 0 and not is_exact:
            text += "ambient_occlusion_rays = 12\nambient_occlusion_distance = 1.5\n"
        if kind == 1 and number == 2 and not is_exact:
            text += "casts_shadows = false\n"
    if not is_exact:
        text += '[[light]]\ntype = "lamp.kernel"\nposition = [0.6, 0.4, 0.3]\nintensity = 0.3\n'
    shadings = ["phong"] if is_exact else ["phong", "gouraud", "flat"]
    return text + objects_text(reflections, shadings, number, is_exact, chance)
