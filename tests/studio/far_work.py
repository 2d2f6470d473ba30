"""What :mod:`test_apart` has done in another process."""

from __future__ import annotations

import os

import numpy as np

from pdeface.errors import InputError


def doubled(tell, value):
    tell("begun")
    tell("half way", 0.5)
    tell.show({"face": np.full(2, value)})
    return 2 * value, os.getpid()


def refused(tell, what):
    raise InputError(f"expected a face, got {what}; choose another")


class Unportable(Exception):
    def __init__(self, one, other):
        super().__init__(one)
        self.other = lambda: other


def strange(tell):
    raise Unportable("odd", 1)


def gone(tell):
    os._exit(3)
