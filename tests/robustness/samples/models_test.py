"""Each model that other programs wrote is shown, framed and lit by the scene that candela import makes of it, or refused with a reason.

    models_test.py CANDELA FOLDER [TEXT]      TEXT: only files whose names contain it
"""
import subprocess
import sys
import tempfile
from pathlib import Path

EXTENSIONS = {".obj", ".ply", ".stl", ".gltf", ".glb"}
# Files without triangles or with errors, each with words of its message. All others must be shown.
REFUSED = {
    "OBJ/box_UTF16BE.obj": "is UTF-16 text", "OBJ/number_formats.obj": "line 11: '3.1+e2' is not a number",
    "OBJ/point_cloud.obj": "3 vertices and no faces", "OBJ/testline.obj": "6 lines and no triangles",
    "OBJ/testpoints.obj": "6 sets of points and no triangles",
    "PLY/Wuson.ply": "line 3: 'Created' does not begin a line", "PLY/issue623.ply": "line 14", "PLY/points.ply": "1 set of points (4) and no triangles",
    "PLY/pond.0.ply": "only 2171512 bytes are left",
    "glTF/": "Candela reads",
    "glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb": "has a vertex that is not finite: number 0 of accessor 2",
    "glTF2/IncorrectVertexArrays/Cube.gltf": "not a multiple of three",
    "glTF2/IndexOutOfRange/": "has a triangle whose corner is out of range",
    "glTF2/MissingBin/BoxTextured.gltf": "names 'BoxTextured0.bin', which cannot be read",
    "glTF2/SchemaFailures/sceneWrongType.gltf": "names 'BoxTextured0.bin', which cannot be read",
    "glTF2/RecursiveNodes/RecursiveNodes.gltf": "has two parents or contains itself",
    "glTF2/TestNoRootNode/NoScene.gltf": "no faces", "glTF2/TestNoRootNode/SceneWithoutNodes.gltf": "no faces",
    **{f"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_{i:02}.gltf": f"1 set of {kind} and no triangles"
       for kind, numbers in (("points", (0, 7)), ("lines", (1, 2, 3, 8, 9, 10))) for i in numbers},
    "glTF2/wrongTypes/badArray.gltf": "no faces",
    "invalid/empty.obj": "no faces", "invalid/empty.ply": "is not a PLY file", "invalid/malformed.obj": "line 28: '0' is not a valid index",
}


def reason_for(name: str) -> str:
    return next((REFUSED[key] for key in sorted(REFUSED, key=len, reverse=True) if name.startswith(key)), "")


def covered(picture: Path) -> float:
    """The share of a PPM's pixels that differ from its first, the background."""
    data = picture.read_bytes()
    pixels = data[data.index(b"255\n") + 4:]
    return sum(pixels[i:i + 3] != pixels[:3] for i in range(0, len(pixels), 3)) / (len(pixels) / 3)


def problem_with(candela: str, model: Path, name: str, folder: Path) -> str:
    def run(*words):
        return subprocess.run([candela, *words], cwd=folder, capture_output=True, timeout=120, check=False)

    imported = run("import", str(model), "-o", "scene.toml", "--force")
    reason, said = reason_for(name), imported.stderr.decode(errors="replace")
    if reason:
        return "" if imported.returncode == 1 and reason in said else f"must be refused with '{reason}', but: {imported.returncode} {said}"
    if imported.returncode != 0:
        return f"is not imported: {imported.returncode} {said}"
    rendered = run("render", "scene.toml", "-o", "a.ppm", "--width", "160", "--height", "120", "--quiet")
    if rendered.returncode != 0:
        return f"its scene is not rendered: {rendered.returncode} {rendered.stderr.decode(errors='replace')}"
    directly = run("render", str(model), "-o", "b.ppm", "--width", "160", "--height", "120", "--quiet")
    if directly.returncode != 0 or (folder / "a.ppm").read_bytes() != (folder / "b.ppm").read_bytes():
        return "render does not show the scene that import writes"
    share = covered(folder / "a.ppm")
    has_camera = "cameras" in name or "2CylinderEngine" in name
    if not has_camera and not 0.01 < share < 0.95:
        return f"covers {share:.3f} of the picture"
    return ""


def main() -> int:
    candela, models, only = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]), "".join(sys.argv[3:4])
    problems, count, refused = [], 0, 0
    for model in sorted(models.rglob("*")):
        name = str(model.relative_to(models))
        if model.suffix.lower() not in EXTENSIONS or only not in name:
            continue
        count += 1
        refused += bool(reason_for(name))
        with tempfile.TemporaryDirectory() as folder:
            if problem := problem_with(candela, model, name, Path(folder)):
                problems.append(f"{name} {problem.strip()}")
    print("\n".join(problems) or f"{count} models, {refused} of them refused as expected")
    return 1 if problems or count == 0 else 0


sys.exit(main())
