-- Last, so that every name is defined: what a new player holds.

define_hotbar { "minecraft:stone", "minecraft:grass_block", "minecraft:oak_log", "minecraft:oak_planks", "minecraft:stone_bricks",
  "minecraft:glass", "minecraft:glowstone", "minecraft:torch", "minecraft:water" }
