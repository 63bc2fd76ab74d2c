"""Writes the stub file of the package on the path, with the types of all options: write_stub.py FILE."""

import inspect
import re
import sys
import typing
from pathlib import Path

sys.path.pop(0)  # excludes the sources beside this file, which have no native module

import relievo  # noqa: E402

HEAD = '''"""The types of the package. Made by python/write_stub.py."""

import os
from collections.abc import Callable
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

'''


def annotation(value):
    """Returns a type annotation as text for the stub file."""
    text = value if isinstance(value, str) else inspect.formatannotation(value)
    text = text.replace("typing.", "").replace("NoneType", "None").replace("Path]", "Union[str, os.PathLike[str]]]")
    text = re.sub(r"\bProgress\b", "Optional[Callable[[str, float], object]]", text)
    text = re.sub(r"(?<!\.)\bPath\b", "Union[str, os.PathLike[str]]", text)
    return text


def parameter(each):
    if each.annotation is inspect.Parameter.empty:
        return each.name
    default = "" if each.default is inspect.Parameter.empty else " = ..."
    return f"{each.name}: {annotation(each.annotation)}{default}"


def signature(name, function, indent):
    made = inspect.signature(function)
    parts, is_marked = [], False
    for each in made.parameters.values():
        if each.kind is inspect.Parameter.KEYWORD_ONLY and not is_marked:
            parts.append("*")
            is_marked = True
        parts.append(parameter(each))
    line = f"{indent}def {name}({', '.join(parts)}) -> {annotation(made.return_annotation)}: ..."
    if len(line) <= 120:
        return line + "\n"
    body = "".join(f"{indent}    {part},\n" for part in parts)
    return f"{indent}def {name}(\n{body}{indent}) -> {annotation(made.return_annotation)}: ...\n"


def class_stub(name, kind):
    base = "(Exception)" if issubclass(kind, Exception) else ""
    lines = [f"class {name}{base}:\n"]
    fields = dict(typing.get_type_hints(kind)) if issubclass(kind, Exception) else {}
    lines += [f"    {field}: {inspect.formatannotation(type_)}\n" for field, type_ in fields.items()]
    if name == "Cloud":
        lines += ["    points: NDArray[Any]\n", "    normals: Optional[NDArray[Any]]\n", "    colours: Optional[NDArray[Any]]\n"]
    for member, value in vars(kind).items():
        if isinstance(value, property):
            result = annotation(inspect.signature(value.fget).return_annotation)
            lines.append(f"    @property\n    def {member}(self) -> {result}: ...\n")
        elif inspect.isfunction(value) and member != "__reduce__":
            lines.append(signature(member, value, "    "))
    return "".join(lines)


def stub():
    names = relievo.__all__
    listed = "".join(f'    "{name}",\n' for name in names)
    parts = [f"__version__: str\n__all__ = [\n{listed}]\n"]
    for name in names:
        value = getattr(relievo, name)
        parts.append(class_stub(name, value) if inspect.isclass(value) else signature(name, value, ""))
    return HEAD + "\n".join(parts)


def main():
    Path(sys.argv[1]).write_text(stub(), encoding="utf-8")


main()
