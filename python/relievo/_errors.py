"""The exceptions of the library."""

from __future__ import annotations


class Error(Exception):
    """An input, an option or a file that the library cannot use.

    kind is "input", "option", "geometry", "output", "cancelled" or "memory". input is the name of the file, the array
    or the keyword that caused the error. place is the position in it, such as "line 12" or "row 7", or empty. expected
    says what was expected there, and what was found instead.
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
        """Lets pickle send errors to other processes."""
        return type(self), (self.kind, self.input, self.place, self.expected)


class OutOfMemory(Error, MemoryError):
    """The error of kind "memory": the memory is too small for this number of points or this resolution.

    Objects that were made before stay valid.
    """
