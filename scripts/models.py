#!/usr/bin/env python3
"""Writes the pages of the shipped lights, reflection models and shading models, docs/models/*.md, and the tables of the kernels' prelude in
docs/plugins/kernel-language.md.

    models.py CANDELA [--pictures [DIR]]    CANDELA is the built program; --pictures also draws docs/pictures/models/*, or to DIR

A page has what the model's kernel declares. The text is checked in, and a test compares it with what this script writes; the pictures are
drawn from the page's own part of a scene. docs/site/site.py uses the same functions for the kinds that have no kernels."""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import textwrap
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs/models"
PICTURES = ROOT / "docs/pictures/models"
PRELUDE = ROOT / "core/include/candela/kernel/prelude.kernel"
LANGUAGE_PAGE = ROOT / "docs/plugins/kernel-language.md"
ENVIRONMENT = ROOT / "docs/examples/terrace.png"
PHOTOMETRY = ROOT / "docs/examples/downlight.ies"
KINDS = {"light": "Lights", "reflection": "Reflection models", "shading": "Shading models", "shape": "Shapes", "image": "Picture formats",
         "target": "Targets"}
# Lines that declare something; the rest is prose (docs/plugins/adding-a-model.md).
KEYWORDS = ("reference:", "properties:", "requires:", "expects:", "presets:", "preset:", "rate:")
KERNEL_KINDS = ("light", "reflection", "shading")

# The rest of the pictures' scenes; each kind leaves out the part that its pages show.
VIEW = """version = 1
[observer]
position = [0, 0.9, 3.6]
look_at = [0, 0, 0]
fov = 34
[image]
width = {width}
height = {height}
samples = 16
{backdrop}
"""
SIZE = {"width": 480, "height": 360}
SMALL = {"width": 320, "height": 240}  # of pictures full of detail
DARK = "background = [24, 26, 32]"
SURROUNDINGS = f"environment = {json.dumps(str(ENVIRONMENT))}"
PHONG_SHADING = '[shading]\nmodel = "phong"\n'
PHONG_REFLECTION = '[reflection]\nmodel = "phong"\n'
LAMP = '[[light]]\ntype = "point"\nposition = [1.6, 2.2, 2.4]\nintensity = 12\n'
DIM = '[[light]]\ntype = "ambient"\ncolor = [110, 115, 140]\n'
COLOR = "color = [210, 90, 60]"
BALL = f'[[object]]\ntype = "sphere"\nradius = 0.9\n{COLOR}\nposition = [0, 0, 0]\n'
# Few enough segments that shading models differ visibly.
COARSE_TEAPOT = f'[[object]]\ntype = "teapot"\nsize = 1.3\nsegments = 2\n{COLOR}\nposition = [0, 0, 0]\n'
FLOOR = '[[object]]\ntype = "cube"\nscale = [7, 0.1, 7]\nposition = [0, -1, 0]\ncolor = [150, 150, 150]\n'

# Parameters that show what a model does.
LIGHTS = {
    "ambient": "color = [160, 160, 160]\nintensity = 6",
    "directional": "direction = [-1, -1.2, -1]",
    "distributed": "position = [1.6, 2.2, 2.4]\nedge_u = [1, 0, -1]\nintensity = 12",
    "environment": f'picture = "{ENVIRONMENT.name}"\nsamples = 256\nintensity = 0.8\nbackground = true',
    "gradient": "zenith_color = [235, 240, 255]\nhorizon_color = [200, 170, 150]\nground_color = [60, 50, 45]\nsamples = 256\nbackground = true",
    "hemisphere": "sky_color = [190, 215, 255]\nground_color = [90, 70, 50]\nintensity = 6",
    "ies": f'file = "{PHOTOMETRY.name}"\nposition = [0, 2.6, 0]\ndirection = [0, -1, 0]\nrotation = 30\nintensity = 0.06',
    "point": "position = [1.6, 2.2, 2.4]\nintensity = 12",
    "sky": "to_sun = [0.8, 0.5, 0.3]\nturbidity = 3\nsamples = 256\nbackground = true",
    "spot": "position = [1.6, 2.2, 2.4]\ndirection = [-1.6, -2.2, -2.4]\ninner_angle = 8\nouter_angle = 16\nintensity = 14",
    "studio": "rotation = 20\nsamples = 256\nbackground = true",
}
MATERIALS = {
    "ashikhmin-shirley": "ks = 0.2\nexponent_u = 10\nexponent_v = 100",
    "beckmann": "kd = 0.6\nks = 0.4\nroughness = 0.25\nior = 3",
    "blinn-phong": "kd = 0.6\nks = 0.4\nshininess = 80",
    "cook-torrance": "kd = 0.6\nks = 0.4\nroughness = 0.25\nior = 3",
    "dielectric": "ior = 1.5\ndepth = 2",
    "disney": "roughness = 0.4\nclearcoat = 1\nclearcoat_gloss = 0.8",
    "eon": "kd = 0.7\nroughness = 1",
    "ggx": "kd = 0.6\nks = 0.4\nroughness = 0.25\nior = 3",
    "gooch": "kd = 0.7\nks = 0.3\nwarm = [80, 80, 0]\ncool = [0, 0, 140]",
    "half-lambert": "kd = 0.7\nexponent = 2",
    "kajiya-kay": "kd = 0.4\nks = 0.4\nshininess = 40",
    "lambert": "kd = 0.7",
    "metallic-roughness": "roughness = 0.6\nclearcoat = 1\nclearcoat_roughness = 0.1\nsheen_color = 0.3\nsheen_roughness = 0.5",
    "minnaert": "kd = 0.7\nk = 0.6",
    "openpbr": "base_color = 0.8\nspecular_roughness = 0.5\ncoat_weight = 1\ncoat_roughness = 0.1\nfuzz_weight = 0.5",
    "oren-nayar": "kd = 0.7\nsigma = 40",
    "phong": "kd = 0.6\nks = 0.4\nshininess = 20",
    "specular-glossiness": "specular_color = [0.5, 0.35, 0.2]\nglossiness = 0.6",
    "toon": "ks = 0.4\nbands = 3\nhighlight = 12",
    "ward": "kd = 0.4\nks = 0.6\nroughness_u = 0.1\nroughness_v = 0.3",
}
SHAPES = {"sphere": "radius = 0.9", "cube": "size = 1.3\nrotation = [0, 35, 0]",
          "torus": "major_radius = 0.75\nminor_radius = 0.3\nrotation = [35, 0, 0]", "teapot": "size = 1.2"}
# These models show the object's surroundings and therefore have no lobe.
SHOW_SURROUNDINGS = {"dielectric"}
REFLECT_NO_LIGHTS = {"unlit"}  # and therefore have none, either
TYPES = {"real": "number", "rgb": "1 or 3 numbers", "color": "colour", "point": "3 numbers", "direction": "3 numbers",
         "vector": "3 numbers", "choice": "word", "matrix": "3 rows of 3 numbers", "numbers": "list of numbers"}


@dataclass
class Kernel:
    """The comment at the beginning of a kernel."""
    equations: list = field(default_factory=list)   # TeX
    paragraphs: list = field(default_factory=list)  # the first is the model's summary


def read_kernel(text):
    kernel, paragraph = Kernel(), []

    def end_paragraph():
        if paragraph and not paragraph[0].startswith(KEYWORDS):
            kernel.paragraphs.append(" ".join(paragraph))
        paragraph.clear()

    for line in text.splitlines():
        if not line.startswith("///"):
            break
        line = line[3:].strip()
        if line.startswith("$$"):
            end_paragraph()
            kernel.equations.append(line.strip("$ "))
        elif not line or line.startswith("# "):
            end_paragraph()
        else:
            paragraph.append(line)
    end_paragraph()
    return kernel


class Model:
    """A model: its manifest and, if it has one, its kernel."""

    def __init__(self, manifest):
        self.manifest = manifest
        self.kind, self.name, self.title = manifest["kind"], manifest["name"], manifest["title"]
        self.file = f"{self.kind}-{self.name}"
        folder = ROOT / "plugins" / self.kind
        self.source = folder / f"{self.name}.kernel"
        self.is_folder = not self.source.exists()
        if self.is_folder:
            self.source = folder / self.name / f"{self.name}.kernel"
        self.kernel = read_kernel(self.source.read_text(encoding="utf-8")) if self.source.exists() else Kernel()

    def part(self):
        """The part of a scene that the page shows; None if the model has no visible effect."""
        if self.kind == "light" and self.name in LIGHTS:
            return f'[[light]]\ntype = "{self.name}"\n{LIGHTS[self.name]}\n'
        if self.kind == "reflection":
            shape = 'type = "sphere"\nradius = 0.9' if self.name in SHOW_SURROUNDINGS else 'type = "teapot"\nsize = 1.3'
            material = f"\n[object.material]\n{MATERIALS[self.name]}\n" if self.name in MATERIALS else ""
            return f'[[object]]\n{shape}\n{COLOR}\nposition = [0, 0, 0]\nreflection = "{self.name}"\n{material}'
        if self.kind == "shading":
            return f'[shading]\nmodel = "{self.name}"\n'
        if self.kind == "shape" and self.name in SHAPES:
            return f'[[object]]\ntype = "{self.name}"\n{SHAPES[self.name]}\n{COLOR}\nposition = [0, 0, 0]\n'
        return None

    def has_lobe(self):
        return self.kind == "reflection" and self.name not in SHOW_SURROUNDINGS | REFLECT_NO_LIGHTS

    def scene(self, part):
        """The scene of the picture, with `part` in its place."""
        rest = {"light": PHONG_SHADING + PHONG_REFLECTION + DIM + BALL + FLOOR,
                "reflection": PHONG_SHADING + LAMP + DIM,
                "shading": PHONG_REFLECTION + LAMP + DIM + COARSE_TEAPOT,
                "shape": PHONG_SHADING + PHONG_REFLECTION + LAMP + DIM}
        view = {"backdrop": SURROUNDINGS, **SMALL} if self.name in SHOW_SURROUNDINGS else {"backdrop": DARK, **SIZE}
        for file in (ENVIRONMENT, PHOTOMETRY):
            part = part.replace(f'"{file.name}"', json.dumps(str(file)))
        return VIEW.format(**view) + rest[self.kind] + part

    def pictures(self):
        """The names of the page's pictures."""
        return [f"{self.file}.webp"] * (self.part() is not None) + [f"{self.file}-lobe.svg"] * self.has_lobe()


def number(value):
    return f"{value:g}" if isinstance(value, float) else json.dumps(value)


def default_of(parameter):
    if "default" not in parameter:
        return "required"
    value = parameter["default"]
    if isinstance(value, list) and parameter["type"] == "rgb" and len(set(value)) == 1:
        value = value[0]
    return f"`[{', '.join(map(number, value))}]`" if isinstance(value, list) else f"`{number(value)}`"


def range_of(parameter):
    if "choices" in parameter:
        return ", ".join(f"`{choice}`" for choice in parameter["choices"])
    if parameter["type"] == "color":
        return "0 to 255"
    words = {"minimum": "at least {:g}", "above": "above {:g}", "maximum": "at most {:g}", "below": "below {:g}"}
    if "minimum" in parameter and "maximum" in parameter:
        return f"{parameter['minimum']:g} to {parameter['maximum']:g}"
    return ", ".join(text.format(parameter[key]) for key, text in words.items() if key in parameter)


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def parameters_table(parameters):
    if not parameters:
        return "It has no parameters.\n"
    rows = ["| parameter | type | default | range | meaning |", "|---|---|---|---|---|"]
    for p in parameters:
        kind = TYPES.get(p["type"], p["type"]) + (f" in {p['unit']}" if "unit" in p else "")
        rows.append("| " + " | ".join(map(cell, (f"`{p['name']}`", kind, default_of(p), range_of(p), p.get("meaning", "")))) + " |")
    return "\n".join(rows) + "\n"


def relation(r):
    left, right, warning = r["left"], r["right"], " (a warning)" if r["only_warns"] else ""
    if r["type"] == "sum-at-most-one":
        return f"`{left}` and `{right}` together are at most 1{warning}: otherwise {r['meaning']}."
    return f"`{left}` is {'at most' if r['type'] == 'less-or-equal' else 'less than'} `{right}`{warning}: {r['meaning']}."


def paragraph(text):
    """A paragraph of a page, in which names such as light/spot are links."""
    def link(match):
        folder = ROOT / "plugins" / match[1]
        if not any((folder / name).exists() for name in (f"{match[2]}.kernel", match[2])):
            sys.exit(f"models: there is no model {match[0]}, which a kernel's comment names")
        return f"[{match[0]}]({match[1]}-{match[2]}.md)"
    text = re.sub(rf"\b({'|'.join(KERNEL_KINDS)})/([a-z]+(?:-[a-z]+)*)", link, text)
    return textwrap.fill(text, 140, break_long_words=False, break_on_hyphens=False) + "\n"


USE = {"light": "This light, with a weak ambient one, lights the picture:",
       "reflection": "This object is the one in the picture:",
       "shading": "The picture's coarse teapot has this shading model; `shading` in an object chooses another for that object:",
       "shape": "This object is the one in the picture:"}
LOBE = "Light from 45 degrees, reflected with the values above; the radius is the reflected intensity."


def page(model):
    """The text of the model's page."""
    manifest = model.manifest
    origin = model.source.relative_to(ROOT)
    text = [f"<!-- Written by scripts/models.py{f' from {origin}' if model.source.exists() else ''}. Do not edit. -->\n", f"# {model.title}\n",
            f"`{model.kind}/{model.name}`: {manifest['summary']}\n"]
    if model.part():
        text.append(f"![{cell(model.title)}: {cell(manifest['summary'])}](../pictures/models/{model.file}.webp)\n")
    text += [paragraph(p) for p in model.kernel.paragraphs[1:]]
    if model.kernel.equations:
        lines = " \\\\\n".join(f"& {equation}" for equation in model.kernel.equations)
        text.append(f"## Formula\n\nThe symbols are those of [equations.md](../user/equations.md).\n\n```math\n\\begin{{aligned}}\n{lines}\n"
                    "\\end{aligned}\n```\n")
    elif manifest.get("formula"):
        text.append(f"## Formula\n\n```text\n{manifest['formula']}\n```\n")
    if model.part():
        text.append(f"## In a scene\n\n{USE[model.kind]}\n\n```toml\n{model.part()}```\n")
    text.append(f"## Parameters\n\n{parameters_table(manifest['parameters'])}")
    text += [relation(r) + "\n" for r in manifest["relations"]]
    if manifest.get("presets"):
        names = ", ".join(preset["name"] for preset in manifest["presets"])
        text.append(f"## Presets\n\n{paragraph(f'{names[0].upper()}{names[1:]}.')}\n"
                    f"`candela describe {model.kind}/{model.name}` prints their values; a page of `candela view` offers them in a menu.\n")
    if model.has_lobe():
        text.append(f"## Lobe\n\n{LOBE}\n\n![Polar diagram of the light reflected by {cell(model.title)}](../pictures/models/{model.file}-lobe.svg)\n")
    if manifest.get("properties"):
        facts = [name if value == "true" else f"{name}: {value}" for name, value in manifest["properties"].items()]
        text.append(f"## Properties\n\nDeclared, and verified by the [conformance kit](../plugins/adding-a-model.md#properties): {', '.join(facts)}.\n")
    if manifest.get("reference"):
        text.append(f"## Reference\n\n{paragraph(manifest['reference'].rstrip('.') + '.')}")
    if model.source.exists():
        whole = "Its mathematics is in" if model.is_folder else "The whole model is one file:"
        text.append(f"{whole} [{origin}](../../{origin}).\n")
    return "\n".join(text)


def index(models):
    """The text of README.md, a table of all models."""
    text = ["<!-- Written by scripts/models.py. Do not edit. -->\n", "# Models\n",
            paragraph("A page for each model: what it looks like, when to choose it, its formula, its parameters, and lines to paste into a scene. "
                      "A model of your own is a file like theirs: [adding-a-model.md](../plugins/adding-a-model.md).")]
    for kind, title in KINDS.items():
        of_kind = [model for model in models if model.kind == kind]
        if not of_kind:
            continue
        text.append(f"## {title}\n\n| | model | |\n|---|---|---|")
        for model in of_kind:
            picture = f'<img src="../pictures/models/{model.file}.webp" width="160" alt="">' if model.part() else ""
            text.append(f"| {picture} | [{cell(model.title)}]({model.file}.md) `{model.name}` | {cell(model.manifest['summary'])} |")
        text.append("")
    return "\n".join(text)


def shipped(candela, kinds=KERNEL_KINDS):
    """The models of `kinds` that Candela ships, without those that the user has installed."""
    nowhere = {**os.environ, "XDG_DATA_HOME": os.devnull, "CANDELA_PLUGIN_PATH": ""}
    listed = subprocess.run([candela, "list", "--json"], check=True, capture_output=True, text=True, env=nowhere).stdout
    return [Model(manifest) for manifest in json.loads(listed) if manifest["kind"] in kinds]


def texts(models):
    """All pages and their index, by file name."""
    return {"README.md": index(models), **{f"{model.file}.md": page(model) for model in models}}


def prelude_tables():
    """The structs and functions that every kernel can use, as two tables."""
    structs = ["| struct | member | |", "|---|---|---|"]
    functions = ["| function | |", "|---|---|"]
    comment, inside = [], False
    for line in PRELUDE.read_text(encoding="utf-8").splitlines():
        code, _, behind = (part.strip() for part in line.partition("//"))
        if inside:
            inside = code != "};"
            if inside:
                structs.append(f"| | `{code.rstrip(';')}` |" + (f" {cell(behind)}" if behind else "") + " |")
        elif not code:
            comment = [*comment, behind] if behind else []
        elif code.startswith("struct "):
            inside = True
            structs.append(f"| `{code.split()[1]}` | | {cell(' '.join(comment))} |")
        elif code.startswith("KERNEL "):
            functions.append(f"| `{code.removeprefix('KERNEL ').rstrip(' {')}` | {cell(' '.join(comment))} |")
    return "\n".join([*structs, "", *functions, ""])


def language_page():
    """The text of the page of the kernel language, with the prelude's tables."""
    begin, end = "<!-- Written by scripts/models.py from candela/kernel/prelude.kernel: -->\n\n", "\n<!-- The end of the prelude. -->\n"
    before, rest = LANGUAGE_PAGE.read_text(encoding="utf-8").split(begin)
    after = rest.split(end)[1]
    return before + begin + prelude_tables() + end + after


def draw(candela, models, folder):
    """Draws the models' pictures to `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        for model in models:
            if model.part():
                scene = Path(scratch) / f"{model.file}.toml"
                scene.write_text(model.scene(model.part()), encoding="utf-8")
                subprocess.run([candela, "render", scene, "-q", "-o", folder / f"{model.file}.webp"], check=True)
            if model.has_lobe():
                values = ",".join(line.replace(" ", "") for line in MATERIALS.get(model.name, "").splitlines() if "[" not in line)
                subprocess.run([candela, "plot", "-q", f"reflection/{model.name}" + (f":{values}" if values else ""), "-o",
                                folder / f"{model.file}-lobe.svg"], check=True, stdout=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("candela", type=Path)
    parser.add_argument("--pictures", nargs="?", type=Path, const=PICTURES)
    options = parser.parse_args()
    models = shipped(options.candela.resolve())
    PAGES.mkdir(exist_ok=True)
    for name, text in texts(models).items():
        (PAGES / name).write_text(text, encoding="utf-8")
    LANGUAGE_PAGE.write_text(language_page(), encoding="utf-8")
    if options.pictures:
        draw(options.candela.resolve(), models, options.pictures.resolve())


if __name__ == "__main__":
    main()
