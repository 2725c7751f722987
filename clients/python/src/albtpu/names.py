"""Checks names that a user types, and suggests the closest valid one."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from difflib import get_close_matches
from functools import wraps
from typing import Callable, ParamSpec, TypeVar

from .errors import ArgumentError

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


def refuse_unknown_keywords(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Makes a call of the method with a keyword that it does not have raise ArgumentError, which suggests one.

    Python's own TypeError would name the required argument that is missing, not the misspelt one.
    """
    known = list(inspect.signature(function).parameters)[1:]  # All but self.

    @wraps(function)
    def checked(*args: Arguments.args, **keywords: Arguments.kwargs) -> Result:
        for name in keywords:
            if name not in known:
                raise ArgumentError(f"{function.__name__} has no argument '{name}'{_suggestion(name, known)}; its "
                                    f"arguments are {', '.join(known)}")
        return function(*args, **keywords)

    return checked


def check_name(argument: str, name: object, known: Iterable[str]) -> None:
    """Raises ArgumentError unless `name`, the value of `argument`, is one of `known`."""
    if name not in (known := list(known)):
        raise ArgumentError(f"{argument} is {name!r}{_suggestion(name, known)}: it should be "
                            f"{' or '.join(map(repr, known))}")


def _suggestion(name: object, known: list[str]) -> str:
    close = get_close_matches(name, known, n=1, cutoff=0.5) if isinstance(name, str) else []
    return f" (did you mean '{close[0]}'?)" if close else ""
