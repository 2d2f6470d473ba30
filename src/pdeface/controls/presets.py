"""The expression presets of VRM 1.0 as weights of ARKit controls.

VRM names eighteen expressions that every program for avatars knows. Left and right are the
subject's, as ours. The five vowels are those of Japanese, and so are the visemes that speak them.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from pdeface.controls.naming import both_sides
from pdeface.controls.visemes import VISEMES

__all__ = ["VRM_PRESETS"]

_WEIGHTS: dict[str, Mapping[str, float]] = {
    # A smile that reaches the eyes: cheeks and lower lids rise with the corners of the mouth.
    "happy": both_sides(mouthSmile=0.75, mouthDimple=0.1, cheekSquint=0.5, eyeSquint=0.3),
    # Brows down and together, lower lids tense, lips pressed and drawn down, nose wrinkled.
    "angry": both_sides(
        browDown=0.9,
        eyeSquint=0.3,
        noseSneer=0.15,
        mouthFrown=0.25,
        mouthPress=0.6,
        mouthRollLower=0.1,
    ),
    # The inner ends of the brows up, corners of the mouth down, the chin raised, eyes lowered.
    "sad": both_sides(
        browInnerUp=0.75, mouthFrown=0.6, mouthShrugLower=0.3, eyeSquint=0.12, eyeLookDown=0.2
    ),
    # Lids half lowered over the beginning of a smile.
    "relaxed": both_sides(eyeBlink=0.25, mouthSmile=0.3, cheekSquint=0.12),
    # Brows and upper lids up, jaw dropped.
    "surprised": both_sides(
        browInnerUp=0.7, browOuterUp=0.8, eyeWide=0.75, jawOpen=0.35, mouthFunnel=0.12
    ),
    "aa": VISEMES["viseme_aa"],
    "ih": VISEMES["viseme_I"],
    "ou": VISEMES["viseme_U"],
    "ee": VISEMES["viseme_E"],
    "oh": VISEMES["viseme_O"],
    "blink": both_sides(eyeBlink=1.0),
    "blinkLeft": both_sides(eyeBlinkLeft=1.0),
    "blinkRight": both_sides(eyeBlinkRight=1.0),
    "lookUp": both_sides(eyeLookUp=1.0),
    "lookDown": both_sides(eyeLookDown=1.0),
    "lookLeft": both_sides(eyeLookOutLeft=1.0, eyeLookInRight=1.0),
    "lookRight": both_sides(eyeLookInLeft=1.0, eyeLookOutRight=1.0),
    "neutral": both_sides(),
}

VRM_PRESETS: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {name: MappingProxyType(dict(weights)) for name, weights in _WEIGHTS.items()}
)
"""Weights by ARKit name of each preset, by its name in the VRM 1.0 specification."""
