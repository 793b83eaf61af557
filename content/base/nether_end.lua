-- The Nether and the End.

block("netherrack", merge(STONE, { texture = "netherrack", hardness = 0.4 }))
for _, wood in ipairs { "crimson", "warped" } do
  block(wood .. "_nylium", merge(STONE, { texture = { wood .. "_nylium_side", wood .. "_nylium", "netherrack" }, hardness = 0.4 }))
  plant(wood .. "_fungus")
  plant(wood .. "_roots", { replaceable = true })
  potted(wood .. "_fungus")
  block("potted_" .. wood .. "_roots", merge(DECOR, { shape = "boxes", texture = "flower_pot", hardness = 0, boxes = {
    { 5, 0, 5, 11, 6, 11 }, { 3, 6, 8, 13, 16, 8, wood .. "_roots" }, { 8, 6, 3, 8, 16, 13, wood .. "_roots" } } }))
end
block("nether_wart_block", { texture = "nether_wart_block", material = "plant", hardness = 1 })
block("warped_wart_block", { texture = "warped_wart_block", material = "plant", hardness = 1 })
plant("nether_sprouts", { replaceable = true })
plant("nether_wart", { shape = "crop", texture = "nether_wart_stage0", variants = {
  ["age=1"] = { texture = "nether_wart_stage1" }, ["age=2"] = { texture = "nether_wart_stage1" }, ["age=3"] = { texture = "nether_wart_stage2" } } },
  "age:0-3")
for _, v in ipairs { { "weeping_vines", "age:0-25" }, { "twisting_vines", "age:0-25" } } do
  plant(v[1], { climbable = true }, v[2])
  plant(v[1] .. "_plant", { climbable = true })
end

block("soul_sand", { texture = "soul_sand", material = "sand", hardness = 0.5 })
block("soul_soil", { texture = "soul_soil", material = "dirt", hardness = 0.5 })
block("magma_block", merge(STONE, { texture = "magma_block", hardness = 0.5, light = { 4, 2, 0 } }))
define_texture("magma_block", { frame_time = 8 })

pillar("basalt", { "basalt_side", "basalt_top" }, merge(STONE, { hardness = 1.25 }))
pillar("polished_basalt", { "polished_basalt_side", "polished_basalt_top" }, merge(STONE, { hardness = 1.25 }))
block("smooth_basalt", merge(STONE, { texture = "smooth_basalt", hardness = 1.25 }))

stone_family("blackstone", "slab stairs wall", { texture = { "blackstone", "blackstone_top" } })
stone_family("polished_blackstone", "slab stairs wall button pressure_plate", { hardness = 2 })
stone_family("polished_blackstone_bricks", "slab stairs wall")
for _, name in ipairs { "chiseled_polished_blackstone", "cracked_polished_blackstone_bricks", "gilded_blackstone" } do
  block(name, merge(STONE, { texture = name }))
end

stone_family("nether_bricks", "slab stairs wall", { hardness = 2 })
fence("nether_brick_fence", "nether_bricks", merge(STONE, { hardness = 2 }))
stone_family("red_nether_bricks", "slab stairs wall", { hardness = 2 })
block("cracked_nether_bricks", merge(STONE, { texture = "cracked_nether_bricks", hardness = 2 }))
block("chiseled_nether_bricks", merge(STONE, { texture = "chiseled_nether_bricks", hardness = 2 }))

block("end_stone", merge(STONE, { texture = "end_stone", hardness = 3 }))
stone_family("end_stone_bricks", "slab stairs wall", { hardness = 3 })
stone_family("purpur_block", nil)
shapes_of("purpur", "slab stairs", nil, "purpur_block")
pillar("purpur_pillar", { "purpur_pillar", "purpur_pillar_top" }, STONE)

local arms = {}
for side, box in pairs { north = { 4, 4, 0, 12, 12, 4 }, south = { 4, 4, 12, 12, 12, 16 }, west = { 0, 4, 4, 4, 12, 12 },
  east = { 12, 4, 4, 16, 12, 12 }, up = { 4, 12, 4, 12, 16, 12 }, down = { 4, 0, 4, 12, 4, 12 } } do arms[side] = box end
-- Every set of arms is written out, so that the shape needs no rule of its own.
local variants = {}
local order = { "north", "east", "south", "west", "up", "down" }
for mask = 0, 63 do
  local key, boxes = {}, { { 4, 4, 4, 12, 12, 12 } }
  for i, side in ipairs(order) do
    local on = (mask >> (i - 1)) & 1 == 1
    key[i] = side .. "=" .. tostring(on)
    if on then boxes[#boxes + 1] = arms[side] end
  end
  variants[table.concat(key, ",")] = { boxes = boxes }
end
block("chorus_plant", { shape = "boxes", texture = "chorus_plant", material = "plant", hardness = 0.4, opacity = 0,
  boxes = { { 4, 4, 4, 12, 12, 12 } }, variants = variants }, SIDES6)
block("chorus_flower", { shape = "boxes", texture = "chorus_flower", material = "plant", hardness = 0.4, opacity = 0,
  boxes = { { 2, 2, 2, 14, 14, 14 }, { 0, 4, 4, 16, 12, 12 }, { 4, 4, 0, 12, 12, 16 }, { 4, 0, 4, 12, 16, 12 } } }, "age:0-5")

block("end_rod", merge(DECOR, { shape = "boxes", texture = "end_rod", light = 14, hardness = 0,
  boxes = { { 6, 0, 6, 10, 1, 10 }, { 7, 1, 7, 9, 16, 9 } }, variants = turned6 { { 6, 6, 15, 10, 10, 16 }, { 7, 7, 0, 9, 9, 15 } } }), "facing_up")
block("dragon_egg", { shape = "boxes", texture = "dragon_egg", material = "stone", hardness = 3, opacity = 0, light = 1,
  boxes = { { 6, 15, 6, 10, 16, 10 }, { 5, 13, 5, 11, 15, 11 }, { 3, 8, 3, 13, 13, 13 }, { 1, 3, 1, 15, 8, 15 }, { 3, 0, 3, 13, 3, 13 } } })
block("end_portal_frame", { shape = "boxes", texture = { "end_portal_frame_side", "end_portal_frame_top", "end_stone" }, material = "stone",
  hardness = -1, opacity = 0, light = 1, boxes = { { 0, 0, 0, 16, 13, 16 } },
  variants = { ["eye=true"] = { boxes = { { 0, 0, 0, 16, 13, 16 }, { 4, 13, 4, 12, 16, 12, "end_portal_frame_eye" } } } } }, "eye? facing")
block("respawn_anchor", { texture = { "respawn_anchor_side", "respawn_anchor_top", "crying_obsidian" }, material = "stone", hardness = 50,
  variants = { ["charges=1"] = { light = 3 }, ["charges=2"] = { light = 7 }, ["charges=3"] = { light = 11 }, ["charges=4"] = { light = 15 } } },
  "charges:0-4")
block("lodestone", merge(METAL, { texture = { "lodestone_side", "lodestone_top" }, hardness = 3.5 }))
