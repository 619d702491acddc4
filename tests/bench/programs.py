"""programs.py BUILD OUT [--scenes A,AR,B,C] [--sizes 512x512,1920x1080] [--rounds 7] [--threads N]: Candela against
POV-Ray and VTK.

Whole processes from scene to PNG, in turns; each ratio is Candela's time over the other's of the same round. vtk.sh builds OUT/vtk_rival.
Writes OUT/programs.json and OUT/programs.md."""

import os
import re
import shutil
import subprocess
import sys

from bench import asked_for, cells
from harness import Bench, processor, ratio, run, spread, write
from pov import pov

START_UP = ("A", 16, 16)  # too few pixels to matter


class Programs(Bench):
    def __init__(self, build, out, threads):
        super().__init__(build, out, threads)
        self.thread_count = threads or os.cpu_count()
        self.build = build
        self.vtk = out / "vtk_rival"
        if not shutil.which("povray") or not self.vtk.exists():
            sys.exit("programs: POV-Ray or OUT/vtk_rival is missing; scripts/bench.sh --programs installs and builds them")
        self.scenes = {}

    def versions(self):
        found = subprocess.run(["povray", "--version"], capture_output=True, text=True)
        pov_ray = re.search(r"POV-Ray ([\d.]*\d)", found.stdout + found.stderr)
        return {"pov_ray": pov_ray[1] if pov_ray else "unknown", "vtk": run([self.vtk, "--version"]).strip(),
                "opengl": run([self.rival, "--version"], env=self.env).strip()}

    def converted(self, scene):
        """The scene's files for VTK and POV-Ray, written once."""
        if scene not in self.scenes:
            dump = self.dump(self.build, scene)
            file = self.out / f"{scene}.pov"
            file.write_text(pov(dump.read_bytes()))
            self.scenes[scene] = dump, file
        return self.scenes[scene]

    def commands(self, scene, width, height):
        dump, file = self.converted(scene)
        pictures = {name: self.out / f"{scene}-{name}.png" for name in ("candela", "pov_ray", "vtk")}
        # +Q3: no shadows, as in Candela's picture; no anti-aliasing, no window.
        pov_ray = ["povray", f"+I{file.name}", f"+O{pictures['pov_ray'].name}", f"+W{width}", f"+H{height}",
                   f"+WT{self.thread_count}", "+Q3", "-A", "-D"]
        return {"candela": self.render_to(scene, width, height, pictures["candela"]), "pov_ray": pov_ray,
                "vtk": [self.vtk, dump, width, height, pictures["vtk"]]}, pictures


def measure(programs, scene, width, height, rounds):
    commands, pictures = programs.commands(scene, width, height)
    result = {"scene": scene, "width": width, "height": height}
    for name in ("pov_ray", "vtk"):
        programs.whole(commands[name])
        result[f"{name}_mean_difference"] = programs.difference(scene, width, height, pictures[name])
    rows = [{name: programs.whole(words) for name, words in commands.items()} for _ in range(rounds)]
    for name in commands:
        result[f"{name}_ms"] = spread([row[name] for row in rows])
        result[f"{name}_mib"] = programs.memory(commands[name])
        if name != "candela":
            result[f"{name}_ratio"] = spread([row["candela"] / row[name] for row in rows])
    return result


def table(results, machine):
    lines = [f"Machine: {machine['processor']}, {machine['threads']} threads; POV-Ray {machine['pov_ray']}; VTK {machine['vtk']} on "
             f"{machine['opengl']}.", "",
             "| scene | size | Candela | POV-Ray | ratio | VTK | ratio | peak memory: Candela | POV-Ray | VTK | "
             "mean difference: POV-Ray | VTK |", "|---|---|---|---|---|---|---|---|---|---|---|---|"]
    for r in results:
        scene = "start-up" if (r["scene"], r["width"], r["height"]) == START_UP else r["scene"]
        lines.append(f"| {scene} | {r['width']} x {r['height']} | {r['candela_ms']['median']:.1f} ms | "
                     f"{r['pov_ray_ms']['median']:.0f} ms | {ratio(r['pov_ray_ratio'], 4)} | {r['vtk_ms']['median']:.1f} ms | "
                     f"{ratio(r['vtk_ratio'])} | " + " | ".join(f"{r[f'{n}_mib']:.0f} MiB" for n in ("candela", "pov_ray", "vtk"))
                     + f" | {r['pov_ray_mean_difference']:.4f} | {r['vtk_mean_difference']:.4f} |")
    return "\n".join(lines) + "\n"


def main():
    arguments = asked_for("512x512,1920x1080")
    os.chdir(arguments.out)  # Debian's POV-Ray writes only here and in /tmp
    programs = Programs(arguments.build, arguments.out, arguments.threads)
    machine = {"processor": processor(), "threads": programs.thread_count, **programs.versions()}
    results = [measure(programs, *START_UP, arguments.rounds)]
    results += [measure(programs, *cell, arguments.rounds) for cell in cells(arguments)]
    write(arguments.out, "programs", machine, results, table(results, machine))


if __name__ == "__main__":
    main()
