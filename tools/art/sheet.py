"""Pictures for looking at the art: contact sheets, 3 x 3 tilings."""
import numpy as np
from PIL import Image, ImageDraw

from noise import N
from tex import paint, stacked

# Gray textures are shown under the tint they are made for.
TINTS = {"grass": (124, 172, 74), "foliage": (104, 152, 56), "water": (58, 122, 196)}


def tint_of(name):
    if name in ("grass_block_top", "short_grass", "fern", "sugar_cane") or name.startswith(("tall_grass", "large_fern")):
        return TINTS["grass"]
    if name in ("oak_leaves", "jungle_leaves", "acacia_leaves", "dark_oak_leaves", "mangrove_leaves", "vine"):
        return TINTS["foliage"]
    if name.startswith("water_") or name == "cauldron_water":
        return TINTS["water"]
    if name == "lily_pad":
        return (96, 150, 72)
    if "jungle_grass" in name and "block" not in name:
        return (74, 160, 48)
    if "savanna_grass" in name and "block" not in name:
        return (186, 168, 84)
    if name == "redstone_dust":
        return (200, 30, 10)
    return None


def picture(name, frame=0, tinted=True):
    rgba = stacked(paint(name))[0][frame * N:(frame + 1) * N].astype(float)
    t = tint_of(name) if tinted else None
    if t:
        rgba[..., :3] *= np.array(t) / 255
    return Image.fromarray(rgba.astype(np.uint8))


def contact(names, path, scale=4, columns=14, per=126):
    for part in range(0, len(names), per):
        some = names[part:part + per]
        cell_w, cell_h = N * scale + 6, N * scale + 16
        rows = -(-len(some) // columns)
        sheet = Image.new("RGB", (columns * cell_w, rows * cell_h), (88, 98, 112))
        draw = ImageDraw.Draw(sheet)
        for k, name in enumerate(some):
            x, y = (k % columns) * cell_w + 3, (k // columns) * cell_h + 2
            p = picture(name).resize((N * scale, N * scale), Image.NEAREST)
            sheet.paste(p, (x, y), p)
            draw.text((x, y + N * scale), name[-22:], fill=(235, 235, 235))
        out = path if len(names) <= per else path.replace(".png", f"_{part // per}.png")
        sheet.save(out)
        print(out)


def tiled(names, path, scale=3, columns=6, reps=3):
    size = N * reps * scale
    rows = -(-len(names) // columns)
    sheet = Image.new("RGB", (columns * (size + 6), rows * (size + 6)), (88, 98, 112))
    for k, name in enumerate(names):
        p = picture(name).resize((N * scale, N * scale), Image.NEAREST)
        for j in range(reps):
            for i in range(reps):
                sheet.paste(p, ((k % columns) * (size + 6) + i * N * scale, (k // columns) * (size + 6) + j * N * scale), p)
    sheet.save(path)
    print(path)
