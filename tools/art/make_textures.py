#!/usr/bin/env python3
"""Paints every texture of the base content. Same bytes every run.

    make_textures.py [--only GLOB] [--out FOLDER] [--sheet FILE.png] [--tile NAME,NAME... FILE.png]
"""
import argparse
import fnmatch
import importlib
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True

MODULES = ["stone", "masonry", "soil", "minerals", "wood", "joinery", "leaves", "plants", "flowers", "crops", "fungi", "water_plants",
           "fluids", "colored", "metal", "nether", "lights", "redstone", "furniture", "household", "heads", "crystals"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--only", default="*")
    parser.add_argument("--out", default=os.path.join(HERE, "../../content/base/textures"))
    parser.add_argument("--sheet")
    parser.add_argument("--tile", nargs=2)
    args = parser.parse_args()
    for module in MODULES:
        if os.path.exists(os.path.join(HERE, module + ".py")):
            importlib.import_module(module)
    import sheet
    from tex import REGISTRY, paint, save
    names = sorted(n for n in REGISTRY if any(fnmatch.fnmatch(n, p) for p in args.only.split(",")))
    if args.sheet:
        return sheet.contact(names, args.sheet)
    if args.tile:
        return sheet.tiled(args.tile[0].split(","), args.tile[1])
    os.makedirs(args.out, exist_ok=True)
    written = []
    for name in names:
        written += save(name, paint(name), args.out)
    if args.only == "*":
        for stale in set(f for f in os.listdir(args.out) if f.endswith(".png")) - set(written):
            os.remove(os.path.join(args.out, stale))
    size = sum(os.path.getsize(os.path.join(args.out, f)) for f in written)
    print(f"{len(names)} textures, {len(written)} files, {size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
