"""The benchmark's tables."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from benchmarks.accuracy.cases import Result
from benchmarks.accuracy.scoring import REGIONS, Score

WAYS: dict[str, Callable[[Result], Score]] = {
    "fitted": lambda result: result.fitted,
    "neutral, scaled": lambda result: result.scaled,
    "neutral": lambda result: result.neutral,
}


def report(rows: Sequence[Result]) -> None:
    """Print what the rows say, one photo and three, by group and by side."""
    print("Synthetic pictures of known heads; distances from the scan to the face, millimetres.")
    single = [row for row in rows if row.views != "three"]
    for name, part in (("One photo", single), ("Three photos", three(rows))):
        print(f"\n{name}")
        for group in (*dict.fromkeys(row.group for row in part), "all"):
            table(group, [row for row in part if group in (row.group, "all")])
    print("\nOne photo, by how far the head is turned (mean of fitted | neutral, scaled)")
    for views in dict.fromkeys(row.views for row in single):
        some = [row for row in single if row.views == views]
        means = (np.mean([mean(way(row)) for row in some]) for way in list(WAYS.values())[:2])
        print(f"  {views:>3s} degrees" + "".join(f"{value:8.2f}" for value in means))


def three(rows: Sequence[Result]) -> list[Result]:
    return [row for row in rows if row.views == "three"]


def mean(score: Score) -> float:
    """Mean distance, millimetres."""
    return 1e3 * float(score.all.mean())


def table(title: str, rows: Sequence[Result]) -> None:
    """Median, mean and standard deviation over all points, and the mean of each region."""
    heads = len({row.subject for row in rows})
    columns = "".join(f"{name:>10s}" for name in ("median", "mean", "sd", *REGIONS))
    print(f"  {f'{title}: {heads} heads, {len(rows)} results':40s}{columns}")
    for name, way in WAYS.items():
        points = 1e3 * np.concatenate([way(row).all for row in rows])
        regions = (np.mean([1e3 * way(row).regions[key].mean() for row in rows]) for key in REGIONS)
        values = (np.median(points), points.mean(), points.std(), *regions)
        print(f"    {name:38s}" + "".join(f"{value:10.2f}" for value in values))
    gains = np.array([1.0 - mean(row.fitted) / mean(row.scaled) for row in rows])
    errors = 100.0 * np.array([row.error for row in rows])
    print(
        f"    nearer than the scaled neutral by {100 * gains.mean():.0f} per cent; "
        f"worse in {(gains < 0).sum()} of {len(rows)}, at worst by {-100 * gains.min():.0f}; "
        f"reprojection {errors.mean():.2f}, at most {errors.max():.2f} per cent of the eye "
        f"distance; identity within {max(row.most for row in rows):.1f} sd; drawn again "
        f"{100.0 * np.mean([row.image for row in rows]):.1f} per cent from the photo's colours"
    )
