"""What can go wrong, with what was found and where."""

from __future__ import annotations

from typing import NamedTuple, Sequence

from . import _candela


class Diagnostic(NamedTuple):
    """One thing that was found in a scene, or among the values of a model."""

    severity: str
    """``"error"`` or ``"warning"``."""
    file: str
    """The file, or what stands for it."""
    line: int
    """From 1; 0: the file as a whole."""
    column: int
    """From 1."""
    length: int
    """How many characters are concerned; 0: not known."""
    message: str
    suggestion: str
    """What to do about it; may be empty."""
    text: str
    """The line in the file; may be empty."""

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        hint = f" ({self.suggestion})" if self.suggestion else ""
        return f"{place}: {self.severity}: {self.message}{hint}"


def diagnostics_from(problems: Sequence[_candela.Problem]) -> list[Diagnostic]:
    return [Diagnostic(*(getattr(problem, field) for field in Diagnostic._fields)) for problem in problems]


class Error(Exception):
    """Something could not be done: a file that cannot be read or written, a plugin that fails, no memory."""

    diagnostics: list[Diagnostic]
    """All that was found; empty where it is no scene and no value that is wrong."""

    def __init__(self, message: str, problems: Sequence[_candela.Problem] = ()) -> None:
        super().__init__(message)
        self.diagnostics = diagnostics_from(problems)


class SceneError(Error, ValueError):
    """A scene is wrong. All that is wrong with it is among the `diagnostics`."""


class RequestError(Error, ValueError):
    """What was asked for does not exist or is not possible: a model that nobody has, a value out of its range."""
