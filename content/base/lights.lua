-- Blocks whose first purpose is light.

local glow = { material = "glass", hardness = 0.3 }
-- Each color loses a step a block, so what starts far apart ends as deep red: lamps of caves begin near white.
block("glowstone", merge(glow, { texture = "glowstone", light = { 15, 13, 9 } }))
block("sea_lantern", merge(glow, { texture = "sea_lantern", light = { 11, 14, 15 } }))
define_texture("sea_lantern", { frame_time = 6 })
block("shroomlight", { texture = "shroomlight", material = "plant", hardness = 1, light = { 15, 12, 8 } })
for name, light in pairs { ochre = { 15, 13, 7 }, verdant = { 10, 15, 9 }, pearlescent = { 14, 11, 15 } } do
  pillar(name .. "_froglight", { name .. "_froglight_side", name .. "_froglight_top" }, { material = "plant", hardness = 0.3, light = light })
end

local warm, soul = { 14, 10, 5 }, { 4, 9, 11 }
local torch = { layer = "cutout", opacity = 0, collision = false, hardness = 0, material = "wood" }
for _, t in ipairs { { "", "torch", warm }, { "soul_", "soul_torch", soul } } do
  block(t[1] .. "torch", merge(torch, { shape = "torch", texture = t[2], light = t[3] }))
  block(t[1] .. "wall_torch", merge(torch, { shape = "wall_torch", texture = t[2], light = t[3] }), "facing")
end
local dark = { ["lit=false"] = { texture = "redstone_torch_off", light = 0 } }
block("redstone_torch", merge(torch, { shape = "torch", texture = "redstone_torch", light = { 7, 1, 1 }, variants = dark }), "lit!")
block("redstone_wall_torch", merge(torch, { shape = "wall_torch", texture = "redstone_torch", light = { 7, 1, 1 }, variants = dark }), "facing lit!")

for name, light in pairs { lantern = { 15, 11, 6 }, soul_lantern = { 4, 9, 11 } } do
  block(name, merge(METAL, { shape = "lantern", texture = { name, name .. "_top" }, layer = "cutout", opacity = 0, light = light, hardness = 3.5 }),
    "hanging? wl")
end
block("chain", merge(METAL, { shape = "chain", texture = "chain", layer = "cutout", opacity = 0 }), "axis wl")

block("redstone_lamp", merge(glow, { texture = "redstone_lamp", variants = { ["lit=true"] = { texture = "redstone_lamp_on", light = { 15, 11, 6 } } } }),
  "lit?")

local logs = { { 0, 0, 1, 16, 4, 5 }, { 0, 0, 11, 16, 4, 15 }, { 1, 3, 0, 5, 7, 16 }, { 11, 3, 0, 15, 7, 16 }, { 5, 0, 5, 11, 1, 11 } }
for _, c in ipairs { { "campfire", "fire", warm }, { "soul_campfire", "soul_fire", soul } } do
  local lit = { table.unpack(logs) }
  lit[#lit + 1] = { 1, 1, 8, 15, 16, 8, c[2] }
  lit[#lit + 1] = { 8, 1, 1, 8, 16, 15, c[2] }
  local variants = { ["lit=true"] = { light = c[3], boxes = lit }, ["lit=false"] = { texture = "oak_log" } }
  for key, value in pairs(turned(lit, "lit=true")) do variants[key] = value end
  for key, value in pairs(turned(logs, "lit=false")) do variants[key] = value end
  block(c[1], merge(DECOR, { shape = "boxes", texture = { "campfire_log", "campfire_log" }, boxes = logs, material = "wood", hardness = 2,
    variants = variants }), "facing lit! signal_fire? wl")
end
