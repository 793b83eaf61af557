world { name = "Garden", spawn = { 0, 70, 0 }, yaw = 90, time = 6000 }
biome("plains") biome("plains", -8, -8, 8, 8)
local h = {}
for z = 0, 3 do for x = 0, 3 do h[#h + 1] = 60 + noise(x, z, 3, 7, 2) * 4 end end
land { x = -12, z = -12, step = 8, width = 4, heights = h, bottom = 50, rock = "stone", water = 60,
  cover = { { top = "dirt", under = "dirt", depth = 3, above = 60, wander = 2, steeper = 0, flatter = 2 }, { top = "stone", below = 60 } } }
fill(0, 60, 0, 4, 62, 4, "stone") fill(0, 60, 0, 4, 62, 4, "dirt", "stone") shell(-4, 60, -4, 4, 66, 4, "stone", "air")
sphere(0, 64, 0, 3.5, "stone") sphere(0, 64, 0, { 1, 2, 3 }, "air") cylinder(5, 60, 5, 2.5, 4, "stone") cone(-5, 60, 5, { 2, 3 }, 4, "dirt")
line(0, 60, 0, 9, 64, -9, "stone") stairs(0, top(0, 0), 0, "north", 2, 3, "oak_stairs", "stone")
fill(0, 70, 0, 9, 70, 0, "oak_fence[north=true]") set(3, 71, 3, "water[level=8]", "air")
print(get(0, 60, 0))
station { name = "a", effect = "b", at = { 0, 70, 0 }, look = { 45, -10 }, fov = 60, time = 12000, text = "c", without = "d.e=f" }
station { name = "g", effect = "b", at = { 0, 70, 0 }, look = { 45, -10 }, without = { "d.e=f", "h.i=1.5" } }
