"""Progress of a large query, shown to the user."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Callable

Progress = Callable[[int], object]  # Takes the number of pulses answered since the last call.

_SECONDS_BETWEEN_LINES = 1.0


@contextmanager
def show_progress(total: int) -> Iterator[Progress]:
    """Shows progress towards `total` pulses on standard error, with tqdm or as plain lines; 0 shows nothing."""
    if total == 0:
        yield lambda count: None
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield _Lines(total).add
        return
    with tqdm(total=total, unit="pulse", unit_scale=True) as bar:
        yield bar.update


class _Lines:
    """One line per second: pulses done, rate and time left."""

    def __init__(self, total: int) -> None:
        self._total, self._done = total, 0
        self._begin = self._last = time.monotonic()

    def add(self, count: int) -> None:
        self._done += count
        now = time.monotonic()
        if now - self._last < _SECONDS_BETWEEN_LINES and self._done < self._total:
            return
        self._last = now
        rate = self._done / max(now - self._begin, 1e-9)
        print(f"albtpu: {self._done} of {self._total} pulses, {rate / 1e6:.2f} million per second, "
              f"{(self._total - self._done) / rate:.0f} s left", file=sys.stderr)
