define_block("stone", {}) define_block("dirt", {}) define_block("grass_block", { properties = { snowy = { false, true } } })
define_terrain { warp = { "20 F3(.015)", 0 }, fields = { { name = "sea", noise = "F(.001)" } }, attributes = { { name = "ocean", field = "sea", low = .01, high = -.02 } }, cave_attributes = { { name = "deep", by_depth = true, offset = "5 F3(.01)", low = 20, high = 30 } }, materials = { dirt = .5 } }
define_terrain_layer("stone", { block = "stone", thickness = 10, amplitude = 5, frequency = .01, remainder = true })
define_terrain_layer("hung", { block = "stone", thickness = 3, hung = true })
define_terrain_layer("dirt", { block = "dirt", loose = true, thickness = 4, repose = 40, steepest = 1.2, over = "stone" })
define_terrain_biome("test:sea", { wants = "+", height = "n = abs(F(.01)); 100 + 8 n^2 + ss(0, 1, W(.01))", materials = { dirt = 0 } })
define_terrain_biome("test:land", { wants = "-", height = 140, rules = { { from = "dirt", depth = 1, chance = .5, to = "grass_block[snowy=true]" }, { from = { "rock", "water" }, above = "100 + height", below = 200, bands = { "stone", "dirt" } } } })
define_cave_biome("test:none", { wants = "-" })
define_cave_biome("test:deep", { wants = "+", rules = { { place = "floor", from = "rock", to = "dirt", depth = 2, chance = .5, vein = "F3(.05)", vein_width = .1 } } })
define_terrain_feature("test:bush", { shape = "shrub", place = "surface", biome = "test:land", cell = 9, padding = 2, chance = .5, layers = { "dirt" }, least_thickness = .5, lowest_y = 120, highest_y = 200, least_height = 0, water_depth = 0, numbers = { radius_most = 2 }, blocks = { trunk = "stone", leaves = "dirt" } })
define_decorator { biome = "test:deep", place = "cave_floor", block = "grass_block", upper = "dirt", chance = .25, on = { "grass_block", "loose" } }
