"""One schema for server and page."""

from __future__ import annotations

from pathlib import Path

import pytest

from pdeface.controls import CONTROLS
from pdeface.studio.schema import DENSITIES, schema
from pdeface.studio.typescript import typescript


def test_the_page_has_the_types_of_the_server(root: Path) -> None:
    written = (root / "client" / "src" / "schema.ts").read_text(encoding="utf-8")
    assert written == typescript(), "client/src/schema.ts is stale; run: make docs"


def test_every_control_is_there_with_its_range(client) -> None:
    told = client.get("/api/schema").json()["controls"]
    assert [(c["name"], c["low"], c["high"], c["kind"]) for c in told] == [
        (c.name, c.low, c.high, c.kind) for c in CONTROLS.values()
    ]


def test_every_control_is_in_a_group_that_is_listed() -> None:
    groups = {(group.kind, group.name) for group in schema().groups}
    assert {(c.kind, c.group) for c in schema().controls} == groups


def test_mirrors_are_mutual() -> None:
    mirrors = {c.name: c.mirror for c in schema().controls}
    paired = {name: other for name, other in mirrors.items() if other}
    assert len(paired) > 30
    assert all(mirrors[other] == name for name, other in paired.items())


@pytest.mark.parametrize("name", ["jawLeft", "mouthRight", "jawOpen", "noseLength"])
def test_what_has_no_other_side_has_no_mirror(name: str) -> None:
    assert {c.name: c.mirror for c in schema().controls}[name] is None


def test_curves_lie_on_rows_of_every_mesh() -> None:
    assert all((density.rows - 1) % 27 == 0 for density in DENSITIES)
