"""One texture and its maps, and the registry of painters."""
import os
import zlib

import numpy as np
from PIL import Image

from noise import N, X, Y, clean, roll

REGISTRY = {}


def add(name, painter, *args, **kw):
    """Registers painter(name, *args, **kw) -> Tex or list of Tex (frames)."""
    if name in REGISTRY:
        raise ValueError("painted twice: " + name)
    REGISTRY[name] = (painter, args, kw)


def paint(name):
    painter, args, kw = REGISTRY[name]
    return painter(name, *args, **kw)


class Tex:
    """rgb, a, e: 0..1; h: height in pixels; r: roughness 0..1."""

    def __init__(self, name, rough=.85):
        self.name = name
        self.rgb = np.zeros((N, N, 3))
        self.a = np.ones((N, N))
        self.h = np.zeros((N, N))
        self.r = np.full((N, N), float(rough))
        self.e = None
        self.wrap = True
        self.bump = .75  # how steep the normals are; fine structure needs less, or it glitters

    def copy(self, name=None):
        t = Tex(name or self.name)
        t.rgb, t.a, t.h, t.r, t.wrap = self.rgb.copy(), self.a.copy(), self.h.copy(), self.r.copy(), self.wrap
        t.e = None if self.e is None else self.e.copy()
        return t

    def fill(self, t, ramp, passes=1):
        """Colors the whole tile from a 0..1 field, in whole steps of the ramp."""
        idx = np.clip((t * len(ramp)).astype(int), 0, len(ramp) - 1)
        self.rgb = ramp[clean(idx, passes)].copy()
        return self

    def put(self, mask, color, h=None, r=None, e=None, a=1.):
        """Lays a color (or one color a pixel) where mask is set."""
        mask = np.asarray(mask, bool)
        color = np.asarray(color, float)
        self.rgb[mask] = color[mask] if color.ndim == 3 else color
        self.a[mask] = a
        if h is not None:
            self.h[mask] = h[mask] if isinstance(h, np.ndarray) else h
        if r is not None:
            self.r[mask] = r
        if e is not None:
            self.glow(mask, e)
        return self

    def shade(self, mask, ramp, t, **kw):
        idx = np.clip((t * len(ramp)).astype(int), 0, len(ramp) - 1)
        return self.put(mask, ramp[idx], **kw)

    def glow(self, mask, strength=1., color=None):
        if self.e is None:
            self.e = np.zeros((N, N, 3))
        c = self.rgb if color is None else np.broadcast_to(color, (N, N, 3))
        self.e[mask] = (c * strength)[mask]
        return self

    def empty(self):
        self.a[:] = 0
        self.wrap = False
        return self

    def light(self, amount):
        """Multiplies the color by 1 + amount, a field or a number."""
        self.rgb = np.clip(self.rgb * (1 + np.asarray(amount))[..., None], 0, 1)
        return self

    def bevel(self, mask, up=.16, down=.16):
        """A lit upper left and a shaded lower right rim just inside a mask."""
        m = np.asarray(mask, bool)
        rim = (m & ~roll(m, 0, -1)) * -down + (m & ~roll(m, 0, 1)) * up
        rim = rim + (m & ~roll(m, -1, 0) & (rim == 0)) * -down * .6 + (m & ~roll(m, 1, 0) & (rim == 0)) * up * .6
        return self.light(rim)

    def maps(self):
        alpha = np.round(self.a * 255).astype(np.uint8)
        color = self.rgb.copy()
        if (alpha == 0).any() and (alpha > 0).any():
            # Mipmaps mix in what lies under clear pixels: give them the sprite's own mean.
            color[alpha == 0] = color[alpha > 0].mean(0)
        rgba = np.dstack([np.round(np.clip(color, 0, 1) * 255).astype(np.uint8), alpha])
        h = self.h * self.bump
        if self.wrap:
            dx, dy = (roll(h, -1, 0) - roll(h, 1, 0)) / 2, (roll(h, 0, -1) - roll(h, 0, 1)) / 2
        else:
            p = np.pad(h, 1, mode="edge")
            dx, dy = (p[1:-1, 2:] - p[1:-1, :-2]) / 2, (p[2:, 1:-1] - p[:-2, 1:-1]) / 2
        # Rows grow downward and +Y of the map is up, so the y part keeps its sign.
        n = np.dstack([-dx, dy, np.ones_like(h)])
        n /= np.linalg.norm(n, axis=-1, keepdims=True)
        # Whole steps of 3 cost nothing to the eye and halve the file.
        n8 = np.clip(np.round(n * 127.5 / 3) * 3 + 128, 0, 255).astype(np.uint8)
        r8 = np.clip(np.round(self.r * 64) * 4, 0, 255).astype(np.uint8)
        e8 = None if self.e is None else np.round(np.clip(self.e, 0, 1) * 255).astype(np.uint8)
        return rgba, n8, r8, e8


def stacked(result):
    """The maps of a texture or of a strip of frames, frames below each other."""
    frames = result if isinstance(result, list) else [result]
    maps = [f.maps() for f in frames]
    out = []
    for k in range(4):
        parts = [m[k] for m in maps]
        if all(p is None for p in parts):
            out.append(None)
            continue
        out.append(np.concatenate([np.zeros((N, N, 3), np.uint8) if p is None else p for p in parts], 0))
    return out


def save(name, result, folder):
    written = []
    for suffix, data in zip(("", "_n", "_r", "_e"), stacked(result)):
        if data is None:
            continue
        path = os.path.join(folder, name + suffix + ".png")
        Image.fromarray(data).save(path, compress_level=9)
        written.append(name + suffix + ".png")
    return written


def seed(name):
    return zlib.crc32(name.encode())


__all__ = ["add", "paint", "Tex", "REGISTRY", "save", "seed", "N", "X", "Y", "stacked"]
