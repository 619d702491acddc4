#!/usr/bin/env python3
"""site.py CANDELA OUT: builds the documentation as a site, OUT/html/index.html, which needs no server.

It contains the documents, also a page for each shape, picture format and target, a page with the help of all commands, and a page for each
header and module of C++. mkdocs checks the links between documents; this script checks those of the finished pages."""
import html
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import urllib.parse
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.append(str(ROOT / "scripts"))

import models  # noqa: E402
from cpp import Reference  # noqa: E402


def copy_documents(sources):
    for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE"):
        shutil.copy(ROOT / name, sources / name)
    shutil.copytree(ROOT / "docs", sources / "docs", ignore=shutil.ignore_patterns("site", "__pycache__"))
    for kernel in (ROOT / "plugins").rglob("*.kernel"):
        copy = sources / kernel.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(kernel, copy)
    shutil.copy(HERE / "site.css", sources / "site.css")
    subprocess.run(["esbuild", HERE / "formulas.js", "--bundle", "--minify", "--log-level=error", f"--outfile={sources}/formulas.js"],
                   check=True)
    # A link to a folder leads to a list of its contents.
    for folder in ("docs/internals/adr", "docs/examples", "docs/examples/plugins"):
        names = sorted(entry.name for entry in (sources / folder).iterdir() if entry.name != "README.md")
        links = [f"- [{name}]({name}{'/README.md' if (sources / folder / name).is_dir() else ''})" for name in names
                 if (sources / folder / name).is_file() or (sources / folder / name / "README.md").exists()]
        if not (sources / folder / "README.md").exists():
            (sources / folder / "README.md").write_text(f"# {Path(folder).name}\n\n" + "\n".join(links) + "\n")


def link_folders(sources):
    """Makes links to folders lead to their README.md, as in a browsed repository."""
    for document in sources.rglob("*.md"):
        text = document.read_text()

        def to_readme(match):
            path = urllib.parse.unquote(match[2])
            is_folder = path and not re.match(r"[a-z]+:", path) and (document.parent / path).is_dir()
            return f"{match[1]}{path.rstrip('/')}/README.md{match[3]}" if is_folder else match[0]
        document.write_text(re.sub(r"(\]\()([^)#\s]+)((?:#[^)]*)?\))", to_readme, text))


def commands_page(candela):
    def output(*words):
        return subprocess.run([candela, *words], check=True, capture_output=True, text=True,
                              env={**os.environ, "COLUMNS": "100", "CANDELA_COMPLETE": ""}).stdout

    listed = subprocess.run([candela, ""], check=True, capture_output=True, text=True,
                            env={**os.environ, "CANDELA_COMPLETE": "1"}).stdout
    verbs = dict(line.split("\t") for line in listed.splitlines())
    text = ["# Commands\n", "The output of `candela VERB --help`, which is also in the manual pages: `man candela-render`.\n"]
    for verb, summary in verbs.items():
        text.append(f"## candela {verb}\n\n{summary[0].upper()}{summary[1:]}.\n\n```text\n{output(verb, '--help').strip()}\n```\n")
    return "\n".join(text)


def model_pages(candela, sources):
    """Adds the pages of models without kernels, and has all formulas typeset; returns the part of the navigation."""
    folder = sources / "docs/models"
    shipped = models.shipped(candela, models.KINDS)
    others = [model for model in shipped if model.kind not in models.KERNEL_KINDS]
    models.draw(candela, others, sources / "docs/pictures/models")
    for model in others:
        (folder / f"{model.file}.md").write_text(models.page(model))
    (folder / "README.md").write_text(models.index(shipped))
    for model in shipped:
        path, formula = folder / f"{model.file}.md", html.escape(model.manifest.get("formula", ""))
        names = " ".join(parameter["name"] for parameter in model.manifest["parameters"])
        block = f'<pre class="formula" data-parameters="{names}">{formula}</pre>\n'
        path.write_text(re.sub(r"^```(?:math|text)\n.*?^```\n", lambda _, block=block: block, path.read_text(), flags=re.DOTALL | re.MULTILINE))
    by_kind = [{title: [{model.title: f"docs/models/{model.file}.md"} for model in shipped if model.kind == kind]}
               for kind, title in models.KINDS.items()]
    return [{"All models": "docs/models/README.md"}, *by_kind]


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.found, self.names = [], set()

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.found.append(value)
            elif name == "id":
                self.names.add(value)


def broken_links(site):
    pages = {}
    for path in sorted(site.rglob("*.html")):
        pages[path] = Links()
        pages[path].feed(path.read_text())
    for path, page in pages.items():
        if path.name == "404.html":  # its links are absolute, for a server
            continue
        for link in page.found:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = Path(os.path.normpath(path.parent / urllib.parse.unquote(parts.path))) if parts.path else path
            place = urllib.parse.unquote(parts.fragment)
            if not target.exists() or (place and target in pages and place not in pages[target].names):
                yield f"{path.relative_to(site)}: {link}"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    candela, out = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    sources, site = out / "sources", out / "html"
    shutil.rmtree(sources, ignore_errors=True)
    sources.mkdir(parents=True)
    copy_documents(sources)
    link_folders(sources)
    (sources / "commands.md").write_text(commands_page(candela))
    navigation = model_pages(candela, sources)
    cpp = Reference(ROOT, sources / "cpp", out / "cpp").write()
    settings = (HERE / "mkdocs.yml").read_text()
    # JSON is YAML.
    for word, value in (("SOURCES", str(sources)), ("SITE", str(site)), ("MODELS", navigation), ("CPP", cpp)):
        settings = settings.replace(f": {word}\n", f": {json.dumps(value)}\n")
    (out / "mkdocs.yml").write_text(settings)
    built = subprocess.run(["mkdocs", "build", "--quiet", "--clean", "--strict", "-f", out / "mkdocs.yml"], check=False)
    if built.returncode != 0:
        sys.exit("site: mkdocs reported the errors above")
    wrong = list(broken_links(site))
    for line in wrong:
        print(f"site: broken link: {line}", file=sys.stderr)
    if wrong:
        sys.exit(1)
    print(site / "index.html")


if __name__ == "__main__":
    main()
