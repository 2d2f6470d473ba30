"""Triangles to pixels with PyVista, off screen.

On Linux VTK is told to use a driver without a screen (EGL), so that it draws the same with and
without a desktop. Where there is no OpenGL at all it does not raise, it crashes; so it is asked
for only after :func:`available` has found a driver that answers.
"""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pdeface.pictures.camera import Camera
from pdeface.pictures.solid import Solid

__all__ = ["Canvas", "available"]

Pixels = NDArray[np.uint8]

_POINTER = ctypes.c_void_p
_EGL_PLATFORM_DEVICE = 0x313F
_LINUX = sys.platform.startswith("linux")


@cache
def available() -> bool:
    """Whether PyVista is installed and there is an OpenGL driver that it can draw with.

    The environment variable ``PDEFACE_OPENGL=0`` says that there is none.
    """
    if os.environ.get("PDEFACE_OPENGL") == "0":
        return False
    try:
        import pyvista  # noqa: F401
    except ImportError:
        return False
    return _egl_answers() if _LINUX else True


@contextmanager
def _without_a_screen() -> Iterator[None]:
    """Let windows made in this block be VTK's EGL windows, and no others."""
    name = "VTK_DEFAULT_OPENGL_WINDOW"
    before = os.environ.get(name)
    if _LINUX:
        os.environ[name] = "vtkEGLRenderWindow"
    try:
        yield
    finally:
        if before is None:
            os.environ.pop(name, None)
        else:
            os.environ[name] = before


def _egl_answers() -> bool:
    """Whether libEGL is there and opens a display on the device that VTK takes: the first."""
    try:
        egl = ctypes.CDLL("libEGL.so.1")
        egl.eglGetProcAddress.restype = _POINTER
        egl.eglGetProcAddress.argtypes = [ctypes.c_char_p]
        devices_at = egl.eglGetProcAddress(b"eglQueryDevicesEXT")
        display_at = egl.eglGetProcAddress(b"eglGetPlatformDisplayEXT")
        egl.eglInitialize.argtypes = [_POINTER, _POINTER, _POINTER]
    except (OSError, AttributeError):
        return False
    if not devices_at or not display_at:
        return False
    devices = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_int, _POINTER, _POINTER)(devices_at)
    display = ctypes.CFUNCTYPE(_POINTER, ctypes.c_int, _POINTER, _POINTER)(display_at)
    found, count = (_POINTER * 1)(), ctypes.c_int()
    if not devices(1, ctypes.addressof(found), ctypes.addressof(count)) or not count.value:
        return False
    first = display(_EGL_PLATFORM_DEVICE, found[0], None)
    return bool(first) and bool(egl.eglInitialize(first, None, None))


class Canvas:
    """An off-screen plotter that is set up once and draws many pictures."""

    def __init__(self) -> None:
        import pyvista

        self._pyvista = pyvista
        with _without_a_screen():
            self._plotter = pyvista.Plotter(off_screen=True, lighting="none")
            window = self._plotter.render_window
        window.SetMultiSamples(4)
        window.SetAlphaBitPlanes(1)
        self._plotter.renderer.SetBackground(0.0, 0.0, 0.0)
        self._plotter.renderer.SetBackgroundAlpha(0.0)

    def draw(self, solids: Sequence[Solid], camera: Camera, size: tuple[int, int]) -> Pixels:
        """(H, W, 4) premultiplied red, green, blue and coverage, 0 to 255."""
        plotter = self._plotter
        plotter.clear_actors()
        plotter.window_size = list(size)
        for solid in solids:
            plotter.add_actor(self._actor(solid), render=False, reset_camera=False)
        self._aim(camera, solids)
        plotter.render_window.Render()
        return self._pixels(size)

    def _pixels(self, size: tuple[int, int]) -> Pixels:
        """What is in the window: unlike a screenshot, with its coverage exact at the edges."""
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

        width, height = size
        buffer = vtkUnsignedCharArray()
        self._plotter.render_window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, buffer)
        image: Pixels = vtk_to_numpy(buffer).reshape(height, width, 4)
        return image[::-1]

    def _aim(self, camera: Camera, solids: Sequence[Solid]) -> None:
        view = self._plotter.camera
        view.position = tuple(camera.position)
        view.focal_point = tuple(camera.target)
        view.up = tuple(camera.up)
        view.view_angle = camera.fov
        depth = np.concatenate(
            [-((s.vertices - camera.position) @ camera.backward) for s in solids]
        )
        near = max(float(depth.min()), 0.01 * camera.distance)
        view.clipping_range = (0.98 * near, 1.02 * max(float(depth.max()), near))

    def _actor(self, solid: Solid) -> Any:
        """A flat-lit actor: the light is in the colours already."""
        pv = self._pyvista
        mesh = pv.PolyData.from_regular_faces(solid.vertices, solid.triangles)
        mesh.point_data["colors"] = np.round(solid.colors * 255.0).astype(np.uint8)
        mapper = pv.DataSetMapper(mesh)
        mapper.SetColorModeToDirectScalars()
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("colors")
        actor = pv.Actor(mapper=mapper)
        actor.prop.lighting = False
        actor.prop.culling = "back"
        if solid.texture is not None and solid.texcoords is not None:
            mesh.active_texture_coordinates = solid.texcoords * [1.0, -1.0] + [0.0, 1.0]
            actor.texture = self._texture(solid.texture)
        return actor

    def _texture(self, image: NDArray[np.uint8]) -> Any:
        texture = self._pyvista.Texture(np.ascontiguousarray(image))
        texture.SetMipmap(True)
        texture.SetInterpolate(True)
        texture.SetMaximumAnisotropicFiltering(8.0)
        texture.SetWrap(texture.ClampToEdge)
        return texture
