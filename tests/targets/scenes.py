"""Scenes that together bring every pair of a shape, a shading model, a reflection model, a light, a projection, a colour
management and a number of samples onto a picture. Made from the installed plugins, so that a new model is in one of them."""

import copy
import itertools
import json
import random
import subprocess

SCENES = 19
OBJECTS = 8  # in two rows; many objects in few scenes, since starting compilers and browsers takes most of the time
COLUMNS = 4

# An icosahedron: closed, with sharp edges, without normals, and with a different colour at each vertex.
OBJ = """v -1 1.618 0 1 1 1
v 1 1.618 0 1 .4 .3
v -1 -1.618 0 .4 1 .3
v 1 -1.618 0 .3 .5 1
v 0 -1 1.618 1 .9 .2
v 0 1 1.618 .3 1 1
v 0 -1 -1.618 1 .3 1
v 0 1 -1.618 .9 .9 .9
v 1.618 0 -1 .6 .2 .2
v 1.618 0 1 .2 .7 .2
v -1.618 0 -1 .25 .25 .8
v -1.618 0 1 1 .6 0
f 1 12 6\nf 1 6 2\nf 1 2 8\nf 1 8 11\nf 1 11 12\nf 2 6 10\nf 6 12 5\nf 12 11 3\nf 11 8 7\nf 8 2 9
f 4 10 5\nf 4 5 3\nf 4 3 7\nf 4 7 9\nf 4 9 10\nf 5 10 6\nf 3 5 12\nf 7 3 11\nf 9 7 8\nf 10 9 2
"""

# Parameters of some plugins, chosen for expressive pictures; those of others follow from their manifests (setting()), so that a new
# plugin needs no line here.
SHAPES = {
    "sphere": "radius = 0.62\nsegments = {segments}\n",
    "cube": "size = 0.85\nrotation = [{tilt}, {turn}, 10]\n",
    "torus": "major_radius = 0.45\nminor_radius = 0.18\nsegments = {segments}\nrotation = [{tilt}, {turn}, 0]\n",
    "teapot": "size = 0.6\nsegments = 8\nrotation = [{tilt}, {turn}, 0]\n",
    "mesh": 'file = "icosahedron.obj"\nscale = [0.36, 0.3, 0.36]\nrotation = [{tilt}, {turn}, 0]\n',
}

LIGHTS = {
    "ambient": "color = [60, 70, 90]\n",
    "hemisphere": "sky_color = [60, 80, 120]\nground_color = [40, 30, 20]\n",
    "directional": "direction = [{x}, -1, -0.8]\nintensity = 0.6\ncolor = [255, 240, 220]\n",
    "point": 'position = [{x}, 3.2, 2.5]\nintensity = 9\nattenuation = "{attenuation}"\nattenuation_offset = 0.5\n',
    "spot": "position = [{x}, 3.4, 3]\ndirection = [{aside}, -1, -0.9]\nintensity = 24\ninner_angle = 18\nouter_angle = 40\n",
    "distributed": "position = [{x}, 3.0, 2]\nintensity = 8\nedge_u = [1.5, 0, 0]\nedge_v = [0, 0, 0.8]\n"
                   "samples_u = 3\nsamples_v = 2\n",
}


class Catalogue:
    """The installed plugins, from `candela list --json`."""

    def __init__(self, candela):
        plugins = json.loads(subprocess.run([candela, "list", "--json"], check=True, capture_output=True).stdout)
        self.parameters = {(p["kind"], p["name"]): p["parameters"] for p in plugins}
        self.samples = [1, 4]
        self.properties = {(p["kind"], p["name"]): p["properties"] for p in plugins}

    def names(self, kind):
        return sorted(name for k, name in self.parameters if k == kind)

    def needs_file(self, kind, name):
        return any(p["type"] == "file" and "default" not in p for p in self.parameters[kind, name])

    def settings(self, kind, name, chance):
        """Its required parameters and its own colours, as TOML."""
        return "".join(f"{p['name']} = {value}\n" for p in self.parameters[kind, name] if (value := setting(p, chance)))

    def exact_of(self, target):
        """The choices without the models that a target only approximates, and without anti-aliasing, which is the target's own."""
        exact = {kind.removeprefix("exact-"): names.split(", ") for kind, names in self.properties["target", target].items()}
        chosen = self.limited_to(exact)
        chosen.samples = [1]
        return chosen

    def limited_to(self, models):
        """The choices with only these models: names by kind."""
        chosen = copy.copy(self)
        chosen.parameters = {(kind, name): p for (kind, name), p in self.parameters.items() if name in models.get(kind, [name])}
        return chosen

    def factors(self):
        # Transparent models show their surroundings, which generated programs do not have.
        reflections = [name for name in self.names("reflection") if name != "dielectric"]
        return {
            "shape": [name for name in self.names("shape") if name in SHAPES or not self.needs_file("shape", name)],
            "shading": self.names("shading"),
            "reflection": reflections,
            "light": self.names("light"),
            "projection": ["perspective", "orthographic"],
            "color_management": ["srgb", "none"],
            "samples": self.samples,
        }


def pairs_of(values):
    """The pairs that one object under one light covers."""
    return set(itertools.combinations(sorted(values.items()), 2))


def all_pairs(factors):
    pairs = set()
    for (a, of_a), (b, of_b) in itertools.combinations(sorted(factors.items()), 2):
        pairs |= {((a, x), (b, y)) for x in of_a for y in of_b}
    return pairs


def pairs_in(scene):
    found = set()
    for thing in scene["objects"]:
        for light in scene["lights"]:
            found |= pairs_of({**scene["frame"], **thing, "light": light})
    return found


def setting(parameter, chance):
    """A value that a parameter of a light or a shape needs, as TOML; None if its default will do."""
    if parameter["type"] == "color":
        return [chance.randrange(80, 256) for _ in range(3)]
    if "default" in parameter:
        return None
    if parameter["type"] == "point":
        return [round(chance.uniform(-2.5, 2.5), 2), 3.2, 2.5]
    if parameter["type"] == "direction":
        return [round(chance.uniform(-0.5, 0.5), 2), -1, -0.8]
    if parameter["type"] in ("real", "integer"):
        low, high = parameter.get("minimum", 0), parameter.get("maximum", parameter.get("minimum", 0) + 1)
        return low + (high - low) // 2 if parameter["type"] == "integer" else low + 0.5 * (high - low)
    return None


def scenes(catalogue, count=SCENES):
    """The scenes as choices: greedy, the best of many candidates each time; deterministic."""
    chance = random.Random(2026)
    factors = catalogue.factors()
    missing = all_pairs(factors)
    result = []
    for number in range(count):
        # The frames first, so that all of their pairs are covered however few objects there are.
        frame = {"projection": factors["projection"][number % 2], "color_management": factors["color_management"][number // 2 % 2],
                 "samples": factors["samples"][number // 4 % len(factors["samples"])]}
        lights = [factors["light"][(number * 2 + k) % len(factors["light"])] for k in range(3)]
        lights = sorted(set(lights))
        objects = []
        for _ in range(OBJECTS):
            candidates = [{k: chance.choice(factors[k]) for k in ("shape", "shading", "reflection")} for _ in range(200)]
            best = max(candidates, key=lambda c: len(
                missing & pairs_in({"frame": frame, "objects": [c], "lights": lights})))
            missing -= pairs_in({"frame": frame, "objects": [best], "lights": lights})
            objects.append(best)
        result.append({"frame": frame, "lights": lights, "objects": objects})
    return result


def value_text(parameter, chance):
    """Some value of a material's parameter, as TOML; nothing if the default will do."""
    if parameter["type"] == "choice":
        return json.dumps(chance.choice(parameter["choices"]))
    low, high = parameter.get("minimum"), parameter.get("maximum")
    if low is None or high is None or parameter["type"] not in ("real", "integer", "rgb"):
        return None
    share = chance.uniform(0.2, 0.7)
    value = low + share * (high - low)
    return str(round(value)) if parameter["type"] == "integer" else f"{value:.3f}"


# Of scenes in which a teapot's lid would cross its body at so small an angle that the sixteenth of a pixel to which a rasteriser rounds
# vertices decides over whole pixels which of the two is nearer.
OTHER_SEEDS = {13: 113}


def scene_text(catalogue, choices, number):
    """The TOML of a scene; it needs icosahedron.obj (OBJ) next to it."""
    chance = random.Random(OTHER_SEEDS.get(number, number))
    frame = choices["frame"]
    size = "fov = 47" if frame["projection"] == "perspective" else "height = 4.4"
    text = (f'version = 1\n[observer]\nposition = [{chance.uniform(-1, 1):.2f}, 1.6, 4.7]\nlook_at = [0, 0, 0]\n'
            f'projection = "{frame["projection"]}"\n{size}\n[image]\nwidth = 320\nheight = 200\n'
            f'samples = {frame["samples"]}\nbackground = [{chance.randrange(90)}, {chance.randrange(90)}, 60]\n'
            f'color_management = "{frame["color_management"]}"\n')
    for light in choices["lights"]:
        values = {"x": round(chance.uniform(-2.5, 2.5), 2), "aside": round(chance.uniform(-0.5, 0.5), 2),
                  "attenuation": chance.choice(["inverse-square", "offset-linear", "none"])}
        if values["attenuation"] == "none":
            values["attenuation"] = "offset-linear"
        text += f'[[light]]\ntype = "{light}"\n'
        text += LIGHTS[light].format(**values) if light in LIGHTS else catalogue.settings("light", light, chance)
    for place, thing in enumerate(choices["objects"]):
        values = {"segments": chance.choice([9, 16, 40]), "tilt": chance.randrange(-40, 40), "turn": chance.randrange(90)}
        color = [chance.randrange(60, 256) for _ in range(3)]
        row, column = divmod(place, COLUMNS)
        text += (f'[[object]]\ntype = "{thing["shape"]}"\nposition = [{-2.25 + 1.5 * column}, '
                 f'{0.3 * (-1) ** column + 0.85 - 1.7 * row:.2f}, {-0.3 * column}]\ncolor = {color}\nshading = "{thing["shading"]}"\nreflection = "{thing["reflection"]}"\n'
                 + (SHAPES[thing["shape"]].format(**values) if thing["shape"] in SHAPES
                    else catalogue.settings("shape", thing["shape"], chance)) + "[object.material]\n")
        for parameter in catalogue.parameters["reflection", thing["reflection"]]:
            value = value_text(parameter, chance)
            if value is not None:
                text += f'{parameter["name"]} = {value}\n'
    return text
