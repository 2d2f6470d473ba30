"""An adaptive binary arithmetic coder: whole numbers to bytes and back, in their contexts.

The interval is kept in 32 bits with carries propagated on output, as in LZMA's range coder (Pavlov
1999; Martin 1979). The probability of each bit in each context is learnt as it comes: quickly at
first, by counts, then by exponential forgetting.
"""

from __future__ import annotations

from collections.abc import Hashable

from pdeface.errors import FileFormatError

__all__ = ["Decoder", "Encoder"]

_BITS = 16
_ONE = 1 << _BITS
_TOP = 1 << 24
_MASK = (1 << 32) - 1
_SLOWEST = 6
"""A bit shifts the probability of its context by 1 / 2 at first, at last by 2^-6 of the rest."""

_ESCAPE = 14
"""Magnitudes from which on the excess is written by Elias's gamma code."""


class _Model:
    """Probabilities that a bit is 0, by context."""

    def __init__(self) -> None:
        self._chances: dict[Hashable, tuple[int, int]] = {}

    def zero(self, context: Hashable) -> int:
        """Of 2^16, the chance of a 0; neither end is ever reached."""
        return self._chances.get(context, (_ONE // 2, 0))[0]

    def learn(self, context: Hashable, bit: int) -> None:
        chance, count = self._chances.get(context, (_ONE // 2, 0))
        goal = _ONE - 32 if bit == 0 else 32
        step = min(count + 1.5, 1 << _SLOWEST)
        chance += int((goal - chance) / (step + 0.5))
        self._chances[context] = chance, count + 1


class Encoder:
    """Numbers in, bytes out."""

    def __init__(self) -> None:
        self._model = _Model()
        self._low, self._range = 0, _MASK
        self._bytes = bytearray()

    def number(self, value: int, context: Hashable) -> None:
        """A whole number, expected to be small; its sign is as likely as not."""
        size = abs(value)
        for at in range(min(size, _ESCAPE)):
            self._bit(1, (context, min(at, 4)))
        if size < _ESCAPE:
            self._bit(0, (context, min(size, 4)))
        else:
            self._gamma(size - _ESCAPE + 1)
        if size:
            self._even(int(value < 0))

    def finish(self) -> bytes:
        """All that was written; nothing more can be."""
        # The shortest ending within the interval; the reader goes on with zeros.
        for kept in (24, 16, 8, 0):
            value = (self._low + (1 << kept) - 1) >> kept << kept
            if value < self._low + self._range:
                break
        for shift in range(32, -1, -8):
            self._bytes += b"\0" if shift == 32 else bytes([value >> shift & 0xFF])
            if shift == 32:
                self._bytes.pop()
                if value > _MASK:
                    self._carry()
        return bytes(self._bytes).rstrip(b"\0")

    def _gamma(self, value: int) -> None:
        length = value.bit_length()
        for _ in range(length - 1):
            self._even(1)
        self._even(0)
        for shift in range(length - 2, -1, -1):
            self._even(value >> shift & 1)

    def _even(self, bit: int) -> None:
        half = self._range >> 1
        self._narrow(bit, half)

    def _bit(self, bit: int, context: Hashable) -> None:
        bound = (self._range >> _BITS) * self._model.zero(context)
        self._narrow(bit, bound)
        self._model.learn(context, bit)

    def _narrow(self, bit: int, bound: int) -> None:
        if bit:
            self._low += bound
            self._range -= bound
        else:
            self._range = bound
        while self._range < _TOP:
            self._range = self._range << 8 & _MASK
            if self._low > _MASK:
                self._carry()
                self._low &= _MASK
            self._bytes.append(self._low >> 24)
            self._low = self._low << 8 & _MASK

    def _carry(self) -> None:
        at = len(self._bytes) - 1
        while self._bytes[at] == 0xFF:
            self._bytes[at] = 0
            at -= 1
        self._bytes[at] += 1


class Decoder:
    """Bytes in, numbers out, asked for in the order and the contexts in which they were written."""

    def __init__(self, data: bytes) -> None:
        self._model = _Model()
        self._data, self._at = data, 0
        self._range, self._code = _MASK, 0
        for _ in range(4):
            self._code = self._code << 8 | self._next()

    def number(self, context: Hashable) -> int:
        """The next number.

        Raises:
            FileFormatError: the bytes are no such numbers.
        """
        size = 0
        while size < _ESCAPE and self._bit((context, min(size, 4))):
            size += 1
        if size == _ESCAPE:
            size += self._gamma() - 1
        return -size if size and self._even() else size

    def _next(self) -> int:
        value = self._data[self._at] if self._at < len(self._data) else 0
        self._at += 1
        return value

    def _gamma(self) -> int:
        length = 1
        while self._even():
            length += 1
            if length > 40:
                raise FileFormatError(
                    "expected the curves of a compact face, got bytes that are damaged; take the "
                    "file from a backup or make it again"
                )
        value = 1
        for _ in range(length - 1):
            value = value << 1 | self._even()
        return value

    def _even(self) -> int:
        return self._narrow(self._range >> 1)

    def _bit(self, context: Hashable) -> int:
        bit = self._narrow((self._range >> _BITS) * self._model.zero(context))
        self._model.learn(context, bit)
        return bit

    def _narrow(self, bound: int) -> int:
        bit = int(self._code >= bound)
        if bit:
            self._code -= bound
            self._range -= bound
        else:
            self._range = bound
        while self._range < _TOP:
            self._range = self._range << 8 & _MASK
            self._code = (self._code << 8 | self._next()) & _MASK
        return bit
