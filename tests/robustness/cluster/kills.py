"""Compares a film and a poster made by many processes, some of which are killed, with the results of one process.

    kills.py <build folder> <work folder> [--engine slurm|local] [--frames N] [--poster PIXELS] [--parts N] [--kills N] [--seed N]
             [--only film|poster]

slurm: on a cluster of three nodes that cluster.sh starts on this machine (as root), a node is killed with all that runs on it, the
controller is killed and started again, and tasks are killed with SIGKILL. local: `candela submit` and its tasks are killed that
many times. In the end, the files must have the same bytes, nothing may be left over, and everything that `candela status` reported as
done on the way must have been done.
"""
import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import time

parser = argparse.ArgumentParser()
parser.add_argument("build", type=pathlib.Path)
parser.add_argument("work", type=pathlib.Path)
parser.add_argument("--engine", choices=("slurm", "local"), default="slurm")
parser.add_argument("--frames", type=int, default=200)
parser.add_argument("--poster", type=int, default=16384)
parser.add_argument("--parts", type=int, default=64)
parser.add_argument("--kills", type=int, default=20, help="local: of the whole job; slurm: of tasks, a tenth of that per job")
parser.add_argument("--seed", type=int, default=19)
parser.add_argument("--only", choices=("film", "poster"))
arguments = parser.parse_args()
command = str(arguments.build.resolve() / "bin" / "candela")
cluster = pathlib.Path(__file__).resolve().parent / "cluster.sh"
work = arguments.work.resolve()
nodes = work / "cluster"
chance = random.Random(arguments.seed)
statuses = 0


def say(text):
    print(f"{time.strftime('%H:%M:%S')} {text}", flush=True)


def candela(*words, check=True):
    return subprocess.run([command, *map(str, words)], cwd=work, check=check, capture_output=True, text=True)


def digest(path):
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


class Job:
    """A job, and the results of one process."""

    def __init__(self, folder, words, expected):
        self.folder, self.words, self.expected = folder, words, expected

    def submit(self, *more, check=True):
        return candela("submit", *self.words, "--engine", arguments.engine, "--quiet", *more, check=check)

    def status(self):
        """The output of `status`, checked for truth."""
        global statuses
        jobs = json.loads(candela("status", self.folder, "--json").stdout)
        status = next(job for job in jobs if job["output"] in self.words)
        statuses += 1
        for task in status["tasks"]:
            for name in self.files_of(task["name"]) if task["state"] == "done" else ():
                if digest(name) != self.expected[name.name]:
                    sys.exit(f"{name} is reported as done but is not")
        return status

    def files_of(self, task):
        """The final files of a task; of a part, none."""
        frames = re.fullmatch(r"(\d+)\.\.(\d+)", task)
        return [work / self.folder / f"{i:04}.png" for i in range(int(frames[1]), int(frames[2]) + 1)] if frames else []

    def check(self):
        for name, expected in self.expected.items():
            if digest(work / self.folder / name) != expected:
                sys.exit(f"{name} differs from the result of one process")
        left = [str(path) for path in (work / self.folder).rglob(".candela-*")] + [str(path) for path in work.glob("*.parts")]
        if left:
            sys.exit(f"left over: {left}")


def processes(of):
    """The numbers of processes whose command line contains all of these texts."""
    found = []
    for folder in pathlib.Path("/proc").iterdir():
        if not folder.name.isdigit() or int(folder.name) == os.getpid():
            continue
        try:
            words = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if all(text in words for text in of):
            found.append(int(folder.name))
    return found


def processes_on(node):
    """The tasks that a node of the cluster has started, and their children."""
    found = []
    for pid in processes([]):
        try:
            if f"SLURMD_NODENAME={node}\0".encode() in pathlib.Path(f"/proc/{pid}/environ").read_bytes():
                found.append(pid)
        except OSError:
            pass
    return found


def kill(pids):
    for pid in pids:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    return len(pids)


def tree(pid):
    """A process and all of its descendants."""
    try:
        children = (pathlib.Path("/proc") / str(pid) / "task" / str(pid) / "children").read_text().split()
    except OSError:
        children = []
    return [pid, *(descendant for child in children for descendant in tree(int(child)))]


def with_slurm(job):
    os.environ["SLURM_CONF"] = str(nodes / "slurm.conf")

    def queue():
        return subprocess.run(["squeue", "-h", "-o", "%i %T"], capture_output=True, text=True, check=False).stdout.split("\n")[:-1]

    def wait_until(what, is_so):
        for _ in range(3000):
            if is_so():
                return
            time.sleep(0.2)
        sys.exit(f"timed out waiting for: {what}\n{job.status()}\n{queue()}")

    def done():
        return job.status()["done"]

    job.submit()
    tasks = len(job.status()["tasks"])
    wait_until("some tasks are done", lambda: done() >= tasks // 8)

    killed = 0
    while killed < max(arguments.kills // 10, 1) or job.status()["failed"] == 0:
        wait_until("a task is running", lambda: processes([command, "--task", "--quiet"]))
        running = processes([command, "--task", "--quiet"])
        killed += kill([chance.choice(running)] if running else [])
        time.sleep(0.5)
    say(f"{killed} tasks are killed with SIGKILL, and status calls some failed; {done()} of {tasks} tasks are done")

    # slurmd, the processes that watch tasks, and the tasks, as in a power failure.
    wait_until("a task is running on node2", lambda: processes_on("node2"))
    victims = {int((nodes / "node2.pid").read_text()), *processes_on("node2")}
    victims.update(pid for pid in processes(["slurmstepd"]) if victims.intersection(tree(pid)))
    say(f"node2 is killed, with {kill(victims)} processes; {done()} of {tasks} tasks are done")

    wait_until("more tasks are done", lambda: done() >= tasks // 4)
    kill([int((nodes / "slurmctld.pid").read_text())])
    say(f"slurmctld is killed; {done()} of {tasks} tasks are done")
    time.sleep(2)
    subprocess.run([cluster, "slurmctld", nodes], check=True)
    say("slurmctld is back")

    subprocess.run([cluster, "node", nodes, "node2"], check=True)
    say("node2 is back")

    wait_until("the queue is empty", lambda: not queue())
    status = job.status()
    say(f"the queue is empty: {status['done']} done, {status['failed']} failed, {status['waiting']} waiting")
    if status["running"]:
        sys.exit("status reports running tasks")
    for task in status["tasks"]:
        if task["state"] == "failed":
            say(f"  {task['name']}: {task['why']}")
    job.submit()
    wait_until("the queue is empty", lambda: not queue())


def with_kills(job):
    for i in range(arguments.kills):
        process = subprocess.Popen([command, "submit", *job.words, "--jobs", "2", "--quiet"], cwd=work, start_new_session=True,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(chance.uniform(0.0, 2.0))
        # Every third time, its tasks outlive it.
        if i % 3:
            kill(tree(process.pid))
        else:
            kill([process.pid])
        process.wait()
        if (work / job.folder / ".candela" / "jobs").exists():
            status = job.status()
            say(f"killed: {status['done']} done, {status['running']} running, {status['failed']} failed, {status['waiting']} waiting")
    job.submit()


def finish(job, name):
    status = job.status()
    states = {task["state"] for task in status["tasks"]} | ({status["last"]["state"]} if "last" in status else set())
    if states != {"done"}:
        sys.exit(f"{name}: {status}")
    job.check()
    say(f"{name}: the same bytes as from one process, nothing left over")


shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
candela("new", "scene.toml", "--animation", "--quiet")
candela("edit", "scene.toml", "--change", f"animation.frames={arguments.frames}", "--quiet")
size = ("--width", "640", "--height", "400", "--samples", "16")
jobs = {}
say("one process makes the expected results")
if arguments.only != "poster":
    candela("animate", "scene.toml", *size, "-o", "alone/%04d.png", "--quiet")
    jobs["film"] = Job("frames", ["scene.toml", *size, "-o", "frames/%04d.png", "--chunk", "5"],
                       {path.name: digest(path) for path in (work / "alone").glob("*.png")})
if arguments.only != "film":
    poster = ("--width", arguments.poster, "--height", arguments.poster)
    candela("render", "scene.toml", *poster, "-o", "alone.tif", "--quiet")
    jobs["poster"] = Job(".", ["scene.toml", *map(str, poster), "-o", "poster.tif", "--parts", str(arguments.parts)],
                         {"poster.tif": digest(work / "alone.tif")})
try:
    if arguments.engine == "slurm":
        subprocess.run([cluster, "start", nodes], check=True)
    for name, job in jobs.items():
        (with_slurm if arguments.engine == "slurm" else with_kills)(job)
        finish(job, name)
    say(f"status was queried {statuses} times, and was always right")
finally:
    if arguments.engine == "slurm":
        subprocess.run([cluster, "stop", nodes], check=False)
