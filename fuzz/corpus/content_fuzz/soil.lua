-- Loose ground: what lies on the rock and what grows over it.

local function soil(name, def) block(name, merge({ texture = name, material = "dirt", hardness = 0.5 }, def)) end

soil("dirt")
soil("coarse_dirt")
soil("rooted_dirt")
soil("clay", { hardness = 0.6 })
soil("mud")
soil("packed_mud", { hardness = 1 })
soil("moss_block", { material = "plant", hardness = 0.1 })
block("moss_carpet", { texture = "moss_block", shape = "carpet", material = "plant", hardness = 0.1, opacity = 0 })
soil("pale_moss_block", { material = "plant", hardness = 0.1 })
block("pale_moss_carpet", { texture = "pale_moss_block", shape = "carpet", material = "plant", hardness = 0.1, opacity = 0 },
  "bottom! north=none|low|tall east=none|low|tall south=none|low|tall west=none|low|tall")
soil("muddy_mangrove_roots", { texture = { "muddy_mangrove_roots_side", "muddy_mangrove_roots_top" }, hardness = 0.7 })

-- The side of grass is painted green beforehand, so only its top takes the biome's tint.
GRASS_SNOWY = { ["snowy=true"] = { texture = { "grass_block_snow", "snow", "dirt" }, tint = { 255, 255, 255 } } }
block("grass_block", { texture = { "grass_block_side", "grass_block_top", "dirt" }, tint = "grass", tint_faces = "top",
  material = "dirt", hardness = 0.6, variants = GRASS_SNOWY }, "snowy?")
for _, name in ipairs { "podzol", "mycelium" } do
  block(name, { texture = { name .. "_side", name .. "_top", "dirt" }, material = "dirt", hardness = 0.6,
    variants = { ["snowy=true"] = { texture = { "grass_block_snow", "snow", "dirt" } } } }, "snowy?")
end
block("dirt_path", { texture = { "dirt_path_side", "dirt_path_top", "dirt" }, material = "dirt", hardness = 0.6, opacity = 0,
  shape = "boxes", boxes = { { 0, 0, 0, 16, 15, 16 } } })
block("farmland", { texture = { "dirt", "farmland", "dirt" }, material = "dirt", hardness = 0.6, opacity = 0, shape = "boxes",
  boxes = { { 0, 0, 0, 16, 15, 16 } }, variants = { ["moisture=7"] = { texture = { "dirt", "farmland_moist", "dirt" } } } },
  "moisture:0-7")

for _, name in ipairs { "sand", "red_sand" } do soil(name, { material = "sand" }) end
soil("suspicious_sand", { material = "sand" })
soil("gravel", { material = "sand", hardness = 0.6 })
soil("suspicious_gravel", { material = "sand", hardness = 0.6 })

block("snow", { texture = "snow", shape = "layers", material = "snow", hardness = 0.1, opacity = 0, replaceable = true,
  variants = { ["layers=8"] = { opacity = 15, replaceable = false } } }, "layers:1-8")
soil("snow_block", { texture = "snow", material = "snow", hardness = 0.2 })
block("powder_snow", { texture = "powder_snow", material = "snow", hardness = 0.25, opacity = 1, collision = false, viscosity = 0.5 })
block("ice", { texture = "ice", material = "ice", layer = "translucent", transparency = 0.5, opacity = 1, hardness = 0.5 })
block("frosted_ice", { texture = "ice", material = "ice", layer = "translucent", transparency = 0.5, opacity = 1, hardness = 0.5 },
  "age:0-3")
block("packed_ice", { texture = "packed_ice", material = "ice", hardness = 0.5 })
block("blue_ice", { texture = "blue_ice", material = "ice", hardness = 2.8 })

for _, name in ipairs { "sculk" } do soil(name, { material = "plant", hardness = 0.2 }) end
block("sculk_vein", merge(PLANT, { texture = "sculk_vein", shape = "faces", sway = false }), SIDES6 .. " wl")
block("sculk_catalyst", { texture = { "sculk_catalyst_side", "sculk_catalyst_top", "sculk_catalyst_bottom" }, light = 6,
  material = "plant", hardness = 3 }, "bloom?")
block("sculk_shrieker", { texture = { "sculk_shrieker_side", "sculk_shrieker_top", "sculk" }, shape = "boxes",
  boxes = { { 0, 0, 0, 16, 8, 16 } }, opacity = 0, material = "plant", hardness = 3 }, "can_summon? shrieking? wl")
local sensor = { texture = { "sculk_sensor_side", "sculk_sensor_top", "sculk" }, shape = "boxes", layer = "cutout", opacity = 0, light = 1,
  material = "plant", hardness = 1.5, boxes = { { 0, 0, 0, 16, 8, 16 }, { 1, 8, 3, 5, 16, 3, "sculk_sensor_tendril" },
    { 11, 8, 3, 15, 16, 3, "sculk_sensor_tendril" }, { 1, 8, 13, 5, 16, 13, "sculk_sensor_tendril" },
    { 11, 8, 13, 15, 16, 13, "sculk_sensor_tendril" } } }
local phases = "power:0-15 sculk_sensor_phase=inactive|active|cooldown wl"
block("sculk_sensor", sensor, phases)
block("calibrated_sculk_sensor", sensor, "facing " .. phases)
