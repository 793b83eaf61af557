-- Attributes of the land, from which every biome follows (docs/terrain.md).
--
-- All of them are read at a place moved by 20 blocks of noise, so that no border is smooth. Their frequencies are those of a world
-- 0.32 times as large, with that factor multiplied in: .0007 * .32 = .000224 and so on.
define_terrain {
  warp = { "20 F3(.015)", "20 F3(.015)" },
  fields = {
    { name = "sea", noise = "F(.000224)" },
    { name = "rockiness", noise = "F(.00048)" },
    { name = "wonder", noise = "F(.00096)" },
    { name = "warmth", noise = "F(.000384)" },
    { name = "wetness", noise = "F(.0016)" },
  },
  -- The order of signs in `wants`. Where low lies above high, the attribute falls as its field rises: the sea is where the field is
  -- low, and the beach is the rim of it.
  attributes = {
    { name = "ocean", field = "sea", low = .01, high = -.02 },
    { name = "beach", field = "sea", low = -.15, high = -.05 },
    { name = "rocky", field = "rockiness", low = -.08, high = .08 },
    { name = "magic", field = "wonder", low = -.07, high = .07 },
    { name = "temperature", field = "warmth", low = -.06, high = .06 },
    { name = "moisture", field = "wetness", low = -.12, high = .12 },
  },
  -- Below ground: how far down, how rocky the land above, and which of the two deep forests. Edges of 6 to 8 blocks let borders mix
  -- without losing their place; the wandering offsets are slow enough that one cavern seldom crosses twice.
  cave_attributes = {
    { name = "shallow", by_depth = true, offset = "23 F3(.006)", low = 16, high = 22 },
    { name = "deep", by_depth = true, offset = "18 F3(.006)", low = 68, high = 76 },
    { name = "rocky", offset = "rocky", low = .3, high = .7 },
    { name = "warped", offset = "F3(.0035)", low = -.06, high = .06 },
  },
  -- How much of each layer a biome has if it says nothing: all strata, dirt, and no other loose ground.
  materials = {
    terracotta = 0, red_sandstone = 0, sandstone = 0,
    gravel = 0, clay = 0, mud = 0, red_sand = 0, sand = 0, smooth_sand = 0, snow = 0,
  },
}
