"""Keywords from the library's table of options, which is also that of the command line."""

from __future__ import annotations

import inspect
import numbers
import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeVar, Union

import numpy as np

from . import _native

Function = TypeVar("Function", bound=Callable[..., Any])

TABLE: list[dict[str, Any]] = _native.option_table()


def of_stage(*stages: str) -> list[str]:
    """Returns the keywords of the options that belong to those stages."""
    return [row["keyword"] for row in TABLE if row["stage"] in stages]


INPUT = [*of_stage("input"), "base_image", "scan", "stream_above_mb"]

_TEXTS = {row["keyword"] for row in TABLE if "min" not in row}

# A session uses the options in PREPARED once, when it prepares the scan. OF_FRAME lists the options of its frames.
PREPARED = {*of_stage("view", "model"), *INPUT} - {"base_image"}
OF_MAKE = [row["keyword"] for row in TABLE if row["stage"] != "input"] + INPUT
OF_SESSION = [keyword for keyword in OF_MAKE if keyword not in PREPARED]
OF_FRAME = of_stage("shape")

# Keyword arguments that belong to another function.
ELSEWHERE = {"threads": "set_threads() sets the number of threads"}

_EXTRA_HELP = {
    "base_image": "height map for base image: a path or a 2-D array, bright is high",
    "scan": "of a project: the path of its scan, where it is not found",
    "stream_above_mb": "size from which binary PLY, PCD and LAS are read piece by piece; 512",
}


def check(function: str, given: Iterable[str], known: Sequence[str]) -> None:
    """Raises TypeError for an unknown keyword, and names the nearest known one."""
    for name in given:
        if name in known:
            continue
        if name in OF_MAKE:
            where = "make() takes it" if name in OF_SESSION else "a session prepares it once, so open another"
            raise TypeError(f"{function}() cannot change '{name}': {where}")
        hint = ELSEWHERE.get(name)
        if hint is None:
            # Users often omit the unit.
            names = {re.sub("_(mm|deg|mb)$", "", keyword): keyword for keyword in known} | dict(zip(known, known))
            nearest = _native.nearest_name(name, list(names))
            hint = f"the nearest is '{names[nearest]}'" if nearest else ""
        raise TypeError(f"{function}() got an unexpected keyword argument '{name}'{hint and '; ' + hint}")


def check_progress(progress: Any) -> None:
    """Raises TypeError unless the argument is a function or None."""
    if progress is not None and not callable(progress):
        raise TypeError(f"progress: expected a function, found {type(progress).__name__}")


def texts(options: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the options, with paths, numbers and sequences converted to the texts that the table expects."""
    made = dict(options)
    for name, value in options.items():
        if isinstance(value, os.PathLike):
            made[name] = os.fsdecode(value)
        elif name in _TEXTS:
            made[name] = text_of(value)
    return made


def text_of(value: Any) -> Any:
    """Converts numbers to text: a row to X,Y,Z and several rows to X,Y;X,Y. Returns other values unchanged."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        return repr(float(value))
    if not isinstance(value, (list, tuple)):
        return value
    has_rows = any(isinstance(each, (list, tuple)) for each in value)
    parts = [text_of(each) for each in value]
    wrong = [part for part in parts if not isinstance(part, str)]
    if wrong:
        raise TypeError(f"expected numbers, found {type(wrong[0]).__name__}")
    return (";" if has_rows else ",").join(parts)


def _annotation(row: Mapping[str, Any]) -> Any:
    if "min" in row:
        return Union[float, str, None] if row["unit"] == "MM" else Union[float, None]
    has_numbers = row["unit"] in ("SIDE", "X,Y,Z", "X0,Y0,X1,Y1", "NOISE", "X,Y;..")
    return Any if has_numbers else Union[str, None]


def _parameters(known: Sequence[str]) -> list[inspect.Parameter]:
    types = {row["keyword"]: _annotation(row) for row in TABLE}
    types["stream_above_mb"] = Union[float, None]
    return [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=types.get(name, Any))
        for name in known
    ]


def _help(known: Sequence[str]) -> str:
    lines = []
    for row in TABLE:
        if row["keyword"] not in known:
            continue
        words = f"; {', '.join(row['choices'])}" if "choices" in row else ""
        ends = f" [{row['min']:g} to {row['max']:g}]" if "min" in row else ""
        lines.append(f"    {row['keyword']}: {row['help']}{words}{ends}; default: {row['default_text']}")
    lines += [f"    {name}: {_EXTRA_HELP[name]}" for name in known if name in _EXTRA_HELP]
    return "\n".join(lines)


def with_keywords(known: Sequence[str]) -> Callable[[Function], Function]:
    """Gives a function that takes **options a signature and a docstring that name each option."""

    def decorate(function: Function) -> Function:
        signature = inspect.signature(function)
        own = [p for p in signature.parameters.values() if p.kind is not inspect.Parameter.VAR_KEYWORD]
        function.__signature__ = signature.replace(parameters=own + _parameters(known))  # type: ignore[attr-defined]
        function.__doc__ = f"{inspect.cleandoc(function.__doc__ or '')}\n\nOptions:\n{_help(known)}\n"
        return function

    return decorate
