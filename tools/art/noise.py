"""Seeded fields on a 32 x 32 torus. Everything here wraps, so every texture tiles."""
import zlib

import numpy as np

N = 32
Y, X = np.mgrid[0:N, 0:N].astype(float)


def rng(name):
    """A generator that depends on the name alone: a texture never changes because another one did."""
    return np.random.default_rng(zlib.crc32(name.encode()))


def smooth(t):
    return t * t * (3 - 2 * t)


def ss(a, b, x):
    return smooth(np.clip((x - a) / (b - a), 0, 1))


def value(name, cx, cy, x=None, y=None, n=N):
    """Value noise with cx by cy lattice cells over the tile, -1..1; x, y may be warped coordinates."""
    lattice = rng(name).uniform(-1, 1, (cy, cx))
    x = X if x is None else x
    y = Y if y is None else y
    u, v = x * cx / n, y * cy / n
    i, j = np.floor(u).astype(int), np.floor(v).astype(int)
    fu, fv = smooth(u - i), smooth(v - j)
    a, b = lattice[j % cy, i % cx], lattice[j % cy, (i + 1) % cx]
    c, d = lattice[(j + 1) % cy, i % cx], lattice[(j + 1) % cy, (i + 1) % cx]
    return (a * (1 - fu) + b * fu) * (1 - fv) + (c * (1 - fu) + d * fu) * fv


def fbm(name, cx, cy, octaves=3, x=None, y=None):
    out, amp, total = 0, 1.0, 0
    for k in range(octaves):
        out = out + amp * value(f"{name}/{k}", cx << k, cy << k, x, y)
        total += amp
        amp *= .5
    return out / total


def loop(name, cx, cy, frames, x=None, y=None):
    """Value noise that moves and comes back after `frames` frames: a walk around a circle between fields."""
    fields = [value(f"{name}/loop{k}", cx, cy, x, y) for k in range(4)]
    out = []
    for f in range(frames):
        a = 2 * np.pi * f / frames
        c, s = np.cos(a), np.sin(a)
        w = [max(c, 0), max(s, 0), max(-c, 0), max(-s, 0)]
        out.append(sum(k * g for k, g in zip(w, fields)) / np.sqrt(c * c + s * s))
    return out


def points(name, nx, ny, jitter=.8, brick=True):
    """Jittered grid points in pixels; brick shifts odd rows by half a cell."""
    r = rng(name + "/pts")
    out = []
    for j in range(ny):
        for i in range(nx):
            dx, dy = r.uniform(-.5, .5, 2) * jitter
            out.append(((i + .5 + dx + (.5 * (j & 1) if brick else 0)) * N / nx, (j + .5 + dy) * N / ny))
    return np.array(out) % N


def wrap(d):
    return (d + N / 2) % N - N / 2


class Cells:
    """Worley cells: f1, f2, edge distance, id, second id and the vector from the cell's center."""

    def __init__(self, pts, sx=1., sy=1., power=2., x=None, y=None):
        x = X if x is None else x
        y = Y if y is None else y
        dx = wrap(x[..., None] - pts[:, 0])
        dy = wrap(y[..., None] - pts[:, 1])
        d = (np.abs(dx * sx) ** power + np.abs(dy * sy) ** power) ** (1 / power)
        order = np.argsort(d, axis=-1, kind="stable")
        self.id, self.id2 = order[..., 0], order[..., 1]

        def take(a, k):
            return np.take_along_axis(a, order[..., k:k + 1], -1)[..., 0]
        self.f1, self.f2 = take(d, 0), take(d, 1)
        self.edge = (self.f2 - self.f1) / 2
        self.vx, self.vy = take(dx, 0), take(dy, 0)
        self.count = len(pts)

    def per(self, name, low=0., high=1.):
        return rng(name + "/per").uniform(low, high, self.count)[self.id]

    def pair(self, name):
        """A number 0..1 for each border between two cells."""
        table = rng(name + "/pair").uniform(0, 1, (self.count, self.count))
        return table[np.minimum(self.id, self.id2), np.maximum(self.id, self.id2)]


class Grid:
    """Bricks: id, distances to the four sides of the brick, its size. rows is a list of (height, width, shift)."""

    def __init__(self, rows):
        self.id = np.zeros((N, N), int)
        self.left, self.right, self.top, self.bottom = (np.zeros((N, N)) for _ in range(4))
        y, count = 0, 0
        for height, width, shift in rows:
            for k in range(height):
                for x in range(N):
                    u = (x - shift) % N
                    self.id[y + k, x] = count + u // width
                    self.left[y + k, x], self.right[y + k, x] = u % width, width - 1 - u % width
                    self.top[y + k, x], self.bottom[y + k, x] = k, height - 1 - k
            y += height
            count += -(-N // width)
        self.count = count
        self.edge = np.minimum(np.minimum(self.left, self.right), np.minimum(self.top, self.bottom))

    def per(self, name, low=0., high=1.):
        return rng(name + "/per").uniform(low, high, self.count)[self.id]


def roll(a, dx, dy):
    return np.roll(np.roll(a, dx, 1), dy, 0)


def blur(a, times=1):
    for _ in range(times):
        a = (4 * a + roll(a, 1, 0) + roll(a, -1, 0) + roll(a, 0, 1) + roll(a, 0, -1)) / 8
    return a


def clean(idx, passes=2):
    """Joins single pixels to their surroundings: pixel art is made of clusters, not of static."""
    idx = idx.copy()
    for _ in range(passes):
        near = np.stack([roll(idx, 1, 0), roll(idx, -1, 0), roll(idx, 0, 1), roll(idx, 0, -1)])
        alone = (near != idx).sum(0) >= 4
        idx = np.where(alone, np.sort(near, 0)[1], idx)
    return idx
