"""Checks that imported models look as POV-Ray draws them from files read by this test's own readers.

    povray_test.py CANDELA FOLDER        FOLDER: of assimp's models

The camera, the lights, and material properties that a file omits come from the imported scene; geometry, normals, colours and materials
come from the file, read independently. If POV-Ray lacks the file's material, both draw Lambert's. Textures, which POV-Ray filters
differently, are left out."""
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

import readers

WIDTH, HEIGHT = 400, 300
TOLERANCE = 2  # of 255
LAMBERT_KD = 0.7  # reflection/lambert without a setting
EDGE = 14  # more between neighbours is an edge, where the two may see different surfaces
PHONG, LAMBERT, FACETS = (), ("--reflection", "lambert"), ("--reflection", "lambert", "--shading", "flat")
# The file, the models to draw, and a brightness of the scene's lights at which nothing is white.
CASES = (
    ("OBJ/WusonOBJ.obj", PHONG, 0.7),  # normals and highlights
    ("OBJ/cube_usemtl.obj", PHONG, 0.4),  # materials of an MTL file, and one that it lacks
    ("OBJ/spider.obj", PHONG, 0.6),  # materials whose Ka is not their Kd
    ("OBJ/regr01.obj", FACETS, 0.6),  # a house of many materials, with polygons and without normals
    ("OBJ/box.obj", PHONG, 1),  # no normals, hard edges
    ("OBJ/cube_with_vertexcolors.obj", PHONG, 1),
    ("PLY/cube_uv.ply", PHONG, 1),
    ("PLY/float-color.ply", PHONG, 1),
    ("STL/Spider_binary.stl", FACETS, 1),
    ("glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", LAMBERT, 1),
    ("glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", LAMBERT, 1),
)


def linear(srgb):
    """Decodes 0 to 1 by IEC 61966-2-1."""
    value = np.asarray(srgb, float)
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def three(value):
    return np.broadcast_to(np.asarray(value, float), 3)


def vector(values):
    return f"<{', '.join(f'{value:.9g}' for value in values)}>"


def vectors(name, rows):
    return f"{name} {{ {len(rows)}, {', '.join(map(vector, rows))} }}\n"


class Material:
    """kd and ka multiply the colour, ks and the exponent are Phong's."""

    def __init__(self, color, ka, kd, ks=0.0, exponent=1.0):
        self.color, self.ka, self.kd, self.ks, self.exponent = color, three(ka), three(kd), ks, exponent


class Materials:
    def __init__(self, path, scene):
        self.objects = {entry.get("part", ""): entry for entry in scene["object"]}
        library = path.with_suffix(".mtl")
        self.library = readers.read_mtl(library) if library.exists() else {}
        self.base_colors = readers.base_colors(path) if path.suffix in (".gltf", ".glb") else []

    def of(self, part):
        if self.base_colors:
            color, metallic = self.base_colors[part.material]
            # reflection/lambert takes only ka from the imported material, which is metallic-roughness's. glTF 2.0, appendix B: the index of
            # refraction is 1.5.
            return Material(color, 0.96 * (1 - metallic), LAMBERT_KD)
        if part.material in self.library:
            found = self.library[part.material]
            # docs/user/meshes.md: no highlight without an exponent, no more is sent out than is received, and white ambient
            # light is the surface's colour.
            ka, kd, ks = (np.array(found[key]) for key in ("Ka", "Kd", "Ks"))
            ks = ks * (found["Ns"][0] > 0)
            most = max(1, *(kd + ks))
            kd, ks = kd / most, ks / most
            return Material((1, 1, 1), kd if all(ka == 1) else ka, kd, ks[0], found["Ns"][0])
        said = self.objects[part.material if part.material in self.objects else ""]
        values = said["material"]
        return Material(linear(np.array(said["color"]) / 255), values["ka"], values["kd"], values["ks"], values["shininess"])


def camera_text(observer):
    eye, target = np.array(observer["position"]), np.array(observer["look_at"])
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, observer.get("up", (0, 1, 0)))
    right /= np.linalg.norm(right)
    height = 2 * np.tan(np.radians(observer["fov"]) / 2)
    return (f"camera {{ perspective location {vector(eye)} direction {vector(forward)} "
            f"right {vector(right * height * WIDTH / HEIGHT)} up {vector(np.cross(right, forward) * height)} }}\n")


def lights_text(lights, size, brightness):
    text, ambient = "", np.zeros(3)
    for light in lights:
        color = linear(np.array(light["color"]) / 255) * light["intensity"] * brightness
        if light["type"] == "ambient":
            ambient += color
        else:
            assert light["type"] == "directional", light["type"]
            text += f"light_source {{ {vector(-1000 * size * np.array(light['direction']))} rgb {vector(color)} parallel point_at 0 }}\n"
    return f"global_settings {{ assumed_gamma 1 adc_bailout 0 ambient_light rgb {vector(ambient)} }}\n{text}"


def texture_text(material, color, options):
    pigment = np.maximum(three(color) * material.kd, 1e-6)
    ambient = three(color) * material.ka / pigment
    highlight = f" phong {material.ks:.9g} phong_size {material.exponent:.9g}" if options == PHONG and material.ks else ""
    return f"texture {{ pigment {{ rgb {vector(pigment)} }} finish {{ ambient rgb {vector(ambient)} diffuse 1{highlight} }} }}\n"


def mesh_text(part, material, options):
    corners = part.positions.reshape(-1, 3)
    text = "mesh2 {\n" + vectors("vertex_vectors", corners)
    if part.normals is not None and options != FACETS:
        text += vectors("normal_vectors", part.normals.reshape(-1, 3))
    indices = np.arange(len(corners)).reshape(-1, 3)
    if part.colors is None:
        faces = ", ".join(map(vector, indices))
        return f"{text}face_indices {{ {len(indices)}, {faces} }}\n{texture_text(material, material.color, options)}no_shadow }}\n"
    textures = [texture_text(material, material.color * linear(color), options) for color in part.colors.reshape(-1, 3)]
    faces = ", ".join(f"{vector(face)}, {', '.join(map(str, face))}" for face in indices)
    return f"{text}texture_list {{ {len(textures)}, {''.join(textures)} }}\nface_indices {{ {len(indices)}, {faces} }}\nno_shadow }}\n"


def read_ppm(path):
    data = path.read_bytes()
    return np.frombuffer(data[-3 * WIDTH * HEIGHT:], np.uint8).reshape(HEIGHT, WIDTH, 3).astype(int)


def drawn_by_povray(path, scene, options, brightness, folder):
    parts, materials = readers.read(path), Materials(path, scene)
    size = max(np.abs(part.positions).max() for part in parts)
    text = "#version 3.7;\n" + lights_text(scene["light"], size, brightness) + camera_text(scene["observer"])
    text += f"background {{ rgb {vector(linear(np.array(scene['image']['background']) / 255))} }}\n"
    text += "".join(mesh_text(part, materials.of(part), options) for part in parts)
    (folder / "other.pov").write_text(text)
    subprocess.run(["povray", "+Iother.pov", "+Oother.ppm", "+FP8", f"+W{WIDTH}", f"+H{HEIGHT}", "-A", "-D", "-V", "-J",
                    "File_Gamma=sRGB", "Dither=off"], cwd=folder, check=True, capture_output=True, timeout=120)
    return read_ppm(folder / "other.ppm")


def drawn_by_candela(candela, scene, options, brightness, folder):
    # As POV-Ray's meshes, which are no_shadow.
    lights = ["--set=shadows.enabled=false"]
    lights += [f"--set=light.{light['name']}.intensity={light['intensity'] * brightness}" for light in scene["light"]]
    subprocess.run([candela, "render", "scene.toml", "-o", "ours.ppm", "--samples=1", f"--width={WIDTH}", f"--height={HEIGHT}",
                    "--quiet", *lights, *options], cwd=folder, check=True, timeout=120)
    return read_ppm(folder / "ours.ppm")


def neighbourhoods(picture):
    """The values of each pixel and its eight neighbours, along a separate axis."""
    around = np.pad(picture, ((1, 1), (1, 1), (0, 0)), mode="edge")
    return np.stack([around[y:y + HEIGHT, x:x + WIDTH] for y in range(3) for x in range(3)])


def compared(ours, other):
    """How much of the picture the model covers, the share of that without edges, and the differences there."""
    around = neighbourhoods(other)
    interior = (around.max(axis=0) - around.min(axis=0)).max(axis=-1) <= EDGE
    model = (other != other[0, 0]).any(axis=-1)
    difference = np.abs(ours - other).max(axis=-1)
    return model.mean(), (interior & model).sum() / model.sum(), np.where(interior, difference, 0)


def main():
    candela, models = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
    problems = 0
    for name, options, brightness in CASES:
        with tempfile.TemporaryDirectory(dir="/tmp") as folder:  # where POV-Ray may read and write
            folder = Path(folder)
            for file in (models / name).parent.glob(f"{Path(name).stem}.*"):
                shutil.copy(file, folder)
            model = folder / Path(name).name
            subprocess.run([candela, "import", model.name, "--plain", "-o", "scene.toml"], cwd=folder, check=True, capture_output=True)
            scene = tomllib.loads((folder / "scene.toml").read_text())
            other = drawn_by_povray(model, scene, options, brightness, folder)
            covered, share, difference = compared(drawn_by_candela(candela, scene, options, brightness, folder), other)
        print(f"{name}: {covered:.0%} covered, {share:.0%} of that compared, at most {difference.max()} of 255 apart")
        if difference.max() > TOLERANCE:
            problems += 1
            y, x = np.unravel_index(difference.argmax(), difference.shape)
            print(f"  the most at ({x}, {y}), where POV-Ray draws {tuple(map(int, other[y, x]))}")
        if covered < 0.05 or share < 0.4 or other.max() == 255:
            problems += 1
            print("  too little of it is compared, or it is overexposed")
    return 1 if problems else 0


sys.exit(main())
