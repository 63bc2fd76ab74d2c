from typing import Any

# Only the sources of this package use the native module.
def __getattr__(name: str) -> Any: ...
