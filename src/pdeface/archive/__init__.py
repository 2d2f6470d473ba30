"""The file that a face is saved in: what it says, and the ZIP around it."""

from pdeface.archive.record import VERSION, FaceRecord, pack, unpack

__all__ = ["VERSION", "FaceRecord", "pack", "unpack"]
