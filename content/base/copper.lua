-- Copper through its four stages of weather; a waxed block looks like the stage it was waxed at.

for _, wax in ipairs { "", "waxed_" } do
  for _, stage in ipairs { "", "exposed_", "weathered_", "oxidized_" } do
    -- The patina of the later stages is a salt.
    local def = merge(METAL, { hardness = 3, optics = (stage == "weathered_" or stage == "oxidized_") and "matte" or nil })
    local full = stage == "" and "copper_block" or stage .. "copper"
    block(wax .. full, merge(def, { texture = full }))
    local cut = stage .. "cut_copper"
    block(wax .. cut, merge(def, { texture = cut }))
    stairs(wax .. cut .. "_stairs", cut, def)
    slab(wax .. cut .. "_slab", cut, def)
    block(wax .. stage .. "chiseled_copper", merge(def, { texture = stage .. "chiseled_copper" }))
    block(wax .. stage .. "copper_grate", merge(def, { texture = stage .. "copper_grate", layer = "cutout", opacity = 0 }), "wl")
    local name = stage .. "copper_door"
    block(wax .. name, merge(def, { shape = "door", layer = "cutout", opacity = 0, texture = name .. "_bottom",
      variants = { ["half=upper"] = { texture = name .. "_top" } } }), "facing half_tall hinge=left|right open? powered?")
    block(wax .. stage .. "copper_trapdoor", merge(def, { shape = "trapdoor", layer = "cutout", opacity = 0, texture = stage .. "copper_trapdoor" }),
      "facing half_block open? powered? wl")
    local glow = ({ [""] = 15, exposed_ = 12, weathered_ = 8, oxidized_ = 4 })[stage]
    local bulb = stage .. "copper_bulb"
    block(wax .. bulb, merge(def, { texture = bulb, variants = {
      ["lit=true"] = { texture = bulb .. "_lit", light = { glow, math.floor(glow * 0.8), math.floor(glow * 0.5) } } } }), "lit? powered?")
  end
end

block("lightning_rod", merge(METAL, { shape = "boxes", texture = "copper_block", opacity = 0, hardness = 3,
  boxes = { { 7, 0, 7, 9, 12, 9 }, { 6, 12, 6, 10, 16, 10 } },
  variants = turned6 { { 7, 7, 4, 9, 9, 16 }, { 6, 6, 0, 10, 10, 4 } } }), "facing_up powered? wl")
