"""third_party.py BUILD SCRATCH [--instructions | --rounds 7] [--compiler g++]: plugins of a third party against the shipped ones.

Makes a project for each of point light, Phong's reflection model and Phong's shading as `candela plugin new` does, puts the
shipped kernels into it, builds it against an installation and nothing else, and renders scene AR with
both. --instructions: counts them with callgrind, and fails if a third party's plugins take 5 % more (the machine does not
matter). Otherwise times frames in turns."""

import argparse
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

from harness import HERE, Bench, ratio as with_range
from instructions import instructions

ALLOWED = 1.05
PLUGINS = (("light", "point"), ("reflection", "phong"), ("shading", "phong"))
SHIPPED = HERE.parent.parent / "plugins"


def quiet(*words):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(w) for w in words)}\n{done.stdout}{done.stderr}")
    return done.stdout


def install(build, scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    quiet("cmake", "--install", build, "--prefix", scratch / "prefix")
    return scratch / "prefix"


def compiler_of(build):
    (found,) = build.glob("CMakeFiles/*/CMakeCXXCompiler.cmake")
    return re.search(r'set\(CMAKE_CXX_COMPILER "([^"]+)"\)', found.read_text()).group(1)


def build_plugins(prefix, scratch, compiler):
    """The folder of the third party's plugins."""
    plugins = scratch / "plugins"
    plugins.mkdir(mode=0o755)
    for kind, name in PLUGINS:
        project = scratch / f"{kind}-{name}"
        quiet(prefix / "bin/candela", "plugin", "new", kind, name, project)
        shutil.copy(SHIPPED / kind / f"{name}.kernel", project)
        quiet("cmake", "-G", "Ninja", "-S", project, "-B", project / "build", "-DCMAKE_BUILD_TYPE=Release",
              f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_PREFIX_PATH={prefix}")
        quiet("cmake", "--build", project / "build", "--target", f"candela_{kind}_{name}")
        for suffix in ("so", "json"):
            shutil.copy(project / "build" / f"{kind}-{name}.{suffix}", plugins)
    return plugins


def ratio_of_frames(bench, theirs, rounds):
    ratios = []
    for _ in range(rounds):
        frames = {}
        for whose, path in (("shipped", ""), ("third party", str(theirs))):
            bench.env = {**os.environ, "CANDELA_PLUGIN_PATH": path}
            frames[whose], _ = bench.ours("AR", 1920, 1080, 30)
        ratios.append(frames["third party"] / frames["shipped"])
    print(f"frames of AR at 1920 x 1080, third party / shipped: {with_range(ratios)}, {rounds} rounds")
    return statistics.median(ratios)


def ratio_of_instructions(command, theirs):
    scene = (HERE / "scenes/AR.toml", "--width", "512", "--height", "512")
    shipped = instructions(command, *scene)
    third = instructions(command, *scene, CANDELA_PLUGIN_PATH=str(theirs))
    print(f"instructions of AR at 512 x 512: {third} by a third party's plugins, {shipped} by the shipped: {third / shipped:.4f}")
    return third / shipped


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--instructions", action="store_true")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--compiler", help="another compiler than Candela's")
    arguments = parser.parse_args()
    build, scratch = arguments.build.resolve(), arguments.scratch.resolve()
    prefix = install(build, scratch)
    theirs = build_plugins(prefix, scratch, arguments.compiler or compiler_of(build))
    command = prefix / "bin/candela"
    for kind, name in PLUGINS:
        described = quiet("env", f"CANDELA_PLUGIN_PATH={theirs}", command, "describe", f"{kind}/{name}")
        if str(theirs) not in described:
            sys.exit(f"{kind}/{name} is not the third party's:\n{described}")
    if arguments.instructions:
        ratio = ratio_of_instructions(command, theirs)
    else:
        bench = Bench(build, scratch)
        bench.candela = command
        ratio = ratio_of_frames(bench, theirs, arguments.rounds)
    return 0 if ratio <= ALLOWED or not arguments.instructions else 1


if __name__ == "__main__":
    sys.exit(main())
