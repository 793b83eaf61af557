-- Helpers shared by every content file. This file sorts first, so its globals are there for the rest.
--
-- Conventions the engine can rely on:
--   * every block with properties gets a full `default`, so no file depends on the order of values;
--   * boxes are written as if the block faced north and are turned here into explicit variants, so that
--     what a state collides with can be read without knowing how a shape turns.

BOOL = { "true", "false" }
COLORS = { "white", "orange", "magenta", "light_blue", "yellow", "lime", "pink", "gray", "light_gray", "cyan",
  "purple", "blue", "brown", "green", "red", "black" }

local known = {
  axis = { "axis", { "x", "y", "z" }, "y" },
  axis_h = { "axis", { "x", "z" }, "x" },
  facing = { "facing", { "north", "south", "west", "east" }, "north" },
  facing6 = { "facing", { "north", "east", "south", "west", "up", "down" }, "north" },
  facing_up = { "facing", { "north", "east", "south", "west", "up", "down" }, "up" },
  facing_hopper = { "facing", { "down", "north", "south", "west", "east" }, "down" },
  wl = { "waterlogged", BOOL, "false" },
  half_tall = { "half", { "upper", "lower" }, "lower" },
  half_block = { "half", { "top", "bottom" }, "bottom" },
  face = { "face", { "floor", "wall", "ceiling" }, "wall" },
  rail6 = { "shape", { "north_south", "east_west", "ascending_east", "ascending_west", "ascending_north",
    "ascending_south" }, "north_south" },
  rail10 = { "shape", { "north_south", "east_west", "ascending_east", "ascending_west", "ascending_north",
    "ascending_south", "south_east", "south_west", "north_west", "north_east" }, "north_south" },
  stairs = { "shape", { "straight", "inner_left", "inner_right", "outer_left", "outer_right" }, "straight" },
}

--- Reads a short description of properties and returns `properties, default`.
-- Words: a known name; `name?` a boolean, false; `name!` a boolean, true; `name:0-15` a number;
-- `name=a|b|c` a list whose first value is the default.
function P(text)
  local properties, default = {}, {}
  for word in string.gmatch(text, "%S+") do
    local entry = known[word]
    if entry then
      properties[entry[1]], default[entry[1]] = entry[2], entry[3]
    else
      local name, mark, rest = string.match(word, "^([%w_]+)([?!:=])(.*)$")
      if not name then error("bad property: " .. word) end
      if mark == "?" or mark == "!" then
        properties[name], default[name] = BOOL, mark == "!" and "true" or "false"
      elseif mark == ":" then
        local low, high = string.match(rest, "^(%d+)%-(%d+)$")
        local values = {}
        for i = tonumber(low), tonumber(high) do values[#values + 1] = string.format("%d", i) end
        properties[name], default[name] = values, values[1]
      else
        local values = {}
        for value in string.gmatch(rest, "[^|]+") do values[#values + 1] = value end
        properties[name], default[name] = values, values[1]
      end
    end
  end
  return properties, default
end

SIDES4 = "north? east? south? west?"
SIDES6 = SIDES4 .. " up? down?"

--- A new table with the fields of all arguments, later ones winning.
function merge(...)
  local out = {}
  for i = 1, select("#", ...) do
    local part = select(i, ...)
    if part then
      for key, value in pairs(part) do out[key] = value end
    end
  end
  return out
end

--- define_block with the namespace added and properties given as text.
function block(name, def, props)
  if not string.find(name, ":", 1, true) then name = "minecraft:" .. name end
  if props and props ~= "" then
    local properties, default = P(props)
    def = merge(def, { properties = properties, default = merge(default, def.default) })
  end
  define_block(name, def)
end

local function bare(name) return (string.gsub(name, "^[^:]*:", "")) end
TEX = bare

-- Materials -------------------------------------------------------------------------------------------------

STONE = { material = "stone", hardness = 1.5 }
WOOD = { material = "wood", hardness = 2 }
METAL = { material = "metal", hardness = 5 }
GLASS = { material = "glass", hardness = 0.3, layer = "cutout", opacity = 0 }
PLANT = { material = "plant", hardness = 0, layer = "cutout", opacity = 0, collision = false, shape = "cross", sway = true }
DECOR = { material = "stone", hardness = 0.5, layer = "cutout", opacity = 0 }

-- Boxes -----------------------------------------------------------------------------------------------------

local function turn(b) return { 16 - b[6], b[2], b[1], 16 - b[3], b[5], b[4], b[7] } end
local function tip_up(b) return { b[1], 16 - b[6], b[2], b[4], 16 - b[3], b[5], b[7] } end
local function tip_down(b) return { b[1], b[3], 16 - b[5], b[4], b[6], 16 - b[2], b[7] } end

local function each(boxes, f)
  local out = {}
  for i, b in ipairs(boxes) do out[i] = f(b) end
  return out
end

--- Variants of boxes that are written for facing=north, for the four horizontal facings; `more` joins the key.
function turned(boxes, more, extra)
  local out, now = {}, boxes
  for _, facing in ipairs { "north", "east", "south", "west" } do
    out["facing=" .. facing .. (more and "," .. more or "")] = merge(extra, { boxes = now })
    now = each(now, turn)
  end
  return out
end

--- A variant for each of the sixteen rotations from what `f` says of the nearest facing; 0 looks south.
function by_rotation(f)
  local out, ways = {}, { [0] = "south", "west", "north", "east" }
  for r = 0, 15 do out["rotation=" .. r] = f(ways[((r + 2) // 4) % 4]) end
  return out
end

--- The same for all six facings: the north face of the boxes ends up looking up or down.
function turned6(boxes)
  local out = turned(boxes)
  out["facing=up"] = { boxes = each(boxes, tip_up) }
  out["facing=down"] = { boxes = each(boxes, tip_down) }
  return out
end

--- The quarter turn of boxes about the vertical axis, for axis=x from axis=z.
function quarter(boxes) return each(boxes, turn) end

-- Families --------------------------------------------------------------------------------------------------

function slab(name, texture, def)
  block(name, merge(STONE, def, { texture = texture, shape = "slab", opacity = 0, variants = { ["type=double"] = { opacity = 15 } } }),
    "type=bottom|top|double wl")
end

function stairs(name, texture, def)
  block(name, merge(STONE, def, { texture = texture, shape = "stairs", opacity = 0 }), "facing half_block stairs wl")
end

function wall(name, texture, def)
  local side = "=none|low|tall"
  block(name, merge(STONE, def, { texture = texture, shape = "wall", opacity = 0 }),
    "north" .. side .. " east" .. side .. " south" .. side .. " west" .. side .. " up! wl")
end

function fence(name, texture, def)
  block(name, merge(WOOD, def, { texture = texture, shape = "fence", opacity = 0 }), SIDES4 .. " wl")
end

function fence_gate(name, texture, def)
  block(name, merge(WOOD, def, { texture = texture, shape = "fence_gate", opacity = 0,
    variants = { ["open=true"] = { collision = false } } }), "facing open? in_wall? powered?")
end

function door(name, def)
  local t = bare(name)
  block(name, merge(WOOD, { hardness = 3 }, def, { texture = t .. "_bottom", shape = "door", layer = "cutout", opacity = 0,
    variants = { ["half=upper"] = { texture = t .. "_top" } } }), "facing half_tall hinge=left|right open? powered?")
end

function trapdoor(name, def)
  block(name, merge(WOOD, { hardness = 3 }, def, { texture = bare(name), shape = "trapdoor", layer = "cutout", opacity = 0 }),
    "facing half_block open? powered? wl")
end

function button(name, texture, def)
  block(name, merge(STONE, { hardness = 0.5 }, def, { texture = texture, shape = "button", opacity = 0, collision = false }),
    "face facing powered?")
end

function pressure_plate(name, texture, def, props)
  block(name, merge(STONE, { hardness = 0.5 }, def, { texture = texture, shape = "pressure_plate", opacity = 0, collision = false }),
    props or "powered?")
end

--- The name a shape of a block takes: stone_bricks -> stone_brick_stairs.
function stem_of(name) return (string.gsub(string.gsub(name, "bricks$", "brick"), "tiles$", "tile")) end

--- A full block and, as `kinds` asks, its slab, stairs, wall, button and pressure plate.
function stone_family(name, kinds, def)
  def = merge(STONE, def)
  local texture = def.texture or bare(name)
  block(name, merge(def, { texture = texture }))
  shapes_of(name, kinds, def, texture)
end

function shapes_of(name, kinds, def, texture)
  local stem = stem_of(name)
  local plain = merge(def, { shape = false, properties = false, default = false, variants = false })
  for key, value in pairs(plain) do if value == false and key ~= "collision" then plain[key] = nil end end
  local make = { slab = slab, stairs = stairs, wall = wall, button = button, pressure_plate = pressure_plate }
  for kind in string.gmatch(kinds or "", "%S+") do
    make[kind](stem .. "_" .. kind, texture, plain)
  end
end

--- A log, stem or other block that lies along an axis.
function pillar(name, texture, def)
  block(name, merge(WOOD, def, { texture = texture, shape = "pillar" }), "axis")
end

function leaves(name, def)
  block(name, merge({ texture = bare(name), layer = "cutout_mipped", opacity = 1, hardness = 0.2, material = "leaves",
    sway = true }, def), "distance:1-7 persistent? wl")
end

function plant(name, def, props)
  block(name, merge(PLANT, { texture = bare(name) }, def), props)
end

--- A plant two blocks high: NAME_bottom and NAME_top.
function tall_plant(name, def, props)
  local t = bare(name)
  plant(name, merge({ texture = t .. "_bottom", variants = { ["half=upper"] = { texture = t .. "_top" } } }, def),
    "half_tall" .. (props and " " .. props or ""))
end

function potted(name, sprite)
  block("potted_" .. name, merge(DECOR, { shape = "boxes", texture = "flower_pot", hardness = 0, boxes = {
    { 5, 0, 5, 11, 6, 11 }, { 3, 6, 8, 13, 16, 8, sprite or name }, { 8, 6, 3, 8, 16, 13, sprite or name } } }))
end
