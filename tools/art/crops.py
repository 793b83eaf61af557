"""Crops, gourds and fruit."""
import numpy as np

from color import blend, lift, mix, ramp, rgb
from noise import X, Y, Cells, fbm, points, rng, roll, ss, value
from sprite import DEEP_GREEN, GREEN, OLIVE, ball, bloom, leaf, pal, shoots, sprite, stalk, stroke, tuft
from tex import Tex, add


def wheat(name, stage):
    t = sprite(name)
    ripe = stage / 7
    p = ramp(mix("#4f9a34", "#d9ab3e", max(0, (ripe - .45) / .55)), .2, .16, 8)
    r = rng("wheat")
    hgt = 5 + 3.6 * stage
    for k in range(11):
        x = 2.5 + k * 2.7 + r.uniform(-.8, .8)
        top = 32 - hgt * r.uniform(.82, 1.02)
        x1 = x + r.uniform(-2, 2)
        stroke(t, [(x, 32.5), (x, (32 + top) / 2), (x1, top)], 1.5, 1, p, .42 + r.uniform(-.1, .1), .3)
        if stage >= 4:
            for j in range(2 + stage // 2):
                ball(t, x1 + (.9 if j % 2 else -.9), top + j * 1.5, 1.35, p, .62 + r.uniform(-.1, .15), 1.2)
        elif stage > 1:
            leaf(t, x, top + hgt * .5, 60 if k % 2 else 120, 5, 2, p, .5, rib=False)
    return t


def root_crop(name, stage, fruit, green=GREEN, broad=3.2):
    t = sprite(name)
    r = rng(name[:-1])
    hgt = 7 + 5 * stage
    for x in (6, 16, 26):
        for k in range(5 + stage):
            a = 90 + (k - (4 + stage) / 2) * 19 + r.uniform(-6, 6)
            leaf(t, x, 32, a, hgt * r.uniform(.75, 1.05), broad, green, .48 + r.uniform(-.14, .14))
        if stage == 3:
            ball(t, x, 30.8, 2.6, pal(fruit), .55)
    return t


def berry(name, stage):
    t = sprite(name)
    r = rng("berry")
    size = (8, 13, 14, 14)[stage]
    for k in range((12, 26, 34, 34)[stage]):
        x, y = 16 + r.uniform(-1, 1) * size, 32 - r.uniform(0, 1) * size * 1.8
        leaf(t, x, y + 3, r.uniform(30, 150), 6, 4, DEEP_GREEN, .45 + r.uniform(-.14, .18))
    if stage >= 2:
        for k in range(5 + 4 * (stage - 2)):
            ball(t, 5 + r.uniform(0, 22), 10 + r.uniform(0, 17), 1.7, pal("#c8203a"), .6)
    return t


def gourd_stem(name, stage):
    t = sprite(name)
    hgt = (7, 13, 20, 25)[stage]
    stroke(t, [(16, 32.5), (14, 32 - hgt * .5), (17, 32 - hgt)], 2.2, 1.3, OLIVE)
    r = rng(name)
    for k in range(2 + 2 * stage):
        leaf(t, 16, 31 - k * hgt / (3 + 2 * stage), 40 if k % 2 else 140, 6 + stage, 4.5, GREEN, .5 + r.uniform(-.1, .1))
    return t


def gourd(name, color, stripe, part, count=4):
    t = Tex(name, .6)
    p = ramp(color, .2, .14, 8)
    if part == "side":
        u = ((X + .8 * fbm(name, 3, 4, 2)) / 32 * count) % 1
        f = .35 + .36 * np.sin(np.pi * u) + .08 * value(name + "/g", 12, 4)
        t.fill(np.clip(f, 0, .99), p)
        t.h = 2.4 * np.sin(np.pi * u)
        if stripe is not None:
            m = np.abs(u - .5 + .10 * fbm(name + "/s", 6, 8, 2)) < .17
            t.shade(m, ramp(stripe, .14, .12, 6), np.clip(f, 0, .99))
    else:
        a, d = np.arctan2(Y - 15.5, X - 15.5), np.hypot(X - 15.5, Y - 15.5)
        wave = np.abs(np.sin(a * count + .3))
        f = .40 + .25 * wave * np.clip(d / 10, 0, 1) + .08 * value(name + "/g", 10, 10)
        t.fill(np.clip(f, 0, .99), p)
        t.h = 1.6 * wave * np.clip(d / 10, 0, 1)
        if stripe is not None:
            t.shade((wave > .82 - .1 * value(name, 9, 9)) & (d > 4), ramp(stripe, .14, .12, 6), np.clip(f, 0, .99))
        t.shade(d < 3, ramp("#8a7a3c", .2, .15, 5), np.clip(.6 - .1 * (X - 15 + Y - 15), 0, .99))
    return t


def carved(name, lit):
    t = gourd("pumpkin_side", "#d98324", None, "side")
    cx = abs(X - 15.5)
    eyes = (Y > 8) & (Y < 15) & (cx > 3.5) & (cx < 11) & (Y - 8 > (cx - 7.2) * .9 * np.sign(7.2 - cx) + 1)
    mouth = (Y > 18) & (Y < 26) & (cx < 12) & (Y > 18 + .3 * cx) & ~((Y < 21) & (X % 7 < 2)) & ~((Y > 23) & ((X + 3) % 7 < 2))
    m = eyes | mouth
    t.light(np.where(roll(m, -1, -1) & ~m, -.35, 0) + np.where(roll(m, 1, 1) & ~m, .12, 0))
    if lit:
        t.shade(m, blend("#f08a12", "#ffc63a", "#fff1a0", n=6), np.clip(1 - np.hypot(X - 15.5, Y - 20) / 17, 0, .99))
        t.glow(m, 1.)
    else:
        t.shade(m, blend("#1d0d06", "#3c1d0a", "#5c300f", n=5), np.clip(.2 + .03 * (Y - 8), 0, .99))
    t.h[m] = -1.5
    return t


def hay(name, top):
    t = Tex(name, .9)
    p = blend("#6e4f12", "#a57c1e", "#d2a834", "#efd067", "#fbeaa0", n=9)
    if top:
        c = Cells(points(name, 11, 11, .9))
        t.fill(np.clip(.55 + c.per(name, -.2, .2) - .35 * (c.edge < .35), 0, .99), p, 0)
        t.put(c.f1 < .8, p[1])
        t.h = ss(0, 1, c.edge)
    else:
        w = X + .8 * fbm(name, 4, 4, 2)
        t.fill(np.clip(.52 + .42 * value(name + "/a", 22, 3, w, Y) + .1 * value(name + "/b", 32, 5, w, Y), 0, .99), p, 0)
        t.h = value(name + "/a", 22, 3, w, Y)
        for y in (7, 23):
            m = abs(Y - y) < 1.6
            t.shade(m, ramp("#a3432a", .16, .14, 5), np.clip(.6 - .2 * (Y - y) + .2 * value(name + "/r", 16, 4), 0, .99), h=1.8)
            t.light(np.where(roll(m, 0, 1) & ~m, -.3, 0))
    return t


def cactus(name, part):
    t = Tex(name, .7)
    p = ramp("#4f8a3a", .22, .16, 8)
    if part == "side":
        u = ((X - 1) / 32 * 5) % 1
        f = .34 + .38 * np.sin(np.pi * u) + .05 * fbm(name, 8, 6, 2)
        t.fill(np.clip(f, 0, .99), p)
        t.h = 2.6 * np.sin(np.pi * u)
        r = rng(name)
        for k in range(5):
            for j in range(4):
                x, y = int(k * 6.4 + 4.2) % 32, (j * 8 + (k % 2) * 4 + 2) % 32
                t.rgb[y, x] = rgb("#f3efcf")
                t.rgb[y, (x + 1) % 32] = rgb("#e2d9a6")
                t.rgb[(y + 1) % 32, x] = p[1]
    else:
        d, a = np.maximum(abs(X - 15.5), abs(Y - 15.5)), np.arctan2(Y - 15.5, X - 15.5)
        f = .62 + .1 * np.cos(a * 10) - .25 * (d > 13) + .05 * fbm(name, 6, 6, 2) - .2 * (np.hypot(X - 15.5, Y - 15.5) < 3)
        t.fill(np.clip(f, 0, .99), p if part == "top" else ramp("#b8b27a", .2, .1, 7))
        t.h = .6 * np.cos(a * 10)
    return t


def cocoa(name, color):
    t = Tex(name, .6)
    u = (X / 32 * 4) % 1
    t.fill(np.clip(.4 + .3 * np.sin(np.pi * u) + .1 * fbm(name, 6, 4, 2), 0, .99), ramp(color, .18, .14, 7))
    t.h = 1.5 * np.sin(np.pi * u)
    return t


def chorus(name, flower):
    t = Tex(name, .7)
    c = Cells(points(name, 5, 5, .9))
    f = .5 + c.per(name, -.16, .16) - .03 * (c.vx + c.vy) - .2 * (c.edge < .6)
    t.fill(np.clip(f, 0, .99), ramp("#d9c3d9" if flower else "#6f4a74", .2, .14, 7))
    if flower:
        for x, y in ((8, 8), (23, 9), (9, 24), (24, 24), (16, 16)):
            bloom(t, x, y, 4.4, 5, pal("#9a6aa4"), "#f0e0ea", x, .4)
    t.h = 1.6 * ss(0, 2, c.edge)
    return t


def cane(name):
    from color import gray
    t = sprite(name)
    p = gray(.42, 1., 8)
    for x, seed in ((7, 2), (16, 7), (25, 4)):
        stroke(t, [(x, 32.5), (x, 16), (x, -.5)], 4, 4, p, .55, 0)
        for y in range(seed, 32, 9):
            m = (abs(X + .5 - x) < 2.2) & (Y == y)
            t.rgb[m] *= .66
            t.rgb[(abs(X + .5 - x) < 2.2) & (Y == y + 1)] *= 1.12
        leaf(t, x, seed + 14, 55 if seed % 2 else 125, 10, 3, p, .6)
    t.rgb = np.clip(t.rgb, 0, 1)
    return t


for _s in range(8):
    add(f"wheat_stage{_s}", wheat, _s)
for _s in range(4):
    add(f"carrots_stage{_s}", root_crop, _s, "#ef8426", GREEN, 2.2)
    add(f"potatoes_stage{_s}", root_crop, _s, "#c8a052", DEEP_GREEN, 4.4)
    add(f"beetroots_stage{_s}", root_crop, _s, "#a02a3c", pal("#5a8f36", .2, .16, 8), 3.4)
    add(f"sweet_berry_bush_stage{_s}", berry, _s)
    add(f"stem_stage{_s}", gourd_stem, _s)
for _s in range(2):
    add(f"torchflower_crop_stage{_s}", lambda name, s: shoots(sprite(name), name, DEEP_GREEN, 16, 4 + 3 * s, height=(6 + 5 * s, 10 + 8 * s), width=4), _s)
add("melon_side", gourd, "#7fae2f", "#4a7a24", "side", 4)
add("melon_top", gourd, "#7fae2f", "#4a7a24", "top", 4)
add("pumpkin_side", gourd, "#d98324", None, "side", 4)
add("pumpkin_top", gourd, "#d98324", None, "top", 4)
add("carved_pumpkin", carved, False)
add("jack_o_lantern", carved, True)
add("hay_block_side", hay, False)
add("hay_block_top", hay, True)
for _p in ("side", "top", "bottom"):
    add("cactus_" + _p, cactus, _p)
for _s, _c in enumerate(("#7f9a3c", "#b98a34", "#a2581f")):
    add(f"cocoa_stage{_s}", cocoa, _c)
add("chorus_plant", chorus, False)
add("chorus_flower", chorus, True)
add("sugar_cane", cane)
