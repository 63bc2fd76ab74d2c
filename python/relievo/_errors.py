"""The exception of everything that the library refuses."""

from __future__ import annotations


class Error(Exception):
    """An input, an option or a file that the library cannot use.

    kind is "input", "option", "geometry", "output", "cancelled" or "memory"; input is the name of the file, the array or the
    keyword; place is where in it, as "line 12" or "row 7", or empty; expected says what was expected there, and what was
    found instead.
    """

    kind: str
    input: str
    place: str
    expected: str

    def __init__(self, kind: str, input: str, place: str, expected: str) -> None:
        head = ", ".join(part for part in (input, place) if part)
        super().__init__(f"{head}: {expected}" if head else expected)
        self.kind = kind
        self.input = input
        self.place = place
        self.expected = expected

    def __reduce__(self) -> tuple[type[Error], tuple[str, str, str, str]]:
        """Errors travel between processes."""
        return type(self), (self.kind, self.input, self.place, self.expected)


class OutOfMemory(Error, MemoryError):
    """The error of kind "memory": there is too little of it for so many points or so fine a resolution.

    What was made before is still there and can be used.
    """
