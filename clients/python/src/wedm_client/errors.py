"""What can go wrong, as exceptions: all of them are a :class:`WedmError`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .findings import Diagnostic


class NotSaved(ResourceWarning):
    """A document was closed whose repairs nobody has saved. Python says it where no ``-W`` and no PYTHONWARNINGS say otherwise."""


class WedmError(Exception):
    """Everything that this package raises by itself."""


class ServerNotFound(WedmError):
    """There is no program ``wedm`` in any of the places where it was looked for."""


class WrongProtocol(WedmError):
    """The program speaks another version of the protocol than this package, or is no wedm at all."""


class WrongSettings(WedmError, ValueError):
    """The server does not take a setting that it was started with; the message names each, and what was expected."""


class ServerDied(WedmError):
    """The server ended again and again; the end of its log is in the message."""


class NoAnswer(WedmError, TimeoutError):
    """The server is alive and did not answer within the time-out."""


class NotOpen(WedmError):
    """The document was closed, or belongs to another server."""


class DoesNotApply(WedmError, ValueError):
    """A change names an entity or a vertex that the drawing does not have; nothing was changed."""


class RequestFailed(WedmError):
    """The server answered with an error. ``code`` and ``data`` are those of the protocol."""

    def __init__(self, message: str, code: int, data: Any = None) -> None:
        super().__init__(message)
        self.code = code
        self.data = data


class Refused(RequestFailed):
    """The drawing does not allow what was asked for (-32803); ``diagnostics`` holds the findings that are the reason, if they are."""

    def __init__(self, message: str, code: int, data: Any, diagnostics: list[Diagnostic]) -> None:
        super().__init__(message, code, data)
        self.diagnostics = diagnostics


class Outdated(RequestFailed):
    """The document has changed since the request or the repair was made (-32801); nothing was changed."""
