"""Mutants of manifests and plugin folders: none may end `list`, `describe`, `plugin doctor` or `check` with a signal,
keep it busy for more than ten seconds, make it print invalid UTF-8 or terminal control characters, or be replaced
silently.

    manifests.py CANDELA [--count N] [--kind manifest|library|folder] [--seed S] [--keep FOLDER] [--jobs J]

N mutants of each kind, made from CANDELA's plugins.
"""
import json
import os
import shutil
import sys
from pathlib import Path

import mutation

KINDS = ["manifest", "library", "folder"]
WORDS = [b'"name":', b'"kind":', b'"parameters":', b'"fingerprint":', b'"default":', b'"type":', b'"unit":', b'"minimum":',
         b'"maximum":', b'"title":', b"null", b"true", b"[", b"]", b"{", b"}", b",", b":", b'"', b"\\u0000", b"\\u202e", b"\\u001b[31m",
         b"\\ud800", b"1e999", b"\xff\xfe", b"\xc3", b"\x1b[31m", b"\xe2\x80\xae", b"\xc2\x9b", b"\0", b"\r", b"\n", b"light", b"image"]
SCENE = """version = 1
[observer]
position = [0, 0, 4]
look_at = [0, 0, 0]
[shading]
model = "{shading}"
[reflection]
model = "{reflection}"
[[light]]
type = "{light}"
position = [2, 2, 2]
[[object]]
type = "{shape}"
"""


def plugins_of(candela: str) -> list:
    folder = Path(candela).parent.parent / "lib" / "candela" / "plugins"
    found = sorted(path for path in folder.glob("*.json") if path.with_suffix(".so").exists())
    mutation.fail_without(found, "plugins")
    return found


def disturb(directory: Path, manifest: Path, library: Path, chance) -> None:
    """Damages a folder."""
    kind = chance.randrange(8)
    target = chance.choice((manifest, library))
    if kind == 0:
        target.unlink()
    elif kind == 1:
        target.unlink()
        target.mkdir()
    elif kind == 2:
        target.unlink()
        os.mkfifo(target)
    elif kind == 3:
        target.unlink()
        target.symlink_to(chance.choice(("/dev/zero", "nowhere", target.name, "/etc/shadow", ".")))
    elif kind == 4:
        target.chmod(chance.choice((0o000, 0o666, 0o777, 0o200)))
    elif kind == 5:
        target.rename(directory / chance.choice(("light-\x1b[31m.json", "light-.so", "-.json", "image-\u202e.json", "x" * 250)))
    elif kind == 6:
        target.write_bytes(b"")
    else:
        shutil.copy(manifest, directory / chance.choice(("light-copy.json", "reflection-copy.json", "shape-\u009b.json")))


def commands(candela: str, manifest: Path, chance) -> list:
    kind, name = manifest.stem.split("-", 1)
    where = ["--plugin-dir", "plugins"]
    scene = ["check", *where, "scene.toml"]
    return [candela, *chance.choice((["list", *where], ["list", kind, *where], ["describe", f"{kind}/{name}", *where],
                                     ["plugin", "doctor", *where], scene, scene))]


def problem_of(candela: str, directory: Path, kind: str, chance, _index: int) -> str:
    plugins = plugins_of(candela)
    original = chance.choice(plugins)
    folder = directory / "plugins"
    folder.mkdir()
    manifest, library = folder / original.name, folder / f"{original.stem}.so"
    shutil.copy(original, manifest)
    shutil.copy(original.with_suffix(".so"), library)
    if kind == "manifest":
        texts = [path.read_bytes() for path in plugins]
        manifest.write_bytes(mutation.mutated(original.read_bytes(), texts, chance, WORDS))
    elif kind == "library":
        content = library.read_bytes()
        # Mutates the parts of an ELF file that are read before its code runs, not the code.
        head = mutation.mutated(content[:4096], [content[:4096]], chance, [b"\x7fELF", b"\xff\xff\xff\xff"])
        library.write_bytes(chance.choice((head, content[:chance.randrange(len(content))], head[:64], b"\x7fELF" + head[8:])))
    else:
        disturb(folder, manifest, library, chance)
    models = {"shading": "phong", "reflection": "phong", "light": "point", "shape": "cube"}
    plugin_kind, name = original.stem.split("-", 1)
    models.update({plugin_kind: name} if plugin_kind in models else {})
    (directory / "scene.toml").write_text(SCENE.format(**models))
    environment = dict(os.environ, HOME=str(directory), XDG_DATA_HOME=str(directory / "none"))
    environment.pop("CANDELA_PLUGIN_PATH", None)
    command = commands(candela, manifest, chance)
    done, wrong = mutation.run(command, directory, (0, 1, 2, 3), environment)
    words = " ".join(command[1:])
    if wrong:
        return f"{words}: {wrong}"
    try:
        json.loads(manifest.read_bytes() if manifest.is_file() else b"?")
    except ValueError:
        if manifest.is_file() and "check" in command and plugin_kind in models and done.returncode == 0:
            return f"{words}: its manifest is unreadable, but there is no message"
    except OSError:
        pass
    return ""


if __name__ == "__main__":
    sys.exit(mutation.sweep(__doc__, 100, KINDS, problem_of))
