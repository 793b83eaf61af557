-- The demo world: a park between a bay and mountains, with one marked station for each effect of the renderer.
--   vitrail generate --script content/demo/stations.lua --world DIR --stations FILE.json
-- x is east, z south; the sun rises in the east, stands in the south at noon and sets over the bay in the west. The lawn's feet
-- are at y = 66, the sea's at 63. docs/demo.md shows every station.

local FEET, SEA = 66, 62
world { name = "Vitrail park", spawn = { 0, FEET, 12 }, yaw = 180, time = 2600 }
biome("plains")
biome("taiga", -208, -208, 207, -96)
biome("forest", -40, 58, 207, 207)
biome("beach", -208, -95, -61, 207)

local MARBLE, POLISHED_SLATE, BRICK = "vitrail:polished_marble", "vitrail:polished_slate", "vitrail:marble_bricks"

-- Helpers -----------------------------------------------------------------------------------------------------------------------

local function smooth(from, to, v)
  local t = math.max(0, math.min(1, (v - from) / (to - from)))
  return t * t * (3 - 2 * t)
end

local function pick(list) return list[math.random(#list)] end

--- Calls f(x, z, distance from the middle) for a disc.
local function disc(x, z, r, f)
  for dz = -math.ceil(r), math.ceil(r) do
    for dx = -math.ceil(r), math.ceil(r) do
      local d = math.sqrt(dx * dx + dz * dz)
      if d <= r then f(x + dx, z + dz, d) end
    end
  end
end

--- Flattens ground for building: `floor` at y, air above, foundations below.
local function level(x0, z0, x1, z1, y, floor, height)
  fill(x0, y - 6, z0, x1, y - 1, z1, "stone")
  fill(x0, y, z0, x1, y, z1, floor)
  fill(x0, y + 1, z0, x1, y + (height or 12), z1, "air")
end

--- A station: paving where one stands, a plinth behind, and the place itself. x, y, z: the block of the feet.
local function place(name, effect, x, y, z, yaw, pitch, more)
  if not more.bare then
    fill(x - 1, y - 1, z - 1, x + 1, y - 1, z + 1, "chiseled_stone_bricks")
    set(x, y - 1, z, "gold_block")
    fill(x - 1, y, z - 1, x + 1, y + 2, z + 1, "air", more.over)
    local a = math.rad(yaw)
    local px, pz = x + math.floor(2.6 * math.sin(a) + .5), z - math.floor(2.6 * math.cos(a) + .5)
    set(px, y - 1, pz, "chiseled_stone_bricks")
    set(px, y, pz, "polished_blackstone_wall")
    set(px, y + 1, pz, "gold_block")
  end
  station { name = name, effect = effect, at = { x + .5, y + (more.eye or 1.62), z + .5 }, look = { yaw, pitch }, fov = more.fov, time = more.time,
    text = more.text, without = more.without }
end

-- The land ----------------------------------------------------------------------------------------------------------------------

local function height(x, z)
  local wild = noise(x, z, 70, 1, 4)
  local sea = smooth(-64, -84, x + 9 * noise(x, z, 45, 2, 2))
  local deep = smooth(-84, -150, x)
  local north = smooth(-78, -178, z) * (58 + 62 * noise(x, z, 60, 3, 4))
  local mist = smooth(13, 36, math.abs(z - 84 - 4 * noise(x, 0, 60, 9)))
  local east = smooth(64, 130, x) * (30 + 34 * noise(x, z, 50, 4, 3)) * mist
  local south = smooth(104, 176, z) * (18 + 22 * noise(x, z, 50, 5, 3))
  local hills = math.max(0, north) + math.max(0, east) + math.max(0, south)
  local rolling = smooth(58, 90, math.max(math.abs(x), math.abs(z))) * 3 * wild
  local h = FEET + rolling + hills * (1 - .85 * sea)
  h = h - sea * (10 + 14 * deep) + sea * 2 * noise(x, z, 18, 6, 2)
  for _, island in ipairs { { -150, -62, 26, 26 }, { -178, 28, 17, 16 } } do
    local dx, dz = (x - island[1]) / island[3], (z - island[2]) / island[3]
    h = h + math.max(0, 1 - dx * dx - dz * dz) * (island[4] + 14 * noise(x, z, 20, 7, 3))
  end
  return math.max(30, math.min(150, h))
end

local EDGE, STEP = 208, 4
do
  local heights = {}
  for z = -EDGE, EDGE, STEP do
    for x = -EDGE, EDGE, STEP do heights[#heights + 1] = height(x, z) end
  end
  land { x = -EDGE, z = -EDGE, step = STEP, width = 2 * EDGE // STEP + 1, heights = heights, bottom = 16, water = SEA, cover = {
    { top = "snow_block", depth = 2, above = 103, wander = 7, flatter = 1.7 },
    { top = "stone", steeper = 1.25, above = 66 },
    { top = "sand", depth = 4, below = 64 },
    { top = "gravel", above = 92, wander = 6, steeper = .95 },
    { top = "grass_block", under = "dirt", depth = 4 },
  } }
end

-- Plants ------------------------------------------------------------------------------------------------------------------------

local function ground(x, z) -- y of the feet, and what one stands on
  local y = top(x, z)
  return y, get(x, y - 1, z)
end

local function is_grass(block) return string.find(block, "grass_block", 1, true) ~= nil end

local function crown(x, y, z, r, leaf)
  for _ = 1, 5 do
    local dx, dy, dz = math.random() - .5, math.random() - .5, math.random() - .5
    sphere(x + dx * r * 1.1, y + dy * r * .7, z + dz * r * 1.1, { r * .78, r * .62, r * .78 }, leaf .. "[persistent=true]", "air")
  end
end

local function broad_tree(x, y, z, tall, r, wood, leaf)
  fill(x, y, z, x, y + tall, z, wood .. "_log")
  crown(x, y + tall + r * .25, z, r, leaf)
  set(x, y - 1, z, "dirt", "grass_block")
end

local function spruce(x, y, z, tall, snowy)
  fill(x, y, z, x, y + tall - 1, z, "spruce_log")
  local k = 2 + math.random(2)
  for dy = k, tall do
    local t = (dy - k) / (tall - k)
    local r = (1 - t) * (tall * .24 + .6) * (((dy - k) % 2 == 0) and 1 or .62) + .35
    cylinder(x, y + dy, z, r, 1, "spruce_leaves[persistent=true]", "air")
    if snowy and (dy - k) % 2 == 0 then
      disc(x, z, r, function(bx, bz, d)
        if d > r - 1.6 and get(bx, y + dy + 1, bz) == "minecraft:air" then set(bx, y + dy + 1, bz, "snow[layers=" .. math.random(2) .. "]") end
      end)
    end
  end
  set(x, y + tall + 1, z, "spruce_leaves[persistent=true]")
end

-- Forests on the hills.
for _ = 1, 900 do
  local x, z = math.random(-70, EDGE - 6), math.random(-EDGE + 6, EDGE - 6)
  local y, under = ground(x, z)
  local wild = math.max(math.abs(x), math.abs(z)) > 66
  if wild and noise(x, z, 40, 21, 2) > -.12 and y < 108 then
    if is_grass(under) and (z < -70 or y > 84) then
      spruce(x, y, z, 7 + math.random(6), y > 92)
    elseif is_grass(under) and not (z > 60 and z < 112) then
      broad_tree(x, y, z, 4 + math.random(3), 2.6 + math.random(), pick { "oak", "oak", "birch" }, "oak_leaves")
    end
  end
end

--- Grass and flowers where grass is open to the sky.
local function meadow(x0, z0, x1, z1, count, flowers)
  for _ = 1, count do
    local x, z = math.random(x0, x1), math.random(z0, z1)
    local y, under = ground(x, z)
    local lamps = x >= 43 and x <= 63 and z >= 22 and z <= 46 and math.random() < .75
    if is_grass(under) and not lamps then
      local n = noise(x, z, 9, 31)
      if n > .18 then set(x, y, z, pick(flowers), "air") elseif n > -.35 then set(x, y, z, "short_grass", "air") end
    end
  end
end

-- The plaza, its needle, and the avenue to the north ----------------------------------------------------------------------------

level(-15, -15, 15, 15, FEET - 1, "grass_block", 30)
disc(0, 0, 15.4, function(x, z, d)
  local ring = d > 14.4 and "smooth_stone" or d > 10.5 and d < 11.5 and BRICK or (x + z) % 2 == 0 and "polished_andesite" or "smooth_stone"
  set(x, FEET - 1, z, ring)
end)
-- A dial for the needle's shadow.
level(-54, -17, -12, -5, FEET - 1, "smooth_stone", 14)
for x = -54, -13 do
  for z = -17, -5 do
    local a = math.deg(math.atan(-z, -x))
    local hour = math.floor(a / 4)
    if z == -17 or z == -5 then set(x, FEET - 1, z, BRICK)
    elseif x % 12 == 0 then set(x, FEET - 1, z, "polished_andesite")
    elseif a - hour * 4 < 1 then set(x, FEET - 1, z, "cut_sandstone") end
  end
end
disc(0, 0, 15.4, function(x, z, d) if x < -10 then set(x, FEET - 1, z, d > 14.4 and BRICK or "smooth_stone") end end)
cylinder(0, FEET, 0, 3.3, 1, "smooth_quartz")
cylinder(0, FEET + 1, 0, 2.3, 1, BRICK)
fill(-1, FEET + 2, -1, 1, FEET + 6, 1, BRICK)
fill(0, FEET + 7, 0, 0, FEET + 25, 0, "quartz_pillar")
for dy = 7, 18 do
  for _, d in ipairs { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } } do set(d[1], FEET + dy, d[2], dy < 18 and "quartz_pillar" or "smooth_quartz_slab") end
end
fill(0, FEET + 26, 0, 0, FEET + 27, 0, "gold_block")
for _, c in ipairs { { -12, -3 }, { -12, 3 }, { 12, -3 }, { 12, 3 }, { -3, 12 }, { 3, 12 }, { -3, -12 }, { 3, -12 } } do
  set(c[1], FEET, c[2], "stone_brick_wall")
  set(c[1], FEET + 1, c[2], "lantern")
end

local function column(x, y, z, tall)
  set(x, y, z, "chiseled_quartz_block")
  fill(x, y + 1, z, x, y + tall - 2, z, "quartz_pillar")
  set(x, y + tall - 1, z, "chiseled_quartz_block")
end

level(-9, -62, 9, -15, FEET - 1, "grass_block", 20)
for z = -62, -15 do
  for x = -3, 3 do set(x, FEET - 1, z, (math.abs(x) == 3) and "smooth_stone" or (x + z) % 3 == 0 and "polished_diorite" or "polished_andesite") end
end
for z = -58, -18, 5 do
  for _, x in ipairs { -5, 5 } do column(x, FEET, z, 7) end
  if z > -58 then
    for _, x in ipairs { -5, 5 } do
      set(x, FEET, z - 2, "flowering_azalea")
      set(x, FEET, z - 3, "azalea")
    end
  end
end
for _, x in ipairs { -5, 5 } do fill(x, FEET + 7, -58, x, FEET + 7, -18, BRICK) end

-- The belvedere: terraces up the northern slope.
for i = 0, 2 do
  local z0, y = -63 - 7 * i, FEET + 3 * i
  level(-16 + 2 * i, z0 - 12, 16 - 2 * i, z0, y + 2, "grass_block", 26)
  fill(-16 + 2 * i, y - 1, z0, 16 - 2 * i, y + 2, z0, BRICK)
  fill(-16 + 2 * i, y + 3, z0, 16 - 2 * i, y + 3, z0, "vitrail:marble_brick_wall")
  fill(-3, y, z0, 3, y + 4, z0, "air")
  fill(-3, FEET - 1, z0 - 3, 3, y + 2, z0 - 3, BRICK)
  fill(-3, y, z0 - 2, 3, y + 6, z0, "air")
  stairs(-3, y, z0, "north", 7, 3, "vitrail:marble_brick_stairs", BRICK)
  fill(-3, y + 2, z0 - 6, 3, y + 2, z0 - 3, MARBLE)
  if i == 0 then
    for _, x in ipairs { -12, 12 } do broad_tree(x, y + 3, z0 - 4, 3, 2.3, "cherry", "cherry_leaves") end
  else
    for _, x in ipairs { -12 + 2 * i, 12 - 2 * i } do
      fill(x - 1, y + 3, z0 - 4, x + 1, y + 3, z0 - 4, "flowering_azalea")
      set(x, y + 3, z0 - 4, "stone_brick_wall")
      set(x, y + 4, z0 - 4, "lantern")
    end
  end
end
do -- a round temple on top
  local y, z = FEET + 9, -86
  disc(0, z, 8.4, function(bx, bz, d) fill(bx, y - 8, bz, bx, y - 1, bz, d > 7.4 and BRICK or MARBLE) fill(bx, y, bz, bx, y + 16, bz, "air") end)
  for i = 0, 9 do
    local a = (i + .5) / 10 * 2 * math.pi
    column(math.floor(6.3 * math.sin(a) + .5), y, z + math.floor(6.3 * math.cos(a) + .5), 6)
  end
  disc(0, z, 7.4, function(bx, bz, d) if d > 5.3 then set(bx, y + 6, bz, "smooth_quartz") end end)
  for k = 0, 5 do
    local r = math.sqrt(math.max(0, 7.4 * 7.4 * (1 - (k / 6) ^ 2)))
    disc(0, z, r, function(bx, bz, d) if d > r - 1.9 then set(bx, y + 7 + k, bz, "oxidized_cut_copper") end end)
  end
  fill(0, y + 13, z, 0, y + 14, z, "lightning_rod")
  set(0, y, z, "chiseled_quartz_block")
  set(0, y + 1, z, "sea_lantern")
end

-- The chapel: white walls, colored windows --------------------------------------------------------------------------------------

do
  local x0, x1, z0, z1, y = 27, 41, -38, -9, FEET
  level(x0 - 2, z0 - 2, x1 + 2, z1 + 3, y - 1, "grass_block", 30)
  fill(x0, y - 1, z0, x1, y - 1, z1, "smooth_quartz")
  fill(x0 + 6, y - 1, z0 + 1, x1 - 6, y - 1, z1, "polished_diorite")
  shell(x0, y - 1, z0, x1, y + 13, z1, BRICK)
  fill(x0 + 1, y, z0 + 1, x1 - 1, y + 13, z1 - 1, "air")
  fill(x0 + 1, y - 1, z0 + 1, x1 - 1, y - 1, z1 - 1, "smooth_quartz")
  for k = 0, 7 do -- the roof
    fill(x0 - 1 + k, y + 13 + k, z0 - 1, x0 - 1 + k, y + 13 + k, z1 + 1, "vitrail:slate_brick_stairs[facing=east]")
    fill(x1 + 1 - k, y + 13 + k, z0 - 1, x1 + 1 - k, y + 13 + k, z1 + 1, "vitrail:slate_brick_stairs[facing=west]")
    for _, z in ipairs { z0, z1 } do fill(x0 + k, y + 13 + k, z, x1 - k, y + 13 + k, z, BRICK) end
    fill(x0 + k, y + 13 + k, z0 + 1, x0 + k, y + 13 + k, z1 - 1, "spruce_planks")
    fill(x1 - k, y + 13 + k, z0 + 1, x1 - k, y + 13 + k, z1 - 1, "spruce_planks")
  end
  fill(34, y + 21, z0 - 1, 34, y + 21, z1 + 1, "vitrail:slate_brick_slab")
  local panes = { { "red", "orange", "yellow" }, { "blue", "light_blue", "cyan" }, { "magenta", "purple", "pink" }, { "lime", "yellow", "green" },
    { "orange", "red", "magenta" }, { "cyan", "lime", "light_blue" } }
  for i = 0, 5 do -- tall windows between buttresses
    local z = z0 + 3 + i * 4 + (i > 2 and 1 or 0)
    for s, x in ipairs { x0, x1 } do
      for dy = 2, 10 do
        local colors = panes[(i + s) % 6 + 1]
        for dz = 0, 2 do
          local color = (dy == 10 and dz ~= 1) and nil or colors[(dy + (dz == 1 and 1 or 0)) % 3 + 1]
          if color then set(x, y + dy, z + dz, color .. "_stained_glass") end
        end
      end
      local out = s == 1 and x - 1 or x + 1
      fill(out, y - 1, z - 1, out, y + 8, z - 1, BRICK)
      set(out, y + 9, z - 1, "vitrail:marble_brick_stairs[facing=" .. (s == 1 and "east" or "west") .. "]")
    end
  end
  for dz = -5, 5 do -- the rose above the altar
    for dy = -5, 5 do
      local d, a = math.sqrt(dz * dz + dy * dy), math.atan(dy, dz)
      if d <= 4.4 then
        local color = d < 1.2 and "yellow" or d < 2.7 and ((math.floor((a + math.pi) / math.pi * 4) % 2 == 0) and "red" or "orange")
          or ((math.floor((a + math.pi) / math.pi * 6) % 2 == 0) and "blue" or "light_blue")
        set(34 + dz, y + 10 + dy, z0, color .. "_stained_glass")
      end
    end
  end
  fill(33, y, z1, 35, y + 3, z1, "air") -- the door
  set(34, y + 4, z1, "air")
  for dz = -3, 3 do
    for dy = -3, 3 do if dz * dz + dy * dy <= 9.5 then set(34 + dz, y + 10 + dy, z1, (dz * dz + dy * dy < 3) and "white_stained_glass" or "light_blue_stained_glass") end end
  end
  stairs(32, y - 1, z1 + 2, "north", 5, 1, "vitrail:marble_brick_stairs")
  for z = z0 + 12, z1 - 9, 3 do -- benches
    for _, b in ipairs { { 29, 32 }, { 36, 39 } } do fill(b[1], y, z, b[2], y, z, "spruce_stairs[facing=south]") end
  end
  fill(33, y - 1, z0 + 6, 35, y - 1, z1, "red_wool")
  fill(32, y, z0 + 2, 36, y, z0 + 5, "smooth_quartz") -- the altar
  fill(33, y + 1, z0 + 3, 35, y + 1, z0 + 3, "chiseled_quartz_block")
  set(33, y + 2, z0 + 3, "white_candle[candles=3,lit=true]")
  set(35, y + 2, z0 + 3, "white_candle[candles=3,lit=true]")
end

-- The hall of polished stone above the bay --------------------------------------------------------------------------------------

do
  local x0, x1, z0, z1, y = -61, -43, -40, -18, FEET
  level(x0 - 1, z0 - 1, x1 + 1, z1 + 1, y - 1, BRICK, 16)
  fill(x0 - 1, 48, z0 - 1, x0 - 1, y - 1, z1 + 1, BRICK)
  for x = x0 + 1, x1 - 1 do
    for z = z0 + 1, z1 - 1 do set(x, y - 1, z, ((x + z) % 2 == 0) and POLISHED_SLATE or MARBLE) end
  end
  fill(x1, y, z0, x1, y + 8, z1, BRICK) -- the back wall, its doors and niches
  for z = z0 + 4, z1 - 4, 7 do
    fill(x1, y, z - 1, x1, y + 4, z + 1, "air")
    set(x1 - 1, y + 5, z, "wall_torch[facing=west]")
  end
  for z = z0, z1, 4 do
    for _, x in ipairs { x0, x0 + 9 } do
      column(x, y, z, 8)
    end
  end
  fill(x0, y + 8, z0, x1, y + 8, z1, "smooth_quartz")
  fill(x0 + 2, y + 8, z0 + 2, x1 - 2, y + 8, z1 - 2, "dark_oak_planks")
  for x = x0 + 5, x1 - 4, 5 do
    for z = z0 + 4, z1 - 4, 6 do set(x, y + 8, z, "glass") end
  end
  for k = 0, 1 do shell(x0 + 1 + k, y + 9 + k, z0 + 1 + k, x1 - 1 - k, y + 9 + k, z1 - 1 - k, "oxidized_cut_copper") end
  fill(x0 + 3, y + 9, z0 + 3, x1 - 3, y + 9, z1 - 3, "air")
  for z = z0 + 6, z1 - 6, 10 do -- bowls of gold, things worth mirroring
    set(x0 + 5, y, z, "gold_block")
    set(x0 + 5, y + 1, z, "red_stained_glass")
    set(x0 + 13, y, z, "lapis_block")
    set(x0 + 13, y + 1, z, "glowstone")
  end
end

-- The harbor ----------------------------------------------------------------------------------------------------------------------

do
  local y = 64 -- feet on the quay
  level(-74, -12, -58, 34, y - 1, "stone_bricks", 14)
  fill(-75, 44, -12, -75, y - 1, 34, "stone_bricks")
  fill(-75, y, -12, -75, y, 34, "stone_brick_slab")
  stairs(-58, y, 4, "east", 10, 2, "stone_brick_stairs", "stone_bricks")
  fill(-56, FEET - 1, 4, -16, FEET - 1, 13, "grass_block")
  for x = -57, -15 do fill(x, FEET - 1, 6, x, FEET - 1, 11, (x % 4 == 0) and "smooth_stone" or "polished_andesite") fill(x, FEET, 4, x, FEET + 3, 13, "air") end
  for x = -55, -19, 6 do
    for _, z in ipairs { 4, 13 } do
      set(x, FEET, z, "stone_brick_wall")
      set(x, FEET + 1, z, "lantern")
    end
  end
  local function pier(z, reach)
    fill(-reach, y - 1, z, -76, y - 1, z + 2, "spruce_planks")
    for x = -reach, -78, 5 do
      for _, pz in ipairs { z - 1, z + 3 } do fill(x, 46, pz, x, y, pz, "spruce_log") end
      set(x, y + 1, z + 3, "lantern")
    end
  end
  pier(-4, 92)
  pier(14, 100)
  local function boat(x, z, sail)
    for i = -3, 3 do
      local w = math.abs(i) == 3 and 0 or 1
      fill(x + i, SEA, z - w, x + i, SEA, z + w, "dark_oak_planks")
      for _, side in ipairs { -1, 1 } do
        set(x + i, SEA + 1, z + side * (w + (w == 1 and 0 or 0)), math.abs(i) == 3 and "dark_oak_planks" or "dark_oak_slab")
      end
      if w == 1 then set(x + i, SEA + 1, z, "spruce_slab") end
    end
    fill(x, SEA + 1, z, x, SEA + 11, z, "spruce_fence")
    for k = 0, 6 do fill(x + 1, SEA + 3 + k, z, x + 1 + (6 - k) * 2 // 3, SEA + 3 + k, z, sail .. "_wool") end
    set(x - 3, SEA + 2, z, "lantern")
  end
  boat(-84, 6, "white")
  boat(-96, -9, "orange")
  boat(-90, 24, "white")
  for _, c in ipairs { { -70, -8, "barrel" }, { -69, -8, "barrel[facing=up]" }, { -70, -7, "barrel[facing=up]" }, { -70, 28, "hay_block" }, { -69, 29, "hay_block" } } do
    set(c[1], y, c[2], c[3])
  end
  set(-70, y + 1, -8, "barrel[facing=up]")
  for z = -10, 32, 7 do
    set(-74, y, z, "stone_brick_wall")
    set(-74, y + 1, z, "lantern")
  end
  -- The lighthouse on its rock.
  sphere(-104, 58, 44, { 11, 10, 11 }, "andesite")
  for k = 0, 20 do
    local r = 4.3 - k * .08
    cylinder(-104, 66 + k, 44, r, 1, (k // 4 % 2 == 0) and "white_concrete" or "red_concrete")
  end
  cylinder(-104, 87, 44, 4.4, 1, "smooth_stone")
  cylinder(-104, 88, 44, 2.4, 3, "sea_lantern")
  disc(-104, 44, 4.4, function(x, z, d) if d > 3.5 then set(x, 88, z, "iron_bars") end end)
  cone(-104, 91, 44, 3.4, 4, "red_concrete")
end

-- The white houses: walls to every side for the last light -------------------------------------------------------------------------

local function house(x, z, w, d, tall)
  level(x, z, x + w, z + d, FEET - 1, "smooth_stone", 16)
  shell(x, FEET - 1, z, x + w, FEET + tall, z + d, "white_concrete")
  fill(x + 1, FEET, z + 1, x + w - 1, FEET + tall - 1, z + d - 1, "air")
  fill(x, FEET + tall + 1, z, x + w, FEET + tall + 1, z + d, "smooth_quartz_slab")
  fill(x + 1, FEET + tall + 1, z + 1, x + w - 1, FEET + tall + 1, z + d - 1, "air")
  for k = 2, math.min(w, d) - 2, 3 do
    for _, y in ipairs(tall > 6 and { 1, 5 } or { 1 }) do
      for _, c in ipairs { { x + k, z }, { x + k, z + d }, { x, z + k }, { x + w, z + k } } do
        set(c[1], FEET + y, c[2], "glass")
        set(c[1], FEET + y + 1, c[2], "glass")
      end
    end
  end
end
house(-36, -44, 8, 7, 5)
house(-27, -52, 7, 9, 9)
house(-24, -38, 6, 6, 4)
fill(-24, FEET, -52, -22, FEET, -46, "air")
disc(-28, -40, 1.3, function(x, z) set(x, FEET - 1, z, "smooth_stone") end)

-- The pond with glass in it ------------------------------------------------------------------------------------------------------

do
  local px, pz, r = -28, 34, 15
  disc(px, pz, r + 2.4, function(x, z, d)
    fill(x, FEET, z, x, FEET + 9, z, "air")
    if d > r then
      set(x, FEET - 1, z, d > r + 1.3 and "smooth_stone" or MARBLE)
    else
      local deep = math.floor(math.min(8, (r - d) * .9) + 1)
      fill(x, FEET - 10, z, x, FEET - 2, z, "smooth_sandstone")
      fill(x, FEET - 1 - deep, z, x, FEET - 2, z, "water")
      set(x, FEET - 1, z, "air")
      set(x, FEET - 2 - deep, z, (deep + math.floor(d)) % 3 == 0 and "prismarine_bricks" or "prismarine")
    end
  end)
  local bottom = FEET - 11
  fill(px - 4, bottom, pz - 4, px + 4, bottom + 1, pz + 4, "prismarine_bricks")
  -- Cubes of glass, one in another, half in the water.
  shell(px - 4, bottom + 2, pz - 4, px + 4, FEET + 4, pz + 4, "light_blue_stained_glass")
  shell(px - 2, FEET - 5, pz - 2, px + 2, FEET + 2, pz + 2, "magenta_stained_glass")
  fill(px, FEET - 5, pz, px, FEET + 1, pz, "gold_block")
  for _, c in ipairs { { 9, -5, "red" }, { -8, 7, "lime" }, { 7, 8, "blue" } } do
    fill(px + c[1], FEET - 7, pz + c[2], px + c[1], FEET + 2, pz + c[2], c[3] .. "_stained_glass")
  end
  for _ = 1, 12 do
    local a, d = math.random() * 6.28, r - 1.5 - math.random() * 3
    set(px + d * math.cos(a), FEET - 1, pz + d * math.sin(a), "lily_pad")
  end
end

-- The clear cove: sand, corals and depth -------------------------------------------------------------------------------------------

do
  for x = -96, -58 do
    for z = 46, 82 do
      local n = noise(x, z, 14, 41, 2)
      local deep = math.max(1, math.min(13, (-62 - x) * .42 + 3 * n))
      local floor = SEA - math.floor(deep)
      fill(x, floor - 4, z, x, floor, z, n > .3 and "gravel" or "sand")
      if deep >= 1 then fill(x, floor + 1, z, x, SEA, z, "water") end
      fill(x, SEA + 1, z, x, SEA + 6, z, "air")
      if math.random() < .05 and deep > 4 then
        local kind = pick { "tube", "brain", "bubble", "fire", "horn" }
        sphere(x, floor + 1, z, .9 + math.random() * .7, kind .. "_coral_block")
      elseif math.random() < .06 and deep > 2 then
        set(x, floor + 1, z, "seagrass")
      end
    end
  end
  fill(-76, SEA + 1, 60, -56, SEA + 1, 62, "spruce_planks")
  for x = -76, -58, 6 do for _, z in ipairs { 59, 63 } do fill(x, SEA - 10, z, x, SEA + 2, z, "spruce_log") end end
end

-- The sunken court: steps, ledges and niches in the shade ----------------------------------------------------------------------------

do
  local x0, x1, z0, z1, y = 16, 40, 24, 44, FEET - 5
  level(x0 - 1, z0 - 1, x1 + 1, z1 + 3, FEET - 1, "grass_block", 18)
  for x = x0, x1 do
    for z = z0, z1 do -- steps down from three sides, two blocks deep each
      local down = math.min(5, math.min(x - x0, x1 - x, z - z0) // 2 + 1)
      fill(x, y - 2, z, x, FEET - 1 - down, z, "polished_andesite")
      fill(x, FEET - down, z, x, FEET - 1, z, "air")
    end
  end
  -- The wall of niches looks north: the sun never reaches it.
  fill(x0 - 1, y - 1, z1, x1 + 1, FEET + 5, z1 + 2, "polished_andesite")
  fill(x0 - 1, FEET + 6, z1 - 1, x1 + 1, FEET + 6, z1 + 2, "stone_brick_slab")
  fill(x0 - 1, FEET + 5, z1 - 1, x1 + 1, FEET + 5, z1 - 1, "stone_brick_stairs[facing=south,half=top]")
  for x = x0 + 6, x1 - 6, 6 do
    fill(x - 1, y, z1, x + 1, y + 5, z1 + 1, "air")
    set(x - 1, y + 5, z1, "polished_andesite_stairs[facing=west,half=top]")
    set(x + 1, y + 5, z1, "polished_andesite_stairs[facing=east,half=top]")
    set(x, y, z1 + 1, "chiseled_stone_bricks")
    set(x, y + 1, z1 + 1, "potted_fern")
  end
  for x = x0 + 3, x1 - 3, 6 do
    fill(x, y, z1 - 1, x, y + 8, z1 - 1, "polished_andesite")
    set(x, y, z1 - 2, "stone_brick_stairs[facing=south]")
  end
  for i = 0, 2 do fill(26 + i, y + i, 34 + i, 30 - i, y + i, 38 - i, "stone_bricks", "air") end -- a stepped fountain
  set(28, y + 3, 36, "water")
  for _, c in ipairs { { 22, 36 }, { 34, 36 } } do
    fill(c[1], y, c[2], c[1], y + 2, c[2], "stone_brick_wall")
    set(c[1], y + 3, c[2], "chiseled_stone_bricks")
  end
end

-- The lamp garden ------------------------------------------------------------------------------------------------------------------

do
  local x0, x1, z0, z1 = 44, 62, 24, 44
  level(x0, z0, x1, z1, FEET - 1, "grass_block", 18)
  for x = x0, x1 do for z = z0, z1 do if (x - x0) % 6 == 3 or (z - z0) % 7 == 3 then set(x, FEET - 1, z, "deepslate_tiles") end end end
  local lamps = { "redstone_lamp[lit=true]", "sea_lantern", "verdant_froglight", "pearlescent_froglight", "ochre_froglight", "vitrail:magenta_crystal",
    "vitrail:cyan_crystal", "vitrail:green_crystal", "shroomlight", "vitrail:stormlight" }
  local n = 0
  for z = z0 + 6, z1 - 2, 7 do
    for x = x0, x1, 6 do
      n = n % #lamps + 1
      set(x, FEET, z, "polished_deepslate")
      fill(x, FEET + 1, z, x, FEET + 2 + (x + z) % 3, z, "polished_deepslate_wall")
      set(x, FEET + 3 + (x + z) % 3, z, lamps[n])
    end
  end
  for _, c in ipairs { { 50, 27, "soul_lantern" }, { 56, 28, "lantern" }, { 50, 40, "lantern" }, { 58, 41, "soul_lantern" }, { 47, 34, "soul_lantern" } } do
    set(c[1], FEET, c[2], "stone_brick_wall")
    set(c[1], FEET + 1, c[2], c[3])
  end
  for _, c in ipairs { { 52, 30, "redstone_torch" }, { 46, 41, "redstone_torch" } } do set(c[1], FEET, c[2], c[3]) end
end

-- The grove and its arbor: leaves over pale paving -----------------------------------------------------------------------------------------------

do
  level(-6, 24, 12, 48, FEET - 1, "grass_block", 22)
  for z = 22, 50 do for x = 0, 4 do set(x, FEET - 1, z, (x == 0 or x == 4) and "stone_bricks" or "smooth_stone") end end
  disc(2, 36, 5.2, function(x, z, d) set(x, FEET - 1, z, d > 4.4 and "stone_bricks" or "smooth_stone") end)
  for _, t in ipairs { { -5, 26 }, { 9, 27 }, { -6, 35 }, { 10, 36 }, { -5, 44 }, { 9, 45 } } do
    broad_tree(t[1], FEET, t[2], 4 + math.random(2), 3, pick { "oak", "birch" }, pick { "oak_leaves", "birch_leaves" })
  end
  for z = 28, 44, 4 do -- an arbor: one layer of leaves on beams
    for _, x in ipairs { -1, 5 } do
      set(x, FEET, z, "stone_bricks")
      fill(x, FEET + 1, z, x, FEET + 3, z, "spruce_fence")
    end
    fill(-1, FEET + 4, z, 5, FEET + 4, z, "stripped_spruce_log[axis=x]")
  end
  for z = 27, 45 do
    for x = -1, 5 do
      if z % 4 ~= 0 and noise(x, z, 2.3, 61) < .22 then set(x, FEET + 4, z, pick { "oak_leaves[persistent=true]", "flowering_azalea_leaves[persistent=true]" }) end
    end
  end
end

-- The aviary: thin bars against the sky ----------------------------------------------------------------------------------------------

do
  local x0, x1, z0, z1, y = 42, 54, -4, 10, FEET
  level(x0 - 2, z0 - 2, x1 + 2, z1 + 2, y - 1, "grass_block", 26)
  fill(x0, y - 1, z0, x1, y - 1, z1, "stone_bricks")
  fill(x0 + 1, y - 1, z0 + 1, x1 - 1, y - 1, z1 - 1, "moss_block")
  for x = x0, x1 do
    for z = z0, z1 do
      local side = (x == x0 or x == x1) and 1 or 0
      local front = (z == z0 or z == z1) and 1 or 0
      if side + front > 0 then
        set(x, y, z, "stone_brick_wall")
        for dy = 1, 10 do
          local along = side == 1 and z - z0 or x - x0
          if along % 2 == 0 or dy % 5 == 0 then set(x, y + dy, z, "iron_bars") end
        end
      end
    end
  end
  for k = 0, 5 do -- the roof: square rings, each lattice joined to the next
    local a, b, c, d = x0 + k, z0 + k, x1 - k, z1 - k
    for dy = 10 + k, 11 + k do
      for x = a, c do for _, z in ipairs { b, d } do if x % 2 == 0 or dy == 11 + k then set(x, y + dy, z, "iron_bars") end end end
      for z = b, d do for _, x in ipairs { a, c } do if z % 2 == 0 or dy == 11 + k then set(x, y + dy, z, "iron_bars") end end end
    end
  end
  local mx, mz = (x0 + x1) // 2, (z0 + z1) // 2
  fill(mx, y + 16, mz - 2, mx, y + 16, mz + 2, "iron_bars")
  fill(mx, y + 17, mz, mx, y + 21, mz, "lightning_rod")
  fill(mx, y + 11, mz, mx, y + 15, mz, "chain")
  set(mx, y + 10, mz, "lantern[hanging=true]")
  fill(x0, y, mz - 1, x0, y + 3, mz + 1, "air")
  fill(x0, y + 4, mz - 1, x0, y + 4, mz + 1, "iron_bars")
  broad_tree(mx + 2, y, mz + 2, 3, 2, "acacia", "acacia_leaves")
  broad_tree(mx - 2, y, mz - 3, 2, 1.8, "cherry", "cherry_leaves")
end

-- The long pool before the chapel, still enough to mirror it ---------------------------------------------------------------------------

do
  local x0, x1, z0, z1, y = 30, 38, -4, 15, FEET
  level(x0 - 1, z0 - 1, x1 + 1, z1 + 1, y - 1, BRICK, 14)
  fill(x0, y - 4, z0, x1, y - 4, z1, "dark_prismarine")
  fill(x0, y - 3, z0, x1, y - 2, z1, "water")
  fill(x0, y - 1, z0, x1, y - 1, z1, "air")
  for _, x in ipairs { x0 - 1, x1 + 1 } do
    for z = z0, z1, 6 do
      set(x, y, z, "smooth_quartz")
      set(x, y + 1, z, "flowering_azalea")
    end
  end
end

-- The cave in the eastern hill ----------------------------------------------------------------------------------------------------

do
  local cx, cy, cz = 112, FEET, -6
  sphere(cx, FEET + 6, cz, { 34, 24, 30 }, "stone", "air") -- enough rock over it
  sphere(cx, FEET + 5, cz, { 20, 16, 20 }, "andesite", "stone")
  for x = 70, cx do -- the passage
    local z = cz + 3 * math.sin((x - 70) / 9)
    sphere(x, FEET + 2, z, { 2, 3.2 + .5 * noise(x, 0, 4, 51), 3.1 + .8 * noise(x, 9, 5, 52) }, "air")
  end
  for x = 62, 73 do fill(x, FEET, cz - 4, x, FEET + 6, cz + 4, "air") fill(x, FEET - 1, cz - 2, x, FEET - 1, cz + 2, "gravel") end
  for i = 0, 5 do -- the chamber
    local a = i / 6 * 2 * math.pi
    sphere(cx + 6 * math.cos(a), FEET + 4, cz + 6 * math.sin(a), { 9, 8 + (i % 2), 9 }, "air")
  end
  disc(cx, cz, 17, function(x, z)
    if get(x, FEET - 1, z) ~= "minecraft:air" then return end
    for y = FEET - 8, FEET - 1 do if y <= FEET - 3 then set(x, y, z, "water", "air") end end
  end)
  disc(cx, cz, 15, function(x, z, d) fill(x, FEET - 9, z, x, FEET - 1, z, d > 6 and "tuff" or "calcite", "air") end)
  disc(cx + 2, cz, 5.5, function(x, z, d)
    fill(x, FEET - 4, z, x, FEET - 2, z, "water")
    set(x, FEET - 1, z, "air")
    if d > 4.6 then set(x, FEET - 1, z, "smooth_basalt") end
  end)
  for _ = 1, 60 do -- dripstone and moss
    local a, d = math.random() * 6.28, 5 + math.random() * 9
    local x, z = math.floor(cx + d * math.cos(a)), math.floor(cz + d * math.sin(a))
    for y = FEET + 2, FEET + 15 do
      if get(x, y, z) == "minecraft:air" and string.find(get(x, y + 1, z), "stone", 1, true) then
        local long = math.random(3)
        fill(x, y - long + 1, z, x, y, z, "dripstone_block")
        set(x, y - long, z, "pointed_dripstone[vertical_direction=down]", "air")
        break
      end
    end
  end
  local lamps = { "vitrail:magenta_crystal", "sea_lantern", "shroomlight", "verdant_froglight", "vitrail:cyan_crystal", "redstone_lamp[lit=true]" }
  for i = 1, 12 do
    local a, d = (i - .5) / 12 * 2 * math.pi, i % 2 == 0 and 11 or 7.5
    local x, z = math.floor(cx + d * math.cos(a)), math.floor(cz + d * math.sin(a))
    fill(x, FEET - 1, z, x, FEET - 1 + i % 3, z, "polished_blackstone")
    set(x, FEET + i % 3, z, lamps[(i - 1) % 6 + 1])
  end
  for _ = 1, 40 do
    local a, d = math.random() * 6.28, 9 + math.random() * 6
    local x, z = math.floor(cx + d * math.cos(a)), math.floor(cz + d * math.sin(a))
    if get(x, FEET - 1, z) ~= "minecraft:air" and get(x, FEET, z) == "minecraft:air" then
      set(x, FEET, z, pick { "amethyst_cluster", "vitrail:blue_mushroom", "moss_carpet", "moss_carpet" })
    end
  end
end

-- The dawn wood in the misty valley ---------------------------------------------------------------------------------------------

--- A pine: a bare trunk below a slender crown, so that light comes in from the side.
local function pine(x, y, z, tall)
  fill(x, y, z, x, y + tall - 1, z, "spruce_log")
  local from = tall * 2 // 5
  for dy = from, tall do
    local t = (dy - from) / (tall - from)
    cylinder(x, y + dy, z, (1 - t) * 2.4 * (((dy - from) % 2 == 0) and 1 or .6) + .3, 1, "spruce_leaves[persistent=true]", "air")
  end
  set(x, y + tall + 1, z, "spruce_leaves[persistent=true]")
end
do
  local placed = {}
  for _ = 1, 900 do
    local x, z = math.random(-30, 150), math.random(66, 104)
    local y, under = ground(x, z)
    local free = is_grass(under) and math.abs(z - 84 - .04 * x) > 2.2 and not (x < 6 and math.abs(z - 84) < 7)
    for _, t in ipairs(placed) do free = free and (t[1] - x) ^ 2 + (t[2] - z) ^ 2 > 22 end
    if free then
      placed[#placed + 1] = { x, z }
      pine(x, y, z, 13 + math.random(8))
    end
  end
end
for x = -34, 60 do
  for z = 83, 85 do
    local y, under = ground(x, z)
    if is_grass(under) then set(x, y - 1, z, pick { "dirt_path", "coarse_dirt", "dirt_path" }) end
  end
end
for _ = 1, 300 do
  local x, z = math.random(-30, 60), math.random(66, 106)
  local y, under = ground(x, z)
  if is_grass(under) then set(x, y, z, pick { "fern", "fern", "short_grass", "sweet_berry_bush[age=2]" }, "air") end
end

-- The cottage: what blocks look like ----------------------------------------------------------------------------------------------

do
  local x0, z0, y = -10, 56, FEET
  level(x0 - 6, z0 - 8, x0 + 16, z0 + 10, y - 1, "grass_block", 18)
  fill(x0, y - 1, z0, x0 + 10, y - 1, z0 + 7, "oak_planks")
  shell(x0, y, z0, x0 + 10, y + 4, z0 + 7, "white_terracotta")
  fill(x0, y, z0, x0 + 10, y, z0 + 7, "cobblestone")
  fill(x0 + 1, y, z0 + 1, x0 + 9, y + 4, z0 + 6, "air")
  for _, x in ipairs { x0, x0 + 5, x0 + 10 } do for _, z in ipairs { z0, z0 + 7 } do fill(x, y, z, x, y + 4, z, "dark_oak_log") end end
  for _, z in ipairs { z0, z0 + 7 } do fill(x0, y + 4, z, x0 + 10, y + 4, z, "dark_oak_log[axis=x]") end
  for k = 0, 4 do
    fill(x0 - 1, y + 4 + k, z0 - 1 + k, x0 + 11, y + 4 + k, z0 - 1 + k, "brick_stairs[facing=south]")
    fill(x0 - 1, y + 4 + k, z0 + 8 - k, x0 + 11, y + 4 + k, z0 + 8 - k, "brick_stairs[facing=north]")
    for _, x in ipairs { x0, x0 + 10 } do fill(x, y + 4 + k, z0 + k, x, y + 4 + k, z0 + 7 - k, "oak_planks") end
  end
  fill(x0 + 8, y + 5, z0 + 4, x0 + 8, y + 10, z0 + 4, "bricks")
  set(x0 + 2, y, z0, "oak_door[facing=south,half=lower]")
  set(x0 + 2, y + 1, z0, "oak_door[facing=south,half=upper]")
  for _, x in ipairs { x0 + 7, x0 + 8 } do set(x, y + 2, z0, "glass_pane") set(x, y + 1, z0 - 1, "oak_trapdoor[half=top]") end
  set(x0 + 4, y + 2, z0 - 1, "wall_torch[facing=north]")
  for i, b in ipairs { "potted_red_tulip", "potted_blue_orchid" } do set(x0 + 6 + i, y + 2, z0 - 1, b) end
  for x = x0 + 5, x0 + 9 do
    set(x, y - 1, z0 - 1, "grass_block")
    set(x, y, z0 - 1, pick { "rose_bush[half=lower]", "poppy", "oxeye_daisy", "cornflower" })
  end
  set(x0 + 4, y, z0 - 1, "barrel[facing=up]")
  set(x0 - 2, y, z0 + 1, "hay_block")
  set(x0 - 2, y, z0 + 2, "hay_block[axis=x]")
  set(x0 - 2, y + 1, z0 + 1, "hay_block[axis=z]")
  set(x0 - 2, y, z0, "pumpkin")
  set(x0 - 3, y, z0 + 2, "melon")
  fill(x0 + 12, y - 1, z0 - 4, x0 + 15, y - 1, z0 + 4, "farmland[moisture=7]")
  fill(x0 + 13, y - 1, z0 - 4, x0 + 13, y - 1, z0 + 4, "water")
  for _, x in ipairs { x0 + 12, x0 + 14, x0 + 15 } do for z = z0 - 4, z0 + 4 do set(x, y, z, "wheat[age=" .. math.random(5, 7) .. "]") end end
  for x = x0 - 6, x0 + 16 do if math.abs(x - x0 - 3) > 1 then set(x, y, z0 - 7, "oak_fence") end end
  fill(x0 + 2, y - 1, z0 - 8, x0 + 3, y - 1, z0 - 1, "dirt_path")
  local rows = { "gold_block", "emerald_block", "amethyst_block", "diamond_block", "copper_block", "blue_ice", "red_glazed_terracotta", "mossy_cobblestone" }
  for i, b in ipairs(rows) do set(x0 - 5, y + (i - 1) // 4, z0 - 5 + (i - 1) % 4, b) end
end

-- Trees and flowers of the park, last: they leave what is built -------------------------------------------------------------------

for _, t in ipairs { { -14, -24, "oak" }, { 14, -26, "birch" }, { 17, -44, "oak" }, { -15, -58, "birch" }, { 20, 10, "oak" }, { 24, 15, "birch" },
  { -18, 18, "cherry" }, { -12, 20, "cherry" }, { -40, 18, "oak" }, { -47, 26, "birch" }, { -48, 46, "oak" }, { -36, 54, "oak" }, { -20, -14, "cherry" },
  { 56, -14, "oak" }, { 50, -30, "birch" }, { 22, -52, "oak" }, { 34, -50, "birch" }, { 60, 14, "oak" },
  { 44, 52, "oak" }, { 30, 54, "birch" }, { -52, -50, "oak" }, { -44, -60, "birch" } } do
  local y, under = ground(t[1], t[2])
  if is_grass(under) then broad_tree(t[1], y, t[2], 4 + math.random(2), 3 + math.random(), t[3], t[3] .. "_leaves") end
end
meadow(-57, -60, 62, 62, 5200, { "poppy", "dandelion", "cornflower", "oxeye_daisy", "azure_bluet", "allium", "short_grass", "short_grass" })

-- The stations ------------------------------------------------------------------------------------------------------------------------

place("avenue", "shadows", -1, FEET, -14, 184, 5, { time = 2700,
  text = "Shadows of columns from at hand to far off: sharp edges, no seam where one cascade ends and the next begins.",
  without = "shadows.on=false" })
place("needle", "penumbra", -41, FEET, -7, 264, 6, { time = 1900, text = "The needle's shadow is sharp at its foot and soft far off.",
  without = "shadows.softness=0" })
place("chapel", "colored", 34, FEET, -13, 164, 4, { time = 2200, text = "Sunlight takes the color of the glass it passes.",
  without = "shadows.colored=false" })
place("grove", "leaves", 2, FEET, 25, 5, 12, { time = 5000, text = "Leaves cast the shadows of leaves, not of cubes.",
  without = "shadows.on=false" })
place("court", "ssao", 28, FEET, 24, 4, 16, { time = 6000, text = "Corners, steps and niches darken where the sky cannot reach.",
  without = "ssao.on=false" })
place("hall", "reflections", -45, FEET, -21, 118, 8, { time = 9300, text = "Polished stone mirrors columns and sky, the more the flatter one looks.",
  without = "reflections.on=false" })
place("mirror", "reflections", 34, FEET, 18, 180, 0, { time = 4200, text = "Water mirrors what stands behind it.",
  without = "reflections.on=false" })
place("lamps", "bloom", 48, FEET, 23, -25, 2, { time = 18000, text = "Bright lamps glow into the night, a blue one as much as a red one.",
  without = "bloom.on=false" })
place("cove", "water", -62, SEA + 2, 70, 104, 17, { time = 7000, text = "Waves in the world, refraction, and water that takes its color with depth.",
  without = { "water.waves=false", "water.refraction=false" } })
place("reef", "caustics", -74, SEA - 3, 70, 70, 18, { time = 6500, bare = true, text = "Under water: light in moving nets on sand and corals.",
  without = "water.caustics=false" })
place("cubes", "translucent", -21, FEET, 20, 28, 14, { time = 8000, text = "Glass in glass in water, each seen through the others in the right order.",
  without = "water.refraction=false" })
place("wood", "volumetric", -4, FEET, 84, 268, -3, { time = 700, text = "Dawn: rays of light between the trees, mist in the valley.",
  without = "fog.volumetric=false" })
place("belvedere", "fog", 0, FEET + 9, -80, 20, 8, { time = 500, text = "Morning haze lies in the low land.",
  without = { "fog.height=false", "fog.volumetric=false" } })
place("cave", "exposure", 84, FEET, -3, 101, -2, { time = 6000, text = "From the dark of the cave into daylight: the eye settles.",
  without = "exposure.automatic=false" })
place("pier", "sunset", -82, SEA + 2, 15, 88, -4, { time = 11750, text = "The sun goes down behind the islands.",
  without = "sky.clouds=off" })
place("houses", "ambient", -39, FEET, -31, 214, -8, { time = 12500, text = "After sunset walls that look west still glow; the others are blue." })
place("temple", "night", 4, FEET + 9, -79, 306, -18, { time = 15600, fov = 80, text = "Moon, stars, and lamps below.",
  without = "sky.stars=false" })
place("quay", "clouds", -66, 64, 2, 70, -20, { time = 4800, text = "Clouds over the bay.",
  without = "sky.clouds=off" })
place("aviary", "antialiasing", 40, FEET, 13, 226, -26, { time = 5200, text = "Thin bars stay whole against the sky.",
  without = "antialias=off" })
place("chamber", "lamps", 101, FEET, -4, 266, 4, { time = 6000, text = "A cave without sky, lit by lamps of six colors." })
place("cottage", "look", 3, FEET, 51, 22, 2, { time = 3600, text = "Textures with their relief, tints of the biome, plants and doors.",
  without = "surface.normal_maps=false" })
