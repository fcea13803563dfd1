"""What can go wrong: one exception, and warnings of scene files."""

from __future__ import annotations

from typing import Optional


class Error(RuntimeError):
    """A scene, a file or an option cannot be. The message says where, what, and what to do.

    ``file``, ``line`` and ``column`` (counted from 1) are the place in a scene file, ``None`` where it is not known; ``failure``
    is "scene", "usage", "output", "run_time", "differs" or "incomplete".
    """

    def __init__(self, message: str, *, failure: str = "run_time", file: Optional[str] = None, line: Optional[int] = None,
                 column: Optional[int] = None) -> None:
        super().__init__(message)
        self.failure = failure
        self.file = file
        self.line = line
        self.column = column


class SceneWarning(UserWarning):
    """Something in a scene file that is known and not honoured, say; its place is ``file``, ``line``, ``column``."""

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0) -> None:
        place = f"{file}:{line}:{column}: " if line > 0 else (f"{file}: " if file else "")
        super().__init__(place + message)
        self.file = file
        self.line = line
        self.column = column
