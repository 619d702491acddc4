"""`candela view` as a test's process with its own scene, and the requests that tests make."""
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time

COMMAND = os.path.abspath(os.environ.get("CANDELA_TEST_COMMAND") or os.environ["CANDELA"])
SCRATCH = pathlib.Path(os.environ.get("CANDELA_TEST_SCRATCH") or tempfile.mkdtemp(prefix="candela-view-")).absolute()
ENVIRONMENT = dict(os.environ, XDG_DATA_HOME=str(SCRATCH / "nothing"), XDG_CACHE_HOME=str(SCRATCH / "cache"), CANDELA_PLUGIN_PATH="")
LONGEST = 20  # seconds, on a busy machine

SCENE = """version = 1
observer = {{position = [0, 1, 4], look_at = [0, 0, 0]}}
image = {{width = 64, height = 48}}
shading = {{model = "phong"}}
reflection = {{model = "lambert"}}
light = [{{type = "directional", direction = [-1, -1, -1]}}]
object = [{{type = "cube", color = [{red}, {green}, 40]}}]
"""

# Lambert's law under a name that no plugin has.
OWN_KERNEL = pathlib.Path(__file__).parents[2].joinpath("plugins/reflection/lambert.kernel").read_text().replace("lambert_", "own_").replace(
    "LambertMaterial", "OwnMaterial")


def status_of(process):
    """Resident memory in kB, threads, open files; nothing if the process has ended."""
    try:
        lines = dict(line.split(":", 1) for line in pathlib.Path(f"/proc/{process}/status").read_text().splitlines() if ":" in line)
        return int(lines["VmRSS"].split()[0]), int(lines["Threads"]), len(os.listdir(f"/proc/{process}/fd"))
    except (OSError, KeyError):
        return None


def children_of(process):
    """Each thread lists its own children."""
    found = []
    try:
        for task in os.listdir(f"/proc/{process}/task"):
            found += pathlib.Path(f"/proc/{process}/task/{task}/children").read_text().split()
    except OSError:
        pass  # it has ended since
    return found


def tcp_sockets_of(process):
    """The inodes of a process's TCP sockets, with the local address and state from /proc ("0A" if it listens)."""
    known = {}
    for table in ("tcp", "tcp6"):
        for line in pathlib.Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
            fields = line.split()
            known[fields[9]] = (fields[1], fields[3])
    found = {}
    for descriptor in pathlib.Path("/proc").glob(f"{process}/fd/*"):
        try:
            match = re.fullmatch(r"socket:\[(\d+)\]", os.readlink(descriptor))
        except OSError:
            continue  # it has been closed since
        if match and match[1] in known:
            found[match[1]] = known[match[1]]
    return found


class View:
    def __init__(self, name, browser=None, options=(), files=None):
        """`browser`: the text of a program that replaces xdg-open; without it, no browser is opened. `files`: texts, by their names in the
        folder; one of them may be scene.toml."""
        self.folder = SCRATCH / name
        shutil.rmtree(self.folder, ignore_errors=True)
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir(parents=True)
        self.file = self.folder / "scene.toml"
        self.save(100)
        for file, text in (files or {}).items():
            self.folder.joinpath(file).parent.mkdir(exist_ok=True)
            self.folder.joinpath(file).write_text(text)
        self.log = open(self.folder / "log.txt", "w+")
        environment = dict(ENVIRONMENT, TMPDIR=str(self.temporary))
        if browser is not None:
            programs = self.folder / "programs"
            programs.mkdir()
            (programs / "xdg-open").write_text(browser)
            (programs / "xdg-open").chmod(0o755)
            environment["PATH"] = f"{programs}:{environment['PATH']}"
        self.process = subprocess.Popen([COMMAND, "view", *(["--no-open"] if browser is None else []), *options, str(self.file)], env=environment,
                                        cwd=self.folder,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.address = self.process.stdout.readline().strip()
        self.port, self.token = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/", self.address).groups()
        self.port = int(self.port)

    @staticmethod
    def text(red, green=90):
        return SCENE.format(red=red, green=green)

    def replace(self, text):
        """Saves like editors do: writes a temporary file, then renames it."""
        draft = self.folder / "draft"
        draft.write_text(text)
        os.replace(draft, self.file)

    def save(self, red):
        self.replace(self.text(red))

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        code = self.process.wait(LONGEST)
        self.process.stdout.close()
        self.log.close()
        return code

    def left_behind(self):
        """Temporary files. ThreadSanitizer creates one when a process starts, and removes it at once unless the process is killed in
        between."""
        return [file for file in self.temporary.iterdir() if not file.name.startswith("tsan.rodata.")]

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=LONGEST)

    def answer(self, data):
        """The whole response; data sent after the server has closed the connection are lost, as they should be."""
        with self.connect() as connection:
            try:
                connection.sendall(data)
                parts = []
                while part := connection.recv(65536):
                    parts.append(part)
            except (ConnectionResetError, BrokenPipeError):
                return b""
            return b"".join(parts)

    def get(self, path, method="GET", host=None, body=b"", **fields):
        host = f"127.0.0.1:{self.port}" if host is None else host
        lines = [f"{method} {path} HTTP/1.1", f"Host: {host}", *(f"{name}: {value}" for name, value in fields.items())]
        if body:
            lines.append(f"Content-Length: {len(body)}")
        return self.answer("\r\n".join([*lines, "", ""]).encode() + body)

    def status(self, path, **options):
        return int(self.get(path, **options).split(b" ", 2)[1])

    def events(self):
        """A connection that has requested events and read their header."""
        connection = self.connect()
        connection.sendall(f"GET /{self.token}/events HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\n\r\n".encode())
        return connection

    def generation(self):
        location = re.search(rb"Location: \S*\?live=(\d+)", self.get(f"/{self.token}/"))
        return int(location[1])

    def page(self):
        return self.get(f"/{self.token}/?live={self.generation()}")

    def wait_for_color(self, red):
        end = time.monotonic() + LONGEST
        wanted = f'"color":[{red}.0,90.0,40.0]'.encode()
        while wanted not in self.page():
            assert time.monotonic() < end, f"the page does not show the color {red}: {self.page()[-400:]}"
            time.sleep(0.02)
