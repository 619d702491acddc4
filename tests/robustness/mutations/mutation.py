"""Shared by the runs over hostile files: mutants, the checks of every run of the command, and the loop over them.

A mutant depends only on the name of its kind, a seed and its number: number I is the same for every count and on
every machine.
"""
import argparse
import concurrent.futures
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import unicodedata
from pathlib import Path

LIMIT = 10  # seconds of processor time
PATIENCE = 60  # seconds of any time, on a busy machine
address_space = str(16 << 30)  # bytes

NUMBERS = [b"0", b"-1", b"1", b"255", b"256", b"65535", b"65536", b"2147483647", b"2147483648", b"4294967295",
           b"4294967296", b"18446744073709551615", b"99999999999999999999", b"1e9", b"1e38", b"1e39", b"1e-46", b"nan",
           b"inf", b"-inf", b".", b"-", b"0x10", b"1e999999999", b""]


def spans_of_digits(data: bytes):
    spans, begin = [], None
    for i, c in enumerate(data + b" "):
        if 48 <= c <= 57:
            begin = i if begin is None else begin
        elif begin is not None:
            spans.append((begin, i))
            begin = None
    return spans


def mutated(data: bytes, others: list, chance: random.Random, words: list) -> bytes:
    """`data` with up to six changes; `others` are files to copy from, `words` are meaningful words of such a file."""
    for _ in range(chance.choice((1, 1, 1, 2, 3, 6))):
        kind = chance.randrange(10)
        at = chance.randrange(len(data) + 1)
        size = min(chance.choice((1, 1, 2, 4, 4, 8, 50, 200)), len(data) - at)
        if kind == 0:  # a bit
            if at < len(data):
                data = data[:at] + bytes([data[at] ^ 1 << chance.randrange(8)]) + data[at + 1:]
        elif kind == 1:  # bytes
            data = data[:at] + chance.randbytes(size) + data[at + size:]
        elif kind == 2:  # extreme ones
            data = data[:at] + bytes([chance.choice((0, 0x7F, 0x80, 0xFF))]) * size + data[at + size:]
        elif kind == 3:  # less
            data = data[:at] + data[at + size:]
        elif kind == 4:  # twice
            data = data[:at] + data[at:at + size] * chance.choice((2, 2, 3, 50)) + data[at + size:]
        elif kind == 5:  # cut off
            data = data[:at]
        elif kind in (6, 7):  # a number
            spans = spans_of_digits(data)
            if spans:
                begin, end = chance.choice(spans)
                data = data[:begin] + chance.choice(NUMBERS) + data[end:]
        elif kind == 8:  # a word
            data = data[:at] + b" " * chance.randrange(2) + chance.choice(words) + b" " * chance.randrange(2) + data[at:]
        else:  # of another file
            other = chance.choice(others)
            begin = chance.randrange(len(other) + 1)
            data = data[:at] + other[begin:begin + 10 * size] + data[at + size:]
    return data


# Visible format characters: signs of numbers and years in Arabic, Syriac and Kaithi.
VISIBLE = {chr(c) for c in [*range(0x600, 0x606), 0x6DD, 0x70F, 0x890, 0x891, 0x8E2, 0x110BD, 0x110CD]}


def unprintable(output: bytes) -> str:
    """Finds output unfit for a terminal: invalid UTF-8, and characters that control the terminal or the text's direction."""
    try:
        text = output.decode()
    except UnicodeDecodeError as problem:
        return f"its output is not UTF-8: {problem}"
    for character in text:
        if character not in "\n\t" and character not in VISIBLE and unicodedata.category(character) in ("Cc", "Cf", "Zl", "Zp"):
            return f"its output holds {character!r}"
    return ""


def run(command: list, directory: Path, codes: tuple, environment: dict = None, most_memory: int = 0):
    """The finished process, and its problem, if it ended in a way that is always wrong (otherwise an empty string).
    `most_memory`: the allowed peak memory in bytes, unless address spaces are unlimited; 0: unlimited."""
    measured = [sys.executable, "-BIS", __file__, directory / "usage", *command] if most_memory else command
    try:
        done = subprocess.run(["prlimit", f"--cpu={LIMIT}", f"--as={address_space}", *measured], cwd=directory,
                              capture_output=True, timeout=PATIENCE, stdin=subprocess.DEVNULL, check=False,
                              env=environment)
    except subprocess.TimeoutExpired:
        return None, f"it takes more than {PATIENCE} s"
    if most_memory and address_space != "unlimited" and (taken := int((directory / "usage").read_text())) > most_memory:
        return done, f"it takes {taken >> 20} MiB"
    if done.returncode not in codes:
        return done, f"exit code {done.returncode}: {done.stderr[-300:]!r}"
    if wrong := unprintable(done.stdout + done.stderr):
        return done, wrong
    if done.returncode != 0 and not done.stderr and not done.stdout:
        return done, "it fails without a message"
    return done, ""


def sweep(document: str, count: int, kinds: list, trial) -> int:
    """The program of a run: `trial(candela, directory, kind, chance, index)` returns the problem of one mutant, or nothing, and leaves
    its files in `directory`."""
    global address_space
    parser = argparse.ArgumentParser(description=document, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("candela", type=lambda path: str(Path(path).resolve()))
    parser.add_argument("--count", type=int, default=count, help=f"mutants of each kind; default: {count}")
    parser.add_argument("--seconds", type=float, help="instead of --count: as many of each kind in turn as fit into this time")
    parser.add_argument("--first", type=int, default=0, help="the number of the first mutant")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", action="append", choices=kinds, help="may be repeated; default: all")
    parser.add_argument("--keep", type=Path, help="a folder for those that fail")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--address-space", default=address_space,
                        help="bytes, or 'unlimited', as AddressSanitizer needs it; default: %(default)s")
    options = parser.parse_args()
    address_space = options.address_space

    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        def tried(kind: str, index: int):
            directory = Path(scratch) / f"{kind}-{index}"
            directory.mkdir()
            problem = trial(options.candela, directory, kind, random.Random(f"{kind} {options.seed} {index}"), index)
            if problem and options.keep:
                options.keep.mkdir(parents=True, exist_ok=True)
                # Pipes and endless files are kept as such.
                subprocess.run(["cp", "-a", "--sparse=always", directory, options.keep], check=False)
            shutil.rmtree(directory)
            return index, problem

        chosen = options.kind or kinds
        tries, failures = dict.fromkeys(chosen, 0), dict.fromkeys(chosen, 0)

        def sweep_once(kind: str, numbers: range) -> None:
            for index, problem in pool.map(lambda i: tried(kind, i), numbers):
                tries[kind] += 1
                failures[kind] += bool(problem)
                if problem:
                    print(f"{kind} {index}: {problem}", flush=True)

        end = time.monotonic() + (options.seconds or 0)
        first, at_once = options.first, options.count if options.seconds is None else 4 * options.jobs
        while True:
            for kind in chosen:
                sweep_once(kind, range(first, first + at_once))
            first += at_once
            if time.monotonic() >= end:
                break
        for kind in chosen:
            print(f"{kind}: {tries[kind]} mutants, {failures[kind]} failed", flush=True)
    return 1 if any(failures.values()) else 0


def measure(usage: str, command: list) -> int:
    """Runs a command, and writes its peak memory in bytes to a file."""
    code = subprocess.run(command, check=False).returncode
    Path(usage).write_text(str(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss << 10))
    return code if code >= 0 else 128 - code


def fail_without(seeds: list, what: str) -> None:
    if not seeds:
        sys.exit(f"there are no {what} to make mutants of")


if __name__ == "__main__":
    sys.exit(measure(sys.argv[1], sys.argv[2:]))
