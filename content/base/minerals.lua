-- Ores, what is smelted from them, and amethyst.

for _, ore in ipairs { "coal", "iron", "copper", "gold", "redstone", "emerald", "lapis", "diamond" } do
  for _, rock in ipairs { "", "deepslate_" } do
    local name = rock .. ore .. "_ore"
    local def = merge(STONE, { texture = name, hardness = rock == "" and 3 or 4.5 })
    if ore == "redstone" then
      block(name, merge(def, { variants = { ["lit=true"] = { light = { 9, 2, 1 } } } }), "lit?")
    else
      block(name, def)
    end
  end
end
block("nether_gold_ore", merge(STONE, { texture = "nether_gold_ore", hardness = 3 }))
block("nether_quartz_ore", merge(STONE, { texture = "nether_quartz_ore", hardness = 3 }))

for _, name in ipairs { "iron_block", "gold_block", "netherite_block" } do
  block(name, merge(METAL, { texture = name }))
end
-- They sound like metal, but are gems and ore.
for _, name in ipairs { "diamond_block", "emerald_block", "raw_iron_block", "raw_gold_block", "raw_copper_block" } do
  block(name, merge(METAL, { texture = name, optics = "matte" }))
end
block("coal_block", merge(STONE, { texture = "coal_block", hardness = 5 }))
block("lapis_block", merge(STONE, { texture = "lapis_block", hardness = 3 }))
block("redstone_block", merge(METAL, { texture = "redstone_block", optics = "matte" }))
block("ancient_debris", merge(METAL, { optics = "matte", texture = { "ancient_debris_side", "ancient_debris_top" }, hardness = 30 }))

local crystal = { material = "crystal", hardness = 1.5 }
block("amethyst_block", merge(crystal, { texture = "amethyst_block" }))
block("budding_amethyst", merge(crystal, { texture = "budding_amethyst" }))
-- Clusters grow from any face. Crossed sprites read well from every side, so only the hanging one has its own picture.
local function bud(name, light)
  block(name, merge(crystal, { shape = "cross", texture = name, layer = "cutout", opacity = 0, light = light, collision = false,
    variants = { ["facing=down"] = { texture = name .. "_down" } } }), "facing_up wl")
end
bud("small_amethyst_bud", { 1, 0, 1 })
bud("medium_amethyst_bud", { 2, 1, 2 })
bud("large_amethyst_bud", { 3, 2, 4 })
bud("amethyst_cluster", { 4, 3, 5 })
