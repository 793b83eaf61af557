-- What our own terrain is made of and Minecraft has no name for.

local function V(name) return "vitrail:" .. name end

-- Rock.
for _, name in ipairs { "marble", "slate" } do
  stone_family(V(name), "slab stairs wall")
  stone_family(V("polished_" .. name), "slab stairs")
end
stone_family(V("cobbled_slate"), "slab stairs wall", { hardness = 2 })
stone_family(V("marble_bricks"), "slab stairs wall")
stone_family(V("slate_bricks"), "slab stairs wall")
block(V("quartz_rock"), merge(STONE, { texture = "quartz_rock", hardness = 0.8 }))
block(V("smooth_sand"), { texture = "smooth_sand", material = "sand", hardness = 0.5 })
for _, kind in ipairs { "warped", "amber" } do
  block(V(kind .. "_deepslate"), merge(STONE, { texture = { kind .. "_deepslate_side", kind .. "_deepslate_top", "deepslate_top" }, hardness = 3 }))
  block(V(kind .. "_blackstone"), merge(STONE, { texture = { kind .. "_blackstone_side", kind .. "_blackstone_top", "blackstone_top" } }))
end

-- Grasses keep their own color where biomes meet, so they are blocks rather than tints.
for _, g in ipairs { { "jungle", { 74, 160, 48 } }, { "savanna", { 186, 168, 84 } } } do
  block(V(g[1] .. "_grass_block"), { texture = { g[1] .. "_grass_block_side", "grass_block_top", "dirt" }, tint = g[2], tint_faces = "top",
    material = "dirt", hardness = 0.6, variants = GRASS_SNOWY }, "snowy?")
  plant(V(g[1] .. "_grass"), { tint = g[2], replaceable = true })
  tall_plant(V("tall_" .. g[1] .. "_grass"), { tint = g[2], replaceable = true })
end

-- Crystals: solid prisms that let light through and give back a little of their own.
for _, c in ipairs { { "magenta", { 15, 9, 15 } }, { "cyan", { 9, 14, 15 } }, { "green", { 9, 15, 10 } } } do
  local name = c[1] .. "_crystal"
  block(V(name), { texture = name, material = "crystal", layer = "translucent", transparency = 0.45, opacity = 1, hardness = 1.5, light = c[2] })
  local shard = { material = "crystal", collision = false, sway = false, light = { c[2][1] // 2, c[2][2] // 2, c[2][3] // 2 } }
  plant(V(name .. "_shard"), shard)
  plant(V("hanging_" .. name .. "_shard"), shard)
end

-- Stormlight: a shell of dark glass around charged cores.
block(V("stormlight"), { texture = "stormlight", material = "crystal", hardness = 1, light = { 13, 15, 15 } })
define_texture("stormlight", { frame_time = 3 })
block(V("stormlight_shell"), merge(STONE, { texture = "stormlight_shell", light = { 11, 13, 15 } }))
plant(V("stormlight_tendril"), { sway = false, light = { 4, 6, 8 } })

-- Trees.
for _, wood in ipairs { "redwood", "palm", "cypress" } do
  log_family(V(wood), "log", "wood")
  plank_family(V(wood))
end
for _, name in ipairs { "redwood", "cypress", "palm", "pine", "shrub", "yellow_birch", "orange_birch", "rafflesia" } do leaves(V(name .. "_leaves")) end
for _, wood in ipairs { "redwood", "palm", "cypress" } do plant(V(wood .. "_sapling"), nil, "stage:0-1") end

-- The rafflesia and the giant mushrooms.
block(V("rafflesia_petal"), { texture = "rafflesia_petal", material = "plant", hardness = 0.4 })
block(V("rafflesia_core"), { texture = "rafflesia_core", material = "plant", hardness = 0.4, light = { 6, 3, 1 } })
pillar(V("rafflesia_stem"), { "rafflesia_stem", "rafflesia_stem_top" }, { material = "plant" })
block(V("purple_mushroom_block"), { texture = "purple_mushroom_block", material = "plant", hardness = 0.2 })
block(V("purple_mushroom_gills"), { texture = "purple_mushroom_gills", material = "plant", hardness = 0.2, light = { 6, 3, 8 } })
pillar(V("purple_mushroom_stem"), { "purple_mushroom_stem", "purple_mushroom_stem_top" }, { material = "plant", hardness = 0.2 })
plant(V("purple_mushroom"), { light = { 3, 1, 4 } })
plant(V("blue_mushroom"), { light = { 1, 2, 4 } })

-- The amber forest, the warm twin of the warped one.
log_family(V("amber"), "stem", "hyphae", { light = { 1, 1, 0 } })
plank_family(V("amber"))
block(V("amber_wart_block"), { texture = "amber_wart_block", material = "plant", hardness = 1 })
plant(V("amber_fungus"), { light = { 3, 2, 0 } })
plant(V("amber_roots"), { replaceable = true })
plant(V("amber_sprouts"), { replaceable = true })

-- Small plants of our own biomes.
for _, name in ipairs { "desert_scrub", "golden_fern", "heather", "cattail", "ice_flower", "swamp_iris" } do plant(V(name)) end
