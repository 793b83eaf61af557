"""Bark, rings and planks for every wood."""
import numpy as np

from color import blend, lift, mix, ramp, rgb
from noise import N, X, Y, Cells, Grid, fbm, points, rng, roll, ss, value, wrap
from tex import Tex, add

# wood: planks, bark, inner bark tone of cut ends, bark style, accent
WOODS = {
    "oak": ("#b08a52", "#6b5232", "ridge", None),
    "spruce": ("#7c5a37", "#3f2c1c", "scale", None),
    "birch": ("#d3bf8c", "#d9d6cd", "birch", "#2f2c2c"),
    "jungle": ("#b0805c", "#5c4a22", "ridge", "#6c7a32"),
    "acacia": ("#b5623a", "#6e665c", "ridge", None),
    "dark_oak": ("#4d3320", "#352817", "ridge", None),
    "mangrove": ("#7b3a37", "#5a4631", "scale", "#6d6a36"),
    "cherry": ("#e3b4ac", "#3c2430", "band", "#5a3848"),
    "pale_oak": ("#e4dad6", "#57504c", "ridge", None),
    "crimson": ("#7c3653", "#5c1a24", "fungus", "#c2342e"),
    "warped": ("#33827e", "#3b2d47", "fungus", "#1fa88e"),
    "amber": ("#c48a3c", "#4e3426", "fungus", "#f2a52c"),
    "redwood": ("#a4563c", "#7a3e2a", "fibre", None),
    "palm": ("#c49a66", "#8f7350", "ring", None),
    "cypress": ("#9c8560", "#766a5c", "fibre", None),
}


def bark(name, base, style, accent):
    t = Tex(name, .92)
    s = name
    if style in ("ridge", "fibre", "fungus"):
        count = {"ridge": 7, "fibre": 9, "fungus": 6}[style]
        w = X + {"ridge": 1.5, "fibre": .8, "fungus": 2.2}[style] * fbm(s + "/w", 4, 3 if style != "fibre" else 2, 2)
        u = (w / N * count) % 1
        col = np.floor(w / N * count).astype(int) % count
        tone = rng(s).uniform(-.12, .12, count)[col]
        seam = np.minimum(u, 1 - u)
        # Ridges break across at their own heights, which keeps bark from looking like cloth.
        shift = rng(s + "/sh").uniform(0, N, count)[col]
        step = rng(s + "/st").integers(2, 4, count)[col]
        across = ((Y + shift) * step / N) % 1
        broken = (across < .06 * step / 2 + .03) & (seam > .12) & (style != "fibre")
        f = .52 + tone + .34 * (seam - .25) - .14 * (u - .5) + .14 * fbm(s + "/g", 8, 4, 2) - .26 * broken + .1 * (roll(broken, 0, 1) & ~broken)
        gap = seam < .11
        f -= .24 * gap
        t.fill(np.clip(f, 0, .99), ramp(base, .17, .15, 8), 1)
        t.h = 2.6 * np.sqrt(np.clip(seam * 2, 0, 1)) - 1.0 * broken
        if style == "fungus":
            vein = (np.abs(fbm(s + "/v", 3, 4, 2, w, Y * 1.0)) < .05)
            rr = ramp(accent, .2, .16, 6)
            t.shade(vein, rr, np.clip(.5 + .6 * fbm(s + "/vv", 4, 4, 2), 0, .99))
            t.put(roll(vein, 1, 1) & ~vein, t.rgb * .75)
            t.glow(vein, .35)
        elif accent:
            m = (fbm(s + "/moss", 4, 4, 2) > .28) & ~gap
            t.shade(m, ramp(accent, .12, .12, 6), np.clip(f + .05, 0, .99))
    elif style == "scale":
        wx = X + .7 * fbm(s + "/w", 5, 5, 2)
        c = Cells(points(s, 5, 4, .9), sx=1.0, sy=.62, x=wx)
        f = .5 + c.per(s, -.16, .16) - .04 * (c.vx + .7 * c.vy) - .3 * (c.edge < .55) + .1 * fbm(s + "/g", 9, 6, 2)
        t.fill(np.clip(f, 0, .99), ramp(base, .16, .15, 8))
        t.h = 2.2 * ss(0, 2, c.edge)
        if accent:
            m = (fbm(s + "/moss", 4, 4, 2) > .25) & (c.edge > .5)
            t.shade(m, ramp(accent, .12, .12, 6), np.clip(f, 0, .99))
    elif style == "birch":
        t.fill(.62 + .16 * fbm(s + "/g", 3, 8, 2) + .1 * np.cos((X - 13) / N * 2 * np.pi), ramp(base, .16, .06, 7))
        r = rng(s)
        dark = ramp(accent, .05, .2, 5)
        for k in range(13):
            x, y, w = r.integers(0, N), int(k * N / 13 + r.uniform(0, 2)), int(r.integers(2, 9))
            for j in range(w):
                px = (x + j) % N
                t.rgb[y % N, px] = dark[1 if 0 < j < w - 1 else 3]
                t.h[y % N, px] = -.8
                if w > 5 and 1 < j < w - 2:
                    t.rgb[(y + 1) % N, px] = dark[2]
                else:
                    t.rgb[(y + 1) % N, px] *= .93
        t.r[:] = .75
    elif style == "band":
        w = Y + 1.6 * fbm(s + "/w", 3, 3, 2)
        u = (w / N * 6) % 1
        f = .5 + .2 * np.sin(u * 2 * np.pi) + .16 * fbm(s + "/g", 4, 12, 2)
        t.fill(np.clip(f, 0, .99), ramp(base, .12, .14, 7))
        band = (value(s + "/b", 4, 9) > .38)
        t.shade(band, ramp(accent, .08, .12, 5), np.clip(f, 0, .99))
        t.h = np.sin(u * 2 * np.pi) * .8 + band * .5
    elif style == "ring":
        w = Y + 1.0 * np.sin(X / N * 4 * np.pi) + .6 * fbm(s + "/w", 5, 3, 2)
        u = (w / N * 5) % 1
        f = .66 - .38 * u + .14 * fbm(s + "/g", 14, 3, 2)
        lip = u < .14
        t.fill(np.clip(f + .12 * lip, 0, .99), ramp(base, .18, .13, 8))
        t.h = 2.2 * (1 - u)
    return t


def grain_field(name, turn=False, stretch=3):
    """Long wavering fibers along x (or along y when turned)."""
    wy = Y + 1.3 * fbm(name + "/w", 3, 4, 2)
    f = .65 * value(name + "/f", stretch, 20, X, wy) + .35 * value(name + "/ff", stretch * 2, 32, X, wy)
    return f.T if turn else f


def planks(name, base, dark=.13, light=.09, rows=((0, 8), (8, 8), (16, 8), (24, 8))):
    t = Tex(name, .7)
    r = rng(name)
    f = np.full((N, N), .56)
    tones = r.permutation([-.09, .01, .07, -.03])
    seam = np.zeros((N, N), bool)
    nails = []
    t.h[:] = 1.5
    for k, (y0, hgt) in enumerate(rows):
        rows_ = slice(y0, y0 + hgt)
        g = grain_field(f"{name}/{k}")
        f[rows_] += tones[k % 4] + .30 * g[rows_]
        # A knot now and then, with the fibers bending round it.
        if r.random() < .5:
            kx, ky = r.uniform(4, 28), y0 + 3.2
            d = np.hypot(wrap(X - kx) * .62, (Y - ky))
            f[rows_] += (-.26 * np.exp(-(d / 1.1) ** 2) + .10 * np.cos(d * 2.2) * np.exp(-(d / 3.4) ** 2))[rows_]
        joint = int((5 + 13 * k + r.integers(0, 5)) % N)
        seam[y0:y0 + hgt - 1, joint] = True
        f[rows_, (joint + 1) % N] += .07
        t.h[rows_, joint] = .4
        nails += [((joint + 2) % N, y0 + 2), ((joint + 2) % N, y0 + hgt - 4), ((joint - 2) % N, y0 + 2), ((joint - 2) % N, y0 + hgt - 4)]
        f[y0] += .13
        f[y0 + hgt - 2] -= .05
        f[y0 + hgt - 1] -= .42
        t.h[y0 + hgt - 1] = 0
        t.h[y0] -= .15
    f[seam] -= .34
    rr = ramp(base, dark, light, 9)
    t.fill(np.clip(f, 0, .99), rr)
    t.h += .25 * grain_field(name + "/0")
    for x, y in nails:
        t.rgb[y, x] = rr[0] * .8
        t.rgb[y, (x - 1) % N] = rr[8]
        t.h[y, x] += .5
        t.r[y, x] = .4
    return t


def cut_end(name, wood_color, bark_of, rings=5.2, border=3):
    """A cut end: growth rings inside a rim of bark."""
    t = Tex(name, .75)
    cx, cy = X - 15.5 + .7 * fbm(name + "/x", 4, 4, 2), Y - 15.5 + .7 * fbm(name + "/y", 4, 4, 2)
    cheb, euc = np.maximum(abs(cx), abs(cy)), np.hypot(cx, cy)
    blend_ = np.clip(euc / 15, 0, 1)
    d = euc * (1 - .75 * blend_) + cheb * .75 * blend_
    d = d + .5 * fbm(name + "/r", 4, 4, 2)
    u = (d / 15.5 * rings) % 1
    f = .62 + .22 * np.cos(u * 2 * np.pi) - .12 * (d < 2) + .05 * fbm(name + "/g", 8, 8, 1)
    angle = np.arctan2(cy, cx)
    r = rng(name)
    for _ in range(3):
        a, reach = r.uniform(-np.pi, np.pi), r.uniform(6, 12)
        off = np.abs((angle - a + np.pi) % (2 * np.pi) - np.pi) * euc
        f -= .25 * ((off < .6) & (euc < reach) & (euc > 1.5))
    t.fill(np.clip(f, 0, .99), ramp(wood_color, .15, .1, 8))
    t.h = 1.2 + .4 * np.cos(u * 2 * np.pi)
    if bark_of is not None:
        edge = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y)) + .8 * value(name + "/rim", 16, 16)
        m = edge < border - .6
        b = bark(*bark_of)
        t.put(m, b.rgb)
        inner = (edge >= border - .6) & (edge < border + .5)
        t.light(np.where(inner, -.22, 0))
        t.h[m] = 2.2
        t.r[m] = .92
    return t


def stripped(name, base):
    t = Tex(name, .7)
    g = grain_field(name, True)
    u = (X / N * 4 + .15 * fbm(name + "/u", 3, 2, 2)) % 1
    f = .55 + .24 * g - .22 * (u < .09) + .08 * (u > .9)
    r = rng(name)
    kx, ky = r.uniform(6, 26, 2)
    d = np.hypot(wrap(X - kx), wrap(Y - ky) * .6)
    f += -.3 * np.exp(-(d / 1.3) ** 2) + .12 * np.cos(d * 2) * np.exp(-(d / 4) ** 2)
    t.fill(np.clip(f, 0, .99), ramp(base, .13, .09, 8))
    t.h = .5 * g - .6 * (u < .09)
    return t


def bamboo(name, base, node="#8a7a34", stalks=4):
    """Stalks side by side, with their knots at different heights."""
    t = Tex(name, .5)
    w = N // stalks
    u = (X % w) / (w - 1)
    k = (X // w).astype(int)
    f = .62 + .30 * np.sin(np.pi * u) - .28 * u - .12 + .07 * value(name, 16, 3)
    gap = (X % w) == w - 1
    shift = np.array([0, 9, 4, 13, 7, 2, 11, 5])[k % 8]
    knot = ((Y + shift) % 16) < 1
    f = f - .4 * gap - .2 * knot + .14 * (((Y + shift) % 16) == 1)
    t.fill(np.clip(f, 0, .99), ramp(base, .2, .14, 8), 0)
    t.h = 2 * np.sin(np.pi * u) + .6 * knot
    return t


def bamboo_end(name, base, hollow):
    t = Tex(name, .6)
    c = Cells(np.array([(4 + 8 * i, 4 + 8 * j) for j in range(4) for i in range(4)], float))
    f = .6 + c.per(name, -.06, .06) - .03 * (c.vx + c.vy)
    t.fill(np.clip(f, 0, .99), ramp(base, .15, .1, 7), 0)
    t.put(c.f1 > 3.6, rgb(hollow) * .55)
    t.put(c.f1 < 1.6, rgb(hollow) * .8)
    t.h = np.where(c.f1 > 3.6, 0, 1.5) - (c.f1 < 1.6) * 1.0
    return t


def mosaic(name, base):
    """Basket weave of short boards."""
    t = Tex(name, .6)
    bx, by = X // 16, Y // 16
    flip = (bx + by) % 2 == 1
    u, v = np.where(flip, Y % 16, X % 16), np.where(flip, X % 16, Y % 16)
    board = (v // 4 + 4 * (bx + 2 * by)).astype(int)
    f = .58 + rng(name).uniform(-.12, .12, 16)[board] + .14 * np.where(flip, grain_field(name, True), grain_field(name))
    f = f - .35 * (v % 4 == 3) + .1 * (v % 4 == 0) - .3 * (u == 15)
    t.fill(np.clip(f, 0, .99), ramp(base, .16, .1, 8))
    t.h = 1 - (v % 4 == 3) - (u == 15)
    return t


for _w, (_planks, _bark, _style, _accent) in WOODS.items():
    _log = "stem" if _style == "fungus" else "log"
    _dark = .09 if _w == "dark_oak" else .13
    add(f"{_w}_planks", planks, _planks, _dark)
    add(f"{_w}_{_log}", bark, _bark, _style, _accent)
    add(f"{_w}_{_log}_top", cut_end, mix(_planks, "#e9cf9a", .12), (f"{_w}_{_log}", _bark, _style, _accent))
    add(f"stripped_{_w}_{_log}", stripped, mix(_planks, "#e8c88e", .10))
    add(f"stripped_{_w}_{_log}_top", cut_end, mix(_planks, "#e9cf9a", .16), None)
add("bamboo_planks", bamboo, "#c4a850", stalks=4)
REG_BAMBOO = {"bamboo_block": "#6f8b34", "stripped_bamboo_block": "#c2ab54"}
for _n, _c in REG_BAMBOO.items():
    add(_n, bamboo, _c)
    add(_n + "_top", bamboo_end, _c, "#8f7a3a")
add("bamboo_mosaic", mosaic, "#c4a64e")
add("bamboo_stalk", bamboo, "#6c9a38", stalks=4)
