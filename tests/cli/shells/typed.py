"""A shell on a terminal, driven by typing, with `candela` on its PATH: Tab makes the command complete the word, Enter makes it record its
arguments and do nothing else."""
import fcntl
import os
import pathlib
import pty
import re
import select
import shutil
import signal
import struct
import subprocess
import termios
import time

COMMAND = os.path.abspath(os.environ.get("CANDELA_TEST_COMMAND") or os.environ["CANDELA"])
SHELLS = pathlib.Path(__file__).resolve().parents[3] / "apps/candela/cli/shells"
LONGEST = 60  # seconds, on a busy machine
KINDS = {"bash": ["bash", "--norc", "--noprofile", "-i"], "zsh": ["zsh", "-f", "-i"], "fish": ["fish", "--no-config", "-i"]}
WHAT_IS_TYPED = "\x18\x0b"  # makes the shell record its line; a terminal ignores it

# With a name that the shell has to quote only where it is completed.
STAND_IN = """#!/bin/sh
if [ -n "$CANDELA_COMPLETE" ]; then exec "$COMMAND" "$@"; fi
printf '%s\\0' "$@" > "$NOTES/arguments.new"
mv "$NOTES/arguments.new" "$NOTES/arguments"
"""

# Each signals by a file that it is ready, because prompts differ.
SETUP = {
    "bash": """PS1=; source {shells}/candela.bash; bind 'set enable-bracketed-paste off'
bind -x '"\\C-x\\C-k": printf %s "$READLINE_LINE" > {notes}/line.new; mv {notes}/line.new {notes}/line'
touch {notes}/ready
""",
    "zsh": """PS1=; fpath=({shells} $fpath); autoload -Uz compinit; compinit -u -D
note() {{ print -rn -- "$BUFFER" > {notes}/line.new; mv {notes}/line.new {notes}/line }}; zle -N note; bindkey '^X^K' note
touch {notes}/ready
""",
    "fish": """function fish_prompt; end; source {shells}/candela.fish
bind \\cx\\ck 'commandline > {notes}/line.new; mv {notes}/line.new {notes}/line'
touch {notes}/ready
""",
}


class Shell:
    def __init__(self, kind, folder):
        """`folder`: its own, created again; the shell runs in `folder`/here."""
        self.kind, self.here, self.notes = kind, folder / "here", folder / "notes"
        shutil.rmtree(folder, ignore_errors=True)
        for part in ("here", "notes", "home", "programs"):
            (folder / part).mkdir(parents=True)
        program = folder / "programs" / "candela"
        program.write_text(STAND_IN)
        program.chmod(0o755)
        environment = {"PATH": f"{program.parent}:/usr/local/bin:/usr/bin:/bin", "HOME": str(folder / "home"), "TERM": "xterm", "LC_ALL": "C.UTF-8",
                       "COMMAND": COMMAND, "NOTES": str(self.notes), "XDG_DATA_HOME": str(folder / "home"), "CANDELA_PLUGIN_PATH": ""}
        self.shown = b""
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.chdir(self.here)
            os.execvpe(KINDS[kind][0], KINDS[kind], environment)
        fcntl.ioctl(self.terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 50, 4000, 0, 0))
        self.type(SETUP[kind].format(shells=SHELLS, notes=self.notes))
        self.wait_for("ready")

    def end(self):
        os.kill(self.pid, signal.SIGKILL)
        os.close(self.terminal)
        os.waitpid(self.pid, 0)

    def type(self, keys):
        os.write(self.terminal, keys.encode())

    def wait_for(self, note):
        """The record of the shell or the command."""
        file, end = self.notes / note, time.monotonic() + LONGEST
        while not file.exists():
            if select.select([self.terminal], [], [], 0.002)[0]:
                self.shown = (self.shown + os.read(self.terminal, 65536))[-4000:]
            if time.monotonic() > end:
                raise TimeoutError(f"{self.kind} did not write '{note}': {self.shown[-1000:]}")
        content = file.read_bytes()
        file.unlink()
        return content

    def is_quote_open(self, line):
        return subprocess.run([self.kind, "-n"], input=line, capture_output=True, check=False).returncode != 0

    def arguments(self, typed, quote=""):
        """The command's arguments after `typed` and Tab. `quote`: the open quotation mark, to be closed unless the shell has done so."""
        self.type(typed + "\t")
        if quote:
            self.type(WHAT_IS_TYPED)
            if self.is_quote_open(self.wait_for("line")):
                self.type(quote)
        self.type("\r")
        return self.wait_for("arguments").split(b"\0")[:-1]


def candidates(words, folder):
    """The candidates for a word, without a shell."""
    environment = dict(os.environ, CANDELA_COMPLETE="1", XDG_DATA_HOME=str(folder), CANDELA_PLUGIN_PATH="")
    lines = subprocess.run([COMMAND, *words], env=environment, cwd=folder, capture_output=True, check=True).stdout.split(b"\n")
    return [re.sub(rb"\t.*", b"", line) for line in lines if line and not line.startswith(b"\t")]
