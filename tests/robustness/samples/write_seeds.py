"""Writes the files of files.py as inputs of the fuzzing harness mesh_file: a byte for the format, then the file.

    write_seeds.py FOLDER
"""
import sys
from pathlib import Path

import files

FORMATS = ("obj", "ply", "stl", "gltf", "glb")  # as tests/robustness/fuzz/mesh_file_fuzz.cpp counts them


def main() -> None:
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for case in files.cases():
        name, content = next(iter(case.files.items()))
        (folder / case.name).write_bytes(bytes([FORMATS.index(Path(name).suffix[1:])]) + content)


if __name__ == "__main__":
    main()
