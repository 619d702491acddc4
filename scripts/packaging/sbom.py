#!/usr/bin/env python3
"""Writes a bill of materials (SPDX 2.3, JSON) of everything that is compiled or linked into Candela.

    sbom.py BUILD-FOLDER VERSION OUTPUT

Headers come from the compiler's dependency records of each object, libraries from the programs and plugins themselves;
Debian's package database maps each to its package. A package without a licence in the table below is an error: it must be
looked up.
"""
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys

# By source package, without the version in its name: the licences in Debian's copyright file of the parts that are used.
LICENCES = {
    "boost": "BSL-1.0",
    "codemirror-js": "MIT",
    "catch2": "BSL-1.0",
    "draco": "Apache-2.0",
    "eigen3": "MPL-2.0",
    "embree": "Apache-2.0",
    "fmtlib": "MIT",
    "gcc": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "glibc": "LGPL-2.1-or-later",
    "imath": "BSD-3-Clause",
    "isa-l": "BSD-3-Clause",
    "libisal": "BSD-3-Clause",
    "libjpeg-turbo": "BSD-3-Clause AND IJG",
    "libpng1.6": "libpng-2.0",
    "libstb": "MIT",
    "linux": "GPL-2.0-only WITH Linux-syscall-note",
    "llvm-toolchain": "Apache-2.0 WITH LLVM-exception",
    "meshoptimizer": "MIT",
    "nlohmann-json3": "MIT",
    "onetbb": "Apache-2.0",
    "openexr": "BSD-3-Clause",
    "openimageio": "BSD-3-Clause",
    "pybind11": "BSD-3-Clause",
    "python": "PSF-2.0",
    "tinygltf": "MIT",
    "tomlplusplus": "MIT",
    "utfcpp": "BSL-1.0",
    "zlib": "Zlib",
}
# Bundled into pages, which compilers do not record.
BUNDLED = ("/usr/share/javascript/codemirror/lib/codemirror.js",)
SHIPPED = ("core/", "sdk/", "plugins/", "apps/")


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout


def compiled_headers(build):
    """The system's headers from which shipped objects were compiled."""
    headers, shipped = set(), False
    for line in run("ninja", "-C", str(build), "-t", "deps").splitlines():
        if not line.startswith(" "):
            shipped = line.startswith(SHIPPED)
        elif shipped and (path := line.strip()).startswith("/usr/"):
            headers.add(path)
    return {os.path.realpath(path) for path in headers}


def linked_libraries(build):
    """The system's libraries to which shipped binaries are linked directly."""
    libraries = set()
    for path in [*(build / "bin").iterdir(), *(build / "lib").rglob("*.so")]:
        needed = re.findall(r"\(NEEDED\).*\[(.+)\]", run("readelf", "--dynamic", str(path)))
        found = dict(re.findall(r"^\s*(\S+) => (/\S+)", run("ldd", str(path)), re.MULTILINE))
        libraries.update(os.path.realpath(found[name]) for name in needed
                         if name in found and not found[name].startswith(str(build.resolve())))
    return libraries


def packages_of(files):
    """The installed packages that own the files, as {package: (source package, version)}."""
    names = set()
    files = sorted(files)
    for first in range(0, len(files), 500):
        # Merged /usr: a package may list its files below / instead.
        words = [w for path in files[first:first + 500] for w in (path, path.removeprefix("/usr"))]
        owners = subprocess.run(["dpkg-query", "--search", *words], capture_output=True, text=True).stdout
        for line in owners.splitlines():
            names.update(name.strip() for name in line.split(": /")[0].split(","))
    rows = run("dpkg-query", "--show", "--showformat", "${binary:Package}\t${source:Package}\t${Version}\n", *sorted(names))
    return {name: (source, version) for name, source, version in (row.split("\t") for row in rows.splitlines())}


def licence_of(source):
    """None if nobody has looked it up yet. Versions in names differ between Debian releases: boost1.81, gcc-14, python3.11."""
    return LICENCES.get(re.sub(r"^(boost|gcc|llvm-toolchain|python)-?[0-9.]+$", r"\1", source))


def package(name, version, licence, comment):
    return {"SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name), "name": name, "versionInfo": version,
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": licence,
            "licenseDeclared": licence, "copyrightText": "NOASSERTION", "comment": comment}


def main():
    build, version, output = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
    uses = {"compiled in": packages_of(compiled_headers(build) | {os.path.realpath(path) for path in BUNDLED}), "linked": packages_of(linked_libraries(build))}
    unknown = {source for found in uses.values() for source, _ in found.values() if licence_of(source) is None}
    if unknown:
        sys.exit(f"sbom: unknown licence of {', '.join(sorted(unknown))}; look it up in the copyright file and add it here")

    packages = [package("candela", version, "Apache-2.0", "Lighting models as plugins")]
    relationships = [("SPDXRef-DOCUMENT", "DESCRIBES", "SPDXRef-candela")]
    for how, found in uses.items():
        for name, (source, its_version) in sorted(found.items()):
            entry = package(name, its_version, licence_of(source), f"{how}; Debian source package {source}")
            if all(other["SPDXID"] != entry["SPDXID"] for other in packages):
                packages.append(entry)
            relation = "DYNAMIC_LINK" if how == "linked" else "DEPENDS_ON"
            relationships.append(("SPDXRef-candela", relation, entry["SPDXID"]))
    # Fetched by npm, if possible.
    three = build / "lib/candela/plugins/target-three/build/three.module.min.js"
    if three.exists():
        its_version = re.search(r"bring_from_npm three (\S+)", (pathlib.Path(__file__).parents[1] / "three.sh").read_text())[1]
        packages.append(package("three", its_version, "MIT", "shipped as it is; npm package three"))
        relationships.append(("SPDXRef-candela", "CONTAINS", "SPDXRef-three"))
    when = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH") or datetime.datetime.now().timestamp()),
                                           datetime.timezone.utc)
    document = {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"candela-{version}",
        "documentNamespace": f"https://candela.example/spdx/candela-{version}",
        "creationInfo": {"created": when.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": ["Tool: candela-sbom"]},
        "packages": packages,
        "relationships": [{"spdxElementId": a, "relationshipType": r, "relatedSpdxElement": b} for a, r, b in relationships],
    }
    text = json.dumps(document, indent=2) + "\n"
    unfinished = output.with_suffix(".part")
    unfinished.write_text(text)
    unfinished.rename(output)


main()
