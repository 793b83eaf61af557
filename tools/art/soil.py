"""Loose ground: earth, sand, snow, moss, and the grass that grows on it."""
import numpy as np

from color import blend, gray, lift, mix, ramp, rgb, tint
from noise import X, Y, Cells, blur, clean, fbm, points, rng, roll, ss, value, wrap
from stone import cobble
from tex import Tex, add

DIRT = "#7c5638"
PLAINS = (118, 170, 72)
GRASS = gray(.46, .98, 8)


def pebbles(t, name, color, count, size=(1.3, 2.4)):
    r = rng(name + "/peb")
    rr = ramp(color, .14, .14, 5)
    for _ in range(count):
        x, y = r.uniform(0, 32, 2)
        a, b = r.uniform(*size), r.uniform(*size) * .8
        dx, dy = wrap(X - x), wrap(Y - y)
        d = (dx / a) ** 2 + (dy / b) ** 2
        m = d < 1
        t.put(roll(m, 1, 1) & ~m, t.rgb * .72)
        t.shade(m, rr, np.clip(.55 - .22 * (dx + dy) / a, 0, .99))
        t.h[m] += (1.5 * np.sqrt(1 - np.clip(d, 0, 1)))[m]
    return t


def dirt(name, base=DIRT, stones=4, stone="#85705a", cells=6, rough=.95, dark=.17, light=.13, seed=None):
    """Clods of earth pressed together, with a few pebbles."""
    t = Tex(name, rough)
    s = seed or name
    wx, wy = X + 1.3 * fbm(s + "/wx", 6, 6, 2), Y + 1.3 * fbm(s + "/wy", 6, 6, 2)
    c = Cells(points(s, cells, cells, .95), x=wx, y=wy)
    small = Cells(points(s + "/s", 12, 12, .9))
    f = .5 + c.per(s, -.14, .14) - .020 * (c.vx + c.vy) + small.per(s + "/sm", -.13, .13) - .24 * (c.edge < .5) * (c.pair(s) < .6)
    t.fill(f, ramp(base, dark, light, 7), 2)
    t.h = 1.6 * ss(0, 2.5, c.edge) + small.per(s + "/sm", 0, .6)
    return pebbles(t, s, stone, stones)


def blades(t, name, ramp_, count=190, length=(3, 6), lean=.8, curl=0., mask=None):
    """Short strokes laid over each other, dark at the root and light at the tip, the nearest last."""
    r = rng(name + "/blades")
    t.h[:] = 0
    t.bump = .4
    n = len(ramp_)
    order = np.linspace(0, 1, count)
    for k in range(count):
        x, y = r.uniform(0, 32, 2)
        size = r.uniform(*length)
        dx = r.uniform(-lean, lean)
        tone = .16 + .5 * order[k] + r.uniform(-.14, .14)
        steps = int(size * 1.5)
        for j in range(steps):
            u = j / max(steps - 1, 1)
            px, py = int(np.floor(x + dx * size * u + curl * u * u)) % 32, int(np.floor(y - size * u)) % 32
            if mask is not None and not mask[py, px]:
                continue
            v = np.clip(tone - .22 + .42 * u, 0, .999)
            t.rgb[py, px] = ramp_[int(v * n)]
            t.h[py, px] = .5 + 1.5 * order[k] + u * .8
    return t


def grass_top(name, ramp_=GRASS, count=260, lean=.55, length=(3, 5.5)):
    t = Tex(name, .9)
    t.fill(.22 + .12 * fbm(name, 6, 6, 2), ramp_)
    return blades(t, name, ramp_, count, length, lean)


def fringe(name, top_ramp, under="dirt", depth=(4, 9), ragged=True, stems=34, seed="fringe"):
    """A dirt side with the surface hanging over its upper edge."""
    painter, args, kw = SOILS[under] if under in SOILS else (None, None, None)
    t = painter(under, *args, **kw)
    r = rng(seed)
    deep = np.zeros(32)
    for k in range(stems):
        x = r.integers(0, 32)
        deep[x] = max(deep[x], r.uniform(*depth))
    deep = np.maximum(deep, depth[0] - 1 + 1.5 * value(seed, 8, 1)[0])
    cover = Y < deep[None, :]
    n = len(top_ramp)
    f = .80 - .055 * Y + .16 * fbm(seed + "/f", 16, 5, 1)
    shadow = roll(cover, 0, 2) & ~cover & (Y < 14)
    t.rgb[shadow] *= .68
    t.shade(cover, top_ramp, np.clip(f, 0, .999), r=.9)
    tip = cover & ~roll(cover, 0, -1) & (Y > 1)
    t.shade(tip, top_ramp, np.clip(f - .08, 0, .999))
    lone = cover & (roll(~cover, 1, 0) | roll(~cover, -1, 0))
    t.shade(lone & (Y > 2), top_ramp, np.clip(f + .12, 0, .999))
    t.h = np.where(cover, 2.6 - .05 * Y, t.h * .6)
    t.wrap = True
    return t


def sand(name, base, ripples=True, rough=.95, dark=.10, light=.07, waves=3, grain=.12):
    """Wind ripples with a lit and a lee side, and grains gathered in short runs."""
    t = Tex(name, rough)
    u = Y + 2.2 * fbm(name + "/w", 3, 2, 2) + X * 0
    phase = (u / 32 * waves) % 1
    wave = np.where(phase < .65, phase / .65, (1 - phase) / .35)
    strength = .5 + .5 * value(name + "/st", 3, 3)
    g = value(name + "/g1", 16, 16) * .6 + value(name + "/g2", 11, 22) * .5
    f = .56 + grain * g + (ripples * .30 * strength * (wave - .5))
    t.fill(f, ramp(base, dark, light, 7))
    t.h = 1.3 * wave * strength * ripples + .25 * g
    return t


def gravel(name, stones=("#857f7c", "#77716f", "#98908a", "#6d6a70", "#8d7868"), seed=None):
    t = Tex(name, .92)
    s = seed or name
    wx, wy = X + .6 * fbm(s + "/x", 8, 8, 1), Y + .6 * fbm(s + "/y", 8, 8, 1)
    c = Cells(points(s, 6, 7, .95), x=wx, y=wy)
    f = .5 + .16 * ss(0, 2, c.edge) - .05 * (c.vx + 1.4 * c.vy) + .1 * fbm(s, 10, 10, 1) + c.per(s + "/t", -.12, .12)
    kind = np.floor(c.per(s + "/k", 0, len(stones) - .001)).astype(int)
    for k, col in enumerate(stones):
        t.shade(kind == k, ramp(col, .18, .14, 7), np.clip(f, 0, .99))
    m = c.edge < .5
    t.put(m, rgb("#3f3a3c"))
    t.put(m & (roll(c.edge, 1, 1) > 1), rgb("#4d4748"))
    t.h = 2.2 * ss(0, 2.2, c.edge) + c.per(s + "/h", 0, .7)
    return t


def snow(name, base="#eef3fa", lumps=3, sparkle=9):
    t = Tex(name, .7)
    d = fbm(name, lumps, lumps, 2)
    relief = d - roll(d, 2, 2)
    t.fill(.62 + 1.3 * relief + .05 * value(name + "/g", 12, 12), blend("#c9d8ee", "#dbe6f5", "#e9f0fa", "#f3f7fc", "#fbfdff", n=6), 2)
    r = rng(name)
    for _ in range(sparkle):
        x, y = r.integers(0, 32, 2)
        t.rgb[y, x] = (1, 1, 1)
        t.r[y, x] = .2
    t.h = 2.4 * d
    return t


def ice(name, base, cracks, alpha=1., rough=.12, dark=.1, light=.12):
    t = Tex(name, rough)
    wx, wy = X + 3 * fbm(name + "/x", 3, 3, 2), Y + 3 * fbm(name + "/y", 3, 3, 2)
    t.fill(.5 + .3 * fbm(name, 3, 3, 2, wx, wy), ramp(base, dark, light, 6), 2)
    c = Cells(points(name, 3, 3, .95), x=wx, y=wy)
    m = (c.edge < .5) & (c.pair(name) < .6)
    t.put(m, lift(base, .13))
    t.put(roll(m, 1, 1) & ~m, t.rgb * .93)
    streak = (np.abs(((X + Y) % 16) - 4) < 1.1) & (value(name + "/s", 4, 4) > .15)
    t.put(streak & ~m, lift(base, .09))
    t.h = .25 * fbm(name, 3, 3, 2) - .5 * m
    t.a[:] = alpha
    if alpha < 1:
        t.a[m | streak] = min(1, alpha + .15)
    return t


def lumps(name, base, cells=4, rough=.8, dark=.1, light=.08, wet=0., streak=.0):
    """Clay and mud: smooth pressed lumps."""
    t = Tex(name, rough)
    wx, wy = X + 3 * fbm(name + "/x", 3, 3, 2), Y + 2 * fbm(name + "/y", 3, 3, 2)
    d = fbm(name, cells, cells, 2, wx, wy)
    rel = d - roll(d, 1, 1)
    t.fill(.5 + .22 * d + 1.0 * rel + streak * fbm(name + "/st", 3, 12, 1), ramp(base, dark, light, 7), 2)
    t.h = 1.6 * d
    if wet:
        glint = (rel > .10) & (value(name + "/w", 6, 6) > .1)
        t.put(glint, lift(base, .16))
        t.r[d < -.05] = .25
    return t


def moss(name, base="#5f7f36", light="#93ab4e"):
    t = Tex(name, .95)
    c = Cells(points(name, 8, 8, .9))
    f = .5 + c.per(name, -.26, .26) - .05 * (c.vx + 1.3 * c.vy) - .12 * (c.edge < .5) + .16 * fbm(name + "/b", 4, 4, 2)
    t.fill(f, blend(lift(base, -.18), base, mix(base, light, .6), light, n=8))
    t.h = 1.4 * ss(0, 2, c.edge) + .8 * fbm(name + "/b", 4, 4, 2)
    return t


def podzol(name):
    t = dirt(name, "#6b4a2c", 0)
    return blades(t, name, blend("#4a3019", "#6e4a24", "#8f6531", "#b58a4a", n=7), 120, (2, 5), 2.2)


def farmland(name, wet):
    t = dirt("dirt", "#5a3d29" if wet else "#80593a", 3)
    wave = np.sin(X / 32 * 2 * np.pi * 4)
    t.light(.22 * wave)
    t.h += 1.6 * wave
    if wet:
        t.r[:] = .55
    return t


def path(name):
    t = dirt(name, "#a08148", 3, "#a98f5c", 6, dark=.1, light=.08)
    return t


def roots_in(name, base, root):
    t = dirt("dirt", base, 2)
    r = rng(name)
    rr = ramp(root, .12, .14, 5)
    for _ in range(7):
        x, y, a = r.uniform(0, 32), r.uniform(0, 32), r.uniform(0, 6.28)
        for k in range(int(r.integers(9, 18))):
            px, py = int(x) % 32, int(y) % 32
            t.rgb[(py + 1) % 32, px] *= .7
            t.rgb[py, px] = rr[2 + int(r.random() < .5) + (k % 5 == 0)]
            t.h[py, px] += 1.2
            a += r.normal(0, .35)
            x, y = x + np.cos(a), y + np.sin(a)
    return t


def suspicious(name, of):
    painter, args, kw = SOILS[of]
    t = painter(of, *args, **kw)
    m = np.hypot(wrap(X - 15), wrap(Y - 17)) + 2 * fbm(name, 6, 6, 2) < 6.5
    t.put(m, t.rgb * .84)
    t.put(roll(m, 1, 1) & ~m, np.clip(t.rgb * 1.08, 0, 1))
    t.h[m] -= 1.2
    return t


MYCEL = blend("#4d4450", "#6a5d6c", "#857687", "#a393a2", "#c3b2bd", n=8)
SOILS = {
    "dirt": (dirt, (), {}),
    "coarse_dirt": (dirt, ("#75553b", 13), {}),
    "sand": (sand, ("#e2d5a4",), {}),
    "red_sand": (sand, ("#b9683a",), {}),
    "smooth_sand": (sand, ("#efe2bd", False), dict(dark=.05, light=.04)),
    "gravel": (gravel, (), {}),
    "clay": (lumps, ("#a1a8b5",), {}),
    "mud": (lumps, ("#4b4244",), dict(wet=1., rough=.5)),
    "packed_mud": (lumps, ("#8e6c50",), dict(streak=.2, rough=.9)),
    "netherrack": (dirt, ("#6e2a2b", 0), dict(cells=7, dark=.15, light=.14)),
}
for _n, (_p, _a, _k) in SOILS.items():
    if _n != "netherrack":
        add(_n, _p, *_a, **_k)
add("rooted_dirt", roots_in, DIRT, "#a98863")
add("suspicious_sand", suspicious, "sand")
add("suspicious_gravel", suspicious, "gravel")
add("grass_block_top", grass_top)
add("grass_block_side", fringe, tint(GRASS, PLAINS))
add("jungle_grass_block_side", fringe, tint(GRASS, (74, 160, 48)), depth=(5, 11))
add("savanna_grass_block_side", fringe, tint(GRASS, (186, 168, 84)))
add("grass_block_snow", fringe, blend("#c9d8ee", "#e2ebf7", "#f6f9fd", "#ffffff", n=8), depth=(5, 8), stems=12, seed="snowy")
add("podzol_top", podzol)
add("podzol_side", fringe, blend("#4a3019", "#7a5228", "#a87c40", n=8), depth=(3, 6))
add("mycelium_top", lambda name: blades(dirt(name, "#6d606f", 0), name, MYCEL, 120, (1.5, 3.5), 1.4))
add("mycelium_side", fringe, MYCEL, depth=(3, 8))
add("dirt_path_top", path)
add("dirt_path_side", fringe, ramp("#a08148", .1, .08, 8), depth=(3, 5), stems=10, seed="path")
add("farmland", farmland, False)
add("farmland_moist", farmland, True)
add("snow", snow)
add("powder_snow", snow, lumps=5, sparkle=16)
add("ice", ice, "#8fb8f0", True, .66)
add("packed_ice", ice, "#8cb2ee", True)
add("blue_ice", ice, "#6aa2f2", True)
add("moss_block", moss)
add("pale_moss_block", moss, "#6b716b", "#9ba39a")
add("warped_nylium", lambda name: blades(dirt("netherrack", "#2c5f5e", 0), name, blend("#123c40", "#176e68", "#1f9a86", "#4fc9a6", n=8), 150, (2, 4), 1.2))
add("crimson_nylium", lambda name: blades(dirt("netherrack", "#6a1f25", 0), name, blend("#3d0d16", "#781420", "#a8202a", "#d1453c", n=8), 150, (2, 4), 1.2))
add("warped_nylium_side", fringe, blend("#123c40", "#176e68", "#1f9a86", "#4fc9a6", n=8), "netherrack", (4, 10))
add("crimson_nylium_side", fringe, blend("#3d0d16", "#781420", "#a8202a", "#d1453c", n=8), "netherrack", (4, 10))
add("netherrack", dirt, "#6e2a2b", 0, cells=7, dark=.15, light=.14)
