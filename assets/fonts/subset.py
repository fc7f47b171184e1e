#!/usr/bin/env python3
"""Makes the faces that stand in where Inter has no sign: subset.py INTER EGUI

INTER is the folder `Inter (web)` of the npm package inter-ui 3.19.3, EGUI the folder `fonts` of the crate
epaint_default_fonts 0.37. Needs `pip install fonttools brotli`. The signs are those of every scene's and body's name that a
person may write, and those that Regatta writes; a test of `view::theme` says which sign is missing.
"""

import sys
from pathlib import Path

from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont

ASCII = range(0x20, 0x7F)
LATIN = range(0xA0, 0x180)
GREEK = range(0x370, 0x400)
CYRILLIC = range(0x400, 0x500)
RUSSIAN_AND_NEIGHBOURS = [*range(0x400, 0x460), 0x490, 0x491]


def characters(font):
    return set(font.getBestCmap())


def write(source, wanted, target):
    options = Options()
    options.hinting = options.notdef_outline = False
    options.desubroutinize = True
    options.layout_features = []
    options.name_IDs = []
    options.drop_tables += ["TTFA"]
    font = TTFont(source, recalcTimestamp=False)
    subsetter = Subsetter(options)
    subsetter.populate(unicodes=characters(font) & wanted)
    subsetter.subset(font)
    font.flavor = None
    font.save(target)


inter, egui = map(Path, sys.argv[1:])
here = Path(__file__).parent
ours = characters(TTFont(here / "Inter-Regular.otf"))
names = {*LATIN, *GREEK, *CYRILLIC, *map(ord, "ℓ⅓⅛")}
write(inter / "Inter-Regular.woff2", names - ours, here / "Names-Regular.ttf")
# What is quoted from a file, in one width.
quoted = {*ASCII, *LATIN, *GREEK, *RUSSIAN_AND_NEIGHBOURS, *map(ord, "⅔∛⌈⌉⌊")}
write(egui / "Hack-Regular.ttf", quoted, here / "Quoted-Regular.ttf")
write(egui / "emoji-icon-font.ttf", set(map(ord, "⏭⏮⏸")), here / "Transport.ttf")
