"""Soul ground, sculk, warped and amber rock, heads of the End."""
import numpy as np

from color import blend, lift, mix, ramp, rgb
from noise import X, Y, Cells, fbm, points, rng, roll, ss, value, wrap
from sprite import ball, pal, sprite, stroke
from soil import fringe, blades, dirt, lumps, SOILS
from stone import NATURAL, basalt_side, cobble
from tex import Tex, add


def soul(name, faces):
    t = lumps(name, "#574336", 4, .9, .14, .1)
    if faces:
        for x, y, s in ((8, 8, 1.), (23, 12, .9), (11, 24, .95), (27, 27, .8)):
            dx, dy = wrap(X - x) / s, wrap(Y - y) / s
            eye = (np.hypot(np.abs(dx) - 2.4, (dy + 1.5) * .8) < 1.5)
            mouth = (np.hypot(dx * .9, (dy - 2.8) * .7) < 1.5)
            m = eye | mouth
            t.put(roll(m, 1, 1) & ~m, np.clip(t.rgb * 1.25, 0, 1))
            t.put(m, rgb("#2c2019"))
            t.h[m] -= 1.6
    return t


def sculk(name, extra=None):
    t = Tex(name, .75)
    f = .42 + .3 * fbm(name, 4, 4, 3)
    t.fill(np.clip(f, 0, .99), blend("#050d12", "#0a1a22", "#0e2832", "#123844", n=7))
    t.h = 1.4 * fbm(name, 4, 4, 3)
    r = rng(name)
    for x, y in points(name + "/p", 5, 5, 1.):
        s = r.uniform(.6, 1.5)
        m = np.hypot(wrap(X - x), wrap(Y - y)) < s
        t.put(m, rgb("#0f6a78") if r.random() < .6 else rgb("#2fb8bc"))
        t.glow(m, .8)
        t.h[m] += .6
    if extra in ("catalyst_top", "catalyst_side", "shrieker_side", "shrieker_top", "sensor_top", "sensor_side"):
        bone = ramp("#cfcdb0", .16, .1, 6)
        d = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
        if extra == "catalyst_top":
            m = (np.hypot(X - 15.5, Y - 15.5) < 13) & (np.abs(np.sin(np.arctan2(Y - 15.5, X - 15.5) * 4)) < .5)
        elif extra == "catalyst_side":
            m = (Y < 13 + 4 * np.sin(X * .8)) & (Y > 2) & ((X % 8) < 6)
        elif extra == "shrieker_top":
            e = np.hypot(X - 15.5, Y - 15.5)
            m = (e > 8) & (e < 12.5) & (np.sin(np.arctan2(Y - 15.5, X - 15.5) * 8) > -.6)
            t.put(e < 7, rgb("#02060a"), h=-2.)
        elif extra == "shrieker_side":
            m = (Y > 14) & (Y < 19) & (X % 6 < 4)
        elif extra == "sensor_top":
            m = (d < 2)
        else:
            m = (Y > 15) & (Y < 18)
        col = bone if "sensor" not in extra else ramp("#1f7f8c", .12, .12, 5)
        t.put(roll(m, 1, 1) & ~m, t.rgb * .5)
        t.shade(m, col, np.clip(.6 + .2 * fbm(name + "/b", 8, 8, 1), 0, .99), h=2.)
    return t


def tendril(name):
    t = sprite(name)
    for x in (8, 16, 24):
        m = stroke(t, [(x, 32.5), (x + 3, 20), (x - 2, 4)], 3.4, 2, pal("#1a8f9c"), .5)
        t.glow(m, .5)
    return t


def veined_rock(name, of, vein, glow, threshold=.08):
    """Deep rock with a living color in its seams."""
    painter, args, kw = of[1]
    t = painter(of[0], *args, **kw)
    v = np.abs(fbm(name, 3, 3, 3, X + 2 * fbm(name + "/x", 4, 4, 2), Y))
    m = v < threshold
    t.rgb[roll(m, 1, 1) & ~m] *= .7
    t.shade(m, ramp(vein, .2, .18, 6), np.clip(1 - v / threshold, 0, .99))
    t.glow(m, glow)
    return t


def grown(name, of, colors, top):
    painter, args, kw = of[1]
    t = painter(of[0], *args, **kw)
    p = blend(*colors, n=8)
    if top:
        return blades(dirt(name, colors[1], 0), name, p, 150, (2, 4), 1.3)
    from soil import SOILS as S
    S[of[0]] = of[1]
    return fringe(name, p, of[0], (4, 11), True, 30, name)


def egg(name):
    t = Tex(name, .3)
    c = Cells(points(name, 5, 5, .9))
    t.fill(np.clip(.4 + c.per(name, -.2, .2) - .04 * (c.vx + c.vy), 0, .99), blend("#07060c", "#150f1e", "#281a38", "#4c2f66", n=7))
    m = value(name + "/s", 9, 9) > .72
    t.put(m, rgb("#9a5cc8"))
    t.glow(m, .6)
    return t


def frame_block(name, part):
    t = cobble("end_stone", "#dcdd9f", dark=.16, light=.08, nx=5, ny=5, gap=.5, spread=.12, mortar="#b6ae78")
    band = (Y >= 6) & (Y < 13) if part == "side" else np.maximum(abs(X - 15.5), abs(Y - 15.5)) < 9
    if part == "eye":
        d = np.hypot(X - 15.5, Y - 15.5)
        t.shade(np.ones_like(X, bool), ramp("#2f6a58", .2, .2, 8), np.clip(.6 - .02 * (X + Y - 31) - .2 * (d > 8), 0, .99), r=.15)
        t.put((abs(X - 15.5) < 1.6) & (abs(Y - 15.5) < 6), rgb("#0a1a18"))
        t.glow(np.ones_like(X, bool), .35)
        return t
    t.shade(band, ramp("#3a7a68", .16, .14, 6), np.clip(.5 + .2 * fbm(name, 6, 6, 2), 0, .99), h=.5)
    t.light(np.where(band & ~roll(band, 0, 1), -.25, 0) + np.where(roll(band, 0, 1) & ~band, .1, 0))
    return t


AMBER = ("#5a2f0c", "#a8661a", "#e0a034", "#ffd978")
WARP = ("#123c40", "#176e68", "#1f9a86", "#4fc9a6")
add("soul_sand", soul, True)
add("soul_soil", soul, False)
add("polished_basalt_side", lambda name: basalt_side(name, "#5a5b64", .5))
add("polished_basalt_top", lambda name: cobble(name, "#64656e", .14, .1, 3, 3, .5, .5, spread=.08))
add("sculk", sculk)
for _e in ("catalyst_top", "catalyst_side", "shrieker_top", "shrieker_side", "sensor_top", "sensor_side"):
    add("sculk_" + _e, sculk, _e)
add("sculk_catalyst_bottom", sculk)
add("sculk_sensor_tendril", tendril)
for _k, _c in (("amber", AMBER), ("warped", WARP)):
    for _r in ("deepslate", "blackstone"):
        add(f"{_k}_{_r}_side", grown, (_r, NATURAL[_r]), _c, False)
        add(f"{_k}_{_r}_top", grown, (_r, NATURAL[_r]), _c, True)
add("dragon_egg", egg)
for _p in ("side", "top", "eye"):
    add("end_portal_frame_" + _p, frame_block, _p)
