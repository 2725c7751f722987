"""Checks of what a user passes: names, with the closest valid one suggested, numbers, and columns of pulses."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from functools import wraps
from typing import Any, Callable, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

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


def read_quantities(names: Iterable[str] | None, known: Iterable[str]) -> tuple[str, ...]:
    """Those of `known`, in their order, that `names` has: one name, several, or None for all."""
    if names is None:
        return tuple(known)
    try:
        wanted = {names} if isinstance(names, str) else set(names)
    except TypeError:
        raise ArgumentError(f"quantities is {names!r}: it should be names of quantities") from None
    for name in wanted:
        check_name("quantities", name, known)
    if not wanted:
        raise ArgumentError("quantities is empty: name at least one, or omit it")
    return tuple(name for name in known if name in wanted)


def read_number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is {value!r}: it should be a number") from None


def read_optional(name: str, value: Any) -> float | None:
    return None if value is None else read_number(name, value)


def read_index(value: Any) -> float | None:
    """A refractive index of water, or None."""
    index = read_optional("refractive_index", value)
    if index is not None and not 1 <= index <= 2:
        raise ArgumentError(f"refractive_index is {index}: it should be 1 to 2")
    return index


def read_vector(name: str, values: Any, axes: Sequence[str]) -> dict[str, float]:
    """Three numbers by the names of their axes."""
    try:
        first, second, third = values
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} is {values!r}: it should be three numbers: {', '.join(axes)}") from None
    return {axis: read_number(name, value) for axis, value in zip(axes, (first, second, third))}


def read_column(name: str, values: ArrayLike | None, units: str = "") -> NDArray[Any]:
    """An array of integers or floats as it is; masked elements become NaN."""
    try:
        array = np.asanyarray(values)
    except ValueError as error:
        raise ArgumentError(f"{name} is not an array: {error}") from error
    if array.dtype.kind not in "iuf":
        raise ArgumentError(f"{name} is of type {array.dtype}: it should be numbers{units and f', in {units}'}")
    if isinstance(array, np.ma.MaskedArray):
        return np.where(np.ma.getmaskarray(array), np.nan, np.ma.getdata(array))
    return np.asarray(array)


def read_doubles(name: str, values: ArrayLike | None) -> NDArray[np.float64]:
    """The same in double precision."""
    return np.asarray(read_column(name, values), np.float64)


def common_shape(arrays: Mapping[str, NDArray[Any]], given: Mapping[str, Any]) -> tuple[int, ...]:
    """The shape to which all arrays broadcast.

    The dimensions of those that were given as arrays of xarray must agree: they would be paired by their position.
    """
    dims = {name: array.dims for name, array in given.items() if isinstance(getattr(array, "dims", None), tuple)}
    longest = max(dims.values(), key=len, default=())
    if any(of_array != longest[len(longest) - len(of_array):] for of_array in dims.values()):
        stated = ", ".join(f"{name} {' x '.join(map(str, of_array))}" for name, of_array in dims.items() if of_array)
        raise ArgumentError(f"the dimensions differ: {stated}; give them by xarray.broadcast")
    try:
        return np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items() if array.ndim > 0)
        raise ArgumentError(f"the shapes do not broadcast: {shapes}") from None
