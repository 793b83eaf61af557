"""Doors, trapdoors and ladders."""
import numpy as np

from color import lift, mix, ramp, rgb
from noise import X, Y, fbm, rng, roll, value
from tex import Tex, add
from wood import WOODS, grain_field

# wood: pattern of the door's upper window, of its panels, and of the trapdoor
DOORS = {
    "oak": ("grid", "panels"), "spruce": ("none", "boards"), "birch": ("tall", "panels"), "jungle": ("slats", "boards"),
    "acacia": ("grid", "weave"), "dark_oak": ("arch", "panels"), "mangrove": ("slats", "weave"), "cherry": ("round", "panels"),
    "pale_oak": ("arch", "boards"), "crimson": ("cross", "boards"), "warped": ("round", "weave"), "bamboo": ("slats", "slats"),
    "amber": ("cross", "panels"), "redwood": ("none", "panels"), "palm": ("slats", "slats"), "cypress": ("tall", "boards"),
}
METAL = "#5c5f66"


def wooden(name, base, upright=True):
    t = Tex(name, .7)
    t.wrap = False
    g = grain_field(name, upright)
    t.fill(np.clip(.56 + .18 * g, 0, .99), ramp(base, .16, .12, 8))
    t.h = 1 + .3 * g
    return t


def window(kind):
    cx, cy = X - 15.5, Y - 13.5
    inside = (abs(cx) < 9.5) & (abs(cy) < 8)
    return {
        "grid": inside & (abs(cx) > 1) & (abs(cy) > 1),
        "tall": (abs(cx) < 9.5) & (abs(abs(cx) - 5) < 2.8) & (Y > 4) & (Y < 26),
        "slats": inside & (Y % 4 < 2),
        "arch": (np.hypot(cx, np.minimum(cy + 1, 0)) < 8.5) & (cy < 7) & (abs(cx) > 1),
        "round": (np.hypot(cx, cy) < 8) & (np.minimum(abs(cx), abs(cy)) > 1),
        "cross": (np.minimum(abs(cx), abs(cy)) < 2.6) & (np.maximum(abs(cx), abs(cy)) < 9),
        "none": np.zeros_like(cx, bool),
    }[kind]


def inset(t, m, depth=.20):
    """Lowers a panel: dark under its upper and left edge, light along the lower right one."""
    t.light(np.where(m, -.06, 0))
    t.light(np.where(m & (~roll(m, 1, 0) | ~roll(m, 0, 1)), -depth, 0) + np.where(m & (~roll(m, -1, 0) | ~roll(m, 0, -1)), depth * .7, 0))
    t.h[m] -= .8
    return t


def panels(t, kind, upper):
    cx = X - 15.5
    if kind == "panels":
        for lo, hi in (((4, 16), (19, 28)) if not upper else ((25, 29),)):
            inset(t, (abs(cx) < 10) & (abs(cx) > 1.2) & (Y >= lo) & (Y < hi))
    elif kind == "boards":
        seam = (X % 8 == 7) & (X < 31)
        t.light(np.where(seam, -.35, 0) + np.where(roll(seam, 1, 0), .1, 0))
        bar = ((Y > 6) & (Y < 11)) if not upper else ((Y > 24) & (Y < 29))
        t.light(np.where(bar, .10, 0) + np.where(bar & ~roll(bar, 0, -1), -.3, 0))
        t.h += bar * .8
    elif kind == "slats":
        slat = (Y % 4 == 3)
        t.light(np.where(slat, -.3, 0) + np.where(Y % 4 == 0, .1, 0))
    elif kind == "weave":
        m = ((X + Y) % 16 < 2) | ((X - Y) % 16 < 2)
        zone = (abs(cx) < 11) & ((Y > 4) & (Y < 28) if not upper else (Y > 23))
        inset(t, zone)
        t.light(np.where(zone & m, .16, 0) + np.where(zone & roll(m, 0, 1) & ~m, -.16, 0))


def frame(t, upper, lower):
    d = np.minimum(X, 31 - X)
    if upper:
        d = np.minimum(d, Y)
    if lower:
        d = np.minimum(d, 31 - Y)
    rim = d < 3
    t.light(np.where(rim, -.05, 0) + np.where(d == 0, -.22, 0) + np.where((d == 1), .10, 0) + np.where(d == 3, -.16, 0))
    t.h[rim] += .8
    return t


def metalwork(t, m, base=METAL):
    t.shade(m, ramp(base, .2, .2, 6), np.clip(.6 - .02 * (X + Y - 30), .2, .9), h=2.6, r=.4)
    t.light(np.where(roll(m, 1, 1) & ~m, -.3, 0))


def hole(t, m):
    t.light(np.where(~m & (roll(m, 1, 0) | roll(m, 0, 1)), -.18, 0) + np.where(~m & (roll(m, -1, 0) | roll(m, 0, -1)), .1, 0))
    t.a[m] = 0
    t.h[m] = 0


def door(name, base, win, pan, upper, metal=METAL, rough=.7):
    t = wooden(name[:-4] if name.endswith("_top") else name[:-7], base)
    panels(t, pan, upper)
    frame(t, upper, not upper)
    if upper:
        w = window(win)
        rim = roll(w, 1, 0) | roll(w, -1, 0) | roll(w, 0, 1) | roll(w, 0, -1)
        t.light(np.where(rim & ~w, -.14, 0))
        hole(t, w)
        metalwork(t, (X < 6) & (abs(Y - 8) < 1.5), metal)
        metalwork(t, (X > 26) & (X < 30) & (Y > 27), metal)
    else:
        metalwork(t, (X < 6) & (abs(Y - 23) < 1.5), metal)
        metalwork(t, (X > 26) & (X < 30) & (Y < 3), metal)
    t.r[:] = np.where(t.r < .5, t.r, rough)
    return t


def trapdoor(name, base, pan, metal=METAL, rough=.7):
    t = wooden(name, base, False)
    cx, cy = X - 15.5, Y - 15.5
    if pan in ("panels", "weave"):
        frame(t, True, True)
        q = (np.maximum(abs(cx), abs(cy)) < 11) & (np.minimum(abs(cx), abs(cy)) > 1.6)
        hole(t, q & (np.maximum(abs(cx), abs(cy)) < 9.5) & (np.minimum(abs(cx), abs(cy)) > 3) if pan == "panels" else q & ((X + Y) % 8 < 3) & ((X - Y) % 8 < 5))
    else:
        panels(t, pan, False)
        frame(t, True, True)
        if pan == "slats":
            hole(t, (abs(cx) < 11) & (abs(cy) < 11) & (Y % 4 == 1))
    for sx in (5, 26):
        metalwork(t, (abs(X - sx) < 1.5) & (Y < 7), metal)
    t.r[:] = np.where(t.r < .5, t.r, rough)
    return t


def ladder(name, base="#a37d48"):
    t = wooden(name, base)
    rails = (abs(X - 4.5) < 2) | (abs(X - 26.5) < 2)
    rungs = (Y % 8 >= 3) & (Y % 8 < 6) & (X > 1) & (X < 30)
    m = rails | rungs
    t.a[~m] = 0
    t.h = np.where(rungs, 1.4, 0) + np.where(rails, 1.8, 0)
    t.light(np.where(rungs & (Y % 8 == 5), -.25, 0) + np.where(rungs & (Y % 8 == 3), .15, 0) + np.where(rails & ((X == 6) | (X == 28)), -.25, 0))
    t.light(np.where(rails & (Y % 8 == 6), -.22, 0))
    return t


for _w, (_win, _pan) in DOORS.items():
    _base = WOODS[_w][0] if _w in WOODS else "#c2a64f"
    add(_w + "_door_top", door, _base, _win, _pan, True)
    add(_w + "_door_bottom", door, _base, _win, _pan, False)
    add(_w + "_trapdoor", trapdoor, mix(_base, "#2a1a10", .08), _pan)
add("iron_door_top", door, "#c6c8c9", "tall", "panels", True, "#84888e", .35)
add("iron_door_bottom", door, "#c6c8c9", "tall", "panels", False, "#84888e", .35)
add("iron_trapdoor", trapdoor, "#c6c8c9", "panels", "#84888e", .35)
add("ladder", ladder)
