define_block("lamp", { properties = { lit = { true, false }, power = { 0, 1, 2 } }, default = { lit = false, power = 2 },
  texture = { "lamp_side", "lamp_top" }, shape = "slab", layer = "cutout_mipped", transparency = 0.25, opacity = 3, light = { 1, 2, 3 },
  hardness = -1, viscosity = 0.5, collision = false, tint = { 10, 20, 30 }, tint_faces = "top", material = "metal", replaceable = true,
  climbable = true, sway = true, hidden_from_hotbar = true, boxes = { { 0, 0, 0, 16, 0.25, 16, "wire" } },
  variants = { ["lit=true"] = { light = 9 }, ["lit=true,power=1"] = { shape = "boxes", texture = "x" }, ["power=2"] = { tint = "water" } } })
define_texture("fire", { frame_time = 2 })
define_biome("plains", { temperature = 0.5, downfall = 0.25, grass = { 1, 2, 3 }, foliage = { 4, 5, 6 }, sky = { 7, 8, 9 }, fog = { 1, 1, 1 } })
define_material(4, { name = "Old Clay", texture = "clay", light = 3 })
define_hotbar { "lamp", "vitrail:old_clay" }
