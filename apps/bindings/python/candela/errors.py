"""Errors, with their diagnostics."""

from __future__ import annotations

from typing import NamedTuple, Sequence

from . import _candela


class Diagnostic(NamedTuple):
    """One problem in a scene, or in the values of a model."""

    severity: str
    """``"error"`` or ``"warning"``."""
    file: str
    """The file, or a name that stands for it."""
    line: int
    """Counted from 1; 0: the file as a whole."""
    column: int
    """Counted from 1."""
    length: int
    """The number of characters; 0: unknown."""
    message: str
    suggestion: str
    """Advice; may be empty."""
    text: str
    """The line in the file; may be empty."""

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        hint = f" ({self.suggestion})" if self.suggestion else ""
        return f"{place}: {self.severity}: {self.message}{hint}"


def diagnostics_from(problems: Sequence[_candela.Problem]) -> list[Diagnostic]:
    return [Diagnostic(*(getattr(problem, field) for field in Diagnostic._fields)) for problem in problems]


class Error(Exception):
    """An operation failed: a file cannot be read or written, a plugin fails, or memory runs out."""

    diagnostics: list[Diagnostic]
    """All problems found; empty unless a scene or a value is invalid."""

    def __init__(self, message: str, problems: Sequence[_candela.Problem] = ()) -> None:
        super().__init__(message)
        self.diagnostics = diagnostics_from(problems)


class SceneError(Error, ValueError):
    """A scene is invalid. The `diagnostics` list everything that is wrong with it."""


class RequestError(Error, ValueError):
    """The request is invalid: an unknown model, or a value out of range."""
