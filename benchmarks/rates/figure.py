"""The picture of bytes against errors."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.rates.codecs import Point
from pdeface.files import atomic_path

Files = dict[str, list[Point]]
LOOKS = {
    "pdeface": ("#b5432f", "-", 2.4, "pdeface"),
    "draco": ("#2f5d8a", "-", 1.8, "Draco, bare mesh"),
    "draco with texcoords": ("#2f5d8a", "--", 1.8, "Draco, texture coordinates too"),
}
SIZES = np.geomspace(80, 8000, 160)
WHAT = "RMS distance, both ways, mm", "normals, median degrees"
LIMITS = (0.03, 2.0), (0.3, 12.0)


def draw(
    groups: dict[str, list[Files]], best: Callable[[list[Point], int, int], float], path: Path
) -> None:
    """A row for each group of heads, a column for each measure; means over the heads."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(
        len(groups), 2, figsize=(10.0, 3.9 * len(groups)), squeeze=False, sharex=True, sharey="col"
    )
    for (group, heads), row in zip(groups.items(), axes, strict=True):
        for what, ax in enumerate(row):
            for way, (color, dashes, width, label) in LOOKS.items():
                errors = [np.mean([best(h[way], n, what) for h in heads]) for n in SIZES]
                there = np.isfinite(errors)
                ax.plot(SIZES[there], np.array(errors)[there], color=color, ls=dashes, lw=width,
                        label=label)  # fmt: skip
            _dress(ax, f"{len(heads)} heads of {group}", WHAT[what])
            ax.set_ylim(LIMITS[what])
    for ax in axes[-1]:
        ax.set_xlabel("bytes")
    axes[0, 0].legend(frameon=False, loc="lower left")
    figure.tight_layout()
    with atomic_path(path) as temporary:
        figure.savefig(temporary, dpi=110, format=path.suffix[1:])
    plt.close(figure)


def _dress(ax: Any, title: str, label: str) -> None:
    from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

    ax.set(xscale="log", yscale="log", title=title, ylabel=label)
    ax.grid(alpha=0.25, lw=0.6)
    ax.spines[["top", "right"]].set_visible(False)
    plain = FuncFormatter(lambda value, _: f"{value:g}")
    sizes = [100, 200, 500, 1000, 2000, 5000]
    errors = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10]
    for axis, places in ((ax.xaxis, sizes), (ax.yaxis, errors)):
        axis.set_major_locator(FixedLocator(places))
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(plain)
