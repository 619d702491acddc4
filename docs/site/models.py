"""Pages of the installed models, from their manifests, with a rendered picture and the lobes of reflection models."""
import html
import json
import subprocess
from pathlib import Path

KINDS = {"light": "Lights", "reflection": "Reflection models", "shading": "Shading models", "shape": "Shapes",
         "image": "Picture formats", "target": "Targets"}
FACETS = 12  # few enough that shading models differ visibly

SCENE = """version = 1
[observer]
position = [0, 0.9, 3.6]
look_at = [0, 0, 0]
fov = 34
[image]
width = 480
height = 360
samples = 16
background = [24, 26, 32]
{environment}
[shading]
model = "{shading}"
[reflection]
model = "{reflection}"
[[light]]
{light}
[[light]]
type = "ambient"
color = [110, 115, 140]
[[object]]
{shape}
color = [210, 90, 60]
position = [0, 0, 0]
"""
LAMP = 'type = "point"\nposition = [1.6, 2.2, 2.4]\nintensity = 12'
BALL = 'type = "sphere"\nradius = 0.9'
# Parameters of models whose defaults show little.
LIGHTS = {
    "ambient": 'type = "ambient"\ncolor = [160, 160, 160]\nintensity = 6',
    "directional": 'type = "directional"\ndirection = [-1, -1.2, -1]',
    "distributed": 'type = "distributed"\nposition = [1.6, 2.2, 2.4]\nedge_u = [1, 0, -1]\nintensity = 12',
    "hemisphere": 'type = "hemisphere"\nintensity = 6',
    "point": LAMP,
    "spot": 'type = "spot"\nposition = [1.6, 2.2, 2.4]\ndirection = [-1.6, -2.2, -2.4]\nouter_angle = 12\ninner_angle = 6\n'
            'intensity = 14',
}
SHAPES = {"sphere": BALL, "cube": 'type = "cube"\nsize = 1.3\nrotation = [0, 35, 0]',
          "torus": 'type = "torus"\nmajor_radius = 0.75\nminor_radius = 0.3\nrotation = [35, 0, 0]',
          "teapot": 'type = "teapot"\nsize = 1.2'}
# These models show the object's surroundings and therefore have no lobe.
SHOW_SURROUNDINGS = {"dielectric"}
ENVIRONMENT = Path(__file__).resolve().parent.parent / "examples/terrace.png"


def scene_of(kind, name):
    """A scene that shows the model, or None if it has no visible effect."""
    parts = {"shading": "phong", "reflection": "phong", "light": LAMP, "shape": BALL}
    environment = ""
    if kind == "reflection":
        parts["reflection"] = name
        if name in SHOW_SURROUNDINGS:
            environment = f"environment = {json.dumps(str(ENVIRONMENT))}"
        else:
            parts["shape"] = 'type = "teapot"\nsize = 1.3'
    elif kind == "shading":
        parts["shading"] = name
        parts["shape"] = f'{BALL}\nsegments = {FACETS}'
    elif kind == "light":
        parts["light"] = LIGHTS.get(name)
    elif kind == "shape":
        parts["shape"] = SHAPES.get(name)
    else:
        return None
    return SCENE.format(**parts, environment=environment) if all(parts.values()) else None


def range_of(parameter):
    if "choices" in parameter:
        return ", ".join(f"`{choice}`" for choice in parameter["choices"])
    low, high = parameter.get("minimum"), parameter.get("maximum")
    if low is None and high is None:
        return ""
    return f"{'' if low is None else f'{low:g}'} … {'' if high is None else f'{high:g}'}"


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def parameters_table(parameters):
    if not parameters:
        return "It has no parameters.\n"
    rows = ["| parameter | type | range | unit | default | meaning |", "|---|---|---|---|---|---|"]
    for p in parameters:
        default = f"`{json.dumps(p['default'])}`" if "default" in p else "required"
        rows.append("| " + " | ".join(map(cell, (f"`{p['name']}`", p["type"], range_of(p), p.get("unit", ""), default,
                                                  p.get("meaning", "")))) + " |")
    return "\n".join(rows) + "\n"


class Models:
    def __init__(self, candela: Path, folder: Path, scratch: Path):
        self.candela, self.folder, self.scratch = candela, folder, scratch
        folder.mkdir(parents=True, exist_ok=True)
        scratch.mkdir(parents=True, exist_ok=True)

    def run(self, *words):
        subprocess.run([self.candela, *words], check=True, stdout=subprocess.DEVNULL)

    def picture(self, kind, name):
        """The file name of the picture next to the page, or None."""
        scene = scene_of(kind, name)
        if scene is None:
            return None
        file = self.scratch / f"{kind}-{name}.toml"
        file.write_text(scene)
        self.run("render", file, "-q", "-o", self.folder / f"{kind}-{name}.png")
        return f"{kind}-{name}.png"

    def lobe(self, name):
        self.run("plot", name, "phong" if name != "phong" else "lambert", "-o", self.folder / f"{name}-lobe.svg")
        return f"{name}-lobe.svg"

    def page(self, manifest):
        kind, name = manifest["kind"], manifest["name"]
        text = [f"# {manifest['title']}\n", f"`{kind}/{name}`: {manifest['summary']}\n"]
        picture = self.picture(kind, name)
        if picture:
            text.append(f"![{html.escape(manifest['title'])}: {html.escape(manifest['summary'])}]({picture})\n")
        if manifest.get("formula"):
            names = " ".join(parameter["name"] for parameter in manifest["parameters"])
            text.append(f'## Formula\n\n<pre class="formula" data-parameters="{names}">{html.escape(manifest["formula"])}</pre>\n')
        if kind == "reflection" and name not in SHOW_SURROUNDINGS:
            other = "Phong's" if name != "phong" else "Lambert's"
            text.append(f"## Lobe\n\n![The model's reflection of light from 45 degrees, with that of {other} model over it]"
                        f"({self.lobe(name)})\n")
        text.append(f"## Parameters\n\n{parameters_table(manifest['parameters'])}")
        if manifest.get("properties"):
            text.append("## Declared properties\n\n" +
                        "".join(f"- {name}: {value}\n" for name, value in manifest["properties"].items()))
        if manifest.get("reference"):
            text.append(f"## Reference\n\n{manifest['reference']}\n")
        (self.folder / f"{kind}-{name}.md").write_text("\n".join(text))
        return picture

    def write(self):
        """Writes all pages and returns their part of the navigation."""
        manifests = json.loads(subprocess.run([self.candela, "list", "--json"], check=True, capture_output=True, text=True).stdout)
        index, navigation = ["# Models\n"], [{"All models": "models/index.md"}]
        for kind, title in KINDS.items():
            of_kind = [m for m in manifests if m["kind"] == kind]
            index.append(f"## {title}\n\n<div class=\"models\" markdown=\"0\">")
            for manifest in of_kind:
                picture = self.page(manifest)
                image = f'<img src="{picture}" alt="">' if picture else ""
                index.append(f'<figure><a href="{kind}-{manifest["name"]}.html">{image}</a><figcaption>'
                             f'<a href="{kind}-{manifest["name"]}.html">{html.escape(manifest["title"])}</a><br>'
                             f'{html.escape(manifest["summary"])}</figcaption></figure>')
            index.append("</div>\n")
            navigation.append({title: [{m["title"]: f"models/{kind}-{m['name']}.md"} for m in of_kind]})
        (self.folder / "index.md").write_text("\n".join(index))
        return navigation
