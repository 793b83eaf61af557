function block(n, d) define_block("minecraft:" .. n, d) end function merge(a) return a end SIDES4 = ""
-- Air and what flows. Liquid textures are {flowing sides, still top}.

local air = { shape = "none", texture = "glass", opacity = 0, transparency = 1, collision = false, replaceable = true,
  hidden_from_hotbar = true, hardness = 0, material = "glass" }
for _, name in ipairs { "air", "cave_air", "void_air", "barrier", "light", "structure_void", "moving_piston", "end_gateway" } do
  local more, props = nil, nil
  if name == "barrier" then more, props = { collision = true, replaceable = false, hardness = -1 }, "wl" end
  if name == "moving_piston" then props = "facing6 type=normal|sticky" end
  if name == "light" then
    local v = {}
    for i = 0, 15 do v["level=" .. i] = { light = i } end
    more, props = { variants = v, default = { level = "15" } }, "level:0-15 wl"
  end
  block(name, merge(air, more), props)
end

block("water", { texture = { "water_flow", "water_still" }, shape = "liquid", layer = "translucent", transparency = 0.7, opacity = 1,
  collision = false, viscosity = 0.2, tint = "water", material = "water", replaceable = true, hardness = 100 }, "level:0-15")
block("bubble_column", { texture = { "water_flow", "water_still" }, shape = "liquid", layer = "translucent", transparency = 0.7, opacity = 1,
  collision = false, viscosity = 0.2, tint = "water", material = "water", replaceable = true, hardness = 100,
  hidden_from_hotbar = true }, "drag!")
block("lava", { texture = { "lava_flow", "lava_still" }, shape = "liquid", layer = "solid", opacity = 0, light = { 15, 10, 4 },
  collision = false, viscosity = 0.6, material = "lava", replaceable = true, hardness = 100 }, "level:0-15")

define_texture("water_still", { frame_time = 3 })
define_texture("water_flow", { frame_time = 2 })
define_texture("lava_still", { frame_time = 4 })
define_texture("lava_flow", { frame_time = 3 })

block("fire", { texture = "fire", shape = "cross", layer = "cutout", opacity = 0, light = { 15, 11, 5 }, collision = false,
  replaceable = true, hardness = 0, material = "plant", hidden_from_hotbar = true }, "age:0-15 " .. SIDES4 .. " up?")
block("soul_fire", { texture = "soul_fire", shape = "cross", layer = "cutout", opacity = 0, light = { 3, 9, 12 }, collision = false,
  replaceable = true, hardness = 0, material = "plant", hidden_from_hotbar = true })
define_texture("fire", { frame_time = 2 })
define_texture("soul_fire", { frame_time = 2 })

block("nether_portal", { texture = "nether_portal", shape = "boxes", boxes = { { 0, 0, 6, 16, 16, 10 } }, layer = "translucent",
  transparency = 0.4, opacity = 0, light = { 8, 3, 11 }, collision = false, hardness = -1, material = "glass", hidden_from_hotbar = true,
  variants = { ["axis=z"] = { boxes = { { 6, 0, 0, 10, 16, 16 } } } } }, "axis_h")
define_texture("nether_portal", { frame_time = 2 })
block("end_portal", { texture = "end_portal", shape = "boxes", boxes = { { 0, 6, 0, 16, 12, 16 } }, opacity = 0, light = 15,
  collision = false, hardness = -1, material = "glass", hidden_from_hotbar = true })
