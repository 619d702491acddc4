#!/usr/bin/env python3
"""Finds turns of phrase that are not idiomatic English in comments, messages and documentation. Called by scripts/lint.sh.

    prose.py [PATH...]       files and folders; default: all that git tracks
    prose.py --commits BASE  subjects of the commits since BASE that are not imperatives of at most 72 characters
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SUFFIXES = {".cpp", ".cppm", ".h", ".in", ".py", ".sh", ".js", ".css", ".html", ".kernel", ".glsl", ".cmake", ".txt", ".md", ".toml", ".yml"}
# Data, and this list.
EXCEPT = re.compile(r"^(LICENSE|tests/robustness/fuzz/corpus/|scripts/prose\.py$)|/third_party/")
# White space, where a comment or a string literal may be continued on the next line.
GAP = r'(?:[ \t]|"\s*\n\s*"|\n\s*(?://[/!]?<?|#|\*)?[ \t]*)+'
START = r'(?:^|(?<=[.;:] )|(?<=[/#*] )|(?<="))'
BE = r"(?:is|are|was|were|be|been)"
RULES = [
    (r"(?<!here )\b(?!here)%s no (?!longer|more|less|fewer|one|doubt|different|better|worse)[a-z]" % BE, "'is not a', 'is not', 'none'"),
    (r"\b[Tt]here (?:is|are) not\b", "absent things are absent"),
    (r"\b[Bb]eside\b", "'next to', 'with', 'except'"),
    (r"\b[Ll]ikewise\b", "'like', 'also'"),
    (r"\banew\b", "'again'"),
    (r"\bfor ever\b", "'forever'"),
    (r"\b(?:is|are) said\b", "who says it?"),
    (r"\b[Ww]hoever\b|\bWhat(?:ever)? [^.?\"#\n]*\bis (?:said|done)\b", "name the subject"),
    (START + r"What (?!is [^.?]*\?|if )[^?\n]*(?:\n|\.)", "a sentence begins with its subject"),
    (r"\bwhat (?:is|are|was|has|can|cannot) [^.;:,?\"\n]{1,60} (?:is|are|was|were|has|must|may|needs?) ", "a concrete noun instead of 'what is'"),
    (r"\bof which the\b", "no relative pronoun without its noun"),
    (r"[a-z] too, ", "'also'"),
    (r"\b(?:has|have) not (?:the|a|an)\b", "'does not have'"),
    (r"\bgoes? without saying\b", "say it, or leave it out"),
    (START + r"The same (?:with|of|for)\b", "'Like ...'"),
]
# What an imperative does not begin with: an article, a preposition, or a verb in another form.
NO_IMPERATIVE = re.compile(r"(?:An?|The|Th[aeio]se?|This|It|There|All|No|Each|Every|Some|Wh\w+|If|In|On|Of|With|For|\w+ing|\w*[^es]ed|\w*[^s]s)\b")
IMPERATIVES = {"Bring", "Embed", "Bias", "Focus"}  # that look otherwise


def is_imperative(subject: str) -> bool:
    return subject.split(" ")[0] in IMPERATIVES or not NO_IMPERATIVE.match(subject)


def git(*words):
    return subprocess.run(["git", "-C", ROOT, *words], check=True, capture_output=True, text=True).stdout.splitlines()


def findings(path: Path):
    text = path.read_text(errors="replace")
    for pattern, advice in RULES:
        for found in re.finditer(pattern.replace(" (?", GAP + "(?").replace(" no ", GAP + "no" + GAP), text, re.MULTILINE):
            if path.suffix == ".md" and text[text.rfind("\n", 0, found.start()) + 1:].startswith("#"):
                continue
            quoted = re.sub(GAP, " ", found[0]).strip()
            yield text.count("\n", 0, found.start()) + 1, f"'{quoted[:60]}': {advice}"


def main(arguments) -> int:
    if arguments[:1] == ["--commits"]:
        bad = [s for s in git("log", "--format=%s", f"{arguments[1]}..HEAD") if len(s) > 72 or s.endswith(".") or not is_imperative(s)]
        print("\n".join(f"prose: not an imperative of at most 72 characters: {s}" for s in bad) or "prose: clean")
        return 0
    names = git("ls-files", "--cached", "--others", "--exclude-standard", "--", *(arguments or ["."]))
    count = 0
    for name in names:
        if EXCEPT.search(name) or Path(name).suffix not in SUFFIXES or not (ROOT / name).is_file():
            continue
        for line, problem in sorted(findings(ROOT / name)):
            print(f"{name}:{line}: {problem}")
            count += 1
    return 1 if count else 0


sys.exit(main(sys.argv[1:]))
