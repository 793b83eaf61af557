-- The 24 biomes of the surface. Signs of `wants`: ocean, beach, rocky, magic, temperature, moisture. Every combination of
-- attributes belongs to exactly one biome, so that weights sum to 1. Colors of the same names stand in biomes.lua.

local function biome(name, wants, height, materials, rules)
  define_terrain_biome("vitrail:" .. name, { wants = wants, height = height, materials = materials or {}, rules = rules or {} })
end

--- Turf: the topmost dirt becomes `block`.
local function turf(block) return { from = "dirt", depth = 1, to = block } end
local GRASS, JUNGLE_GRASS = turf("grass_block"), turf("vitrail:jungle_grass_block")
-- Biomes without dirt of their own have some at their borders, a neighbor's: it too wears turf, or bare patches show.
local DRY_GRASS = turf("vitrail:savanna_grass_block")
local NOT_DIRT = { "rock", "gravel", "clay", "mud", "red_sand", "sand", "vitrail:smooth_sand", "snow_block" }

-- Seas and shores.
biome("coral_reef", "+-++..", "107 + 16 F(.0065)", { dirt = 0, sand = .7, smooth_sand = .8 })
-- Islands: the power keeps most of the sea floor low and lets rounded hills rise out of it.
biome("archipelago", "+-+-..", "107 + 24 F(.006) + 22 ss(1, 0, ((F4(.0055) + 1) / 2)^2.4)", { dirt = 0, gravel = .3, sand = .8 }, {
  { from = "loose", above = "129.5 + 1.7 F3(.0065)", to = "dirt" },
  GRASS,
})
biome("warm_ocean", "+--.+.", "93 + 18 F(.0055)", { dirt = 0, sand = .7 })
biome("icebergs", "+--+-.", "66 + 18 F(.006)", { dirt = 0, gravel = .5 })
biome("cool_ocean", "+----.", "80 + 22 F(.0065)", { dirt = 0, gravel = .5 })
biome("rocky_beach", "+++...", "134 + 8 F(.007)", { dirt = 0, gravel = 1 }, { GRASS })
biome("tropical_beach", "++-.+.", "129.5 + 6 F(.0045)", { dirt = 0, smooth_sand = 1 }, { { from = "ground", depth = 2, to = "vitrail:smooth_sand" } })
biome("beach", "++-.-.", "132 + 5 F(.0055)", { dirt = 0, sand = 1 }, { { from = "ground", depth = 2, to = "sand" } })

-- Rocky and magic.
-- Plateaus: some of the cells of two Worley patterns, flat on top, their edges bent so that none is straight.
biome("savanna", "-.++++", [[
  x = 24 F3(.012); z = 24 F3(.012);
  136 + 9 F4(.008) + 14 warp(x, z, ss(.03, .07, E(.007)) ss(.5, .52, R(.007))) + 9 warp(x, z, ss(.03, .07, E(.0045)) ss(.45, .47, R(.0045)))]],
  { stone = .6, tuff = .15, calcite = 0, granite = .2, terracotta = 3.2, marble = 0 }, { DRY_GRASS })

local bands = {}
for _, band in ipairs { { 5, "" }, { 3, "orange_" }, { 4, "red_" }, { 2, "white_" }, { 6, "" }, { 1, "orange_" }, { 5, "yellow_" }, { 3, "purple_" }, { 3, "" } } do
  for _ = 1, band[1] do bands[#bands + 1] = band[2] .. "terracotta" end
end
-- Canyons run where Worley cells meet. Clay above the water is baked like the rock: gray slopes would hide the bands.
biome("mesa", "-.+++-", [[
  e = warp(28 F3(.011), 28 F3(.011), E(.003));
  122 + 10 ss(0, .05, e) + (37.5 + 5 F4(.03)) ss(.07, .22, e) + 6 S(.025)]],
  { clay = .8, dirt = 0 }, { { from = { "rock", "clay" }, above = "108 + 12 F3(.004)", bands = bands }, DRY_GRASS })
-- A lake's ice is three blocks thick here, with water below it.
biome("frozen_wasteland", "-.++-+", "136 + 16 F(.0035)", { granite = 0, dirt = .6, snow = 1.1 }, {
  turf("grass_block[snowy=true]"),
  { from = "water", depth = 3, to = "packed_ice" },
})
biome("redwood_forest", "-.++--", "134 + 8 F(.012)", {}, { GRASS })

-- Rocky without magic.
biome("swamp", "-.+-++", "130 + 12 F(.008)", { clay = 1.7, mud = 2.2, dirt = .6 }, {
  { from = "dirt", below = "128.8 + 1.1 S(.03)", to = "mud" },
  JUNGLE_GRASS,
})
biome("sparse_desert", "-.+-+-", "132 + 4 F4(.007) + 18 W(.016)^2", { marble = 2, andesite = .5, dirt = 0, smooth_sand = 1.4 }, { DRY_GRASS })
biome("lush_birch_forest", "-.+--+", "135 + 8 F(.009) + 20(S(.0012) + .8)", {}, { GRASS })
-- Pillars of sandstone, two sizes of them, with turf wherever dirt can lie.
biome("tianzi_mountains", "-.+---", [[
  128 + 16 S(.015) + 9 F3(.007) + (1.2 ss(.45, .35, W(.015)) + .6 ss(.45, .35, W(.021)))(54 + 7 F3(.02))]],
  { sandstone = 1 }, { { from = NOT_DIRT, above = "112 + 16 F3(.02)", to = "smooth_sandstone" }, GRASS })

-- Magic without rocks.
biome("jungle", "-.-+++", "139 + 8 F(.012) + 25(S(.003) + .5)", { clay = 1, mud = 1, dirt = .5 }, { JUNGLE_GRASS })
biome("red_desert", "-.-++-", "137 + 13 F(.0075)", { red_sandstone = 1, dirt = 0, red_sand = 1 }, { DRY_GRASS })
biome("purple_mushrooms", "-.-+-+", "136 + 9 F(.014)", { gravel = .4 }, { turf("mycelium") })
-- Spires of quartz, each of its own height, on rises that are few and far between. Quartz is where the land stands high.
biome("crystals", "-.-+--", [[
  s = S(.003);
  137 + 8 F(.02) + 60 ss(.10, .15, E(.07)) (.4 + 1.2 R(.07)) ss(.70, .74, s) + 18 ss(.35, .8, s)]],
  { calcite = .3, gravel = .15, clay = .2, dirt = 0 }, {
  { from = "ground", above = "140 + 15 F3(.008) + 300 ss(152, 146, height)", to = "vitrail:quartz_rock" },
  -- A tenth of the ground, in patches: single blocks of it would be mere noise. Clay gives way to gravel for the same reason; its
  -- thin sheet would draw pale contour lines all over the dark ground that crystals stand out from.
  { from = "ground", depth = 1, above = "400 ss(.68, .64, S(.045))", to = "mycelium" },
  { from = "clay", depth = 1, to = "gravel" },
  turf("mycelium"),
})

-- Neither.
-- Sand lies over the dirt; where water is near the green comes through.
biome("oasis", "-.--++", "132 + 9 F(.012)", { sandstone = 1, clay = .4, dirt = .6, sand = .4 }, {
  JUNGLE_GRASS,
  { from = "sand", depth = 1, below = "133 + 5 F3(.03)", to = "vitrail:jungle_grass_block" },
})
biome("desert", "-.--+-", "136 + 6 F(.011)", { sandstone = 1, dirt = 0, sand = 1 }, { DRY_GRASS })
biome("plains", "-.---+", "144 + 8 F(.008)", {}, { GRASS })
-- F4 where five octaves would be finer than two blocks.
biome("mountains", "-.----", [[
  n = (abs(F(.0035)) + .05)^2 + .1(F(.005) - .5);
  165 + 140(n - .15) + 20 n F4(.035)]],
  { gravel = 1 }, { { from = "ground", depth = 3, above = "202 + 5 F3(.05)", to = "snow_block" }, GRASS })
