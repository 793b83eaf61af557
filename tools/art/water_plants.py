"""Seagrass, kelp, corals and what else lives under water."""
import numpy as np

from color import blend, lift, mix, ramp
from fungi import wart
from noise import X, Y, Cells, fbm, points, rng, roll, ss, value, wrap
from sprite import ball, leaf, outline, pal, sprite, stroke, tuft
from tex import Tex, add

SEA = ramp("#2f8a52", .22, .18, 8)
CORALS = {"tube": "#3c63d8", "brain": "#d86a9e", "bubble": "#a83cb0", "fire": "#d0303a", "horn": "#e2ca3c"}


def seagrass(name, top=None):
    t = sprite(name)
    r = rng("seagrass" if top is None else "tall_seagrass")
    base = 64 if top else 32
    low, high = (12, 26) if top is None else (34, 60)
    for k in range(8):
        x = 4 + 3.4 * k + r.uniform(-1, 1)
        hgt = r.uniform(low, high)
        s = r.choice([-1, 1]) * 3.4
        stroke(t, [(x, base + .5), (x + s, base - hgt * .33), (x - s, base - hgt * .66), (x + s * .4, base - hgt)], 2.6, 1.2, SEA, .46 + r.uniform(-.14, .14), .3)
    return t


def kelp(name, tip):
    t = sprite(name)
    top = 4 if tip else -.5
    stroke(t, [(16, 32.5), (18.5, 22), (13.5, 11), (16, top)], 2.4, 1.6 if tip else 2.4, ramp("#5f7a2c", .2, .16, 8), .45, 0)
    p = ramp("#6f8f34", .22, .18, 8)
    for k in range(5):
        y = 30 - k * 6.4
        if y < top + 2:
            break
        for s in (-1, 1):
            leaf(t, 16 + .4 * s, y - (3 if s > 0 else 0), 90 - s * 56, 12.5 - (3 if tip and k > 3 else 0), 5, p, .5 + .05 * s)
        ball(t, 16, y - 1.5, 1.7, p, .66)
    if tip:
        leaf(t, 16, 8, 90, 8, 4, p, .62)
    return t


def coral_block(name, color, kind):
    t = Tex(name, .7)
    p = ramp(color, .2, .18, 8, shift=.025)
    if kind == "brain":
        v = fbm(name, 4, 4, 2, X + 2 * fbm(name + "/x", 4, 4, 2), Y + 2 * fbm(name + "/y", 4, 4, 2))
        u = np.abs(np.sin(v * 9))
        t.fill(np.clip(.25 + .55 * u, 0, .99), p)
        t.h = 2 * u
    elif kind in ("tube", "bubble"):
        c = Cells(points(name, 5, 5, .8))
        hole = c.f1 < (1.1 if kind == "tube" else 0)
        f = .5 + c.per(name, -.12, .12) - .05 * (c.vx + c.vy) - .3 * (c.edge < .5) - .35 * hole
        t.fill(np.clip(f, 0, .99), p)
        t.h = 2.4 * ss(0, 2.5, c.edge) - 1.5 * hole
    else:
        return wart(name, color) if kind == "fire" else coral_block(name, color, "brain")
    return t


def coral(name, color, kind):
    t = sprite(name)
    p = ramp(color, .22, .18, 8, shift=.025)
    r = rng(name.replace("dead_", ""))
    if kind == "tube":
        for x, hgt in ((8, 17), (24, 15), (12, 24), (20, 21), (16, 28)):
            stroke(t, [(16 + (x - 16) * .5, 32.5), (x, 30 - hgt * .5), (x, 32 - hgt)], 4.6, 5, p, .45)
            ball(t, x, 32 - hgt, 2.4, p, .72, .6)
            ball(t, x, 32 - hgt, 1.2, p, .1, .6)
    elif kind == "brain":
        for x, y, s in ((9, 25, 6), (23, 24, 6.6), (16, 16, 8)):
            m = ball(t, x, y, s, p, .5)
            line = np.sin((X - x) * 1.4 + 1.5 * np.sin((Y - y) * .9)) > .45
            t.rgb[m & line] *= .76
        stroke(t, [(16, 32.5), (16, 24)], 5, 4, p, .3)
    elif kind == "bubble":
        for k in range(24):
            a, d = r.uniform(0, 6.28), r.uniform(0, 1) ** .5
            ball(t, 16 + 11 * d * np.cos(a), 17 + 10 * d * np.sin(a), r.uniform(2, 3.4), p, .52 + r.uniform(-.15, .15))
        stroke(t, [(16, 32.5), (16, 24)], 4, 4, p, .3)
    else:
        def branch(x, y, a, length, w, depth):
            x1, y1 = x + np.cos(a) * length, y - np.sin(a) * length
            stroke(t, [(x, y), (x1, y1)], w, w * .8, p, .36 + .09 * depth, .1)
            if depth < 3:
                spread = .62 if kind == "fire" else .42
                for s in (-1, 1):
                    branch(x1, y1, a + s * r.uniform(.6, 1.2) * spread, length * .74, w * .78, depth + 1)
            else:
                ball(t, x1, y1, 1.4, p, .75)
        for x, a in ((13, 1.9), (19, 1.24), (16, 1.57)):
            branch(x, 32, a, 9.5, 3.4, 0)
    return t


def fan(name, color):
    t = sprite(name)
    p = ramp(color, .22, .18, 8, shift=.025)
    r = rng(name.replace("dead_", ""))
    for layer in range(2):
        for k in range(9):
            a = np.pi * (k + .5) / 9
            length = r.uniform(17, 25) * (1 - .14 * layer)
            x1, y1 = 16 + length * .75 * np.cos(a), 31 - length * np.sin(a)
            stroke(t, [(16, 32), (16 + .5 * (x1 - 16), 31 - .6 * (31 - y1)), (x1, y1)], 2, 1.3, p, .36 + .16 * layer, .3)
            for j in (.55, .75, .95):
                for s in (-1, 1):
                    x, y = 16 + (x1 - 16) * j, 31 - (31 - y1) * j
                    stroke(t, [(x, y), (x + 3 * np.cos(a + s * .8), y - 3 * np.sin(a + s * .8))], 1.1, 1, p, .5 + .14 * layer, .2, seam=False)
    return t


def sponge(name, color, wet):
    t = Tex(name, .35 if wet else .95)
    c = Cells(points(name, 6, 6, .95))
    size = c.per(name, .8, 2.2)
    f = .58 + .1 * fbm(name, 6, 6, 2) - .36 * (c.f1 < size) + .14 * (roll(c.f1 < size, -1, -1) & (c.f1 >= size))
    t.fill(np.clip(f, 0, .99), ramp(color, .2, .12, 7))
    t.h = 1.6 * ss(0, 2, c.f1 - size + .6)
    return t


def egg(name, color, spot):
    t = Tex(name, .6)
    t.fill(np.clip(.6 + .1 * fbm(name, 4, 4, 2) - .01 * (X + Y - 31), 0, .99), ramp(color, .12, .08, 6))
    m = fbm(name + "/s", 7, 7, 2) > .3
    t.shade(m, ramp(spot, .12, .1, 5), np.full_like(X, .5))
    return t


def pickle(name):
    t = Tex(name, .5)
    t.fill(np.clip(.5 + .2 * np.sin((X % 8) / 8 * np.pi) + .1 * fbm(name, 8, 5, 2) - .01 * (Y - 16), 0, .99), ramp("#6f7a34", .18, .16, 7))
    m = Y < 22
    d = np.hypot(X % 8 - 3.5, Y % 8 - 3.5)
    top = (d < 2.2) & m
    t.shade(top, ramp("#cfe08a", .1, .1, 5), np.full_like(X, .6))
    t.glow(top, .7)
    return t


def dried_kelp(name, top):
    t = Tex(name, .9)
    p = ramp("#3c4630", .16, .14, 7)
    if top:
        d = np.maximum(abs(X - 15.5), abs(Y - 15.5)) + .8 * fbm(name, 5, 5, 2)
        t.fill(np.clip(.5 + .25 * np.cos(d * 1.6), 0, .99), p)
    else:
        u = Y + 1.4 * fbm(name, 4, 4, 2)
        t.fill(np.clip(.5 + .25 * np.sin(u / 32 * 2 * np.pi * 6) + .1 * fbm(name + "/g", 8, 8, 1), 0, .99), p)
        for x in (6, 25):
            m = abs(X - x) < 1.4
            t.shade(m, ramp("#8a7a4c", .12, .12, 5), np.clip(.6 - .2 * (X - x), 0, .99), h=1.5)
    return t


def spawn(name):
    t = sprite(name)
    r = rng(name)
    for k in range(26):
        a, d = r.uniform(0, 6.28), 13 * np.sqrt(r.uniform(0, 1))
        x, y = 16 + d * np.cos(a), 16 + d * np.sin(a)
        ball(t, x, y, 2.6, ramp("#a9b0a0", .16, .14, 6), .6)
        ball(t, x + .3, y + .3, 1, ramp("#2c2a26", .1, .1, 5), .4)
    return t


add("seagrass", seagrass)
add("tall_seagrass_bottom", seagrass, False)
add("tall_seagrass_top", seagrass, True)
add("kelp", kelp, True)
add("kelp_plant", kelp, False)
for _k, _c in CORALS.items():
    for _dead in ("", "dead_"):
        _col = mix("#827c78", _c, .12) if _dead else _c
        add(f"{_dead}{_k}_coral_block", coral_block, _col, _k)
        add(f"{_dead}{_k}_coral", coral, _col, _k)
        add(f"{_dead}{_k}_coral_fan", fan, _col)
add("sponge", sponge, "#cbbb48", False)
add("wet_sponge", sponge, "#a9a03c", True)
add("turtle_egg", egg, "#e4dfc4", "#6fa08a")
add("sniffer_egg", egg, "#8a2f2a", "#5f9a6c")
add("sea_pickle", pickle)
add("dried_kelp_side", dried_kelp, False)
add("dried_kelp_top", dried_kelp, True)
add("frogspawn", spawn)
