"""Lamps, torches, lanterns."""
import numpy as np

from color import blend, lift, mix, ramp, rgb
from metal import plate
from noise import X, Y, Cells, fbm, points, rng, roll, ss, value, wrap
from sprite import ball, pal, sprite, stroke
from tex import Tex, add
from wood import bark, WOODS


def glowing(name, stops, nx=5, dim=.35, edge=.5, rough=.4):
    t = Tex(name, rough)
    c = Cells(points(name, nx, nx, .95))
    f = .52 + c.per(name, -.24, .24) - .05 * (c.vx + c.vy) - .3 * (c.edge < edge) + .08 * fbm(name, 6, 6, 2)
    t.fill(np.clip(f, 0, .999), blend(*stops, n=9))
    t.h = 2 * ss(0, 2.5, c.edge)
    t.glow(np.ones_like(X, bool), 1.)
    t.e *= np.clip(dim + .75 * f, 0, 1)[..., None]
    return t


def sea_lantern(name):
    frames = []
    cx, cy = X - 15.5, Y - 15.5
    cheb, euc = np.maximum(abs(cx), abs(cy)), np.hypot(cx, cy)
    for k in range(5):
        a = 2 * np.pi * k / 5
        t = Tex(name, .2)
        ring = np.sin(euc * .9 - a) * .12
        f = .62 + ring - .012 * (cx + cy) + .08 * fbm(name, 6, 6, 2)
        t.fill(np.clip(f, 0, .999), blend("#5f98a0", "#8cc4c4", "#bfe6de", "#e8fbf4", "#ffffff", n=8))
        rim = cheb > 13.4
        t.shade(rim, ramp("#6f9aa0", .14, .14, 6), np.clip(.5 + .3 * fbm(name + "/r", 9, 9, 2), 0, .99), h=1.5)
        cross = (np.minimum(abs(cx), abs(cy)) < .8) & ~rim & (cheb > 5)
        t.light(np.where(cross, -.16, 0))
        t.glow(~rim, .9)
        t.h += np.where(rim, 1, .4)
        frames.append(t)
    return frames


def frog(name, color, top):
    t = Tex(name, .35)
    p = ramp(color, .14, .1, 8)
    if top:
        d = np.maximum(abs(X - 15.5), abs(Y - 15.5)) * .6 + np.hypot(X - 15.5, Y - 15.5) * .4
        f = .6 + .18 * np.cos(d * .85)
    else:
        f = .62 + .16 * np.sin((Y + 1.5 * fbm(name, 4, 4, 2)) / 32 * 2 * np.pi * 3) + .06 * fbm(name, 6, 6, 2)
    t.fill(np.clip(f, 0, .99), p)
    t.glow(np.ones_like(X, bool), .85)
    t.h = f
    return t


def torch(name, flame, lit=True, wood="#8a6538", head=None):
    t = sprite(name, .8)
    stick = (X >= 14) & (X < 18) & (Y >= 12)
    t.shade(stick, ramp(wood, .2, .14, 7), np.clip(.75 - .17 * (X - 14) + .12 * value(name, 16, 8), 0, .99), h=1.)
    t.light(np.where(stick & (Y % 7 == 6), -.14, 0))
    hot = stick & (Y < 19)
    if lit:
        f = np.clip(.98 - .085 * (Y - 12) - .10 * np.abs(X - 15.5), 0, .99)
        t.shade(hot, blend(*flame, n=8), f)
        t.glow(hot, 1.)
        t.put(stick & (Y == 19), t.rgb * .6)
    else:
        t.shade(hot, ramp(head or "#4a2018", .12, .12, 5), np.clip(.7 - .05 * (Y - 12) - .1 * (X - 14), 0, .99))
    return t


def torch_top(name, lit):
    t = Tex(name, .7)
    p = blend("#7a0c06", "#d82a14", "#ff7a4a", "#ffe0c0", n=7) if lit else ramp("#4a2018", .12, .12, 6)
    t.fill(np.clip(.8 - .035 * (Y % 16) + .1 * value(name, 12, 12), 0, .99), p)
    if lit:
        t.glow(np.ones_like(X, bool), .9)
    return t


def lantern(name, flame, top=False):
    """Iron plates round a flame. The drawing fills the tile, so that any part of it can be cut out for the body."""
    t = Tex(name, .5)
    iron = ramp("#565a66", .2, .2, 7)
    t.shade(np.ones_like(X, bool), iron, np.clip(.5 + .1 * fbm(name, 6, 6, 2) - .01 * (X + Y - 31), 0, .99))
    if top:
        cheb = np.maximum(abs(X - 15.5), abs(Y - 15.5))
        t.light(np.where((cheb > 3.5) & (cheb < 4.6), .2, 0) - np.where(cheb > 5.5, .12, 0))
        t.h = 3 - cheb * .3
        return t
    body = (Y >= 18) & (X >= 10) & (X < 22)
    win = (Y >= 20) & (Y < 30) & (X >= 11) & (X < 21) & ~((X > 14.5) & (X < 16.5) & (Y < 21))
    d = np.hypot((X - 15.5) * .8, Y - 26)
    t.shade(win, blend(*flame, n=8), np.clip(1.02 - d / 8, 0, .99), r=.2)
    t.glow(win, 1.)
    bars = win & ((X == 13) | (X == 18))
    t.shade(bars, iron, np.full_like(X, .35))
    t.e[bars] = 0
    t.light(np.where(body & ((Y == 18) | (Y == 30)), .25, 0) - np.where(body & ((Y == 19) | (Y == 31)), .2, 0))
    t.h = np.where(win, -.8, 0)
    return t


def chain(name):
    t = sprite(name, .4)
    p = ramp("#4a4f5c", .18, .24, 7)
    for y0 in range(-8, 40, 16):
        d = np.hypot((X - 15.5) * 1.7, (Y - y0 - 7.5) * .75)
        m = (d > 2.6) & (d < 5.2)
        t.shade(m, p, np.clip(.62 - .06 * ((X - 15) + (Y - y0 - 8) * .4), 0, .99), h=1.)
        mid = (np.abs(X - 15.5) < 1.2) & (np.abs(Y - y0 - 15.5) < 4.5)
        t.shade(mid, p, np.clip(.7 - .2 * (X - 15), 0, .99), h=1.6)
    return t


def lamp(name, on):
    t = Tex(name, .35)
    cx, cy = X - 15.5, Y - 15.5
    d = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
    frame = (d < 2) | (np.minimum(np.abs(cx), np.abs(cy)) < 1) | (np.abs(np.abs(cx) - np.abs(cy)) < .8)
    core = blend("#a8580c", "#eea030", "#ffdc88", "#fffbe8", n=8) if on else blend("#2c1410", "#4c2418", "#744028", "#8f5a3a", n=8)
    f = np.clip(.86 - np.hypot(cx, cy) / 34 - .008 * (cx + cy) + .08 * fbm(name, 6, 6, 2), 0, .99)
    t.shade(np.ones_like(X, bool), core, f)
    t.shade(frame, ramp("#6a4a34" if not on else "#a8743a", .16, .16, 6), np.clip(.6 - .01 * (cx + cy), 0, .99), h=1.6)
    if on:
        t.glow(~frame, 1.)
        t.glow(frame, .3)
    return t


add("glowstone", glowing, ("#6a4312", "#b07a2a", "#e8b850", "#fbe08c", "#fffbe0"))
add("shroomlight", glowing, ("#a83c14", "#e0762a", "#f8a850", "#ffd898", "#fff6dc"), 6)
add("sea_lantern", sea_lantern)
for _k, _c in (("ochre", "#f4d88a"), ("verdant", "#b9e8a8"), ("pearlescent", "#ecc6e4")):
    add(_k + "_froglight_side", frog, _c, False)
    add(_k + "_froglight_top", frog, _c, True)
WARM, SOUL = ("#c0480c", "#f59a22", "#ffd75e", "#fffbe0"), ("#0a6a8c", "#1ab0cc", "#7cecec", "#f0ffff")
add("torch", torch, WARM)
add("soul_torch", torch, SOUL)
add("redstone_torch", torch, ("#7a0c06", "#d82a14", "#ff6a4a", "#ffd0b8"))
add("redstone_torch_off", torch, WARM, False)
add("redstone_torch_top", torch_top, True)
add("redstone_torch_top_off", torch_top, False)
add("lantern", lantern, WARM)
add("soul_lantern", lantern, SOUL)
add("lantern_top", lantern, WARM, True)
add("soul_lantern_top", lantern, SOUL, True)
add("chain", chain)
add("redstone_lamp", lamp, False)
add("redstone_lamp_on", lamp, True)
add("campfire_log", lambda name: (lambda t: (t.glow((value(name, 7, 7) > .42) & (Y > 12), .9, rgb("#ff8a2a")), t)[1])(bark("oak_log", *WOODS["oak"][1:4])))
add("end_rod", lambda name: glowing(name, ("#b8a8c8", "#e0d4ea", "#f6f0fa", "#ffffff"), 4, .6))
add("blaze_rod", lambda name: glowing(name, ("#a8580c", "#e8a030", "#ffd870", "#fff6c8"), 4, .4))
