#!/usr/bin/env python3
"""Runs clang-tidy on the sources that a change may have affected. scripts/lint.sh calls it after a full build.

    tidy.py BUILD OUT --all          every source of the core, the SDK, the plugins and the command, except tests
    tidy.py BUILD OUT --since REV    those that differ from commit REV, committed or not, and those that include or import them;
                                     not the Python module's, which take as long as all the rest of such a change
    … --minutes N                    stops after N minutes. Sources that differ come first, and otherwise the commit decides the order, so
                                     that runs for other commits check others

Uses the newest clang-tidy whose compiler is installed. Compiled module interfaces can be read only by the version of clang that wrote them,
so for any version but the build's they are compiled again, without code. OUT receives a Ninja file: clean sources are checked again only
when they, or files that they read, have changed.
"""

import hashlib
import json
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import sys
import threading

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = [ROOT / name for name in ("core", "sdk", "plugins", "apps")]
# Their faults are deliberate.
UNCHECKED = ROOT / "sdk" / "conformance" / "faulty_plugins"
# pybind11's templates take clang-tidy minutes and a gigabyte for each source.
ONLY_WITH_ALL = ROOT / "apps" / "bindings" / "python"
# A change to one of these affects everything.
OF_ALL = {".clang-tidy", "scripts/tidy.py"}
VERSIONS = (22, 21, 20, 19)


def output_of(*words, **options):
    return subprocess.run(words, check=True, capture_output=True, text=True, **options).stdout


def without_precompiled_headers(words, is_module_unit):
    """Uses the headers themselves: a precompiled one can be read only by the version of clang that wrote it. In a module unit, nothing
    may precede its first line, and it includes what it uses."""
    kept, rest = [], list(words)
    while rest:
        if rest[:2] == ["-Xclang", "-include-pch"]:
            del rest[:4]
        elif is_module_unit and rest[:3] == ["-Xclang", "-include", "-Xclang"]:
            del rest[:4]
        elif rest[0] in ("-Winvalid-pch", "-fpch-instantiate-templates"):
            del rest[0]
        else:
            kept.append(rest.pop(0))
    return kept


class Unit:
    """The source that an entry of compile_commands.json compiles."""

    def __init__(self, entry, includes):
        self.directory = pathlib.Path(entry["directory"])
        self.source = pathlib.Path(entry["file"])
        self.object = entry["output"]
        is_module_unit = bool(re.search(r"^(export )?module\b", self.source.read_text(errors="replace"), re.MULTILINE))
        words = without_precompiled_headers(shlex.split(entry["command"]), is_module_unit)
        self.compiler = words[0]
        modmaps = [word[1:] for word in words if word.startswith("@")]
        of_modules = [option for name in modmaps for option in (self.directory / name).read_text().split()]
        self.imports = [option.split("=", 2)[2] for option in of_modules if option.startswith("-fmodule-file=")]
        self.names = {option.split("=", 2)[2]: option.split("=", 2)[1] for option in of_modules
                      if option.startswith("-fmodule-file=")}
        self.interface = next((option.split("=", 1)[1] for option in of_modules if option.startswith("-fmodule-output=")), None)
        # Warnings are left to the build.
        without = ("@", "-fsave-optimization-record", "-foptimization-record", "-Werror")
        self.options = [word for word in words[1:] if not word.startswith(without)]
        self.includes = includes.get(self.object, [])

    def is_checked(self):
        """Interfaces are checked in the sources that import them; tests are not checked."""
        return not self.interface and not self.source.name.endswith("_test.cpp") and not self.source.is_relative_to(UNCHECKED)


def included_files(build):
    """For each object file, the files of this repository that it was made from, as recorded by Ninja."""
    found, current = {}, None
    for line in output_of("ninja", "-C", build, "-t", "deps").splitlines():
        if line.startswith("    "):
            path = (build / line.strip()).resolve()
            if path.is_relative_to(ROOT) and not path.is_relative_to(build):
                current.append(path)
        elif ": #deps" in line:
            current = found.setdefault(line.split(": #deps")[0], [])
    return found


def changed_files(since):
    names = output_of("git", "diff", "--name-only", "--no-renames", "-z", since, cwd=ROOT)
    names += output_of("git", "ls-files", "--others", "--exclude-standard", "-z", cwd=ROOT)
    return set(filter(None, names.split("\0")))


def concerned(units, changed):
    """The units that read a changed file, or import an interface that does."""
    paths = {ROOT / name for name in changed}

    def reads(unit):
        return unit.source in paths or any(file in paths for file in unit.includes)

    interfaces = {unit.interface for unit in units if unit.interface and reads(unit)}
    return [unit for unit in units if reads(unit) or interfaces.intersection(unit.imports)]


def tools(compiler):
    """clang-tidy, the compiler to make interfaces for it with, and the clang-tidy that reads the build's own; the last two are None if
    clang-tidy does that itself."""
    own = int(re.search(r"clang version (\d+)", output_of(compiler, "--version"))[1])
    for version in VERSIONS:
        if not shutil.which(f"clang-tidy-{version}"):
            continue
        if version == own:
            return f"clang-tidy-{version}", None, None
        if shutil.which(f"clang++-{version}"):
            return f"clang-tidy-{version}", f"clang++-{version}", f"clang-tidy-{own}"
    sys.exit(f"tidy: no clang-tidy for the interfaces of {compiler} is installed; scripts/setup.sh installs one")


def escaped(path):
    return str(path).replace("$", "$$").replace(" ", "$ ").replace(":", "$:")


def check_command(build, out, stamp, source, tidy, other):
    """Checks a source, and creates the stamp if it is clean. If clang-tidy itself crashes, as 22 does on some templates from
    modules, the other one checks it."""
    log = shlex.quote(f"{stamp}.log")

    def check(program, commands):
        return f"{shlex.join([program, '-p', str(commands), '--quiet', str(source)])} >{log} 2>&1"

    command = check(tidy, out)
    if other:
        note = shlex.quote(f"tidy: {tidy} crashes on {source.relative_to(ROOT)}; {other} checks it")
        command += f" || {{ grep -q '^PLEASE submit a bug report' {log} && echo {note} && {check(other, build)}; }}"
    return f"{{ {command}; }} && touch {shlex.quote(str(stamp))} || {{ cat {log}; exit 1; }}"


def write_ninja_file(build, out, units, chosen, tidy, compiler, other):
    """Rules that make the interfaces that `tidy` needs, and check the chosen units."""
    own = {unit.interface: str(out / unit.interface) if compiler else str(unit.directory / unit.interface)
           for unit in units if unit.interface}

    def import_options(unit):
        return [f"-fmodule-file={unit.names[path]}={own[path]}" for path in unit.imports]

    def edge(output, rule, unit, command):
        inputs = [*unit.includes, *(own[path] for path in unit.imports)]
        if rule == "tidy":
            inputs.append(ROOT / ".clang-tidy")
        return (f"build {escaped(output)}: {rule} {escaped(unit.source)} | {' '.join(map(escaped, inputs))}\n"
                f"  command = {command.replace('$', '$$')}\n  description = {rule} {unit.source.relative_to(ROOT)}\n")

    text = ["rule interface\n  command = $command\n", "rule tidy\n  command = $command\n"]
    commands, checked = [], []
    for unit in units:
        at = shlex.quote(str(unit.directory))
        if unit.interface and compiler:
            options = [word for word in unit.options if word not in ("-c", "-o", unit.object, str(unit.source))]
            options += [*import_options(unit), "-w", "-x", "c++-module", "--precompile", str(unit.source), "-o", own[unit.interface]]
            text.append(edge(own[unit.interface], "interface", unit, f"cd {at} && {shlex.join([compiler, *options])}"))
        if unit.is_checked():
            commands.append({"directory": str(unit.directory), "file": str(unit.source), "output": unit.object,
                             "arguments": [compiler or "clang++", *unit.options, *import_options(unit)]})
    for unit in chosen:
        stamp = out / f"{unit.object}.clean"
        stamp.parent.mkdir(parents=True, exist_ok=True)
        text.append(edge(stamp, "tidy", unit, check_command(build, out, stamp, unit.source, tidy, other)))
        checked.append(escaped(stamp))
    text.append(f"build checked: phony {' '.join(checked)}\n")
    for name in own.values():
        pathlib.Path(name).parent.mkdir(parents=True, exist_ok=True)
    (out / "compile_commands.json").write_text(json.dumps(commands, indent=1))
    (out / "build.ninja").write_text("\n".join(text))


def in_order_of_commit(chosen, changed):
    """The units, first those that differ."""
    head = output_of("git", "rev-parse", "HEAD", cwd=ROOT)

    def order(unit):
        name = str(unit.source.relative_to(ROOT))
        return name not in changed, hashlib.sha256((head + name).encode()).digest()

    return sorted(chosen, key=order)


def run_checks(out, minutes):
    """The exit code: 0 if no check that has ended found anything."""
    ninja = subprocess.Popen(["ninja", "-C", str(out), "-k", "0", "checked"], stdout=subprocess.PIPE, text=True)
    is_out_of_time = threading.Event()

    def stop():
        is_out_of_time.set()
        ninja.send_signal(signal.SIGINT)

    timer = threading.Timer(60 * minutes, stop) if minutes else None
    if timer:
        timer.start()
    has_failed, last = False, ""
    for line in ninja.stdout:
        if is_out_of_time.is_set():  # the checks that were running
            continue
        has_failed |= line.startswith("FAILED: ")
        last = line if line.startswith("[") else last
        print(line, end="", flush=True)
    code = ninja.wait()
    if timer:
        timer.cancel()
    if not is_out_of_time.is_set():
        return code
    print(f"tidy: stopped after {minutes} minutes at {last.partition(']')[0]}]")
    return 1 if has_failed else 0


def main():
    minutes = 0
    if "--minutes" in sys.argv:
        at = sys.argv.index("--minutes")
        minutes = float(sys.argv[at + 1])
        del sys.argv[at:at + 2]
    build, out = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
    includes = included_files(build)
    entries = json.loads((build / "compile_commands.json").read_text())
    units = [Unit(entry, includes) for entry in entries
             if any(pathlib.Path(entry["file"]).is_relative_to(folder) for folder in FOLDERS)]
    all_of_them = [unit for unit in units if unit.is_checked()]
    chosen, changed = all_of_them, set()
    if sys.argv[3] == "--since":
        changed = changed_files(sys.argv[4])
        if not changed & OF_ALL:
            chosen = [unit for unit in concerned(units, changed)
                      if unit.is_checked() and not unit.source.is_relative_to(ONLY_WITH_ALL)]
    if minutes:
        chosen = in_order_of_commit(chosen, changed)
    tidy, compiler, other = tools(units[0].compiler)
    print(f"tidy: {tidy} checks {len(chosen)} of {len(all_of_them)} sources", flush=True)
    out.mkdir(parents=True, exist_ok=True)
    write_ninja_file(build, out, units, chosen, tidy, compiler, other)
    return run_checks(out, minutes)


if __name__ == "__main__":
    sys.exit(main())
