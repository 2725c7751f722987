"""What recorded files and messages have and later ones have not, as lines of text. Later ones may have more.

Numbers agree within a relative 1e-5: sums in single precision, which compilers and processors order differently.

Since 0.1.0 the physics was corrected: the share of the sea is of the water's index, and totals are of the reported
point (CHANGELOG.md), and overlapping lines are compared in parts. Within `corrected()`, numbers may differ by as much
as that changes any, and orders of S-44, biases along the beam and the factors of parts by more.
"""

import contextlib
import csv
import json

import numpy as np

from las_file import LasFile

RELATIVE = 1e-5
OF_THE_CORRECTION = 0.3
FREE = ("best_s44_order", "s44_order_met", "best_order", "best_orders", "best_s44_orders", "bias_along_beam",
        "mean_bias_along_beam", "limited_by",
        "factor", "factor_air", "factor_sea", "air_in_variance")
OF_THE_PROGRAM = ("program_version",)
# Columns of single precision, of which messages have the bytes.
COLUMNS = ("SeaSurfaceColumns", "BudgetColumns", "S44Columns")
ONE_BYTE_EACH = ("best_s44_orders", "best_orders")


_relative, _ignored = RELATIVE, ()


@contextlib.contextmanager
def corrected():
    global _relative, _ignored
    _relative, _ignored = OF_THE_CORRECTION, FREE
    try:
        yield
    finally:
        _relative, _ignored = RELATIVE, ()


def numbers_differ(old, new, scale=0):
    """`scale`: of numbers in which larger ones cancel."""
    old, new = np.asarray(old, float), np.asarray(new, float)
    return old.shape != new.shape or not np.allclose(new, old, rtol=_relative, atol=_relative * scale, equal_nan=True)


def of_json(old, new, ignored=(), where=""):
    """Sentences are for people and may be worded anew. What was not known, null, may be known later."""
    if isinstance(old, dict):
        for key, value in old.items():
            if not isinstance(new, dict) or key not in new:
                yield f"{where}.{key} is gone"
            elif key not in (*ignored, *_ignored, *OF_THE_PROGRAM):
                yield from of_json(value, new[key], ignored, f"{where}.{key}")
    elif isinstance(old, list) and old and all(isinstance(each, str) for each in old):
        if not (isinstance(new, list) and {each for each in old if " " not in each} <= set(new)):
            yield f"{where} is {new}, not {old}"
    elif isinstance(old, list):
        if not isinstance(new, list) or len(old) != len(new):
            yield f"{where} is {new}, not {old}"
        else:
            for i, both in enumerate(zip(old, new)):
                yield from of_json(*both, ignored, f"{where}[{i}]")
    elif isinstance(old, (int, float)) and not isinstance(old, bool):
        if not isinstance(new, (int, float)) or numbers_differ(old, new, 1e-3):
            yield f"{where} is {new}, not {old}"
    elif old is not None and not (isinstance(old, str) and isinstance(new, str) and " " in old) and old != new:
        yield f"{where} is {new}, not {old}"


def of_csv(old, new):
    """Columns by their names, and their order."""
    old, new = (list(csv.DictReader(path.read_text().splitlines())) for path in (old, new))
    if len(old) != len(new):
        yield f"there are {len(new)} lines, not {len(old)}"
    for i, (before, after) in enumerate(zip(old, new)):
        if [name for name in after if name in before] != list(before):
            yield f"the columns are {list(after)}, not {list(before)}"
        for name, cell in before.items():
            try:
                same = not numbers_differ(float(cell), float(after.get(name, "")), 1e-3)
            except ValueError:
                same = cell == after.get(name) or name in _ignored
            if not same:
                yield f"line {i + 2}, column {name}: '{after.get(name)}', not '{cell}'"


def of_las(old, new):
    """The bytes of the points as they were before, and the dimensions that were added, by name and type."""
    old, new = LasFile(old), LasFile(new)
    before, after = old.extra_dimensions(), new.extra_dimensions()
    own = min(offset for offset, *_ in before.values())
    if old.records.shape[0] != new.records.shape[0] or (old.records[:, :own] != new.records[:, :own]).any():
        yield "the bytes of the points are others"
        return
    for name, (_, kind, no_data, _) in before.items():
        if name not in after or after[name][1] != kind or str(after[name][2]) != str(no_data):
            yield f"{name} is {after.get(name)}, not {before[name]}"
        else:
            columns = [las.columns()[name] for las in (old, new)]
            # The reported point turns a covariance, and a bias along the beam may be of any size beside what it was.
            greatest = np.nanmax(np.abs(columns[0]), initial=0) if _ignored else 0
            if numbers_differ(*columns, scale=max(1e-3, greatest)):
                yield f"{name}: values differ by {np.nanmax(np.abs(columns[0] - columns[1]))}"


def read_json(path):
    return json.loads(path.read_text())


def without_land(report):
    """Since 0.1.0 limits of land are held against no single point: a report without them, all others as they were."""
    kept = [each for each in report.get("specifications", ()) if each["name"] != "asprs"]
    places = [of["index"] for each in kept for of in each["classes"]]

    def changed(value, key=""):
        if isinstance(value, dict):
            return {name: changed(of, name) for name, of in value.items()}
        if isinstance(value, list):
            return [value[place] for place in places] if key == "meeting" else [changed(of) for of in value]
        return places.index(value) if key == "index" else value

    return changed({**report, "specifications": kept}) if kept else report


def of_files(old, new, ignored=()):
    kinds = {".csv": of_csv, ".las": of_las,
             ".json": lambda *_: of_json(without_land(read_json(old)), read_json(new), ignored)}
    return [f"{new.name}: {line}" for line in kinds[old.suffix](old, new)]


def of_messages(old, new, ignored=(), where=""):
    """Fields in `ignored` may differ. Bytes are columns where their message has columns."""
    for field, value in old.ListFields():
        if field.name in (*ignored, *_ignored):
            continue
        name, other = f"{where}.{field.name}", getattr(new, field.name)
        if field.message_type and field.message_type.GetOptions().map_entry:
            yield from (f"{name}[{key}] is gone" for key in value if key not in other)
            pairs = [(f"{name}[{key}]", value[key], other[key]) for key in value
                     if key in other and key not in OF_THE_PROGRAM]
        elif field.label == field.LABEL_REPEATED:
            if len(value) != len(other):
                yield f"{name} has {len(other)} elements, not {len(value)}"
            pairs = [(f"{name}[{i}]", *both) for i, both in enumerate(zip(value, other))]
        else:
            pairs = [(name, value, other)]
        for name, before, after in pairs:
            if field.message_type:
                yield from of_messages(before, after, ignored, name)
            elif not _same(field, old.DESCRIPTOR.name, before, after):
                yield f"{name} is {after!r}, not {before!r}"


def _same(field, message, old, new):
    if field.type == field.TYPE_BYTES and message in COLUMNS and field.name not in ONE_BYTE_EACH:
        old, new = np.frombuffer(old, "<f4"), np.frombuffer(new, "<f4")
        return not numbers_differ(old, new, np.nan_to_num(np.abs(old)).max(initial=0))
    if isinstance(old, float):
        return not numbers_differ(old, new, 1e-3)
    if field.type == field.TYPE_STRING and " " in old:
        return bool(new)  # A sentence.
    return old == new
