-- What grows: grass, flowers, crops, mushrooms, vines, water plants, coral.

-- `grass` is what short_grass was called before 1.20.3; old worlds still hold it.
for _, name in ipairs { "short_grass", "grass" } do plant(name, { texture = "short_grass", tint = "grass", replaceable = true }) end
plant("fern", { tint = "grass", replaceable = true })
potted("fern")
tall_plant("tall_grass", { tint = "grass", replaceable = true })
tall_plant("large_fern", { tint = "grass", replaceable = true })
plant("dead_bush", { replaceable = true })
potted("dead_bush")

FLOWERS = { "dandelion", "poppy", "blue_orchid", "allium", "azure_bluet", "red_tulip", "orange_tulip", "white_tulip", "pink_tulip",
  "oxeye_daisy", "cornflower", "lily_of_the_valley", "wither_rose", "torchflower" }
for _, name in ipairs(FLOWERS) do
  plant(name, name == "torchflower" and { light = { 12, 9, 5 } } or nil)
  potted(name)
end
plant("open_eyeblossom", { light = { 2, 1, 0 } })
plant("closed_eyeblossom")
for _, name in ipairs { "sunflower", "lilac", "rose_bush", "peony" } do tall_plant(name) end
tall_plant("pitcher_plant")
tall_plant("pitcher_crop", { texture = "pitcher_plant_bottom", variants = { ["half=upper"] = { texture = "pitcher_plant_top" } } }, "age:0-4")

--- A crop whose ages share the pictures NAME_stage0..; `map` gives the picture of each age.
local function crop(name, map, shape)
  local variants, props = {}, "age:0-" .. (#map - 1)
  for i, stage in ipairs(map) do variants["age=" .. (i - 1)] = { texture = name .. "_stage" .. stage } end
  plant(name, { shape = shape or "crop", texture = name .. "_stage0", variants = variants }, props)
end
crop("wheat", { 0, 1, 2, 3, 4, 5, 6, 7 })
crop("carrots", { 0, 0, 1, 1, 2, 2, 2, 3 })
crop("potatoes", { 0, 0, 1, 1, 2, 2, 2, 3 })
crop("beetroots", { 0, 1, 2, 3 })
crop("torchflower_crop", { 0, 1 }, "cross")
crop("sweet_berry_bush", { 0, 1, 2, 3 }, "cross")
for _, name in ipairs { "melon", "pumpkin" } do
  local variants = {}
  for age = 0, 7 do variants["age=" .. age] = { texture = "stem_stage" .. age // 2 } end
  plant(name .. "_stem", { texture = "stem_stage0", variants = variants }, "age:0-7")
  plant("attached_" .. name .. "_stem", { texture = "stem_stage3" }, "facing")
end
block("melon", { texture = { "melon_side", "melon_top" }, material = "plant", hardness = 1 })
block("pumpkin", { texture = { "pumpkin_side", "pumpkin_top" }, material = "plant", hardness = 1 })
block("carved_pumpkin", { texture = { "carved_pumpkin", "pumpkin_side", "pumpkin_top", "pumpkin_top" }, material = "plant", hardness = 1 }, "facing")
block("jack_o_lantern", { texture = { "jack_o_lantern", "pumpkin_side", "pumpkin_top", "pumpkin_top" }, material = "plant", hardness = 1,
  light = { 15, 11, 5 } }, "facing")
block("hay_block", { texture = { "hay_block_side", "hay_block_top" }, shape = "pillar", material = "plant", hardness = 0.5 }, "axis")
block("dried_kelp_block", { texture = { "dried_kelp_side", "dried_kelp_top" }, material = "plant", hardness = 0.5 })

plant("sugar_cane", { tint = "grass", climbable = false }, "age:0-15")
block("cactus", { shape = "boxes", texture = { "cactus_side", "cactus_top", "cactus_bottom" }, material = "plant", hardness = 0.4,
  layer = "cutout", opacity = 0, boxes = { { 1, 0, 1, 15, 16, 15 } } }, "age:0-15")
block("bamboo", { shape = "boxes", texture = "bamboo_stalk", material = "wood", hardness = 1, layer = "cutout", opacity = 0,
  boxes = { { 7, 0, 7, 9, 16, 9 } }, variants = {
    ["age=1"] = { boxes = { { 6.5, 0, 6.5, 9.5, 16, 9.5 } } },
    ["leaves=small"] = { boxes = { { 7, 0, 7, 9, 16, 9 }, { 0, 0, 8, 16, 16, 8, "bamboo_small_leaves" } } },
    ["leaves=large"] = { boxes = { { 7, 0, 7, 9, 16, 9 }, { 0, 0, 8, 16, 16, 8, "bamboo_large_leaves" }, { 8, 0, 0, 8, 16, 16, "bamboo_large_leaves" } } } } },
  "age:0-1 leaves=none|small|large stage:0-1")
plant("bamboo_sapling")
potted("bamboo", "bamboo_sapling")
block("cocoa", { shape = "boxes", texture = "cocoa_stage0", material = "plant", hardness = 0.2, opacity = 0,
  boxes = { { 6, 7, 1, 10, 12, 5 } }, variants = (function()
    local v = {}
    local sizes = { { 6, 7, 1, 10, 12, 5 }, { 5, 5, 1, 11, 12, 7 }, { 4, 3, 1, 12, 12, 9 } }
    for age = 0, 2 do
      v["age=" .. age] = { texture = "cocoa_stage" .. age }
      for key, value in pairs(turned({ sizes[age + 1] }, "age=" .. age)) do v[key] = value end
    end
    return v
  end)() }, "age:0-2 facing")

for _, name in ipairs { "brown_mushroom", "red_mushroom" } do
  plant(name, name == "brown_mushroom" and { light = 1 } or nil)
  potted(name)
end
-- The inside of a mushroom shows where a face is not grown over.
for _, name in ipairs { "brown_mushroom_block", "red_mushroom_block", "mushroom_stem" } do
  local variants, order = {}, { "west", "east", "down", "up", "north", "south" }
  for mask = 0, 62 do
    local key, faces = {}, {}
    for i, side in ipairs(order) do
      local on = (mask >> (i - 1)) & 1 == 1
      key[i], faces[i] = side .. "=" .. tostring(on), on and name or "mushroom_block_inside"
    end
    variants[table.concat(key, ",")] = { texture = faces }
  end
  block(name, { texture = name, material = "plant", hardness = 0.2, variants = variants }, "north! east! south! west! up! down!")
end

block("vine", merge(PLANT, { shape = "faces", texture = "vine", tint = "foliage", climbable = true, replaceable = true, hardness = 0.2 }),
  SIDES4 .. " up?")
block("glow_lichen", merge(PLANT, { shape = "faces", texture = "glow_lichen", light = { 4, 6, 5 }, sway = false, replaceable = true,
  hardness = 0.2 }), SIDES6 .. " wl")
block("resin_clump", merge(PLANT, { shape = "faces", texture = "resin_clump", sway = false }), SIDES6 .. " wl")
plant("pale_hanging_moss", { variants = { ["tip=true"] = { texture = "pale_hanging_moss_tip" } } }, "tip!")
plant("hanging_roots", nil, "wl")
plant("spore_blossom", { texture = "spore_blossom" })
local berries = { ["berries=true"] = { texture = "cave_vines_lit", light = { 14, 11, 6 } } }
plant("cave_vines", { texture = "cave_vines", climbable = true, variants = berries }, "age:0-25 berries?")
plant("cave_vines_plant", { texture = "cave_vines_plant", climbable = true, variants = {
  ["berries=true"] = { texture = "cave_vines_plant_lit", light = { 14, 11, 6 } } } }, "berries?")

block("azalea", merge(PLANT, { shape = "boxes", texture = { "azalea_side", "azalea_top" }, collision = true,
  boxes = { { 0, 8, 0, 16, 16, 16 }, { 0, 0, 8, 16, 8, 8, "azalea_plant" }, { 8, 0, 0, 8, 8, 16, "azalea_plant" } } }))
block("flowering_azalea", merge(PLANT, { shape = "boxes", texture = { "flowering_azalea_side", "flowering_azalea_top" }, collision = true,
  boxes = { { 0, 8, 0, 16, 16, 16 }, { 0, 0, 8, 16, 8, 8, "azalea_plant" }, { 8, 0, 0, 8, 8, 16, "azalea_plant" } } }))
potted("azalea_bush", "azalea_plant")
potted("flowering_azalea_bush", "azalea_plant")
block("pink_petals", merge(PLANT, { shape = "carpet", texture = "pink_petals", sway = false }), "facing flower_amount:1-4")
block("big_dripleaf", merge(PLANT, { shape = "boxes", texture = { "big_dripleaf_side", "big_dripleaf_top" }, collision = true, sway = false,
  boxes = { { 0, 13, 0, 16, 15, 16 }, { 0, 0, 8, 16, 13, 8, "big_dripleaf_stem" } } }), "facing tilt=none|unstable|partial|full wl")
plant("big_dripleaf_stem", nil, "facing wl")
tall_plant("small_dripleaf", nil, "facing wl")

-- Water plants stand in water without saying so.
plant("kelp", { texture = "kelp" }, "age:0-25")
plant("kelp_plant")
plant("seagrass", { replaceable = true })
tall_plant("tall_seagrass", { replaceable = true })
block("lily_pad", merge(PLANT, { shape = "lily_pad", texture = "lily_pad", tint = { 96, 150, 72 }, collision = true, sway = false }))
block("sea_pickle", merge(PLANT, { shape = "boxes", texture = "sea_pickle", sway = false, light = { 5, 6, 3 }, boxes = { { 6, 0, 6, 10, 6, 10 } },
  variants = {
    ["pickles=2"] = { boxes = { { 3, 0, 3, 7, 6, 7 }, { 9, 0, 9, 13, 5, 13 } }, light = { 7, 9, 5 } },
    ["pickles=3"] = { boxes = { { 6, 0, 9, 10, 6, 13 }, { 2, 0, 2, 6, 6, 6 }, { 9, 0, 4, 13, 4, 8 } }, light = { 9, 12, 7 } },
    ["pickles=4"] = { boxes = { { 2, 0, 2, 6, 6, 6 }, { 9, 0, 10, 13, 4, 14 }, { 9, 0, 2, 13, 6, 6 }, { 2, 0, 8, 6, 7, 12 } }, light = { 11, 15, 8 } },
    ["waterlogged=false"] = { light = 0 } } }), "pickles:1-4 wl")

for _, kind in ipairs { "tube", "brain", "bubble", "fire", "horn" } do
  for _, dead in ipairs { "", "dead_" } do
    local name = dead .. kind .. "_coral"
    block(name .. "_block", merge(STONE, { texture = name .. "_block" }))
    plant(name, { sway = dead == "" }, "wl")
    plant(name .. "_fan", { sway = dead == "" }, "wl")
    plant(name .. "_wall_fan", { texture = name .. "_fan", sway = dead == "" }, "facing wl")
  end
end
block("sponge", { texture = "sponge", material = "plant", hardness = 0.6 })
block("wet_sponge", { texture = "wet_sponge", material = "plant", hardness = 0.6 })
block("turtle_egg", merge(DECOR, { shape = "boxes", texture = "turtle_egg", boxes = { { 5, 0, 5, 9, 6, 9 } }, variants = {
  ["eggs=2"] = { boxes = { { 5, 0, 5, 9, 6, 9 }, { 10, 0, 9, 13, 4, 12 } } },
  ["eggs=3"] = { boxes = { { 5, 0, 5, 9, 6, 9 }, { 10, 0, 9, 13, 4, 12 }, { 1, 0, 9, 4, 5, 12 } } },
  ["eggs=4"] = { boxes = { { 5, 0, 5, 9, 6, 9 }, { 10, 0, 9, 13, 4, 12 }, { 1, 0, 9, 4, 5, 12 }, { 10, 0, 2, 14, 5, 6 } } } } }), "eggs:1-4 hatch:0-2")
block("sniffer_egg", merge(DECOR, { shape = "boxes", texture = "sniffer_egg", boxes = { { 1, 0, 2, 15, 16, 14 } } }), "hatch:0-2")
block("frogspawn", merge(PLANT, { shape = "lily_pad", texture = "frogspawn", sway = false }))
block("cobweb", merge(PLANT, { texture = "cobweb", sway = false, hardness = 4, viscosity = 0.9, opacity = 1 }))
