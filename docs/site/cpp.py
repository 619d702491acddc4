"""The C++ reference: a page for each installed header and each module of the core, read by Doxygen."""
import html
import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

# The title, the folders and the purpose of each group of pages.
GROUPS = (
    ("Interfaces", ("core/include",),
     "The interfaces of plugins, and the data that crosses the boundary. Programs import them as modules."),
    ("Plugin SDK", ("sdk/include",), "The headers for writing plugins."),
    ("For exporters", ("sdk/target/include",), "Code shared by targets."),
    ("Embedding", ("core/embedding/include",), "For programs built with any C++20 compiler."),
    ("Modules", ("core/util", "core/plugins", "core/scene", "core/geometry", "core/raster", "core/shading", "core/render"), "For programs that import `candela.core`."),
)
SETTINGS = """
INPUT = {sources}
FILE_PATTERNS = *.h *.cppm *.kernel
EXTENSION_MAPPING = cppm=C++ kernel=C++
RECURSIVE = YES
STRIP_FROM_PATH = {sources}
OUTPUT_DIRECTORY = {output}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
SORT_MEMBER_DOCS = NO
INHERIT_DOCS = NO
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
SEARCH_INCLUDES = NO
PREDEFINED = CANDELA_EXPORT= CANDELA_KERNEL_INLINE=inline CANDELA_BATCH_LOOP= KERNEL=
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
"""


CODE, END = "```cpp\n", "```\n"


def escaped(comment):
    """A comment with Doxygen's special characters escaped outside of its `code`."""
    parts = re.split(r"(`[^`]*`)", comment)
    return "".join(part if part.startswith("`") else re.sub(r"([<>@\\#])", r"\\\1", part) for part in parts)


def for_doxygen(path, text):
    """The source without module declarations, and with trailing comments marked as Doxygen's."""
    lines = []
    for line in text.splitlines():
        if path.suffix == ".cppm":
            if re.match(r"(module|export module|import|export import)\b[^(]*;", line):
                line = ""
            line = re.sub(r"^export ", "", line)
        if re.match(r'#include ".*\.kernel"', line):  # read separately
            line = ""
        if path.suffix == ".kernel" and "" in lines:  # below the file's first comment
            line = re.sub(r"^// ", "/// ", line)
        line = re.sub(r"^(\s*[^#}/\s][^/]*?)\s+// (?!NOLINT)(.*)$", r"\1  ///< \2", line)
        if lines and "///< " in lines[-1]:  # continues
            line = re.sub(r"^(\s+)// ", r"\1///< ", line)
        line = re.sub(r"(///<? )(.*)$", lambda found: found[1] + escaped(found[2]), line)
        lines.append(line)
    body = "\n".join(lines) + "\n"
    return f"namespace candela::kernel {{\n{body}}}\n" if path.suffix == ".kernel" else body


def comment_at_head(text):
    lines = []
    for line in text.splitlines():
        if not line.startswith("//"):
            break
        lines.append(line[2:].removeprefix(" "))
    # Indented lines are code.
    return "\n".join(line if line.startswith("    ") else html.escape(line, quote=False) for line in lines)


def words_of(element):
    """The text of a type or an initializer, without Doxygen's spaces."""
    text = " ".join("".join(element.itertext()).split()) if element is not None else ""
    text = re.sub(r"\s+>", ">", re.sub(r"<\s+", "<", text))
    return re.sub(r"(?<=[^(][&*])(?=\w)", " ", re.sub(r"\s+(?=[&*]+(\W|\w|$))", "", text))


class Page:
    def __init__(self, name, group, head):
        self.name, self.group, self.head, self.parts = name, group, head, []
        self.file = re.sub(r"[^a-z0-9]+", "-", name) + ".md"

    def summary(self):
        return " ".join(self.head.split("\n\n")[0].split()).partition(". ")[0].rstrip(".:")

    def text(self):
        parts = [f"# {self.name}\n"]
        if not self.name.endswith(".kernel"):
            parts.append(f"```cpp\n{f'#include <{self.name}>' if '/' in self.name else f'import {self.name};'}\n```\n")
        parts.append(self.head + "\n")
        for _, text in sorted(self.parts, key=lambda part: part[0]):
            if text.startswith(CODE) and parts[-1].startswith(CODE):  # declared together
                parts[-1] = parts[-1].removesuffix(END) + text.removeprefix(CODE)
            else:
                parts.append(text)
        return "\n".join(parts)


class Reference:
    def __init__(self, root, folder, scratch):
        self.root, self.folder, self.scratch = root, folder, scratch
        self.pages = {}  # by path of source
        self.anchors = {}  # page by id of its declarations
        self.compounds = []

    def page_of(self, path, group, text):
        """The page of a source; partitions of a module share its page."""
        module = re.search(r"^export module ([\w.]+)(:\w+)?;", text, re.MULTILINE)
        name = module[1] if module else f"candela/{path.as_posix().partition('/include/candela/')[2]}"
        page = next((page for page in self.pages.values() if page.name == name), None) or Page(name, group, "")
        if not module or not module[2]:
            page.head = comment_at_head(text)
        return page

    def read(self):
        sources, output = self.scratch / "sources", self.scratch / "doxygen"
        shutil.rmtree(self.scratch, ignore_errors=True)
        for group, folders, _ in GROUPS:
            for path in sorted(path for folder in folders for path in (self.root / folder).rglob("*")):
                relative = path.relative_to(self.root)
                if path.suffix not in (".h", ".cppm", ".kernel") or "internal" in relative.parts:
                    continue
                text = path.read_text()
                self.pages[relative.as_posix()] = self.page_of(relative, group, text)
                (sources / relative).parent.mkdir(parents=True, exist_ok=True)
                (sources / relative).write_text(for_doxygen(path, text))
        output.mkdir(parents=True)
        settings = SETTINGS.format(sources=sources, output=output)
        subprocess.run(["doxygen", "-"], input=settings, text=True, check=True)
        for path in sorted((output / "xml").glob("*.xml")):
            self.compounds.extend(ElementTree.parse(path).getroot().findall("compounddef"))

    def page_at(self, element):
        location = element.find("location")
        return self.pages.get(location.get("file")) if location is not None else None

    # Descriptions

    def prose(self, element, page):
        """Markdown of a description's elements."""
        def plain(text):
            return re.sub(r"([\\`*_\[\]|])", r"\\\1", html.escape(text or "", quote=False))
        parts = [plain(element.text)]
        for child in element:
            if child.tag == "computeroutput":
                parts.append(f"`{''.join(child.itertext())}`")
            elif child.tag == "ref":
                parts.append(self.link(child, page))
            elif child.tag in ("verbatim", "programlisting", "preformatted"):
                parts.append(f"\n\n```cpp\n{''.join(child.itertext()).strip()}\n```\n\n")
            elif child.tag == "listitem":
                parts.append(f"\n- {self.prose(child, page).strip()}")
            elif child.tag == "para":
                parts.append(f"{self.prose(child, page).strip()}\n\n")
            else:
                parts.append(self.prose(child, page))
            parts.append(plain(child.tail))
        return "".join(parts)

    def link(self, reference, page):
        name, target = "".join(reference.itertext()), self.anchors.get(reference.get("refid"))
        return f"[`{name}`]({'' if target is page else target.file}#{reference.get('refid')})" if target else f"`{name}`"

    def description(self, element, page):
        both = (element.find("briefdescription"), element.find("detaileddescription"))
        return "\n\n".join(text for text in (self.prose(part, page).strip() for part in both if part is not None) if text)

    # Declarations

    @staticmethod
    def template(element):
        parameters = element.find("templateparamlist")
        if parameters is None:
            return ""
        listed = []
        for parameter in parameters.findall("param"):
            default = words_of(parameter.find("defval"))
            words = [words_of(parameter.find("type")), words_of(parameter.find("declname")), f"= {default}" if default else ""]
            listed.append(" ".join(word for word in words if word))
        return f"template <{', '.join(listed)}>\n"

    def declaration(self, member):
        kind, name = member.get("kind"), member.findtext("name")
        if kind == "define":
            parameters = [words_of(parameter.find("defname")) for parameter in member.findall("param")]
            return f"#define {name}" + (f"({', '.join(parameters)})" if parameters else "")
        if kind == "enum":
            return f"enum class {name}" if member.get("strong") == "yes" else f"enum {name}"
        if kind == "typedef":
            return f"{self.template(member)}using {name} = {words_of(member.find('type'))}"
        words = [word for word in ("static", "explicit") if member.get(word) == "yes"]
        arguments = re.sub(r"(?<=[\w\]&) ])\s*=(?=\w|\{|\")\s*", " = ", words_of(member.find("argsstring")))
        if member.get("virt") in ("virtual", "pure-virtual") and "override" not in arguments:
            words.append("virtual")
        text = " ".join([*words, words_of(member.find("type")), name]).strip()
        if kind == "variable":
            initializer = words_of(member.find("initializer"))
            if initializer.startswith("{") or len(initializer) >= 40:
                initializer = ""
            return f"{text}{arguments} {initializer}".strip()
        if len(text + arguments) > 100:
            arguments = re.sub(r", (?![^<(]*[>)](?!$| |;))", ",\n" + " " * (len(text) + 1 if len(text) < 50 else 4), arguments)
        return self.template(member) + text + arguments

    def values(self, members, page):
        """A table of data members, or of an enumeration's values."""
        rows = [f"| {'value' if members[0].tag == 'enumvalue' else 'member'} | meaning |", "|---|---|"]
        for member in members:
            shown = member.findtext("name") if member.tag == "enumvalue" else self.declaration(member)
            meaning = " ".join(self.description(member, page).split())
            if meaning.count(".") == 1:  # added by Doxygen
                meaning = meaning.removesuffix(".")
            rows.append(f"| `{shown.replace('|', chr(92) + '|')}` | {meaning} |")
        return "\n".join(rows) + "\n"

    def functions(self, members, page, level):
        """Each function with its description below it; those without one are declared together."""
        parts, alone = [], []
        for member in members:
            about = self.description(member, page)
            declared = self.declaration(member) + ("" if member.get("kind") == "define" else ";")
            if about:
                name = member.findtext("name" if level > 2 or member.get("kind") == "define" else "qualifiedname").removeprefix("candela::")
                heading = f"{'#' * level} {html.escape(name)} {{#{member.get('id')}}}\n"
                parts.append(f"{heading}\n```cpp\n{declared}\n```\n\n{about}\n")
            else:
                alone.append(declared)
        return "\n".join(parts + ([f"```cpp\n{chr(10).join(alone)}\n```\n"] if alone else []))

    def class_text(self, compound, page):
        name, about = words_of(compound.find("compoundname")), self.description(compound, page)
        members = [member for section in compound.findall("sectiondef") for member in section.findall("memberdef")
                   if member.get("prot") in ("public", "protected") and member.get("kind") != "friend"]
        bases = [base.text for base in compound.findall("basecompoundref") if base.get("prot") == "public"]
        of = f" : public {', '.join(' '.join(base.split()) for base in bases)}" if bases else ""
        data = [member for member in members if member.get("kind") == "variable"]
        enums = [member for member in members if member.get("kind") == "enum"]
        rest = [member for member in members if member.get("kind") in ("function", "typedef")]
        parts = [f"## {html.escape(name.removeprefix('candela::'))} {{#{compound.get('id')}}}\n",
                 f"```cpp\n{self.template(compound)}{compound.get('kind')} {name}{of}\n```\n", about + "\n" if about else "",
                 self.values(data, page) if data else "", *(self.enum_text(enum, page, 3) for enum in enums),
                 self.functions(rest, page, 3) if rest else ""]
        return "\n".join(part for part in parts if part)

    def enum_text(self, member, page, level=2):
        return (f"{'#' * level} {member.findtext('name')} {{#{member.get('id')}}}\n\n```cpp\n{self.declaration(member)}\n```\n\n"
                f"{self.description(member, page)}\n\n{self.values(member.findall('enumvalue'), page)}")

    def write(self):
        """Writes all pages and returns their part of the navigation."""
        self.read()
        classes = [compound for compound in self.compounds if compound.get("kind") in ("class", "struct") and self.page_at(compound)]
        free = [member for compound in self.compounds if compound.get("kind") in ("namespace", "file")
                for member in compound.iter("memberdef") if self.page_at(member)]
        free = list({member.get("id"): member for member in free}.values())
        # Macros without a description are internal.
        free = [member for member in free if member.get("kind") != "define" or "".join(member.find("briefdescription").itertext()).strip()]
        for element in classes + free:
            page = self.page_at(element)
            documented = element.tag == "compounddef" or element.get("kind") == "enum" or self.description(element, page)
            if documented:
                self.anchors[element.get("id")] = page
            if element.tag == "compounddef":
                self.anchors.update((member.get("id"), page) for member in element.iter("memberdef")
                                    if member.get("prot") != "private" and (member.get("kind") == "enum" or (
                                        member.get("kind") in ("function", "typedef") and self.description(member, page))))
        for element in classes + free:
            page, location = self.page_at(element), element.find("location")
            if element.tag == "compounddef":
                text = self.class_text(element, page)
            elif element.get("kind") == "enum":
                text = self.enum_text(element, page)
            else:
                text = self.functions([element], page, 2)
            page.parts.append(((location.get("file"), int(location.get("line"))), text))
        return self.write_pages()

    def write_pages(self):
        self.folder.mkdir(parents=True)
        index = ["# C++ reference\n"]
        navigation = [{"All headers and modules": "cpp/index.md"}]
        for group, _, about in GROUPS:
            pages = sorted({page.name: page for page in self.pages.values() if page.group == group and page.parts}.items())
            for _, page in pages:
                (self.folder / page.file).write_text(page.text())
            rows = [f"| [`{name}`]({page.file}) | {page.summary()} |" for name, page in pages]
            index.append(f"## {group}\n\n{about}\n\n| file or module | contents |\n|---|---|\n" + "\n".join(rows) + "\n")
            navigation.append({group: [{name.removeprefix("candela/"): f"cpp/{page.file}"} for name, page in pages]})
        (self.folder / "index.md").write_text("\n".join(index))
        return navigation
