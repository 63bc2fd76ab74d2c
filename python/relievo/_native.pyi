from typing import Any

# The native module is for the sources of this package alone.
def __getattr__(name: str) -> Any: ...
