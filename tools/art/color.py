"""Palettes. Ramps are built in OKLab so that equal steps look equal; shadows lean to cool, highlights to warm."""
import numpy as np


def rgb(c):
    """'#aabbcc' or three numbers 0..255 as floats 0..1."""
    if isinstance(c, str):
        c = c.lstrip("#")
        return np.array([int(c[i:i + 2], 16) for i in (0, 2, 4)]) / 255
    c = np.asarray(c, float)
    return c / 255 if c.max() > 1 else c


def linear(c):
    return np.where(c <= .04045, c / 12.92, ((np.maximum(c, 0) + .055) / 1.055) ** 2.4)


def encode(c):
    c = np.clip(c, 0, 1)
    return np.where(c <= .0031308, c * 12.92, 1.055 * c ** (1 / 2.4) - .055)


M1 = np.array([[.4122214708, .5363325363, .0514459929], [.2119034982, .6806995451, .1073969566], [.0883024619, .2817188376, .6299787005]])
M2 = np.array([[.2104542553, .7936177850, -.0040720468], [1.9779984951, -2.4285922050, .4505937099], [.0259040371, .7827717662, -.8086757660]])


def to_lab(c):
    return np.cbrt(linear(np.asarray(c, float)) @ M1.T) @ M2.T


def from_lab(lab):
    return encode(((np.asarray(lab) @ np.linalg.inv(M2).T) ** 3) @ np.linalg.inv(M1).T)


COOL, WARM = np.array([-.10, -.99]), np.array([.25, .97])


def ramp(base, dark=.2, light=.15, n=7, shift=.014, chroma=1.):
    """n colors from shadow to highlight around base. dark, light: OKLab lightness below and above it."""
    lab = to_lab(rgb(base))
    lab[1:] *= chroma
    out = []
    for k in range(n):
        t = 2 * k / (n - 1) - 1
        c = lab.copy()
        c[0] += (light if t > 0 else dark) * t
        c[1:] *= 1 - .12 * abs(t)
        c[1:] += (WARM * t if t > 0 else COOL * -t) * shift
        out.append(from_lab(c))
    return np.array(out)


def gray(low=.42, high=.92, n=7):
    """A neutral ramp for textures that a tint multiplies."""
    v = np.linspace(low, high, n)
    return np.stack([v, v, v], -1)


def blend(*stops, n=8):
    """A ramp through given colors, evenly spaced, mixed in OKLab."""
    labs = np.array([to_lab(rgb(s)) for s in stops])
    t = np.linspace(0, len(stops) - 1, n)
    return from_lab(np.stack([np.interp(t, range(len(stops)), labs[:, k]) for k in range(3)], -1))


def mix(a, b, t):
    return from_lab(to_lab(rgb(a)) * (1 - t) + to_lab(rgb(b)) * t)


def lift(c, dl, chroma=1.):
    lab = to_lab(rgb(c))
    lab[0] += dl
    lab[1:] *= chroma
    return from_lab(lab)


def tint(r, color):
    """What a gray ramp becomes under a tint: for textures painted beforehand to match tinted ones."""
    return r * rgb(color)
