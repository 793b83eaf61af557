-- Rock and everything cut from it, in the overworld.

stone_family("stone", "slab stairs button pressure_plate")
block("infested_stone", merge(STONE, { texture = "stone", hardness = 0.75 }))
stone_family("cobblestone", "slab stairs wall", { hardness = 2 })
block("infested_cobblestone", merge(STONE, { texture = "cobblestone", hardness = 0.75 }))
stone_family("mossy_cobblestone", "slab stairs wall", { hardness = 2 })
block("smooth_stone", merge(STONE, { texture = "smooth_stone", hardness = 2 }))
slab("smooth_stone_slab", { "smooth_stone_slab_side", "smooth_stone" }, { hardness = 2 })
slab("petrified_oak_slab", "oak_planks", { hardness = 2 })
block("bedrock", merge(STONE, { texture = "bedrock", hardness = -1 }))

for _, name in ipairs { "granite", "diorite", "andesite" } do
  stone_family(name, "slab stairs wall")
  stone_family("polished_" .. name, "slab stairs")
end

stone_family("stone_bricks", "slab stairs wall")
stone_family("mossy_stone_bricks", "slab stairs wall")
for _, name in ipairs { "cracked_stone_bricks", "chiseled_stone_bricks" } do block(name, merge(STONE, { texture = name })) end
for _, name in ipairs { "stone_bricks", "mossy_stone_bricks", "cracked_stone_bricks", "chiseled_stone_bricks" } do
  block("infested_" .. name, merge(STONE, { texture = name, hardness = 0.75 }))
end
stone_family("bricks", "slab stairs wall", { hardness = 2 })
stone_family("mud_bricks", "slab stairs wall")
block("calcite", merge(STONE, { texture = "calcite", hardness = 0.75 }))
block("dripstone_block", merge(STONE, { texture = "dripstone_block" }))
block("obsidian", merge(STONE, { texture = "obsidian", hardness = 50 }))
block("crying_obsidian", merge(STONE, { texture = "crying_obsidian", hardness = 50, light = { 7, 2, 10 } }))

-- Deepslate lies along an axis, so it is a pillar; what is cut from it is not.
local deep = { hardness = 3 }
pillar("deepslate", { "deepslate", "deepslate_top" }, merge(STONE, deep))
pillar("infested_deepslate", { "deepslate", "deepslate_top" }, merge(STONE, deep))
for _, name in ipairs { "cobbled_deepslate", "polished_deepslate", "deepslate_bricks", "deepslate_tiles" } do
  stone_family(name, "slab stairs wall", deep)
end
for _, name in ipairs { "chiseled_deepslate", "cracked_deepslate_bricks", "cracked_deepslate_tiles" } do
  block(name, merge(STONE, deep, { texture = name }))
end
block("reinforced_deepslate", merge(STONE, { texture = { "reinforced_deepslate_side", "reinforced_deepslate_top" }, hardness = 55 }))

for _, name in ipairs { "tuff", "polished_tuff", "tuff_bricks" } do stone_family(name, "slab stairs wall") end
block("chiseled_tuff", merge(STONE, { texture = { "chiseled_tuff", "polished_tuff" } }))
block("chiseled_tuff_bricks", merge(STONE, { texture = { "chiseled_tuff_bricks", "tuff_bricks" } }))

-- Sandstones: a layered side, a smooth top and a rough bottom.
for _, red in ipairs { "", "red_" } do
  local s = red .. "sandstone"
  local sides, soft = { s, s .. "_top", s .. "_bottom" }, { hardness = 0.8 }
  stone_family(s, "slab stairs wall", merge(soft, { texture = sides }))
  stone_family("smooth_" .. s, "slab stairs", { texture = s .. "_top", hardness = 2 })
  block("cut_" .. s, merge(STONE, soft, { texture = { "cut_" .. s, s .. "_top" } }))
  slab("cut_" .. s .. "_slab", { "cut_" .. s, s .. "_top" }, soft)
  block("chiseled_" .. s, merge(STONE, soft, { texture = { "chiseled_" .. s, s .. "_top" } }))
end

for _, name in ipairs { "prismarine", "prismarine_bricks", "dark_prismarine" } do
  stone_family(name, name == "prismarine" and "slab stairs wall" or "slab stairs")
end
define_texture("prismarine", { frame_time = 60 })

stone_family("quartz_block", nil, { texture = "quartz_block_side", hardness = 0.8 })
shapes_of("quartz", "slab stairs", { hardness = 0.8 }, "quartz_block_side")
stone_family("smooth_quartz", "slab stairs", { texture = "smooth_quartz", hardness = 2 })
block("quartz_bricks", merge(STONE, { texture = "quartz_bricks", hardness = 0.8 }))
block("chiseled_quartz_block", merge(STONE, { texture = { "chiseled_quartz_block", "smooth_quartz" }, hardness = 0.8 }))
pillar("quartz_pillar", { "quartz_pillar", "quartz_pillar_top" }, merge(STONE, { hardness = 0.8 }))

block("pointed_dripstone", merge(STONE, { texture = "pointed_dripstone_down_tip", shape = "cross", layer = "cutout", opacity = 0,
  variants = (function()
    local v = {}
    for _, way in ipairs { "up", "down" } do
      for _, part in ipairs { "tip_merge", "tip", "frustum", "middle", "base" } do
        v["vertical_direction=" .. way .. ",thickness=" .. part] = { texture = "pointed_dripstone_" .. way .. "_" .. part }
      end
    end
    return v
  end)() }), "thickness=tip|tip_merge|frustum|middle|base vertical_direction=up|down wl")
