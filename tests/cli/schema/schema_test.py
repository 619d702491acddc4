"""Tests the output of `candela schema` with an independent validator, and against `candela check`.

Run by ctest, which sets the paths.
"""
import json
import os
import pathlib
import re
import subprocess
import tomllib
import unittest

import jsonschema

COMMAND = os.environ["CANDELA_TEST_COMMAND"]
SOURCE = pathlib.Path(os.environ["CANDELA_TEST_SOURCE"])
SCRATCH = pathlib.Path(os.environ["CANDELA_TEST_SCRATCH"])
PLUGINS = os.environ["CANDELA_TEST_PLUGINS"]


def candela(*arguments):
    """Runs the command with only the shipped plugins and those that the arguments name."""
    environment = dict(os.environ, XDG_DATA_HOME=str(SCRATCH / "nothing"), CANDELA_PLUGIN_PATH="")
    return subprocess.run([COMMAND, *arguments], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True)


def output_of(*arguments):
    done = candela(*arguments)
    if done.returncode != 0 or done.stderr:
        raise AssertionError(f"candela {arguments}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def validator_of(*arguments):
    return jsonschema.Draft7Validator(json.loads(output_of("schema", *arguments)))


def blocks(file):
    """The TOML of a Markdown page."""
    return re.findall(r"^```toml\n(.*?)^```$", (SOURCE / file).read_text(), re.M | re.S)


# A complete valid scene, as text by table, so that one table can be replaced.
TABLES = {
    "top": "version = 1",
    "room": "[room]\nheight = 100.0",
    "observer": "[observer]\nposition = [0.0, 1.0, 4.0]\nlook_at = [0.0, 0.0, 0.0]",
    "image": "[image]\nwidth = 64",
    "shading": '[shading]\nmodel = "phong"',
    "reflection": '[reflection]\nmodel = "phong"',
    "light": '[[light]]\ntype = "point"\nposition = [2.0, 3.0, 3.0]',
    "object": '[[object]]\ntype = "cube"',
}


def scene(**tables):
    """The scene with tables replaced; `<table>_more` adds to a table."""
    texts = dict(TABLES)
    for name, text in tables.items():
        if name.endswith("_more"):
            texts[name.removesuffix("_more")] += "\n" + text
        else:
            texts[name] = text
    return "\n\n".join(texts.values()) + "\n"


def light(text):
    return scene(light="[[light]]\n" + text)


def thing(text):
    return scene(object="[[object]]\n" + text)


def material(text, own=""):
    return thing(f'type = "cube"\n{own}\n[object.material]\n{text}')


WRONG = {
    # Types.
    "a text where a number is due": scene(observer_more='fov = "wide"'),
    "a number where a text is due": thing('name = 7\ntype = "cube"'),
    "a number where the name of a plugin is due": thing("type = 7"),
    "a boolean where a number is due": light('type = "ambient"\nintensity = true'),
    "a fraction where an integer is due": scene(image_more="height = 64.5"),
    "two numbers where three are due": light('type = "point"\nposition = [2.0, 3.0]'),
    "four numbers where three are due": thing('type = "cube"\nposition = [0.0, 0.0, 0.0, 1.0]'),
    "a text among three numbers": thing('type = "cube"\nrotation = [0.0, "30", 0.0]'),
    "a number where three are due": thing('type = "cube"\nposition = 0.5'),
    "two numbers where one or three are due": thing('type = "cube"\nscale = [1.0, 2.0]'),
    "a colour of fractions": light('type = "ambient"\ncolor = [0.5, 0.5, 0.5]'),
    "a date where a number is due": scene(observer_more="fov = 2024-01-01"),
    "a table where a number is due": scene(observer_more="[observer.fov]\nvertical = 40.0"),
    "a list where a table is due": scene(image="[[image]]\nwidth = 64"),
    "a table where a list is due": scene(light='[light]\ntype = "ambient"'),
    "numbers where objects are due": scene(top="version = 1\nobject = [1, 2]", object=""),
    "a number where a material is due": thing('type = "cube"\nmaterial = 3'),
    "a text where a list of files is due": scene(top='version = 1\ninclude = "lights.toml"'),
    "a number where a file is due": scene(top="version = 1\ninclude = [1]"),
    "a number where a mesh's file is due": thing('type = "mesh"\nfile = 1'),
    # Ranges.
    "a colour of 257": light('type = "ambient"\ncolor = [257, 0, 0]'),
    "a colour below zero": thing('type = "cube"\ncolor = [0, -1, 0]'),
    "a background of 300": scene(image_more="background = [0, 0, 300]"),
    "a room without height": scene(room="[room]\nheight = 0.0"),
    "a room of negative width": scene(room="[room]\nwidth = -1"),
    "a view of 180 degrees": scene(observer_more="fov = 180"),
    "a view of 0 degrees": scene(observer_more="fov = 0.0"),
    "a picture without width": scene(image="[image]\nwidth = 0"),
    "a picture that is too wide": scene(image="[image]\nwidth = 65537"),
    "five samples": scene(image_more="samples = 5"),
    "a negative intensity": light('type = "point"\nposition = [2, 3, 3]\nintensity = -0.5'),
    "an infinite intensity": light('type = "ambient"\nintensity = inf'),
    "a position at infinity": light('type = "point"\nposition = [2, 3, -inf]'),
    "an intensity too large for a float": light('type = "ambient"\nintensity = 1e39'),
    "a cone of 90 degrees": light('type = "spot"\nposition = [2, 3, 3]\ndirection = [0, -1, 0]\nouter_angle = 90.0'),
    "a direction of zero": light('type = "directional"\ndirection = [0.0, 0, 0]'),
    "no direction that is up": scene(observer_more="up = [0, 0, 0]"),
    "a scale of zero": thing('type = "cube"\nscale = 0'),
    "a scale of zero along y": thing('type = "cube"\nscale = [1.0, 0.0, 1.0]'),
    "a cube without size": thing('type = "cube"\nsize = 0.0'),
    "a sphere of two segments": thing('type = "sphere"\nsegments = 2'),
    "a sphere of too many segments": thing('type = "sphere"\nsegments = 8193'),
    "a teapot of more segments than it may have, though a sphere may": thing('type = "teapot"\nsegments = 1025'),
    "a kd above 1": material("kd = 1.01"),
    "a ks below 0 in one channel": material("ks = [0.1, -0.1, 0.1]"),
    "a negative shininess": material("shininess = -1"),
    # Names.
    "an unknown table": scene(image="[picture]\nwidth = 64"),
    "an unknown key at the top": scene(top='version = 1\ntitle = "test"'),
    "an unknown key of a table": scene(image_more="depth = 3"),
    "an unknown key of a light": light('type = "ambient"\nintensty = 2.0'),
    "an unknown key of a material": material("kd = 0.5\nshinyness = 3.0"),
    "a key of another light": light('type = "ambient"\nposition = [0.0, 0.0, 0.0]'),
    "a key of another shape": thing('type = "cube"\nradius = 0.5'),
    "a key of another model than the object's": material("shininess = 3.0", 'reflection = "lambert"'),
    "a key of another model than the scene's": scene(reflection='[reflection]\nmodel = "lambert"', object_more="[object.material]\nks = 0.1"),
    "a material in [reflection]": scene(reflection_more="kd = 0.5"),
    "a parameter that a shading model lacks": scene(shading_more="levels = 3"),
    "an unknown light": light('type = "lamp"'),
    "an unknown shape": thing('type = "dodecahedron"'),
    "an unknown shading model": scene(shading='[shading]\nmodel = "smooth"'),
    "an unknown reflection model": scene(reflection='[reflection]\nmodel = "pong"'),
    "an unknown shading model of an object": thing('type = "cube"\nshading = "smooth"'),
    "an unknown reflection model of an object": thing('type = "cube"\nreflection = "Phong"'),
    "a light as a shape": thing('type = "point"\nposition = [0.0, 0.0, 0.0]'),
    "an unknown word": scene(observer_more='projection = "fisheye"'),
    "an unknown word of a plugin": light('type = "point"\nposition = [2, 3, 3]\nattenuation = "linear"'),
    # Missing keys.
    "a light without type": light("color = [255, 255, 255]"),
    "an object without type": thing("size = 1.0"),
    "a point light without position": light('type = "point"'),
    "a mesh without file": thing('type = "mesh"'),
    "an observer without position": scene(observer="[observer]\nlook_at = [0, 0, 0]"),
    "an observer that looks nowhere": scene(observer="[observer]\nposition = [0, 1, 4]"),
    "[shading] without model": scene(shading="[shading]"),
    # The version.
    "version 2": scene(top="version = 2"),
    "the version as a text": scene(top='version = "1"'),
}

BOUNDARIES = {
    "the scene itself": scene(),
    "whole numbers where numbers are due": scene(room="[room]\nheight = 100", observer="[observer]\nposition = [0, 1, 4]\nlook_at = [0, 0, 0]"),
    "a view of nearly 180 degrees": scene(observer_more="fov = 179.99"),
    "a view of nearly 0 degrees": scene(observer_more="fov = 0.01"),
    "an orthographic view": scene(observer_more='projection = "orthographic"\nheight = 0.001'),
    "up, with one number that is not zero": scene(observer_more="up = [0, 0.001, 0]"),
    "one pixel": scene(image="[image]\nwidth = 1\nheight = 1"),
    "the widest picture": scene(image="[image]\nwidth = 65536"),
    "sixteen samples": scene(image_more="samples = 16"),
    "numbers as they are": scene(image_more='color_management = "none"'),
    "colours of 0, 255 and 256": thing('type = "cube"\ncolor = [0, 255, 256]'),
    "no intensity": light('type = "ambient"\nintensity = 0'),
    "a spot without inner cone": light('type = "spot"\nposition = [2, 3, 3]\ndirection = [0, -1, 0]\ninner_angle = 0\nouter_angle = 89.99'),
    "an attenuation by word": light('type = "point"\nposition = [2, 3, 3]\nattenuation = "offset-linear"\nattenuation_offset = 0'),
    "a scale in one number": thing('type = "cube"\nscale = 0.001'),
    "a scale in three": thing('type = "cube"\nscale = [0.5, 1, 0.001]'),
    "a rotation below zero": thing('type = "cube"\nrotation = [-720, 0.5, 1e3]'),
    "a sphere of three segments": thing('type = "sphere"\nsegments = 3'),
    "coefficients of 0 and 1": material("ka = 0\nkd = 1\nks = [0.0, 0, 0]\nshininess = 0"),
    "the parameters of the object's own model": material("exponent = 1", 'reflection = "half-lambert"'),
    "the parameters of the scene's model": scene(reflection='[reflection]\nmodel = "half-lambert"', object_more="[object.material]\nexponent = 0"),
    "a shading model of its own": thing('type = "cube"\nshading = "flat"'),
    "neither lights nor objects": scene(light="", object=""),
    "neither lights nor objects, as empty lists": scene(top="version = 1\nlight = []\nobject = []", light="", object=""),
    "tables on one line": scene(object='[[object]]\ntype = "cube"\nmaterial = {kd = 0.5, ks = 0.5}'),
    "an empty list of files": scene(top="version = 1\ninclude = []"),
    "no room and no picture": scene(room="", image=""),
}

# Errors that a JSON Schema of one file cannot express.
BEYOND = {
    "no version": scene(top=""),
    "no observer": scene(observer=""),
    "an inner cone wider than the outer": light('type = "spot"\nposition = [2, 3, 3]\ndirection = [0, -1, 0]\ninner_angle = 30.0\nouter_angle = 20.0'),
    "two lights of one name": scene(light_more='name = "lamp"\n[[light]]\ntype = "ambient"\nname = "lamp"'),
    "a file that does not exist": thing('type = "mesh"\nfile = "nowhere.obj"'),
    "1.0 where an integer is due": scene(image="[image]\nwidth = 64.0"),
    "nan": light('type = "ambient"\nintensity = nan'),
    "an observer that looks at itself": scene(observer="[observer]\nposition = [0, 1, 4]\nlook_at = [0, 1, 4]"),
}


class Schema(unittest.TestCase):
    def test_meta(self):
        schema = json.loads(output_of("schema"))
        self.assertEqual(schema["$schema"], "http://json-schema.org/draft-07/schema#")
        jsonschema.Draft7Validator.check_schema(schema)
        # The meta-schema accepts unknown keywords and wrong references. A kernel file's parameters are unknown, so that
        # the tables which may have them are open; the cases for installed models close them.
        open_tables = {"[shading]", "[[light]]", "[object.material]"}
        objects = 0
        for node in self.nodes(schema):
            if node.get("type") == "object":
                objects += 1
                if node.get("title") not in open_tables:
                    self.assertIs(node.get("additionalProperties"), False, node.get("title"))
                self.assertTrue(node.get("title"), node)
            if "$ref" in node:
                self.assertIn(node["$ref"].removeprefix("#/definitions/"), schema["definitions"])
        self.assertGreater(objects, 8)

    def test_complete(self):
        schema = json.loads(output_of("schema"))
        properties = schema["properties"]
        places = {
            "light": (properties["light"]["items"]["properties"], "type"),
            "shape": (properties["object"]["items"]["properties"], "type"),
            "shading": (properties["shading"]["properties"], "model"),
            "reflection": (properties["object"]["items"]["properties"]["material"]["properties"], None),
        }
        parameters = 0
        for plugin in json.loads(output_of("list", "--json")):
            if plugin["kind"] in ("image", "target"):  # scene files name none
                continue
            definition = schema["definitions"][f"{plugin['kind']}-{plugin['name']}"]
            place, key = places[plugin["kind"]]
            if key:
                names = place[key] if plugin["kind"] == "shape" else place[key]["anyOf"][0]
                self.assertIn(plugin["name"], names["enum"])
            for parameter in plugin["parameters"]:
                parameters += 1
                self.assertIn(parameter["name"], definition["properties"])
                known = place[parameter["name"]]
                self.assertIn(parameter["meaning"], known["description"])
                self.assertEqual(parameter["name"] in definition.get("required", []), "default" not in parameter)
                if parameter["type"] == "choice":
                    own = definition["properties"][parameter["name"]]
                    if own is not True:
                        self.assertEqual(own["enum"], parameter["choices"])
                    # If models describe a key of the same name differently, the description lists all.
                    if "enum" in known:
                        self.assertEqual(known["enum"], parameter["choices"])
                    else:
                        for choice in parameter["choices"]:
                            self.assertIn(f"'{choice}'", known["description"])
        self.assertGreater(parameters, 20)
        self.assertEqual(properties["reflection"]["properties"]["model"]["anyOf"][0]["enum"],
                         properties["object"]["items"]["properties"]["reflection"]["anyOf"][0]["enum"])

    def test_documentation(self):
        validator = validator_of()
        source = (SOURCE / "core/scene/default_scene.cpp").read_text()
        scenes = {"the default scene": re.search(r'R"\((.*?)\)"', source, re.S).group(1)}
        for file in sorted((SOURCE / "docs/examples").glob("*.toml")):
            scenes[file.name] = file.read_text()
        self.assertGreater(len(scenes), 1)
        for page in ("README.md", "docs/user/scene-file.md", "docs/user/scene-reference.md"):
            found = blocks(page)
            self.assertTrue(found, page)
            scenes.update({f"{page}, block {i}": text for i, text in enumerate(found)})
        for name, text in scenes.items():
            with self.subTest(name):
                validator.validate(tomllib.loads(text))

    def test_kernel_files(self):
        validator = validator_of()
        kernel = scene(object='[[object]]\ntype = "cube"\nreflection = "velvet.kernel"\nmaterial = { sheen = 0.4 }',
                       light='[[light]]\ntype = "lights/sky.kernel"\nhaze = 0.2', shading='[shading]\nmodel = "./own.kernel"')
        validator.validate(tomllib.loads(kernel))
        for name in ("velvet", "velvet.kernel.txt"):
            self.assertFalse(validator.is_valid(tomllib.loads(kernel.replace("velvet.kernel", name))), name)

    def nodes(self, node):
        """All schemas within a schema."""
        if isinstance(node, dict):
            yield node
            for key, value in node.items():
                if key not in ("default", "enum", "const", "x-taplo"):
                    yield from self.nodes(value)
        elif isinstance(node, list):
            for value in node:
                yield from self.nodes(value)


class Agreement(unittest.TestCase):
    def compare(self, scenes, by_schema, by_check, arguments=()):
        validator = validator_of(*arguments)
        for name, text in scenes.items():
            with self.subTest(name):
                file = SCRATCH / (re.sub(r"\W", "-", name) + ".toml")
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text)
                problems = [f"{'.'.join(map(str, e.path))}: {e.message}" for e in validator.iter_errors(tomllib.loads(text))]
                self.assertEqual(not problems, by_schema, f"JSON Schema: {problems or 'accepted'}\n{text}")
                done = candela("check", str(file), *arguments)
                self.assertEqual(done.returncode, 0 if by_check else 3, f"candela check: {done.stderr or 'accepted'}\n{text}")

    def test_wrong(self):
        self.assertGreater(len(WRONG), 60)
        self.compare(WRONG, by_schema=False, by_check=False)

    def test_boundaries(self):
        self.compare(BOUNDARIES, by_schema=True, by_check=True)

    def test_beyond_schemas(self):
        self.compare(BEYOND, by_schema=True, by_check=False)

    def test_parts(self):
        """`candela check a.toml b.toml` accepts the parts as a scene, and each part fits the schema by itself."""
        validator = validator_of()
        SCRATCH.mkdir(parents=True, exist_ok=True)
        files = []
        for name, text in TABLES.items():
            validator.validate(tomllib.loads(text))
            file = SCRATCH / f"{name}.toml"
            file.write_text(text)
            files.append(str(file))
        done = candela("check", *files)
        self.assertEqual(done.returncode, 0, done.stderr)


# Every value that the test plugin takes, and some that it does not.
GOOD_VALUES = {
    "gloss": ["1", "0.001"],
    "kd": ["2", "1.5", "0"],
    "layers": ["1", "8"],
    "metallic": ["true", "false"],
    "finish": ['"matt"', '"satin"'],
    "label": ['""', '"any"'],
    "tint": ["[0, 128, 256]"],
    "grain": ["[-2, 0.5, 2.0]"],
    "anchor": ["[-1e6, 0, 1e6]"],
    "axis": ["[0, 0, -3.5]"],
    "weights": ["0.99", "[-5, 0, 0.5]", "-1e30"],
    "turn": ["[[1, 0, 0], [0, 0.5, 0], [0, 0, -1.0]]"],
    "ramp": ["[0]", "[0, 0.5, 3]"],
}
BAD_VALUES = {
    "gloss": ["0", "1.001", '"1"', "[1, 1, 1]"],
    "kd": ["2.1", "[0.5, 0.5, 0.5]"],
    "layers": ["0", "9", "1.5", "true", "3000000000"],
    "metallic": ["1", '"true"'],
    "finish": ['"gloss"', "0"],
    "label": ["1", "true"],
    "tint": ["[0, 0, 257]", "[0.5, 0, 0]", "128"],
    "grain": ["[-2.1, 0, 0]", "[0, 0]", "1"],
    "anchor": ["[0, 0]", "[0, 0, 1e39]"],
    "axis": ["[0, 0, 0]", "[0.0, -0.0, 0]"],
    "weights": ["1", "[0, 0, 1.0]", "[0, 0]"],
    "turn": ["[[1, 0, 0], [0, 1.5, 0], [0, 0, 1]]", "[[1, 0], [0, 1]]", "[1, 0, 0, 0, 1, 0, 0, 0, 1]"],
    "ramp": ["[]", "1", "[0, -1]", "[[0], [1]]"],
}


class ThirdParty(Agreement):
    # Does not repeat the base class's tests.
    test_wrong = test_boundaries = test_beyond_schemas = test_parts = None

    def test_plugin(self):
        own = 'reflection = "every-type"'
        for text in (output_of("schema"), output_of("schema", "--format", "markdown")):
            self.assertNotIn("every-type", text)
        self.compare({"a plugin that is not there": material("gloss = 1", own)}, by_schema=False, by_check=False)

        there = ("--plugin-dir", PLUGINS)
        self.assertIn("### reflection/every-type", output_of("schema", "--format", "markdown", *there))
        self.assertEqual(set(GOOD_VALUES), set(BAD_VALUES))
        good = {"the least that it needs": material("gloss = 1", own)}
        for key, values in GOOD_VALUES.items():
            for value in values:
                rest = "" if key == "gloss" else "gloss = 1\n"
                good[f"{key} = {value}"] = material(f"{rest}{key} = {value}", own)
                good[f"{key} = {value}, by [reflection]"] = scene(
                    reflection='[reflection]\nmodel = "every-type"', object_more=f"[object.material]\n{rest}{key} = {value}")
        self.compare(good, by_schema=True, by_check=True, arguments=there)
        bad = {
            "without what is required": material("kd = 1", own),
            "without a material": thing(f'type = "cube"\n{own}'),
            "without a material, by [reflection]": scene(reflection='[reflection]\nmodel = "every-type"'),
            "a key of another model": material("gloss = 1\nks = 0.5", own),
            "its kd for another model": material("kd = 1.5", 'reflection = "lambert"'),
        }
        for key, values in BAD_VALUES.items():
            for value in values:
                rest = "" if key == "gloss" else "gloss = 1\n"
                bad[f"{key} = {value}"] = material(f"{rest}{key} = {value}", own)
        self.compare(bad, by_schema=False, by_check=False, arguments=there)


if __name__ == "__main__":
    unittest.main()
