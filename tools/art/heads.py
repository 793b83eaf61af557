"""Heads. A head is half a block wide and a box shows the part of the tile it covers: low in the tile for a head on the ground,
half way up for one on a wall."""
import numpy as np

from color import lift, ramp, rgb
from noise import X, Y, fbm, value
from tex import Tex, add

HEADS = {"skeleton_skull": ("#c8c8c4", "#26262a", "bone"), "wither_skeleton_skull": ("#2f3032", "#0a0a0c", "bone"), "zombie_head": ("#5f8a4c", "#16241a", "flesh"),
         "player_head": ("#b8866a", "#3a4a9a", "flesh"), "creeper_head": ("#62b04c", "#0e1a10", "creep"), "dragon_head": ("#1e1b22", "#c060e8", "flesh"),
         "piglin_head": ("#e0a070", "#2a1a16", "flesh")}


def head(name, base, dark, kind, front, on_wall=False):
    if on_wall:
        t = head(name.replace("_wall", ""), base, dark, kind, front)
        t.rgb, t.h = np.roll(t.rgb, -8, 0), np.roll(t.h, -8, 0)
        t.e = None if t.e is None else np.roll(t.e, -8, 0)
        return t
    t = Tex(name, .85)
    g = value(name.rsplit("_", 1)[0], 16, 16) if kind == "creep" else fbm(name.rsplit("_", 1)[0], 8, 8, 2)
    t.fill(np.clip(.56 + .25 * g, 0, .99), ramp(base, .14, .12, 7), 0 if kind == "creep" else 1)
    if front:
        x, y = (X + 8) % 16, Y % 16
        cx = np.abs(x - 7.5)
        if kind == "creep":
            m = ((cx > 1) & (cx < 6) & (y >= 4) & (y < 8)) | ((cx < 2) & (y >= 8) & (y < 13)) | ((cx < 4) & (y >= 9) & (y < 15) & ~((cx < 2) & (y > 12)))
        elif kind == "bone":
            m = ((cx > 1.2) & (cx < 5.5) & (y >= 6) & (y < 9)) | ((cx < 1) & (y == 10)) | ((y == 13) & (cx < 6))
        else:
            m = ((cx > 1.4) & (cx < 4.6) & (y >= 7) & (y < 9)) | ((y == 13) & (cx < 3))
        t.put(m, rgb(dark), h=-1.)
        if name == "dragon_head_front":
            t.glow(m, .9)
        if name == "player_head_front":
            t.put((y < 4), rgb("#4a2f1c"))
    elif name == "player_head_side":
        t.put((Y % 16) < 6, rgb("#4a2f1c"))
    t.h = t.h + .4 * g
    return t


for _n, (_b, _d, _k) in HEADS.items():
    for _w in ("", "_wall"):
        add(f"{_n}{_w}_front", head, _b, _d, _k, True, _w != "")
        add(f"{_n}{_w}_side", head, _b, _d, _k, False, _w != "")
