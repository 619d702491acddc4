"""Completes names from untrusted files in bash, zsh and fish: the resulting word is the name, and no part of it is executed.

    CANDELA=build/release/bin/candela python3 tests/cli/shells/completion_test.py [--seconds N] [--seed N] [--shells bash,zsh,fish]

Without options: names with special meaning in some shell, and some random ones.
"""
import argparse
import json
import os
import pathlib
import random
import sys
import tempfile
import time

from typed import COMMAND, KINDS, Shell, candidates

SCRATCH = pathlib.Path(os.environ.get("CANDELA_TEST_SCRATCH") or tempfile.mkdtemp(prefix="candela-shells-")).absolute()
PLUGINS = pathlib.Path(COMMAND).parent.parent / "lib/candela/plugins"
VICTIM = "victim"  # a file that only an executed name creates
SCENE = """version = 1
observer = {{position = [0, 1, 4], look_at = [0, 0, 0]}}
light = [{{type = "directional", name = "{name}", direction = [-1, -1, -1]}}]
object = [{objects}]
"""

FRAGMENTS = ["$(touch victim)", "$(touch${IFS}victim)", "`touch victim`", "`touch${IFS}victim`", ";touch victim;", "|touch victim|", "&touch victim&",
             "(touch victim)", "<(touch victim)", ">victim", ">>victim", "&&touch victim", "\ntouch victim\n", "\rtouch victim\r", "{touch,victim}",
             "${x:=victim}", "$((1+1))", "$HOME", "$x", "~", "~root", "=ls", "!!", "!touch", "!$", "^a^b", "*", "?", "[a-z]", "{a,b}", "#", "%1",
             "'", '"', "\\", "\\\\", "$'", '$"', "\\'", '\\"', "'\"'", " ", "  ", "\t", "-", "--", "-x", "--help", "a", "Z", "0", "_", ",", ":", "@",
             "+", "/", "é", "漢字", "e\u0301", "\u00a0", "\u3000", "\u202e", "\u200b", "\x07", "\x1b[A", "\x03", "\x04", "\x7f", "\x80", "🙂", ".", "="]
NAMES = ["box", "box$(touch${IFS}victim)", "two words", "-x", "--help", "it's", 'say "$(touch victim)"', "`touch victim`", "a;touch victim", "a|b&c<d>e",
         "~", "~root", "!!", "wow!touch", "a!", "*", "?[a]", "{a,b}", "#", "\\", "\\'", "'\\''", "$'x'", "$HOME", "%1", "^a^b", "=ls", "a=b", "a.b", "a:b", "a@b",
         "new\nline $(touch victim)", "bell\x07", "\x1b]0;x\x07", "\u202eleft", "漢字 🙂", "'\"'\"$(touch victim)'\"", "trailing\\", " leading", "trailing "]


def random_name(chance):
    parts = []
    for _ in range(chance.randrange(1, 6)):
        kind = chance.random()
        if kind < 0.7:
            parts.append(chance.choice(FRAGMENTS))
        elif kind < 0.95:
            parts.append(chr(chance.randrange(1, 256)))
        else:
            parts.append(chr(chance.choice([chance.randrange(0x100, 0xd800), chance.randrange(0xe000, 0x110000)])))
    return "".join(parts)


def in_toml(name):
    return "".join(f"\\U{ord(c):08X}" for c in name)


def scene_with(*names):
    objects = ", ".join(f'{{type = "cube", name = "{in_toml(name)}", color = [1, 2, 40], position = [{3 * i}, 0, 0]}}' for i, name in enumerate(names))
    return SCENE.format(name=in_toml(names[0]), objects=objects)


class Tester:
    def __init__(self, kinds):
        self.shells = {kind: Shell(kind, SCRATCH / kind) for kind in kinds}
        self.tried = self.completed = 0

    def end(self):
        for shell in self.shells.values():
            shell.end()

    def check(self, shell, words, before, typed, quote, expected=None, is_folder=False):
        """`words`: those before the completed one, which begins with `before` and then `typed`, without the quotation mark."""
        line = " ".join(["candela", *words, before + quote + typed])
        if expected is None:
            found = candidates([*words, before + typed], shell.here)
            expected = os.path.commonprefix(found) if found else (before + typed).encode()
        there = sorted(os.listdir(shell.here))
        given = shell.arguments(line, quote)
        if is_folder:
            given[-1] = given[-1].removesuffix(b"/")
        self.tried += 1
        self.completed += expected != (before + typed).encode()
        problem = f"{shell.kind}: {line!r} and Tab"
        assert given == [*(word.encode() for word in words), expected], f"{problem} gives {given}, expected is {expected}"
        assert sorted(os.listdir(shell.here)) == there, f"{problem} has made {set(os.listdir(shell.here)) - set(there)}"

    def try_scene(self, shell, name, chance):
        (shell.here / "s.toml").write_text(scene_with(name))
        what = chance.choice(["object.", "light."])
        verb, option = chance.choice([("render", "--set"), ("edit", "--change")])
        quote = chance.choice(["", "'", '"'])
        if chance.random() < 0.3:
            self.check(shell, [verb, "s.toml"], f"{option}=", what, quote)
        else:
            self.check(shell, [verb, "s.toml", option], "", what, quote)

    def try_scene_of_several(self, shell, name, chance):
        """Their common part is inserted, also complete. (fish and zsh continue with one of them.)"""
        if shell.kind != "bash":
            return
        names = {name + chance.choice(FRAGMENTS) for _ in range(chance.randrange(2, 4))}
        (shell.here / "s.toml").write_text(scene_with(*sorted(names)))
        quote = chance.choice(["", "'", '"'])
        self.check(shell, ["render", "s.toml", "--set"], "", "object.", quote)

    def try_plugin(self, shell, name, chance):
        """A prefix that no other name shares, so that it is unambiguous."""
        name = "zq" + name.replace("/", "")
        folder = shell.here.parent / "plugins"
        folder.mkdir(exist_ok=True)
        for file in folder.iterdir():
            file.unlink()
        manifest = json.loads((PLUGINS / "reflection-lambert.json").read_text())
        manifest["name"] = name
        base = f"reflection-{name}".encode("utf-8", "surrogatepass")
        if len(base) > 200:
            return
        with open(os.path.join(os.fsencode(folder), base + b".json"), "w", encoding="utf-8") as file:
            json.dump(manifest, file)
        os.symlink(PLUGINS / "reflection-lambert.so", os.path.join(os.fsencode(folder), base + b".so"))
        quote = chance.choice(["", "'", '"'])
        where = f"--plugin-dir={folder}"
        if chance.random() < 0.3:
            self.check(shell, ["describe", where], "", "reflection/zq", quote)
        elif chance.random() < 0.5:
            self.check(shell, ["render", where], "--reflection=", "zq", quote)
        else:
            self.check(shell, ["render", where, "--reflection"], "", "zq", quote)

    def try_file(self, shell, name, chance):
        """Shells complete file names themselves; those with control characters are left to them."""
        name = "zq" + "".join(c for c in name if c != "/" and c.isprintable())
        if len(name.encode()) > 200:
            return
        file, quote, is_value = shell.here / name, chance.choice(["", "'", '"']), chance.random() < 0.3
        if chance.random() < 0.5:
            file.write_text("")
            words, before = (["render"], "--output=") if is_value else (["render"], "")
            self.check(shell, words, before, "zq", quote, before.encode() + name.encode())
            file.unlink()
        else:
            file.mkdir()
            words, before = (["list"], "--plugin-dir=") if is_value else (["list", "--plugin-dir"], "")
            self.check(shell, words, before, "zq", quote, before.encode() + name.encode(), is_folder=True)
            file.rmdir()

    def try_name(self, name, chance):
        for shell in self.shells.values():
            for attempt in (self.try_scene, self.try_scene_of_several, self.try_plugin, self.try_file):
                attempt(shell, name, chance)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--shells", default=",".join(KINDS))
    options = parser.parse_args()
    chance = random.Random(options.seed)
    tester = Tester(options.shells.split(","))
    end = time.monotonic() + options.seconds
    try:
        if options.seconds == 0:
            for name in [*NAMES, *(random_name(chance) for _ in range(20))]:
                tester.try_name(name, chance)
        while time.monotonic() < end:
            tester.try_name(random_name(chance), chance)
    finally:
        tester.end()
    print(f"{tester.tried} words tried, {tester.completed} of them completed; seed {options.seed}")
    assert tester.completed > 0


if __name__ == "__main__":
    sys.exit(main())
