-- Trees, crystals, icebergs and the like: one candidate a cell of a grid, `padding` blocks from its edges, with a chance. What numbers
-- a shape takes stands in docs/terrain.md.

local function feature(name, shape, biome, cell, padding, chance, more)
  define_terrain_feature("vitrail:" .. name, merge({ shape = shape, biome = "vitrail:" .. biome, cell = cell, padding = padding, chance = chance }, more))
end

--- A log's three axes and leaves that never fall.
local function wood(log, leaf)
  return { trunk = log .. "[axis=y]", trunk_x = log .. "[axis=x]", trunk_z = log .. "[axis=z]", leaves = leaf .. "[persistent=true]" }
end
--- Grows where at least `thickness` blocks of one of these loose layers are on top.
local function on(layers, thickness, more) return merge({ layers = layers, least_thickness = thickness }, more) end
local DIRT = on("dirt", .5)

-- The sea. Kelp grows in the two seas that have no name for anything else, in at least 4 blocks of water.
feature("coral", "coral", "coral_reef", 5, 0, .65, on({ "sand", "smooth_sand" }, .3, { place = "sea_floor", highest_y = 121, blocks = {
  tube = "tube_coral_block", brain = "brain_coral_block", bubble = "bubble_coral_block", fire = "fire_coral_block", horn = "horn_coral_block" } }))
for _, sea in ipairs { "cool_ocean", "warm_ocean" } do
  feature("kelp_" .. sea, "kelp", sea, 5, 0, .5, { place = "sea_floor", water_depth = 4, blocks = { stalk = "kelp_plant", tip = "kelp" } })
end
feature("iceberg", "iceberg", "icebergs", 112, 6, .7, { place = "sea_floor", water_depth = 12,
  numbers = { radius_least = 20, radius_most = 32 }, blocks = { ice = "packed_ice", core = "blue_ice", snow = "snow_block" } })

-- Trees.
feature("acacia", "acacia", "savanna", 36, 4, .3, merge(DIRT, { blocks = wood("acacia_log", "acacia_leaves") }))
feature("redwood", "redwood", "redwood_forest", 16, 2, .7,
  merge(DIRT, { numbers = { height_least = 27, height_most = 40 }, blocks = wood("vitrail:redwood_log", "vitrail:redwood_leaves") }))
feature("cypress", "cypress", "swamp", 18, 3, .6, on({ "dirt", "mud" }, .5,
  { numbers = { branches_least = 6, branches_most = 10 }, blocks = wood("vitrail:cypress_log", "vitrail:cypress_leaves") }))
local birch = { numbers = { tall_share = .08, yellow_share = .1, orange_share = .1 }, blocks = { trunk = "birch_log[axis=y]",
  leaves = "birch_leaves[persistent=true]", leaves_yellow = "vitrail:yellow_birch_leaves[persistent=true]", leaves_orange = "vitrail:orange_birch_leaves[persistent=true]" } }
feature("birch_lush_birch_forest", "birch", "lush_birch_forest", 9, 2, .7, merge(DIRT, birch))
feature("birch_swamp", "birch", "swamp", 16, 2, .15, merge(on({ "dirt", "mud" }, .5), birch))
-- Conifers of the valleys, up to the tree line.
feature("conifer_mountains", "redwood", "mountains", 13, 2, .35, merge(DIRT, { highest_y = 188,
  numbers = { height_least = 15, height_most = 22, giant_share = 0 }, blocks = wood("spruce_log", "spruce_leaves") }))
-- Pines and shrubs cling to the bare sandstone of pillars.
feature("pine", "pine", "tianzi_mountains", 7, 1, .8, { blocks = wood("spruce_log", "vitrail:pine_leaves") })
feature("shrub", "shrub", "tianzi_mountains", 6, 1, .8,
  { blocks = { trunk = "spruce_log[axis=y]", leaves = "vitrail:shrub_leaves[persistent=true]" } })
local jungle = { blocks = wood("jungle_log", "jungle_leaves") }
feature("rafflesia", "rafflesia", "jungle", 54, 6, .5, merge(DIRT, { blocks = { stem = "vitrail:rafflesia_stem", petal = "vitrail:rafflesia_petal",
  core = "vitrail:rafflesia_core", leaves = "vitrail:rafflesia_leaves[persistent=true]" } }))
feature("jungle_tree_large", "jungle_tree", "jungle", 28, 3, .7, merge(DIRT, jungle))
feature("jungle_tree_small", "small_jungle_tree", "jungle", 10, 2, .82, merge(DIRT, jungle))
feature("jungle_tree_tiny", "small_jungle_tree", "jungle", 6, 1, .28, merge(on("dirt", .3), jungle,
  { numbers = { height_least = 2, height_most = 4, crown_least = 1.5, crown_most = 2.4 } }))
local palm = { blocks = wood("vitrail:palm_log", "vitrail:palm_leaves") }
feature("palm_tropical_beach", "palm", "tropical_beach", 48, 3, .35, merge(on("smooth_sand", .3), palm))
feature("palm_red_desert", "palm", "red_desert", 40, 3, .2, merge(on("red_sand", .3), palm))
feature("palm_oasis", "palm", "oasis", 24, 3, .35, merge(on({ "dirt", "sand" }, .3), palm))
feature("palm_desert", "palm", "desert", 64, 3, .3, merge(on("sand", .3), palm))

-- Cacti: most in the red desert, few where there is more rock than sand.
for biome, row in pairs { red_desert = { .7, "red_sand" }, desert = { .5, "sand" }, sparse_desert = { .2, "smooth_sand" }, mesa = { .3 } } do
  feature("cactus_" .. biome, "cactus", biome, 16, 2, row[1], { layers = row[2], least_thickness = row[2] and .3,
    numbers = { height_least = 7, height_most = 13 }, blocks = { body = "cactus" } })
end

-- Mushrooms and crystals.
local mushroom = { blocks = { stem = "vitrail:purple_mushroom_stem[axis=y]", stem_x = "vitrail:purple_mushroom_stem[axis=x]",
  stem_z = "vitrail:purple_mushroom_stem[axis=z]", cap = "vitrail:purple_mushroom_block", gills = "vitrail:purple_mushroom_gills" } }
feature("purple_mushroom_medium", "medium_mushroom", "purple_mushrooms", 10, 2, .5, merge(on("dirt", .3), mushroom))
-- Cells of 18, not 11: caps of this width overlapped threefold, and what was left below them was a wall of stems.
feature("purple_mushroom_large", "mushroom", "purple_mushrooms", 18, 3, .45,
  merge(DIRT, mushroom, { numbers = { cap_radius_least = 12, cap_radius_most = 19 } }))
local crystal = { first = "vitrail:magenta_crystal", second = "vitrail:cyan_crystal", third = "vitrail:green_crystal" }
feature("crystal_medium", "crystal", "crystals", 28, 6, .9, { highest_y = 179, blocks = crystal,
  numbers = { height_least = 8, height_most = 20, radius_least = 1.5, radius_most = 3, shards_least = 2, shards_most = 5 } })
feature("crystal_large", "crystal", "crystals", 52, 10, .8, { highest_y = 179, blocks = crystal })
-- Blades of ice break the white of the wasteland.
feature("ice_blades", "crystal", "frozen_wasteland", 60, 9, .55, merge(on("snow", .3), {
  blocks = { first = "packed_ice", second = "blue_ice", third = "packed_ice" },
  numbers = { height_least = 7, height_most = 20, radius_least = 1.5, radius_most = 3, shards_least = 3, shards_most = 7 } }))

-- Below ground; least_height is that of the cavern.
local stormlight = { core = "vitrail:stormlight", shell = "vitrail:stormlight_shell", cord = "vitrail:stormlight_tendril" }
feature("stormlight", "stormlight", "crystal_caves", 32, 4, .8, { place = "cave_floor", least_height = 4, blocks = stormlight })
feature("stormlight_hanging", "stormlight", "crystal_caves", 32, 4, .8, { place = "cave_ceiling", least_height = 4, blocks = stormlight, numbers = { hanging = 1 } })
feature("crystal_pillar", "crystal_pillar", "crystal_caves", 28, 5, .6, { place = "cave_floor", least_height = 10, blocks = crystal })
for biome, grid in pairs { crystal_caves = { 24, 3, .6 }, lush_caves = { 24, 3, .6 }, warped_forest = { 16, 3, .8 }, amber_forest = { 18, 3, .75 } } do
  feature("glowstone_cluster_" .. biome, "glowstone_cluster", biome, grid[1], grid[2], grid[3],
    { place = "cave_ceiling", least_height = 16, blocks = { glow = "glowstone" } })
end
feature("cave_vine", "cave_vine", "lush_caves", 4, 0, .4, { place = "cave_ceiling", least_height = 4,
  numbers = { length_least = 3, length_most = 15, glowing_share = .2 },
  blocks = { vine = "cave_vines_plant", glowing = "cave_vines_plant[berries=true]", tip = "cave_vines" } })
feature("warped_fungus", "fungus", "warped_forest", 7, 1, .75, { place = "cave_floor", least_height = 6,
  blocks = { stem = "warped_stem[axis=y]", cap = "warped_wart_block", light = "shroomlight" } })
feature("amber_fungus", "fungus", "amber_forest", 5, 1, .6, { place = "cave_floor", least_height = 9,
  blocks = { stem = "vitrail:amber_stem[axis=y]", cap = "vitrail:amber_wart_block", light = "shroomlight" } })
