-- The five biomes below ground. Signs of `wants`: shallow, deep, rocky, warped (terrain_world.lua).

define_cave_biome("vitrail:none", { wants = "-..." })

define_cave_biome("vitrail:crystal_caves", { wants = "+-+.", rules = {
  { place = "rock", from = "rock", to = "vitrail:quartz_rock", vein = "F2(.03)", vein_width = .035 },
  { place = "rock", from = "stone", to = "cobblestone", chance = .5 },
  { place = "rock", from = "deepslate", to = "cobbled_deepslate", chance = .4 },
} })

-- Clay first: moss grows only on rock, so the pockets stay bare.
define_cave_biome("vitrail:lush_caves", { wants = "+--.", rules = {
  { place = "floor", from = "rock", to = "clay", depth = 3, vein = "F2(.05)", vein_width = .09 },
  { place = "floor", from = "rock", to = "moss_block", depth = 2 },
  { place = "ceiling", from = "rock", to = "moss_block", depth = 1, chance = .9 },
} })

-- The block shows its overgrowth on top, so floors are one block of it. What is neither deepslate nor blackstone turns to the
-- deepslate kind, or a floor of slate would be a bald patch in the forest.
for kind, sign in pairs { warped = "+", amber = "-" } do
  define_cave_biome("vitrail:" .. kind .. "_forest", { wants = "++." .. sign, rules = {
    { place = "floor", from = "blackstone", to = "vitrail:" .. kind .. "_blackstone" },
    { place = "floor", from = "rock", to = "vitrail:" .. kind .. "_deepslate" },
  } })
end
