"""A table restated for water of another refractive index.

The twin of sea/table/table_at_index.h, which says how and why, and of EffectiveGainsOf in sea/response/closed_form.h.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .schema import AXES, Doubles
from .table_reader import TableContent

_OF_THE_PAPER = 1.33  # Assumed of a table that states no index.
_STEEPEST = 0.5  # Mean square slope.
_MOST = 1e6  # Of a value of a table.
_GENTLE, _STEEP = 0.005, 0.04  # Slope variances on each axis.
_NOTHING = 1e-9  # What rounding leaves of a number that is 0 at nadir.


def index_of(content: TableContent) -> float:
    """The refractive index of the water that the table was made for."""
    index = content.table.attributes.get("refractive_index")
    return index if isinstance(index, float) and 1.01 <= index <= 2 else _OF_THE_PAPER


def at_index(content: TableContent, index: float) -> TableContent:
    """The table as it would be in water of `index`, 1 to 2; at its own index the same table."""
    if index == index_of(content):
        return content
    factors = _factors(content, index)
    values, errors = ({name: _scaled(numbers, factors[name]) for name, numbers in columns.items()}
                      for columns in (content.values, content.standard_errors))
    attributes = content.table.attributes.copy()
    attributes["refractive_index"] = index
    return TableContent(replace(content.table, attributes=attributes), values, errors)


def _scaled(numbers: NDArray[Any], factors: Doubles) -> NDArray[Any]:
    product = (numbers * factors).astype(np.float32)
    held = np.clip(product, np.finfo(np.float32).tiny, _MOST)  # What is positive stays so.
    result: NDArray[Any] = np.where(numbers > 0, held, np.maximum(product, np.float32(-_MOST))).astype(np.float32)
    return result


def _ratio(a: Doubles, b: Doubles, otherwise: Doubles) -> Doubles:
    with np.errstate(all="ignore"):
        ratio = a / b
    found: Doubles = np.where((ratio > 0) & (ratio < 1e3), ratio, otherwise)
    return found


def _variance(degrees: Doubles, bias: Doubles) -> Doubles:
    angle = (np.deg2rad(degrees) / 2) ** 2
    variance = angle
    for _ in range(3):
        variance = angle / (1 - np.minimum(variance + bias * bias, 0.3)) ** 2
    return variance


def _degrees(variance: Doubles, bias: Doubles) -> Doubles:
    degrees: Doubles = np.rad2deg(2 * np.sqrt(variance) * (1 - np.minimum(variance + bias * bias, 0.3)))
    return degrees


class _Snell:
    """Snell's law on a sea, for one incidence and index: a row of numbers for each covariance of the slopes."""

    def __init__(self, incidence: float, index: float) -> None:
        self._incidence, self._index = incidence, index
        self._level = self._of(0, 0, 0)
        self._gentle, self._steep = self._changes(_GENTLE), self._changes(_STEEP)

    def __call__(self, slopes: Doubles) -> tuple[Doubles, Doubles, Doubles, Doubles]:
        """Gain, path, curvature and bias; x along the beam, y across it."""
        trace = slopes[..., 0, 0] + slopes[..., 1, 1]
        steep = np.clip((trace / 2 - _GENTLE) / (_STEEP - _GENTLE), -1, 2)[..., None]
        numbers: Doubles = np.broadcast_to(self._level, (*trace.shape, self._level.size))
        for i, (row, column) in enumerate(((0, 0), (1, 1), (0, 1))):
            entry = slopes[..., row, column, None]
            numbers = numbers + (1 - steep) * entry * self._gentle[i] + steep * entry * self._steep[i]
        shape = trace.shape
        return (numbers[..., :4].reshape(*shape, 2, 2), numbers[..., 4:6], numbers[..., 6:10].reshape(*shape, 2, 2),
                numbers[..., 10:])

    def _changes(self, variance: float) -> list[Doubles]:
        both = self._of(variance, variance, 0)
        x, y = self._of(variance, 0, 0) - self._level, self._of(0, variance, 0) - self._level
        together = both - self._level - x - y
        mixed = self._of(variance, variance, variance / 2) - both
        mixed /= variance / 2
        return [x / variance + together / (2 * variance), y / variance + together / (2 * variance), mixed]

    def _of(self, xx: float, yy: float, xy: float) -> Doubles:
        gains = _effective_gains(self._incidence, self._index, np.array([[xx, xy], [xy, yy]]))
        mean, gain, curvature = gains
        sine = np.sin(self._incidence) / self._index
        cosine = np.sqrt(1 - sine * sine)
        bias = mean - [sine / cosine, 0, 1 / cosine]
        bias[2] *= cosine
        row: Doubles = np.concatenate([gain[:2].ravel(), cosine * gain[2], (cosine * curvature[2]).ravel(), bias])
        return row


def _effective_gains(incidence: float, index: float, slopes: Doubles) -> tuple[Doubles, Doubles, Doubles]:
    """E_w[F], its gains (3, 2) and its curvatures (3, 2, 2), F = tangent along, across, and secant."""
    quadrature: Any = np.polynomial.hermite_e.hermegauss  # NumPy gives it no type.
    at, weight = quadrature(10)
    weight = weight / weight.sum()
    variances, axes = np.linalg.eigh(slopes)
    deviation = axes * np.sqrt(np.maximum(variances, 0))
    slope = np.stack(np.meshgrid(at, at, indexing="ij"), -1).reshape(-1, 2) @ deviation.T
    share = np.outer(weight, weight).ravel()
    tau = np.tan(incidence)
    weights = share * np.maximum(0, 1 + tau * slope[:, 0])
    step = 1e-3

    def rays(i: int, j: int) -> Doubles:
        m = slope + step * np.array([i, j])
        ratio, q = 1 / index, 1 + (m * m).sum(-1)
        v = ratio * (m[:, 0] * np.sin(incidence) + np.cos(incidence))
        lift = (v - np.sqrt(q * (1 - ratio * ratio) + v * v)) / q
        secant = -1 / (-ratio * np.cos(incidence) + lift)
        ray: Doubles = np.stack([(ratio * np.sin(incidence) - lift * m[:, 0]) * secant, -lift * m[:, 1] * secant,
                                 secant], -1)
        return ray

    shifted = {(i, j): weights @ rays(i, j) / weights.sum() for i in (-1, 0, 1) for j in (-1, 0, 1)}
    mean = shifted[0, 0]
    gain = np.stack([(shifted[1, 0] - shifted[-1, 0]) / (2 * step) + tau * (share @ rays(0, 0) - mean),
                     (shifted[0, 1] - shifted[0, -1]) / (2 * step)], -1)
    xx = shifted[1, 0] + shifted[-1, 0] - 2 * mean
    yy = shifted[0, 1] + shifted[0, -1] - 2 * mean
    xy = (shifted[1, 1] + shifted[-1, -1] - shifted[1, -1] - shifted[-1, 1]) / 4
    curvature = np.stack([np.stack([xx, xy], -1), np.stack([xy, yy], -1)], -2) / step ** 2
    return mean, gain, curvature


def _slopes(content: TableContent, own: float) -> Doubles:
    """Variances on the axes of the sea, by wind and fetch."""
    bent = (1 - 1 / own) ** 2
    x, y = (_variance(content.values[name][:, :, 0, 0, 0].astype(float), np.zeros(1)) / bent
            for name in ("refraction_along_wind", "refraction_cross_wind"))
    depth = float(content.table.axes["depth"].nodes[-1])
    whole = x + y
    if "bias_vertical" in content.values and depth > 0:
        bias = content.values["bias_vertical"][:, :, 0, 0, 0, -1].astype(float)
        whole = np.where(whole > 0, np.maximum(whole, -2 * bias / depth / bent), whole)
    with np.errstate(all="ignore"):
        scale = np.where(x + y > 0, np.minimum(whole, _STEEPEST) / (x + y), 0)
    slopes: Doubles = np.stack([x * scale, y * scale], -1)
    return slopes


def _form(curvature: Doubles, slopes: Doubles) -> Doubles:
    product = curvature @ slopes
    form: Doubles = np.trace(product @ product, axis1=-2, axis2=-1)
    return form


def _factors(content: TableContent, index: float) -> dict[str, Doubles]:
    """By quantity, what its values and standard errors are multiplied by."""
    axes, own = content.table.axes, index_of(content)
    slopes = _slopes(content, own)
    # The axes of wind, fetch and azimuth, then a matrix; the footprint comes between where there is one.
    angle = np.deg2rad(axes["azimuth"].nodes.astype(float))
    turn = np.stack([np.stack([np.cos(angle), -np.sin(angle)], -1), np.stack([np.sin(angle), np.cos(angle)], -1)], -2)
    back = np.swapaxes(turn, -1, -2)
    on_beam = back @ (slopes[:, :, None, :, None] * np.eye(2)) @ turn
    incidences = np.deg2rad(np.minimum(axes["incidence"].nodes.astype(float), 80))
    nadir = _Snell(float(incidences[0]), own)(on_beam)
    parts: list[dict[str, Doubles]] = []
    for i, incidence in enumerate(incidences):
        values = {name: numbers[:, :, i].astype(float) for name, numbers in content.values.items()}
        vertical: Doubles = np.square(content.values["tvu"][:, :, 0].astype(float))
        both = tuple(_Snell(float(incidence), n)(on_beam) for n in (own, index))
        parts.append(_of_incidence(values, vertical, both, nadir, turn, float(axes["depth"].nodes[0]) == 0))
    return {name: np.stack([part[name] for part in parts], 2) for name in content.values if name in parts[0]}


def _of_incidence(values: dict[str, Doubles], vertical: Doubles, both: Any, nadir: Any, turn: Doubles,
                  from_surface: bool) -> dict[str, Doubles]:
    (gain, path, bend, bias), (new_gain, new_path, new_bend, new_bias) = both
    back = np.swapaxes(turn, -1, -2)
    squares, new_squares = ((turn @ g @ back)[..., None, :, :] ** 2 for g in (gain, new_gain))
    tilt, new_tilt = ((turn @ b[..., :2, None])[..., None, :, 0] for b in (bias, new_bias))
    angles = np.stack([values["refraction_along_wind"], values["refraction_cross_wind"]], -1)
    errors = _variance(angles, tilt)
    seen = np.maximum(np.linalg.solve(squares, errors[..., None]), 0)
    change = ((new_squares - squares) @ seen)[..., 0]
    usual = np.trace(new_squares, axis1=-2, axis2=-1) / np.trace(squares, axis1=-2, axis2=-1)
    new_errors = errors * _ratio(errors + change, errors, usual[..., None])
    refraction = _ratio(_degrees(new_errors, new_tilt), angles, np.sqrt(usual)[..., None])
    horizontal = np.sqrt(_ratio(new_errors.sum(-1), errors.sum(-1), usual))
    on_beam = back[:, None] @ (seen * np.eye(2)) @ turn[:, None]

    def first_order(row: Doubles) -> Doubles:
        form: Doubles = np.einsum("...i,...ij,...j", row[..., None, :], on_beam, row[..., None, :])
        return form

    along = (new_gain[..., 0, 0] / gain[..., 0, 0]) ** 2
    slanted = np.linalg.norm(path, axis=-1) > _NOTHING
    first = np.where(slanted[..., None], _ratio(first_order(new_path), first_order(path), along[..., None]),
                     along[..., None])
    forms = [_form(b[..., None, :, :], on_beam) for b in (bend, new_bend, nadir[2])]
    second = _ratio(forms[1], forms[0], usual * usual)
    of_nadir = _ratio(forms[0], forms[2], np.ones(1))
    variance = values["tvu"] ** 2
    surface, below_nadir = ((v[..., :1] if from_surface else np.zeros_like(v[..., :1])) for v in (variance, vertical))
    below = np.maximum(0, variance - surface)
    bent = np.minimum(below, np.maximum(0, vertical - below_nadir) * of_nadir[..., None])
    whole = np.minimum(surface, variance) + below
    tvu = np.sqrt(_ratio((whole - bent) * first[..., None] + bent * second[..., None], whole, first[..., None]))
    factors = {"refraction_along_wind": refraction[..., 0], "refraction_cross_wind": refraction[..., 1],
               "thu": np.broadcast_to(horizontal[..., None], variance.shape), "tvu": tvu}
    for name, axis, otherwise in (("bias_along_beam", 0, np.sqrt(usual)), ("bias_vertical", 2, usual)):
        ratio = _ratio(new_bias[..., None, axis], bias[..., None, axis], otherwise)
        ratio = np.where(np.abs(bias[..., None, axis]) > _NOTHING, ratio, otherwise)
        factors[name] = np.broadcast_to(ratio[..., None], variance.shape)
    return factors


assert list(AXES) == ["wind_speed", "fetch", "incidence", "azimuth", "footprint", "depth"]
