-- What a house and a village are fitted with.

local function wood(name, texture, props, more) block(name, merge(WOOD, { texture = texture, hardness = 2.5 }, more), props) end

wood("crafting_table", { "crafting_table_front", "crafting_table_side", "crafting_table_top", "oak_planks" })
wood("cartography_table", { "cartography_table_front", "cartography_table_side", "cartography_table_top", "dark_oak_planks" })
wood("fletching_table", { "fletching_table_front", "fletching_table_side", "fletching_table_top", "birch_planks" })
wood("smithing_table", { "smithing_table_front", "smithing_table_side", "smithing_table_top", "smithing_table_bottom" })
wood("loom", { "loom_front", "loom_side", "loom_top", "oak_planks" }, "facing")
wood("bookshelf", { "bookshelf", "oak_planks" }, nil, { hardness = 1.5 })
wood("chiseled_bookshelf", { "chiseled_bookshelf_front", "chiseled_bookshelf_side", "chiseled_bookshelf_top", "chiseled_bookshelf_top" },
  "facing slot_0_occupied? slot_1_occupied? slot_2_occupied? slot_3_occupied? slot_4_occupied? slot_5_occupied?", { hardness = 1.5 })
wood("barrel", { "barrel_top", "barrel_bottom", "barrel_side", "barrel_side", "barrel_side" }, "facing6 open?")
wood("composter", { "composter_side", "composter_top", "composter_side" }, "level:0-8",
  { shape = "boxes", opacity = 0, hardness = 0.6, boxes = { { 0, 0, 0, 16, 2, 16 }, { 0, 2, 0, 2, 16, 16 }, { 14, 2, 0, 16, 16, 16 }, { 2, 2, 0, 14, 16, 2 },
    { 2, 2, 14, 14, 16, 16 } } })
wood("beehive", { "beehive_front", "beehive_side", "beehive_end", "beehive_end" }, "facing honey_level:0-5", { hardness = 0.6 })
wood("bee_nest", { "bee_nest_front", "bee_nest_side", "bee_nest_top", "bee_nest_bottom" }, "facing honey_level:0-5", { hardness = 0.3 })
block("honeycomb_block", { texture = "honeycomb_block", material = "plant", hardness = 0.6 })
block("honey_block", { texture = "honey_block", shape = "boxes", boxes = { { 1, 0, 1, 15, 15, 15 } }, layer = "translucent", transparency = 0.4,
  opacity = 0, material = "plant", hardness = 0, viscosity = 0.4, ior = 1.48 })
block("slime_block", { texture = "slime_block", layer = "translucent", transparency = 0.4, opacity = 0, material = "plant", hardness = 0 })

-- Furnaces and their kin: dark until lit.
for _, f in ipairs { "furnace", "smoker", "blast_furnace" } do
  local rest = { f .. "_side", f .. "_top", f == "smoker" and "smoker_bottom" or f .. "_top" }
  block(f, merge(STONE, { texture = { f .. "_front", rest[1], rest[2], rest[3] }, hardness = 3.5,
    variants = { ["lit=true"] = { texture = { f .. "_front_on", rest[1], rest[2], rest[3] }, light = { 13, 9, 4 } } } }), "facing lit?")
end

for _, c in ipairs { { "chest", "chest" }, { "trapped_chest", "chest" }, { "ender_chest", "ender_chest" } } do
  local t = c[2]
  local ender = c[1] == "ender_chest"
  block(c[1], merge(ender and STONE or WOOD, { shape = "chest", texture = { t .. "_front", t .. "_side", t .. "_top", t .. "_top" }, opacity = 0,
    hardness = ender and 22.5 or 2.5, light = ender and { 3, 6, 6 } or 0 }), ender and "facing wl" or "facing type=single|left|right wl")
end

block("ladder", merge(DECOR, { shape = "ladder", texture = "ladder", material = "wood", climbable = true, hardness = 0.4 }), "facing wl")
block("scaffolding", merge(DECOR, { shape = "boxes", texture = { "scaffolding_side", "scaffolding_top" }, material = "wood", climbable = true, hardness = 0,
  boxes = { { 0, 14, 0, 16, 16, 16 }, { 0, 0, 0, 2, 14, 2 }, { 14, 0, 0, 16, 14, 2 }, { 0, 0, 14, 2, 14, 16 }, { 14, 0, 14, 16, 14, 16 } } }),
  "bottom? distance:0-7 wl")

local lectern = { { 0, 0, 0, 16, 2, 16 }, { 4, 2, 4, 12, 13, 12 }, { 0, 12, 1, 16, 16, 15, "lectern_top" } }
block("lectern", merge(WOOD, { shape = "boxes", texture = "lectern_side", opacity = 0, hardness = 2.5, boxes = lectern, variants = turned(lectern) }),
  "facing has_book? powered?")
local grind = { { 2, 4, 2, 14, 16, 14, "grindstone_side" }, { 0, 0, 6, 2, 13, 10 }, { 14, 0, 6, 16, 13, 10 } }
block("grindstone", merge(STONE, { shape = "boxes", texture = "dark_oak_planks", opacity = 0, hardness = 2, boxes = grind, variants = turned(grind) }),
  "face facing")
local saw = { { 0, 0, 0, 16, 9, 16 }, { 1, 9, 8, 15, 16, 8, "stonecutter_saw" } }
block("stonecutter", merge(STONE, { shape = "boxes", texture = { "stonecutter_side", "stonecutter_top", "furnace_top" }, layer = "cutout", opacity = 0,
  hardness = 3.5, boxes = saw, variants = turned(saw) }), "facing")
local anvil = { { 2, 0, 2, 14, 4, 14 }, { 4, 4, 3, 12, 5, 13 }, { 6, 5, 4, 10, 10, 12 }, { 3, 10, 0, 13, 16, 16 } }
for _, a in ipairs { "anvil", "chipped_anvil", "damaged_anvil" } do
  block(a, merge(METAL, { shape = "boxes", texture = { "anvil", a .. "_top", "anvil" }, opacity = 0, boxes = anvil, variants = turned(anvil) }), "facing")
end
local pan = { { 0, 3, 0, 16, 4, 16 }, { 0, 4, 0, 2, 16, 16 }, { 14, 4, 0, 16, 16, 16 }, { 2, 4, 0, 14, 16, 2 }, { 2, 4, 14, 14, 16, 16 },
  { 0, 0, 0, 4, 3, 4 }, { 12, 0, 0, 16, 3, 4 }, { 0, 0, 12, 4, 3, 16 }, { 12, 0, 12, 16, 3, 16 } }
local function filled(texture, y)
  local out = { table.unpack(pan) }
  out[#out + 1] = { 2, 4, 2, 14, y, 14, texture }
  return out
end
local kettle = merge(METAL, { shape = "boxes", texture = { "cauldron_side", "cauldron_top", "cauldron_side" }, opacity = 0, hardness = 2, boxes = pan })
block("cauldron", kettle)
block("lava_cauldron", merge(kettle, { boxes = filled("lava_still", 15), light = { 15, 10, 4 } }))
for _, c in ipairs { { "water_cauldron", "cauldron_water" }, { "powder_snow_cauldron", "powder_snow" } } do
  block(c[1], merge(kettle, { boxes = filled(c[2], 9), variants = { ["level=2"] = { boxes = filled(c[2], 12) }, ["level=3"] = { boxes = filled(c[2], 15) } } }),
    "level:1-3")
end
block("brewing_stand", merge(DECOR, { shape = "boxes", texture = "smooth_stone", light = 1, boxes = { { 7, 2, 7, 9, 14, 9, "blaze_rod" }, { 9, 0, 5, 15, 2, 11 },
  { 2, 0, 1, 8, 2, 7 }, { 2, 0, 9, 8, 2, 15 } } }), "has_bottle_0? has_bottle_1? has_bottle_2?")
block("enchanting_table", merge(STONE, { shape = "boxes", texture = { "enchanting_table_side", "enchanting_table_top", "obsidian" }, opacity = 0,
  hardness = 5, light = 7, boxes = { { 0, 0, 0, 16, 12, 16 } } }))
block("beacon", merge(GLASS, { shape = "boxes", texture = "glass", light = 15, hardness = 3, boxes = { { 0, 0, 0, 16, 16, 16 }, { 2, 0.1, 2, 14, 3, 14, "obsidian" },
  { 3, 3, 3, 13, 14, 13, "beacon" } } }))
block("conduit", merge(DECOR, { shape = "boxes", texture = "conduit", light = 15, boxes = { { 5, 5, 5, 11, 11, 11 } }, hardness = 3 }), "wl")
block("bell", merge(METAL, { shape = "boxes", texture = "bell", opacity = 0, boxes = { { 5, 6, 5, 11, 13, 11 }, { 4, 4, 4, 12, 6, 12 },
  { 7, 13, 7, 9, 16, 9, "dark_oak_planks" } } }), "attachment=floor|ceiling|single_wall|double_wall facing powered?")
block("spawner", merge(METAL, { texture = "spawner", layer = "cutout", opacity = 1, light = 1 }))
block("trial_spawner", merge(STONE, { texture = { "trial_spawner_side", "trial_spawner_top", "tuff_bricks" }, hardness = 50, light = 4 }),
  "ominous? trial_spawner_state=inactive|waiting_for_players|active|waiting_for_reward_ejection|ejecting_reward|cooldown")
block("vault", merge(STONE, { texture = { "vault_front", "vault_side", "vault_top", "vault_top" }, hardness = 50, light = 6 }),
  "facing ominous? vault_state=inactive|active|unlocking|ejecting")
block("heavy_core", merge(METAL, { shape = "boxes", texture = "heavy_core", opacity = 0, boxes = { { 4, 0, 4, 12, 8, 12 } } }), "wl")
block("decorated_pot", merge(DECOR, { shape = "boxes", texture = { "decorated_pot_side", "decorated_pot_top" }, hardness = 0,
  boxes = { { 1, 0, 1, 15, 16, 15 } } }), "cracked? facing wl")
block("flower_pot", merge(DECOR, { shape = "boxes", texture = "flower_pot", hardness = 0, boxes = { { 5, 0, 5, 11, 6, 11 } } }))
potted("cactus", "cactus_side")
block("cake", merge(DECOR, { shape = "boxes", texture = { "cake_side", "cake_top", "cake_bottom" }, material = "wool", boxes = { { 1, 0, 1, 15, 8, 15 } },
  variants = (function()
    local v = {}
    for i = 1, 6 do v["bites=" .. i] = { boxes = { { 1 + 2 * i, 0, 1, 15, 8, 15 } } } end
    return v
  end)() }), "bites:0-6")
block("bone_block", { texture = { "bone_block_side", "bone_block_top" }, shape = "pillar", material = "stone", hardness = 2 }, "axis")
block("resin_block", merge(STONE, { texture = "resin_block", hardness = 0 }))
stone_family("resin_bricks", "slab stairs wall")
block("chiseled_resin_bricks", merge(STONE, { texture = "chiseled_resin_bricks" }))
block("creaking_heart", merge(WOOD, { shape = "pillar", texture = { "creaking_heart", "creaking_heart_top" }, hardness = 10 }), "axis creaking? natural?")

-- Heads: a box on the floor, or half way up a wall.
for _, head in ipairs { "skeleton_skull", "wither_skeleton_skull", "zombie_head", "player_head", "creeper_head", "dragon_head", "piglin_head" } do
  local kind = string.match(head, "^(.*)_[^_]+$")
  local part = string.match(head, "_([^_]+)$")
  local t = { head .. "_front", head .. "_side", head .. "_side", head .. "_side" }
  local ways = by_rotation(function(facing)
    local f, s = t[1], t[2]
    local function at(side) return side == facing and f or s end
    return { texture = { at "west", at "east", s, s, at "north", at "south" } }
  end)
  block(head, merge(DECOR, { shape = "boxes", texture = t, hardness = 1, boxes = { { 4, 0, 4, 12, 8, 12 } }, variants = ways }),
    "powered? rotation:0-15")
  local on_wall, w = { { 4, 4, 8, 12, 12, 16 } }, head .. "_wall"
  local hung = { w .. "_front", w .. "_side", w .. "_side", w .. "_side" }
  block(kind .. "_wall_" .. part, merge(DECOR, { shape = "boxes", texture = hung, hardness = 1, boxes = on_wall, variants = turned(on_wall) }), "facing powered?")
end
