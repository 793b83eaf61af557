-- Every wood that Minecraft has: logs, planks, leaves and saplings.

for _, wood in ipairs { "oak", "spruce", "birch", "jungle", "acacia", "dark_oak", "mangrove", "cherry", "pale_oak" } do
  log_family(wood, "log", "wood")
  plank_family(wood)
end
for _, wood in ipairs { "crimson", "warped" } do
  log_family(wood, "stem", "hyphae")
  plank_family(wood)
end

plank_family("bamboo")
pillar("bamboo_block", { "bamboo_block", "bamboo_block_top" })
pillar("stripped_bamboo_block", { "stripped_bamboo_block", "stripped_bamboo_block_top" })
block("bamboo_mosaic", merge(WOOD, { texture = "bamboo_mosaic" }))
stairs("bamboo_mosaic_stairs", "bamboo_mosaic", WOOD)
slab("bamboo_mosaic_slab", "bamboo_mosaic", WOOD)

-- Broad leaves take the biome's color; needles, birch and the flowering ones are painted as they are.
for _, wood in ipairs { "oak", "jungle", "acacia", "dark_oak", "mangrove" } do leaves(wood .. "_leaves", { tint = "foliage" }) end
for _, name in ipairs { "spruce_leaves", "birch_leaves", "cherry_leaves", "pale_oak_leaves", "azalea_leaves", "flowering_azalea_leaves" } do
  leaves(name)
end

for _, wood in ipairs { "oak", "spruce", "birch", "jungle", "acacia", "dark_oak", "cherry", "pale_oak" } do
  plant(wood .. "_sapling", nil, "stage:0-1")
  potted(wood .. "_sapling")
end
plant("mangrove_propagule", nil, "age:0-4 hanging? stage:0-1 wl")
potted("mangrove_propagule")
block("mangrove_roots", merge(WOOD, { texture = { "mangrove_roots_side", "mangrove_roots_top" }, layer = "cutout", opacity = 1, hardness = 0.7 }),
  "wl")
