-- Colors of every biome. Grass and foliage follow warmth and rain over three corner colors, as a whole, so that biomes that meet
-- belong together; a biome with a character of its own overrides what it must.

local GRASS = { cold = { 118, 160, 122 }, dry = { 172, 174, 84 }, wet = { 78, 164, 52 } }
local LEAF = { cold = { 88, 138, 100 }, dry = { 168, 158, 62 }, wet = { 52, 140, 38 } }

local function blend(corners, t, d)
  t = math.max(0, math.min(1, t))
  d = math.max(0, math.min(1, d)) * t
  local out = {}
  for i = 1, 3 do out[i] = math.floor(corners.cold[i] * (1 - t) + corners.dry[i] * (t - d) + corners.wet[i] * d + 0.5) end
  return out
end

-- Warm air is a deeper, purer blue; cold air is paler.
local function sky_of(t)
  t = math.max(-0.5, math.min(2, t)) / 2
  return { math.floor(126 - 14 * t + 0.5), math.floor(168 + 2 * t + 0.5), 255 }
end

local WATER, FOG = { 58, 122, 196 }, { 190, 214, 245 }

local function biome(name, t, d, over)
  if not string.find(name, ":", 1, true) then name = "minecraft:" .. name end
  define_biome(name, merge({ temperature = t, downfall = d, grass = blend(GRASS, t, d), foliage = blend(LEAF, t, d), water = WATER,
    sky = sky_of(t), fog = FOG }, over))
end

local warm_water, lukewarm, cold_water, frozen_water = { 48, 190, 208 }, { 52, 156, 208 }, { 52, 100, 178 }, { 60, 92, 168 }
local swamp = { grass = { 102, 118, 60 }, foliage = { 96, 114, 54 }, water = { 92, 114, 86 }, fog = { 176, 196, 190 } }
local dark = { grass = { 84, 128, 56 }, foliage = { 66, 116, 44 } }
local badlands = { grass = { 150, 134, 76 }, foliage = { 158, 128, 72 }, fog = { 226, 206, 186 } }
local cherry = { grass = { 176, 212, 102 }, foliage = { 178, 210, 104 }, water = { 92, 170, 214 }, fog = { 232, 216, 236 } }
-- The green that the sides of grass are painted with: it must be that of the plains.
local plains = { grass = { 118, 170, 72 } }
local savanna = { grass = { 186, 168, 84 }, foliage = { 160, 158, 68 } }
local meadow = { grass = { 122, 186, 96 }, water = { 40, 118, 200 } }

for _, b in ipairs {
  { "the_void", 0.5, 0.5 },
  { "plains", 0.8, 0.4, plains }, { "sunflower_plains", 0.8, 0.4, plains }, { "snowy_plains", 0, 0.5 }, { "ice_spikes", 0, 0.5, { water = frozen_water } },
  { "desert", 2, 0, { fog = { 232, 218, 190 }, water = { 54, 150, 190 } } },
  { "swamp", 0.8, 0.9, swamp }, { "mangrove_swamp", 0.8, 0.9, merge(swamp, { foliage = { 124, 150, 56 }, water = { 62, 122, 106 } }) },
  { "forest", 0.7, 0.8 }, { "flower_forest", 0.7, 0.8 }, { "birch_forest", 0.6, 0.6 }, { "dark_forest", 0.7, 0.8, dark },
  { "pale_garden", 0.7, 0.8, { grass = { 122, 130, 116 }, foliage = { 136, 142, 130 }, water = { 118, 136, 152 }, sky = { 168, 176, 184 }, fog = { 150, 156, 160 } } },
  { "old_growth_birch_forest", 0.6, 0.6 }, { "old_growth_pine_taiga", 0.3, 0.8 }, { "old_growth_spruce_taiga", 0.25, 0.8 },
  { "taiga", 0.25, 0.8 }, { "snowy_taiga", -0.5, 0.4, { water = frozen_water } },
  { "savanna", 2, 0, savanna }, { "savanna_plateau", 2, 0, savanna }, { "windswept_savanna", 2, 0, savanna },
  { "windswept_hills", 0.2, 0.3 }, { "windswept_gravelly_hills", 0.2, 0.3 }, { "windswept_forest", 0.2, 0.3 },
  { "jungle", 0.95, 0.9 }, { "sparse_jungle", 0.95, 0.8 }, { "bamboo_jungle", 0.95, 0.9 },
  { "badlands", 2, 0, badlands }, { "eroded_badlands", 2, 0, badlands }, { "wooded_badlands", 2, 0, badlands },
  { "meadow", 0.5, 0.8, meadow }, { "cherry_grove", 0.5, 0.8, cherry }, { "grove", -0.2, 0.8, { water = frozen_water } },
  { "snowy_slopes", -0.3, 0.9, { water = frozen_water } }, { "frozen_peaks", -0.7, 0.9, { water = frozen_water } }, { "jagged_peaks", -0.7, 0.9, { water = frozen_water } },
  { "stony_peaks", 1, 0.3 },
  { "river", 0.5, 0.5 }, { "frozen_river", 0, 0.5, { water = frozen_water } }, { "beach", 0.8, 0.4, { water = lukewarm } },
  { "snowy_beach", 0.05, 0.3, { water = cold_water } }, { "stony_shore", 0.2, 0.3 },
  { "warm_ocean", 0.5, 0.5, { water = warm_water } }, { "lukewarm_ocean", 0.5, 0.5, { water = lukewarm } }, { "deep_lukewarm_ocean", 0.5, 0.5, { water = lukewarm } },
  { "ocean", 0.5, 0.5 }, { "deep_ocean", 0.5, 0.5 }, { "cold_ocean", 0.5, 0.5, { water = cold_water } }, { "deep_cold_ocean", 0.5, 0.5, { water = cold_water } },
  { "frozen_ocean", 0, 0.5, { water = frozen_water } }, { "deep_frozen_ocean", 0.5, 0.5, { water = frozen_water } },
  { "mushroom_fields", 0.9, 1, { grass = { 92, 176, 72 } } },
  { "dripstone_caves", 0.8, 0.4 }, { "lush_caves", 0.5, 0.5, { grass = { 110, 176, 66 } } }, { "deep_dark", 0.8, 0.4, { fog = { 20, 34, 44 } } },
  { "nether_wastes", 2, 0, { sky = { 58, 10, 8 }, fog = { 56, 12, 10 } } }, { "warped_forest", 2, 0, { sky = { 22, 8, 30 }, fog = { 28, 10, 32 } } },
  { "crimson_forest", 2, 0, { sky = { 52, 6, 8 }, fog = { 52, 8, 8 } } }, { "soul_sand_valley", 2, 0, { sky = { 24, 70, 72 }, fog = { 28, 70, 72 } } },
  { "basalt_deltas", 2, 0, { sky = { 100, 92, 112 }, fog = { 104, 96, 112 } } },
  { "the_end", 0.5, 0.5, { sky = { 12, 8, 20 }, fog = { 160, 128, 160 } } }, { "end_highlands", 0.5, 0.5, { sky = { 12, 8, 20 }, fog = { 160, 128, 160 } } },
  { "end_midlands", 0.5, 0.5, { sky = { 12, 8, 20 }, fog = { 160, 128, 160 } } }, { "small_end_islands", 0.5, 0.5, { sky = { 12, 8, 20 }, fog = { 160, 128, 160 } } },
  { "end_barrens", 0.5, 0.5, { sky = { 12, 8, 20 }, fog = { 160, 128, 160 } } },
} do biome(b[1], b[2], b[3], b[4]) end

-- Ours. Sea biomes run from turquoise to slate blue, deserts and mesas carry dust in the air, the magic ones tint the haze.
for _, b in ipairs {
  { "coral_reef", 0.9, 0.6, { water = { 40, 196, 200 }, fog = { 188, 228, 238 } } },
  { "archipelago", 0.9, 0.6, { water = { 44, 176, 204 }, grass = { 124, 188, 70 } } },
  { "warm_ocean", 0.8, 0.5, { water = { 44, 172, 208 } } },
  { "icebergs", 0, 0.5, { water = { 66, 112, 176 }, fog = { 208, 224, 240 } } },
  { "cool_ocean", 0.4, 0.5, { water = { 46, 98, 172 } } },
  { "rocky_beach", 0.4, 0.4, { water = { 54, 128, 186 } } },
  { "tropical_beach", 1, 0.6, { water = { 48, 190, 204 } } },
  { "beach", 0.8, 0.4, { water = { 52, 152, 200 } } },
  { "savanna", 1.6, 0.1, { grass = { 186, 168, 84 }, foliage = { 160, 158, 68 }, fog = { 228, 216, 186 } } },
  { "mesa", 1.8, 0, badlands },
  { "frozen_wasteland", -0.4, 0.4, { water = frozen_water, fog = { 214, 226, 240 } } },
  { "redwood_forest", 0.5, 0.7, { grass = { 112, 158, 72 }, foliage = { 78, 132, 62 }, fog = { 196, 210, 214 } } },
  { "swamp", 0.8, 0.9, merge(swamp, { grass = { 98, 130, 58 } }) },
  { "sparse_desert", 1.6, 0, { fog = { 230, 218, 200 } } },
  { "lush_birch_forest", 0.6, 0.6, { grass = { 130, 182, 78 }, foliage = { 136, 178, 74 } } },
  { "tianzi_mountains", 0.6, 0.8, { grass = { 104, 164, 80 }, fog = { 206, 220, 222 } } },
  { "jungle", 0.95, 0.9, { grass = { 74, 160, 48 }, foliage = { 56, 146, 42 }, water = { 44, 150, 160 }, fog = { 186, 214, 206 } } },
  { "red_desert", 1.9, 0, { fog = { 232, 200, 174 }, sky = { 132, 164, 230 } } },
  { "purple_mushrooms", 0.7, 0.8, { grass = { 132, 140, 104 }, foliage = { 148, 112, 160 }, water = { 96, 96, 178 }, sky = { 140, 144, 228 }, fog = { 206, 188, 226 } } },
  { "crystals", 0.5, 0.4, { grass = { 118, 164, 138 }, foliage = { 104, 158, 142 }, water = { 76, 130, 200 }, sky = { 128, 152, 236 }, fog = { 204, 200, 240 } } },
  { "oasis", 1.2, 0.7, { grass = { 88, 168, 56 }, foliage = { 76, 156, 50 }, water = { 44, 170, 186 } } },
  { "desert", 2, 0, { fog = { 234, 220, 192 } } },
  { "plains", 0.8, 0.4, plains },
  { "mountains", 0.3, 0.5, { grass = { 116, 164, 92 }, fog = { 200, 216, 236 } } },
  { "none", 0.5, 0.5 },
  { "crystal_caves", 0.5, 0.4, { fog = { 60, 50, 90 }, water = { 90, 110, 200 } } },
  { "lush_caves", 0.6, 0.8, { grass = { 104, 172, 64 }, fog = { 60, 86, 60 }, water = { 48, 150, 150 } } },
  { "warped_forest", 1, 0.2, { grass = { 64, 160, 146 }, foliage = { 60, 150, 140 }, fog = { 24, 56, 58 }, water = { 40, 130, 140 } } },
  { "amber_forest", 1, 0.2, { grass = { 196, 148, 62 }, foliage = { 190, 136, 54 }, fog = { 76, 48, 20 }, water = { 124, 112, 80 } } },
} do biome("vitrail:" .. b[1], b[2], b[3], b[4]) end
