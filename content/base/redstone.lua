-- Rails, wires and machines.

for _, r in ipairs { { "rail", "rail10" }, { "powered_rail", "rail6 powered?" }, { "detector_rail", "rail6 powered?" },
  { "activator_rail", "rail6 powered?" } } do
  local name = r[1]
  local v = { ["powered=true"] = { texture = name .. "_on" } }
  if name == "rail" then
    v = {}
    for _, s in ipairs { "south_east", "south_west", "north_west", "north_east" } do v["shape=" .. s] = { texture = "rail_corner" } end
  end
  block(name, merge(DECOR, { shape = "rail", texture = name, collision = false, hardness = 0.7, material = "metal", variants = v }), r[2] .. " wl")
end

-- Wire is a flat sheet tinted by its strength, cut down to the arms it has; climbing arms are thin boxes on the wall.
local wire = {}
for p = 0, 15 do
  wire["power=" .. p] = { tint = { p == 0 and 90 or 110 + p * 9, p > 10 and (p - 10) * 8 or 4, 4 }, light = p > 0 and { (p + 1) // 4, 0, 0 } or 0 }
end
local function arm(side, on)
  if not on then return nil end
  return ({ north = { 7, 0, 0, 9, 0.25, 7 }, south = { 7, 0, 9, 9, 0.25, 16 }, west = { 0, 0, 7, 7, 0.25, 9 }, east = { 9, 0, 7, 16, 0.25, 9 } })[side]
end
local climb = { north = { 7, 0, 0, 9, 16, 0.25 }, south = { 7, 0, 15.75, 9, 16, 16 }, west = { 0, 0, 7, 0.25, 16, 9 }, east = { 15.75, 0, 7, 16, 16, 9 } }
local states = { "none", "side", "up" }
for n = 0, 80 do
  local key, boxes, left = {}, { { 6, 0, 6, 10, 0.25, 10 } }, n
  for i, side in ipairs { "north", "east", "south", "west" } do
    local s = states[left % 3 + 1]
    left = left // 3
    key[i] = side .. "=" .. s
    boxes[#boxes + 1] = arm(side, s ~= "none")
    if s == "up" then boxes[#boxes + 1] = climb[side] end
  end
  wire[table.concat(key, ",")] = { boxes = boxes }
end
local link = "=none|side|up"
block("redstone_wire", merge(DECOR, { shape = "boxes", boxes = { { 6, 0, 6, 10, 0.25, 10 } }, texture = "redstone_dust", collision = false, hardness = 0,
  variants = wire }), "power:0-15 north" .. link .. " east" .. link .. " south" .. link .. " west" .. link)

-- The torches of a repeater: the movable one stands further back for each step of delay. Boxes face north.
local plate = { 0, 0, 0, 16, 2, 16 }
local function stub(x, z, on) return { x, 2, z, x + 2, 7, z + 2, on and "redstone_torch_top" or "redstone_torch_top_off" } end
local v = { ["powered=true"] = { texture = { "smooth_stone", "repeater_on", "smooth_stone" } } }
for delay = 1, 4 do
  for _, on in ipairs { true, false } do
    local key = "delay=" .. delay .. ",powered=" .. tostring(on)
    for k, value in pairs(turned({ plate, stub(7, 2, on), stub(7, 4 + 2 * delay, on) }, key)) do v[k] = value end
  end
end
block("repeater", merge(DECOR, { shape = "boxes", texture = { "smooth_stone", "repeater", "smooth_stone" }, boxes = { plate, stub(7, 2), stub(7, 6) },
  hardness = 0, variants = v }), "delay:1-4 facing locked? powered?")
v = { ["powered=true"] = { texture = { "smooth_stone", "comparator_on", "smooth_stone" } } }
for _, on in ipairs { true, false } do
  for _, sub in ipairs { true, false } do
    local key = "mode=" .. (sub and "subtract" or "compare") .. ",powered=" .. tostring(on)
    for k, value in pairs(turned({ plate, stub(4, 11, on), stub(10, 11, on), stub(7, 2, sub) }, key)) do v[k] = value end
  end
end
block("comparator", merge(DECOR, { shape = "boxes", texture = { "smooth_stone", "comparator", "smooth_stone" },
  boxes = { plate, stub(4, 11), stub(10, 11), stub(7, 2) }, hardness = 0, variants = v }), "facing mode=compare|subtract powered?")

block("lever", merge(DECOR, { shape = "lever", texture = { "lever", "cobblestone" }, collision = false, material = "wood" }), "face facing powered?")
for _, name in ipairs { "light_weighted_pressure_plate", "heavy_weighted_pressure_plate" } do
  pressure_plate(name, string.find(name, "light") and "gold_block" or "iron_block", METAL, "power:0-15")
end

-- Fronts and, for six facings, side pictures turn with `facing` by themselves.
for _, name in ipairs { "dispenser", "dropper" } do
  local vertical = { texture = { name .. "_front_vertical", "furnace_top", "furnace_top", "furnace_top" } }
  block(name, merge(STONE, { texture = { name .. "_front", "furnace_side", "furnace_top", "furnace_top" }, hardness = 3.5,
    variants = { ["facing=up"] = vertical, ["facing=down"] = vertical } }), "facing6 triggered?")
end
block("observer", merge(STONE, { texture = { "observer_front", "observer_back", "observer_side", "observer_side", "observer_side" }, hardness = 3 }),
  "facing6 powered?")

local EXTENDED = { { 0, 0, 4, 16, 16, 16 } }
for _, name in ipairs { "piston", "sticky_piston" } do
  local head = name == "piston" and "piston_top" or "piston_top_sticky"
  local variants = {}
  for key, value in pairs(turned6(EXTENDED)) do
    variants[key .. ",extended=true"] = { shape = "boxes", boxes = value.boxes, opacity = 0 }
  end
  block(name, merge(STONE, { texture = { head, "piston_bottom", "piston_side", "piston_side", "piston_side" }, variants = variants }), "extended? facing6")
end
local HEAD = { { 0, 0, 0, 16, 16, 4 }, { 6, 6, 4, 10, 10, 20 } }
block("piston_head", merge(STONE, { shape = "boxes", texture = "piston_top", opacity = 0, boxes = HEAD, variants = turned6(HEAD),
  hidden_from_hotbar = true }), "facing6 short? type=normal|sticky")

block("target", { texture = { "target_side", "target_top" }, material = "plant", hardness = 0.5 }, "power:0-15")
block("note_block", merge(WOOD, { texture = "note_block", hardness = 0.8 }),
  "instrument=harp|basedrum|snare|hat|bass|flute|bell|guitar|chime|xylophone|iron_xylophone|cow_bell|didgeridoo|bit|banjo|pling|zombie|skeleton|creeper|dragon|wither_skeleton|piglin|custom_head note:0-24 powered?")
block("jukebox", merge(WOOD, { texture = { "note_block", "jukebox_top", "note_block" } }), "has_record?")
block("tnt", { texture = { "tnt_side", "tnt_top", "tnt_bottom" }, material = "plant", hardness = 0 }, "unstable?")
block("daylight_detector", merge(WOOD, { shape = "boxes", texture = { "daylight_detector_side", "daylight_detector_top", "daylight_detector_side" },
  opacity = 0, hardness = 0.2, boxes = { { 0, 0, 0, 16, 6, 16 } }, variants = { ["inverted=true"] = {
    texture = { "daylight_detector_side", "daylight_detector_inverted_top", "daylight_detector_side" } } } }), "inverted? power:0-15")

local hopper = { { 0, 10, 0, 16, 16, 16 }, { 4, 4, 4, 12, 10, 12 } }
local function spout(b) return { hopper[1], hopper[2], b } end
block("hopper", merge(METAL, { shape = "boxes", texture = { "hopper_side", "hopper_top", "hopper_side" }, opacity = 0, hardness = 3,
  boxes = spout { 6, 0, 6, 10, 4, 10 }, variants = turned(spout { 6, 4, 0, 10, 8, 4 }) }), "enabled! facing_hopper")

local hook = { { 6, 1, 14, 10, 9, 16, "oak_planks" }, { 7, 4, 9, 9, 6, 14, "iron_block" } }
block("tripwire_hook", merge(DECOR, { shape = "boxes", texture = "oak_planks", boxes = hook, collision = false, variants = turned(hook), hardness = 0 }),
  "attached? facing powered?")
block("tripwire", merge(DECOR, { shape = "boxes", texture = "white_wool", boxes = { { 0, 1, 7.5, 16, 1.5, 8.5 } }, collision = false, hardness = 0 }),
  "attached? disarmed? powered? " .. SIDES4)

door("iron_door", { material = "metal", hardness = 5 })
trapdoor("iron_trapdoor", { material = "metal", hardness = 5 })
block("iron_bars", merge(METAL, { shape = "pane", texture = { "iron_bars", "iron_bars" }, layer = "cutout", opacity = 0 }), SIDES4 .. " wl")

for _, name in ipairs { "command_block", "chain_command_block", "repeating_command_block" } do
  block(name, merge(METAL, { texture = { name .. "_front", name .. "_side", name .. "_side", name .. "_side" }, hardness = -1 }),
    "conditional? facing6")
end
block("structure_block", merge(METAL, { texture = "structure_block", hardness = -1 }), "mode=load|save|corner|data")
block("jigsaw", merge(METAL, { texture = "structure_block", hardness = -1 }),
  "orientation=north_up|down_east|down_north|down_south|down_west|up_east|up_north|up_south|up_west|west_up|east_up|south_up")
block("crafter", merge(STONE, { texture = { "crafter_side", "crafter_top", "furnace_top" } }),
  "crafting? triggered? orientation=north_up|down_east|down_north|down_south|down_west|up_east|up_north|up_south|up_west|west_up|east_up|south_up")
