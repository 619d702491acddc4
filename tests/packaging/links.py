#!/usr/bin/env python3
"""Checks that every relative link in the installed documentation leads to an installed file or heading.

links.py CMAKE BUILD_DIR SCRATCH_DIR      installs the documents of the development package first
"""
import re
import shutil
import subprocess
import sys
import urllib.parse
from pathlib import Path

LINK = re.compile(r"\[[^\]]*\]\(\s*<?([^)\s>]+)>?[^)]*\)|^\[[^\]]+\]:\s*(\S+)", re.MULTILINE)
CODE = re.compile(r"```.*?^\s*```|`[^`\n]*`", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^#+\s+(.*?)\s*$", re.MULTILINE)


def anchors(text):
    """The anchors of a document's headings: lower case, hyphens for spaces, without punctuation or links."""
    plain = re.sub(r"```.*?```", "", text, flags=re.DOTALL)
    found, seen = set(), {}
    for heading in HEADING.findall(plain):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        anchor = re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")
        count = seen.get(anchor, 0)
        seen[anchor] = count + 1
        found.add(anchor if count == 0 else f"{anchor}-{count}")
    return found


def broken(folder):
    """Yields 'document:line: link' for each dead link within `folder`, and counts all links."""
    count = 0
    for document in sorted(folder.rglob("*.md")):
        text = document.read_text(encoding="utf-8")
        without_code = CODE.sub(lambda code: re.sub(r"[^\n]", " ", code.group()), text)
        for match in LINK.finditer(without_code):
            link = match.group(1) or match.group(2)
            if re.match(r"[a-z][a-z0-9+.-]*:", link):
                continue
            count += 1
            path, _, anchor = urllib.parse.unquote(link).partition("#")
            target = (document.parent / path).resolve() if path else document
            is_there = target.exists() and target.is_relative_to(folder)
            if is_there and anchor and target.suffix == ".md":
                is_there = anchor in anchors(target.read_text(encoding="utf-8"))
            if not is_there:
                line = text.count("\n", 0, match.start()) + 1
                yield f"{document.relative_to(folder)}:{line}: {link}"
    if count < 50:
        yield f"only {count} relative links were found in {folder}"


def main():
    cmake, build, scratch = sys.argv[1:]
    shutil.rmtree(scratch, ignore_errors=True)
    subprocess.run([cmake, "--install", build, "--prefix", scratch, "--component", "development"], check=True,
                   stdout=subprocess.DEVNULL)
    folders = list(Path(scratch).resolve().glob("share/doc/candela-dev"))
    if len(folders) != 1:
        sys.exit("the development package installs no documents in share/doc/candela-dev")
    wrong = list(broken(folders[0]))
    for link in wrong:
        print(link, file=sys.stderr)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
