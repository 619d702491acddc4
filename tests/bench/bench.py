"""bench.py BUILD OUT [--scenes A,AR,B,C] [--sizes 512x512,1920x1080,3840x2160] [--rounds 7] [--threads N]: Candela against
OpenGL.

The rivals take turns within one run; each figure is the median of its rounds, each ratio is Candela's time over OpenGL's of the
same round. Writes OUT/results.json and OUT/results.md."""

import argparse
import os
import re
import sys

from harness import HERE, Bench, folders, processor, ratio, run, spread, write


def measure(bench, build, scene, width, height, rounds):
    dump = bench.dump(build, scene)
    result = {"scene": scene, "width": width, "height": height, "mean_difference": bench.same_picture(scene, dump, width, height)}
    to_png = bench.render_to(scene, width, height, bench.pictures / "candela.png")
    their_to_png = [bench.rival, dump, width, height, "--png", bench.pictures / "opengl.png"]
    frames = 30
    rows = []
    for _ in range(rounds):
        ours, relit = bench.ours(scene, width, height, frames)
        theirs = bench.theirs(dump, width, height, frames)
        png = bench.whole(to_png)
        their_png = bench.whole(their_to_png)
        ppm = bench.whole(bench.render_to(scene, width, height, bench.pictures / "candela.ppm"))
        rows.append((ours, relit, theirs, png, their_png, ppm, bench.whole(["true"]), bench.whole([bench.empty])))
    ours, relit, theirs, png, their_png, ppm, true, empty = zip(*rows)
    result["frame"] = {"candela_ms": spread(ours), "opengl_ms": spread(theirs), "ratio": spread([a / b for a, b in zip(ours, theirs)])}
    result["relit"] = {"candela_ms": spread(relit), "ratio_to_frame": spread([a / b for a, b in zip(relit, ours)])}
    result["whole_process_png"] = {"candela_ms": spread(png), "opengl_ms": spread(their_png),
                                   "ratio": spread([a / b for a, b in zip(png, their_png)])}
    result["whole_process_ppm"] = {"candela_ms": spread(ppm), "ratio_to_true": spread([a / b for a, b in zip(ppm, true)]),
                                   "ratio_to_empty_program": spread([a / b for a, b in zip(ppm, empty)])}
    result["peak_memory"] = {"candela_mib": bench.memory(to_png), "opengl_mib": bench.memory(their_to_png)}
    result["png_size_ratio"] = (bench.pictures / "candela.png").stat().st_size / (bench.pictures / "opengl.png").stat().st_size
    return result


def table(results, machine):
    lines = [f"Machine: {machine['processor']}, {machine['threads']} threads; Candela: {machine['instruction_set']}; OpenGL: "
             f"{machine['opengl']}.", "",
             "| scene | size | Candela frame | OpenGL frame | ratio | relit / frame |", "|---|---|---|---|---|---|"]
    for r in results:
        frame = r["frame"]
        lines.append(f"| {r['scene']} | {r['width']} x {r['height']} | {frame['candela_ms']['median']:.2f} ms | "
                     f"{frame['opengl_ms']['median']:.2f} ms | {ratio(frame['ratio'])} | {ratio(r['relit']['ratio_to_frame'])} |")
    lines += ["", "| scene | size | whole process to PNG: Candela | OpenGL | ratio | size of the file, ratio | peak memory: Candela | "
              "OpenGL | without PNG, over `true` | over an empty C++ program |", "|---|---|---|---|---|---|---|---|---|---|"]
    for r in results:
        whole, memory = r["whole_process_png"], r["peak_memory"]
        lines.append(f"| {r['scene']} | {r['width']} x {r['height']} | {whole['candela_ms']['median']:.1f} ms | "
                     f"{whole['opengl_ms']['median']:.1f} ms | {ratio(whole['ratio'])} | {r['png_size_ratio']:.2f} | "
                     f"{memory['candela_mib']:.0f} MiB | {memory['opengl_mib']:.0f} MiB | "
                     f"{r['whole_process_ppm']['ratio_to_true']['median']:.1f} | "
                     f"{r['whole_process_ppm']['ratio_to_empty_program']['median']:.1f} |")
    return "\n".join(lines) + "\n"


def asked_for(sizes):
    parser = argparse.ArgumentParser()
    parser.add_argument("--scenes", default="A,AR,B,C")
    parser.add_argument("--sizes", default=sizes)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--threads", type=int)
    arguments = folders(parser, "build", "out")
    for scene in arguments.scenes.split(","):
        if not (HERE / f"scenes/{scene}.toml").exists():
            parser.error(f"no scene '{scene}' (A, AR, B, C)")
    if not re.fullmatch(r"[1-9]\d*x[1-9]\d*(,[1-9]\d*x[1-9]\d*)*", arguments.sizes):
        parser.error(f"sizes are like 512x512,1920x1080, not '{arguments.sizes}'")
    if arguments.rounds < 1:
        parser.error("at least one round")
    if arguments.threads is not None and arguments.threads < 1:
        parser.error("at least one thread")
    return arguments


def cells(arguments):
    """The scene, width and height of each row, reported when done."""
    for scene in arguments.scenes.split(","):
        for size in arguments.sizes.split(","):
            yield scene, *(int(x) for x in size.split("x"))
            print(f"bench: {scene} {size} done", file=sys.stderr)


def main():
    arguments = asked_for("512x512,1920x1080,3840x2160")
    build, out = arguments.build, arguments.out
    bench = Bench(build, out, arguments.threads)
    machine = {"processor": processor(), "threads": arguments.threads or os.cpu_count(),
               "instruction_set": bench.figures("A", 16, 16, 1)["instruction_set"],
               "opengl": run([bench.rival, "--version"], env=bench.env).strip()}
    results = [measure(bench, build, *cell, arguments.rounds) for cell in cells(arguments)]
    write(out, "results", machine, results, table(results, machine))


if __name__ == "__main__":
    main()
