"""Rails, wires and machines."""
import numpy as np

from color import blend, gray, lift, mix, ramp, rgb
from masonry import smooth_block
from metal import plate, rim
from noise import X, Y, Cells, fbm, points, rng, roll, ss, value
from sprite import pal, sprite
from stone import NATURAL, cobble
from tex import Tex, add
from wood import planks

CX, CY = X - 15.5, Y - 15.5
D = np.minimum(np.minimum(X, 31 - X), np.minimum(Y, 31 - Y))
CHEB, EUC = np.maximum(abs(CX), abs(CY)), np.hypot(CX, CY)


def machine(name, base="#7b7d82", seed="machine"):
    """The stone case that furnaces, droppers and pistons share."""
    t = cobble(seed, base, .16, .12, 4, 4, .55, spread=.12)
    edge = D < 2
    t.shade(edge, ramp(base, .16, .14, 7), np.clip(.62 - .012 * (CX + CY) * .8 + .1 * fbm("machine/e", 8, 8, 2), 0, .99), h=2.6)
    t.light(np.where(D == 2, -.25, 0) - np.where((D < 1) & ((X > 30) | (Y > 30)), .2, 0) + np.where((D < 1) & ((X < 1) | (Y < 1)), .1, 0))
    return t


def opening(t, m, deep=("#0c0b0e", "#1a1a1f", "#2a2a30")):
    t.light(np.where(roll(m, -1, -1) & ~m, -.3, 0) + np.where(roll(m, 1, 1) & ~m, .2, 0))
    t.shade(m, blend(*deep, n=5), np.clip(.1 + .03 * (Y - 8), 0, .99), h=-2.)
    return t


def rail(name, kind="plain", on=False, corner=False):
    t = sprite(name, .6)
    wood = ramp("#7a5636", .18, .14, 7)
    iron = ramp("#9a9ca4" if kind in ("plain", "detector") else ("#e8b83c" if kind == "powered" else "#9a9ca4"), .2, .2, 7)
    if corner:
        d = np.hypot(X - 31.5, Y - 31.5)
        a = np.arctan2(31.5 - Y, 31.5 - X)
        ties = (d > 5) & (d < 28) & (np.abs(((a / (np.pi / 2) * 4) % 1) - .5) < .2)
        rails = (np.abs(d - 7.5) < 1.5) | (np.abs(d - 24.5) < 1.5)
        f = .6 - .1 * (d % 3 - 1)
    else:
        ties = (Y % 8 >= 2) & (Y % 8 < 6) & (X > 2) & (X < 29)
        rails = (np.abs(X - 7) < 1.6) | (np.abs(X - 24) < 1.6)
        f = .65 - .16 * (X - np.where(X < 16, 7, 24))
    t.shade(ties, wood, np.clip(.56 + .12 * value("rail", 4, 16) - .2 * (Y % 8 == 5) + .12 * (Y % 8 == 2), 0, .99), h=.8)
    shadow = (roll(rails, 1, 0) & ~rails & ties)
    t.rgb[shadow] *= .7
    t.shade(rails, iron, np.clip(f, 0, .99), h=1.8, r=.35)
    if kind in ("powered", "activator", "detector"):
        red = ramp("#e0281a" if on else "#5c1410", .14, .16, 5)
        m = (np.abs(CX) < (1.6 if kind != "detector" else 5)) & ((Y % 8 < 7) if kind != "detector" else (np.abs(CY) < 5))
        if kind == "detector":
            t.shade((np.abs(CX) < 6) & (np.abs(CY) < 6), ramp("#8b8c90", .14, .14, 6), np.clip(.6 - .02 * (CX + CY), 0, .99), h=1.2)
            m = (np.abs(CX) < 3) & (np.abs(CY) < 3)
        t.shade(m, red, np.clip(.6 - .05 * CX, 0, .99), h=1.)
        if on:
            t.glow(m, .9)
    return t


def dust(name):
    t = Tex(name, .9)
    c = Cells(points(name, 10, 10, .9))
    t.fill(np.clip(.55 + c.per(name, -.3, .3) - .3 * (c.edge < .35), 0, .99), gray(.4, 1., 7), 0)
    t.h = ss(0, 1.2, c.edge)
    return t


def repeater(name, on, compare=False):
    t = smooth_block("repeater", "#a4a6aa")
    t.light(.05 * value("rep", 9, 9))
    red = ramp("#e0281a" if on else "#6a1812", .14, .16, 5)
    m = (np.abs(CX) < 1.6) & (Y > 4) & (Y < 28) if not compare else ((np.abs(CX) < 1.6) & (Y < 18)) | ((np.abs(CY - 7) < 1.6) & (np.abs(CX) < 8))
    arrow = (np.abs(CX) < (Y - 3) * .8) & (Y < 8) & (Y > 2)
    m = m | arrow
    t.light(np.where(roll(m, 1, 1) & ~m, -.2, 0))
    t.shade(m, red, np.clip(.6 - .1 * CX * .3, 0, .99), h=.6)
    if on:
        t.glow(m, .8)
    return t


def lever(name):
    t = sprite(name)
    m = (X >= 14) & (X < 18) & (Y >= 10)
    t.shade(m, ramp("#8a6538", .2, .14, 7), np.clip(.72 - .15 * (X - 14) + .1 * value(name, 16, 8), 0, .99), h=1.)
    t.shade(m & (Y < 14), ramp("#8d8f96", .18, .18, 6), np.clip(.8 - .14 * (X - 14) - .05 * (Y - 12), 0, .99), r=.4)
    return t


def furnace(name, part, kind="furnace", lit=False):
    base = {"furnace": "#7b7d82", "smoker": "#7a746c", "blast_furnace": "#63656c"}[kind]
    t = machine(name, base)
    if kind == "smoker" and part in ("side", "front"):
        wood = planks("oak_planks", "#6f5432")
        m = (Y < 12) & (D >= 2)
        t.put(m, wood.rgb, h=2.)
        t.light(np.where((Y == 12) & (D >= 2), -.3, 0))
    if kind == "blast_furnace" and part != "front":
        b = plate(name, "#7d8088", .4)
        m = (Y < 11) if part == "side" else (CHEB < 9)
        t.put(m & (D >= 2), b.rgb, h=2.)
    if kind == "blast_furnace" and part == "top" or kind == "smoker" and part == "top":
        opening(t, (CHEB < 6) & ((X % 4) < 2))
    if part == "front":
        hearth = (np.abs(CX) < 9) & (Y > 17) & (Y < 28) & ~((Y < 20) & (np.abs(CX) > 7))
        opening(t, hearth)
        grate = hearth & (X % 4 == 1) & (Y > 23)
        t.shade(grate, ramp("#50525a", .14, .14, 5), np.full_like(X, .5), h=.5)
        upper = (np.abs(CX) < 7) & (Y > 7) & (Y < 11)
        opening(t, upper)
        if kind != "furnace":
            t.shade((np.abs(CY + 1) < 1) & (np.abs(CX) < 11), ramp("#9a9ca2", .16, .16, 5), np.full_like(X, .6), h=3.)
        if lit:
            f = np.clip(.15 + .075 * (Y - 17) + .25 * value(name, 8, 5) - .03 * np.abs(CX), 0, .99)
            m = hearth & ~grate & (f > .2)
            t.shade(m, blend("#8a1606", "#e0540c", "#f9a022", "#ffe27a", n=7), f)
            t.glow(m, 1.)
            t.shade(upper, blend("#c8480c", "#f9a022", n=4), np.full_like(X, .5))
            t.glow(upper, .8)
    return t


def dispenser(name, kind):
    t = machine(name)
    if kind == "dispenser":
        ring = (EUC < 9.5)
        t.shade(ring, ramp("#8b8d92", .18, .16, 7), np.clip(.6 - .03 * (CX + CY), 0, .99), h=2.6)
        opening(t, EUC < 5.5)
    elif kind == "dropper":
        opening(t, (np.abs(CX) < 7) & (np.abs(CY) < 5) & ~((np.abs(CX) > 5) & (np.abs(CY) > 3)))
        opening(t, (np.abs(np.abs(CX) - 5) < 1.5) & (np.abs(CY + 9) < 1.5))
    else:
        opening(t, (CHEB < (5 if "dispenser" in name else 6)) & (np.abs(CX) + np.abs(CY) < 9))
    return t


def observer(name, part):
    t = machine(name, "#6d6f75")
    if part == "front":
        m = (np.abs(CX) < 10) & (np.abs(CY) < 8)
        t.shade(m, ramp("#8b8d92", .14, .14, 6), np.clip(.6 - .02 * (CX + CY), 0, .99), h=2.6)
        opening(t, (np.abs(np.abs(CX) - 5) < 2.6) & (np.abs(CY + 2) < 2.6))
        opening(t, (np.abs(CX) < 6) & (np.abs(CY - 5) < 1))
    elif part == "back":
        opening(t, CHEB < 4)
        t.shade(CHEB < 2.5, ramp("#7a1810", .14, .14, 5), np.full_like(X, .55))
    else:
        m = (np.abs(CX) < 2) | ((np.abs(np.abs(CX) + CY - 2) < 1.6) & (CY < 3) & (CY > -8))
        opening(t, m & (np.abs(CY) < 10))
    return t


def piston(name, part):
    if part == "bottom":
        t = machine(name)
        return opening(t, (CHEB > 5) & (CHEB < 6.5))
    t = planks("oak_planks", "#b08a52")
    if part == "side":
        m = machine(name)
        low = Y > 9
        t.put(low, m.rgb)
        t.h[low] = m.h[low]
        t.light(np.where(Y == 10, -.3, 0) + np.where(D < 1, -.15, 0))
        return t
    band = (D < 3) | (np.abs(CX) < 2) & False
    t.shade(band, ramp("#8b8d92", .18, .16, 7), np.clip(.6 - .012 * (CX + CY), 0, .99), h=2.4)
    t.light(np.where(D == 3, -.25, 0))
    if part == "sticky":
        m = EUC + 1.2 * fbm(name, 5, 5, 2) < 10
        t.shade(m, ramp("#7cb85a", .16, .16, 7), np.clip(.6 - .02 * (CX + CY) + .15 * fbm(name + "/s", 6, 6, 2), 0, .99), h=3., r=.15)
    return t


def target(name, top):
    t = Tex(name, .85)
    ring = (np.floor((CHEB if not top else EUC) / 3.2) % 2 == 0)
    grain = value(name, 20, 6)
    t.shade(ring, ramp("#cf3a34", .14, .12, 6), np.clip(.55 + .2 * grain, 0, .99))
    t.shade(~ring, ramp("#ece3d0", .12, .05, 6), np.clip(.55 + .2 * grain, 0, .99))
    t.h = .5 * grain + ring * .4
    return t


def tnt(name, part):
    t = Tex(name, .8)
    u = (X / 32 * 4) % 1
    if part == "side":
        t.fill(np.clip(.36 + .36 * np.sin(np.pi * u) + .06 * value(name, 16, 6), 0, .99), ramp("#cc3428", .2, .16, 7))
        t.h = 2 * np.sin(np.pi * u)
        band = (Y > 10) & (Y < 21)
        t.shade(band, ramp("#eae4d8", .12, .05, 6), np.clip(.5 + .25 * np.sin(np.pi * u), 0, .99))
        t.light(np.where((Y == 21) | (Y == 10), -.25, 0))
        # Letters on a five by seven grid.
        word = ["11111 10001 11111", "00100 11001 00100", "00100 10101 00100", "00100 10011 00100", "00100 10001 00100"]
        for j, row in enumerate(word):
            for k, bit in enumerate(row.replace(" ", "0")):
                if bit == "1":
                    m = (X == 7 + k) & (Y == 13 + j)
                    t.put(m, rgb("#2c2426"))
    else:
        c = Cells(np.array([(4 + 8 * i, 4 + 8 * j) for j in range(4) for i in range(4)], float))
        t.fill(np.clip(.62 - .05 * (c.vx + c.vy), 0, .99), ramp("#cc3428", .2, .16, 7), 0)
        t.put(c.f1 > 4, rgb("#4a1412"))
        t.shade(c.f1 < 2, ramp("#d8cfc0" if part == "top" else "#a08a70", .1, .1, 5), np.full_like(X, .5))
        t.h = 2 * ss(5, 1, c.f1)
    return t


def daylight(name, part):
    t = planks("oak_planks", "#8a6a42")
    if part == "side":
        return t
    inner = D >= 3
    c = ramp("#c8b070" if part == "top" else "#6a7aa8", .2, .16, 7)
    g = (X % 7 == 3) | (Y % 7 == 3)
    t.shade(inner, c, np.clip(.7 - .02 * ((X % 7) + (Y % 7)) - .3 * g, 0, .99), r=.15, h=1.)
    return t


def bars(name):
    t = sprite(name, .4)
    iron = ramp("#868890", .2, .18, 7)
    for x in (0, 8, 16, 24, 32): # one in the middle, where a lone bar and the ends of a run stand
        m = (np.abs(X - x + .5) < 1.6)
        t.shade(m, iron, np.clip(.62 - .16 * (X - x + .5), 0, .99), h=1.4)
    for y in (3, 16, 28):
        m = np.abs(Y - y) < 1.1
        t.shade(m, iron, np.clip(.66 - .16 * (Y - y), 0, .99), h=2.)
    return t


def command(name, color, front):
    t = plate(name, color, .5, kind="flat")
    m = (CHEB < 9)
    t.shade(m, ramp(mix(color, "#20242c", .6), .12, .12, 6), np.clip(.55 - .02 * (CX + CY), 0, .99), h=.6)
    dot = (np.abs(((X + 1) % 6) - 3) < 1.2) & (np.abs(((Y + 1) % 6) - 3) < 1.2) & (CHEB < 8)
    if front:
        dot = (EUC < 6) & (EUC > 2.5)
    t.put(dot, lift(color, .2))
    t.glow(dot, .6)
    return t


def hopper(name, top):
    t = plate(name, "#565860", .5)
    if top:
        opening(t, (CHEB < 12) & (CHEB > 2))
        t.shade(CHEB <= 11, ramp("#3a3b42", .16, .14, 6), np.clip(.3 + .04 * CHEB, 0, .99), h=-1.)
    return t


for _n, _kw in {"rail": {}, "rail_corner": dict(corner=True), "powered_rail": dict(kind="powered"), "powered_rail_on": dict(kind="powered", on=True),
                "detector_rail": dict(kind="detector"), "detector_rail_on": dict(kind="detector", on=True),
                "activator_rail": dict(kind="activator"), "activator_rail_on": dict(kind="activator", on=True)}.items():
    add(_n, rail, **_kw)
add("redstone_dust", dust)
add("repeater", repeater, False)
add("repeater_on", repeater, True)
add("comparator", repeater, False, True)
add("comparator_on", repeater, True, True)
add("lever", lever)
for _k in ("furnace", "smoker", "blast_furnace"):
    for _p in ("side", "top", "front"):
        add(f"{_k}_{_p}", furnace, _p, _k)
    add(_k + "_front_on", furnace, "front", _k, True)
add("smoker_bottom", furnace, "side", "furnace")
for _k in ("dispenser", "dropper"):
    add(_k + "_front", dispenser, _k)
    add(_k + "_front_vertical", dispenser, "vertical")
for _p in ("front", "back", "side"):
    add("observer_" + _p, observer, _p)
add("piston_top", piston, "top")
add("piston_top_sticky", piston, "sticky")
add("piston_side", piston, "side")
add("piston_bottom", piston, "bottom")
add("target_side", target, False)
add("target_top", target, True)
for _p in ("side", "top", "bottom"):
    add("tnt_" + _p, tnt, _p)
add("daylight_detector_top", daylight, "top")
add("daylight_detector_inverted_top", daylight, "night")
add("daylight_detector_side", daylight, "side")
add("hopper_side", hopper, False)
add("hopper_top", hopper, True)
add("iron_bars", bars)
for _k, _c in (("command_block", "#b8855a"), ("chain_command_block", "#6aa890"), ("repeating_command_block", "#8a72b8")):
    add(_k + "_front", command, _c, True)
    add(_k + "_side", command, _c, False)
add("structure_block", command, "#7a6a8a", True)
add("crafter_side", lambda name: opening(machine(name, "#7d7670"), (CHEB < 8) & ((X + Y) % 6 < 2)))
add("crafter_top", lambda name: opening(machine(name, "#7d7670"), (CHEB < 11) & (X % 7 > 1) & (Y % 7 > 1)))
