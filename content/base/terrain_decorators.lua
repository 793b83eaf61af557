-- Small plants and the like: chance a column of the biome (below ground: of each floor or ceiling).

local TURF = { "grass_block", "vitrail:jungle_grass_block", "vitrail:savanna_grass_block" }
local CRYSTALS = { "magenta", "cyan", "green" }

--- `name` with an asterisk in front stands two blocks high.
local function grow(biome, on, list, place)
  for name, chance in pairs(list) do
    local tall = string.match(name, "^%*(.*)$")
    define_decorator { biome = "vitrail:" .. biome, place = place, on = on, chance = chance,
      block = tall and tall .. "[half=lower]" or name, upper = tall and tall .. "[half=upper]" }
  end
end

local reef = { seagrass = .2, ["*tall_seagrass"] = .04 }
for _, kind in ipairs { "tube", "brain", "bubble", "fire", "horn" } do reef[kind .. "_coral[waterlogged=true]"] = .03 end
grow("coral_reef", "ground", reef, "sea_floor")

grow("archipelago", TURF, { short_grass = .2, lily_of_the_valley = .025 })
grow("tropical_beach", "vitrail:smooth_sand", { ["vitrail:jungle_grass"] = .1 })
grow("savanna", TURF, { ["vitrail:savanna_grass"] = .1 })
grow("redwood_forest", TURF, { short_grass = .2, ["*tall_grass"] = .08, oxeye_daisy = .04, lily_of_the_valley = .04, ["*peony"] = .02 })
grow("swamp", TURF, { ["vitrail:jungle_grass"] = .3, fern = .05, cornflower = .03, blue_orchid = .03, allium = .03 })
grow("lush_birch_forest", TURF, { short_grass = .3, ["*peony"] = .02, ["*lilac"] = .02, dandelion = .04 })
grow("jungle", TURF, { ["vitrail:jungle_grass"] = .4, ["*vitrail:tall_jungle_grass"] = .2, ["*pitcher_plant"] = .03, fern = .12, blue_orchid = .04 })
grow("sparse_desert", "vitrail:smooth_sand", { dead_bush = .02 })
grow("red_desert", "red_sand", { dead_bush = .03 })
grow("desert", "sand", { dead_bush = .02 })

local mushrooms, crystals = { ["vitrail:purple_mushroom"] = .1 }, { ["vitrail:blue_mushroom"] = .02 }
for _, color in ipairs(CRYSTALS) do
  mushrooms["vitrail:" .. color .. "_crystal_shard"] = .005
  crystals["vitrail:" .. color .. "_crystal_shard"] = .025
end
grow("purple_mushrooms", "mycelium", mushrooms)
grow("crystals", { "ground", "mycelium", "vitrail:quartz_rock" }, crystals)

grow("oasis", TURF, { ["vitrail:jungle_grass"] = .2, cornflower = .02 })
grow("plains", TURF, { short_grass = .2, red_tulip = .01, orange_tulip = .01, white_tulip = .01, pink_tulip = .01, dandelion = .03, poppy = .03 })
grow("mountains", TURF, { short_grass = .05, lily_of_the_valley = .015 })

-- Below ground.
local CAVE_ROCK = { "ground", "cobblestone", "cobbled_deepslate", "vitrail:quartz_rock" }
local floor, ceiling = {}, {}
for _, color in ipairs(CRYSTALS) do
  floor["vitrail:" .. color .. "_crystal_shard"] = .015
  ceiling["vitrail:hanging_" .. color .. "_crystal_shard"] = .015
end
grow("crystal_caves", CAVE_ROCK, floor, "cave_floor")
grow("crystal_caves", CAVE_ROCK, ceiling, "cave_ceiling")
grow("lush_caves", "moss_block", { short_grass = .1, ["*tall_grass"] = .03, torchflower = .02 }, "cave_floor")
grow("warped_forest", { "vitrail:warped_deepslate", "vitrail:warped_blackstone" }, { warped_fungus = .02, warped_roots = .06, nether_sprouts = .04 }, "cave_floor")
grow("amber_forest", { "vitrail:amber_deepslate", "vitrail:amber_blackstone" }, { ["vitrail:amber_fungus"] = .02, ["vitrail:amber_roots"] = .06 }, "cave_floor")

-- What the land would miss beside all that: plants of our own, and something in the biomes that would be bare.
grow("coral_reef", "ground", { ["sea_pickle[pickles=3,waterlogged=true]"] = .016 }, "sea_floor")
-- Dunes bear a little grass; bare sand to the horizon is dull.
grow("beach", "sand", { ["vitrail:savanna_grass"] = .035, ["vitrail:desert_scrub"] = .003 })
grow("rocky_beach", { "gravel", "ground" }, { ["vitrail:savanna_grass"] = .012, dead_bush = .004 })
grow("savanna", TURF, { ["vitrail:desert_scrub"] = .006 })
grow("mesa", "ground", { ["vitrail:desert_scrub"] = .012, dead_bush = .01 })
grow("sparse_desert", "vitrail:smooth_sand", { ["vitrail:desert_scrub"] = .006 })
grow("frozen_wasteland", { "snow_block", "grass_block[snowy=true]" }, { ["vitrail:ice_flower"] = .012 })
grow("redwood_forest", TURF, { ["vitrail:golden_fern"] = .03, fern = .06 })
grow("swamp", { "mud", "vitrail:jungle_grass_block" }, { ["vitrail:cattail"] = .05, ["vitrail:swamp_iris"] = .02 })
grow("tianzi_mountains", TURF, { short_grass = .15, fern = .06, azalea = .008 })
grow("mountains", TURF, { ["vitrail:heather"] = .02 })
grow("lush_caves", "moss_block", { moss_carpet = .06, azalea = .008, flowering_azalea = .006 }, "cave_floor")
grow("lush_caves", { "moss_block", "ground" }, { hanging_roots = .04, spore_blossom = .008 }, "cave_ceiling")
