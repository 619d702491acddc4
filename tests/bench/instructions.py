"""instructions.py COMMAND RECORD [--update]: how many instructions the default scene takes, from start to PNG file.

Counts with callgrind, which simulates a processor with AVX2, so that the figure is the same to a hundredth of a percent wherever
the same compiler and C library built and run it; the record names both, and another pair is not compared (exit code 77). Fails if the
figure is more than 3 % above the record. --update rewrites the record, also after a gain.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ALLOWED = 1.03


def first_line(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout.splitlines()[0].strip()


def built_with(command):
    """Everything that the figure depends on apart from the source."""
    notes = subprocess.run(["readelf", "-p", ".comment", command], check=True, capture_output=True, text=True).stdout
    compilers = sorted(set(re.findall(r"\]\s+(.*clang version \S+)", notes)))
    return {"compiler": ", ".join(compilers), "c_library": first_line("ldd", "--version"),
            "valgrind": first_line("valgrind", "--version")}


def instructions(command, *arguments, **environment):
    """Counts instructions of `candela render` with these arguments, with one thread."""
    with tempfile.TemporaryDirectory() as folder:
        counts = pathlib.Path(folder) / "counts"
        subprocess.run(["setarch", "-R", "valgrind", "--tool=callgrind", f"--callgrind-out-file={counts}", command, "render",
                        "--threads", "1", "-o", f"{folder}/picture.png", *arguments], check=True, capture_output=True,
                       env={**os.environ, **environment})
        return int(re.search(r"^(?:totals|summary): (\d+)", counts.read_text(), re.MULTILINE).group(1))


def main():
    command, record = sys.argv[1], pathlib.Path(sys.argv[2])
    now = {**built_with(command), "instructions": instructions(command)}
    if sys.argv[3:] == ["--update"]:
        record.write_text(json.dumps(now, indent=2) + "\n")
        print(f"recorded: {now['instructions']}")
        return 0
    before = json.loads(record.read_text())
    same = [before[key] == now[key] for key in ("compiler", "c_library", "valgrind")]
    ratio = now["instructions"] / before["instructions"]
    print(f"{now['instructions']} instructions, {before['instructions']} recorded: {ratio:.4f}")
    if not all(same):
        print(f"not compared: recorded with {before}, here {now}")
        return 77
    if ratio > ALLOWED:
        print("The default scene takes more instructions than recorded. If that is unavoidable, record it with scripts/bench.sh "
              "--instructions, and explain why in the commit")
        return 1
    if ratio < 1 / ALLOWED:
        print("Fewer than recorded; scripts/bench.sh --instructions records the gain")
    return 0


if __name__ == "__main__":
    sys.exit(main())
