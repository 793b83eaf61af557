-- Runs the base content the way the server does, with stubs, and checks what it says.
--   lua5.4 tools/art/check_content.lua [--missing-only] [ORACLE.json ...]
-- An oracle is a file of block counts whose keys are block states; each must be definable from our content.

local base = (arg[0]:match("^(.*)tools/art/") or "./") .. "content/base/"
local problems, blocks, biomes, animated, hotbar = {}, {}, {}, {}, nil
local order = {}
local function problem(...) problems[#problems + 1] = string.format(...) end

local function files(pattern)
  local out = {}
  local pipe = assert(io.popen("ls -1 " .. base .. pattern .. " 2>/dev/null | LC_ALL=C sort"))
  for line in pipe:lines() do out[#out + 1] = line end
  pipe:close()
  return out
end

local textures = {}
for _, path in ipairs(files("textures | sed 's,^," .. base .. "textures/,'")) do
  local stem = path:match("([^/]+)%.png$")
  if stem then textures[stem] = true end
end

local set = function(text)
  local out = {}
  for word in text:gmatch("%S+") do out[word] = true end
  return out
end
local SHAPES = set "cube pillar slab stairs fence wall fence_gate pane cross crop torch wall_torch door trapdoor liquid layers carpet ladder faces rail button lever pressure_plate sign wall_sign chest bed lantern chain lily_pad boxes none"
local LAYERS = set "solid cutout cutout_mipped translucent"
local MATERIALS = set "stone wood dirt sand plant leaves glass water lava snow ice metal wool crystal"
local FIELDS = set "properties default texture shape layer transparency opacity light hardness viscosity collision tint tint_faces material replaceable climbable hidden_from_hotbar sway optics ior absorption variants boxes"
local NEEDS = { pillar = "axis", slab = "type", stairs = "facing half shape", fence = "north east south west", wall = "north east south west up",
  fence_gate = "facing open in_wall", pane = "north east south west", wall_torch = "facing", door = "facing half hinge open",
  trapdoor = "facing half open", layers = "layers", ladder = "facing", faces = "north east south west up", rail = "shape",
  button = "face facing powered", lever = "face facing powered", sign = "rotation", wall_sign = "facing", chest = "facing", bed = "facing part",
  lantern = "hanging", chain = "axis" }

local used = {}
local function check_color(where, v, top)
  if type(v) ~= "table" or #v ~= 3 then return problem("%s: not a color", where) end
  for i = 1, 3 do if math.type(v[i]) ~= "integer" or v[i] < 0 or v[i] > top then problem("%s: color part out of range", where) end end
end
local function need_texture(where, t)
  if type(t) ~= "string" then return problem("%s: texture is not a string", where) end
  used[t] = true
  if not textures[t] then problem("%s: no texture %s", where, t) end
end
local function number(where, v, low, high)
  if type(v) ~= "number" or v < low or v > high then problem("%s: %s is not a number in %g..%g", where, tostring(v), low, high) end
end

local function check_fields(where, d)
  for key in pairs(d) do if not FIELDS[key] then problem("%s: unknown field %s", where, tostring(key)) end end
  if d.texture ~= nil then
    if type(d.texture) == "table" then
      if #d.texture < 1 or #d.texture > 6 then problem("%s: 1 to 6 textures", where) end
      for _, t in ipairs(d.texture) do need_texture(where, t) end
    else need_texture(where, d.texture) end
  end
  if d.shape and not SHAPES[d.shape] then problem("%s: unknown shape %s", where, d.shape) end
  if d.layer and not LAYERS[d.layer] then problem("%s: unknown layer %s", where, d.layer) end
  if d.material and not MATERIALS[d.material] then problem("%s: unknown material %s", where, d.material) end
  if d.transparency then number(where, d.transparency, 0, 1) end
  if d.opacity then number(where, d.opacity, 0, 15) end
  if d.viscosity then number(where, d.viscosity, 0, 1) end
  if d.hardness then number(where, d.hardness, -1, 1000) end
  if type(d.light) == "table" then check_color(where .. " light", d.light, 15) elseif d.light then number(where, d.light, 0, 15) end
  if type(d.tint) == "table" then check_color(where .. " tint", d.tint, 255)
  elseif d.tint and not set("grass foliage water")[d.tint] then problem("%s: unknown tint", where) end
  if d.tint_faces and d.tint_faces ~= "top" then problem("%s: unknown tint_faces", where) end
  for _, key in ipairs { "collision", "replaceable", "climbable", "hidden_from_hotbar", "sway" } do
    if d[key] ~= nil and type(d[key]) ~= "boolean" then problem("%s: %s is not a boolean", where, key) end
  end
  for _, b in ipairs(d.boxes or {}) do
    for i = 1, 6 do if type(b[i]) ~= "number" then problem("%s: box of %s", where, tostring(b[i])) end end
    for i = 1, 3 do if b[i] > b[i + 3] or b[i] < -16 or b[i + 3] > 32 then problem("%s: box out of range", where) end end
    if b[7] then need_texture(where, b[7]) end
  end
end

local function has(list, value)
  for _, v in ipairs(list) do if v == value then return true end end
  return false
end

local states = 0
local function define_block(name, d)
  if type(name) ~= "string" or not name:match("^[a-z0-9_]+:[a-z0-9_]+$") then problem("bad block name %s", tostring(name)) end
  if blocks[name] then problem("%s is defined twice", name) end
  blocks[name], order[#order + 1] = d, name
  check_fields(name, d)
  if not d.texture then problem("%s: no texture", name) end
  local properties, count = d.properties or {}, 1
  for key, values in pairs(properties) do
    count = count * #values
    for _, v in ipairs(values) do if type(v) ~= "string" then problem("%s: %s has a value that is not a string", name, key) end end
    if not (d.default and has(values, d.default[key])) then problem("%s: no default for %s", name, key) end
  end
  states = states + count
  for word in (NEEDS[d.shape or "cube"] or ""):gmatch("%S+") do
    if not properties[word] then problem("%s: shape %s needs %s", name, d.shape, word) end
  end
  if d.shape == "boxes" and not d.boxes then problem("%s: no boxes", name) end
  for match, over in pairs(d.variants or {}) do
    check_fields(name .. "[" .. match .. "]", over)
    for pair in match:gmatch("[^,]+") do
      local key, value = pair:match("^([%w_]+)=([%w_]+)$")
      if not key or not properties[key] or not has(properties[key], value) then problem("%s: variant %s matches nothing", name, match) end
    end
  end
end

local env = { math = math, string = string, table = table, pairs = pairs, ipairs = ipairs, tostring = tostring, tonumber = tonumber, type = type,
  error = error, assert = assert, select = select, define_block = define_block,
  define_texture = function(name, d)
    animated[name] = true
    need_texture("define_texture", name)
    number(name, d.frame_time, 1, 1000)
  end,
  define_biome = function(name, d)
    if biomes[name] then problem("biome %s is defined twice", name) end
    biomes[name], biomes[#biomes + 1] = d, name
    for _, key in ipairs { "grass", "foliage", "water", "sky", "fog" } do check_color(name .. " " .. key, d[key], 255) end
    number(name, d.temperature, -2, 2)
    number(name, d.downfall, 0, 1)
  end,
  define_hotbar = function(list) hotbar = list end }

for _, path in ipairs(files("*.lua")) do
  local chunk, message = loadfile(path, "t", env)
  if chunk then
    local ok, err = pcall(chunk)
    if not ok then problem("%s", err) end
  else problem("%s", message) end
end

if not hotbar or #hotbar ~= 9 then problem("the hotbar must have 9 blocks") end
for _, name in ipairs(hotbar or {}) do if not blocks[name] then problem("hotbar: %s is not defined", name) end end

-- Maps that belong to an albedo must not stand alone.
for stem in pairs(textures) do
  local albedo = stem:match("^(.*)_[nre]$")
  if albedo and not textures[albedo] and not used[stem] then problem("texture %s has no albedo", stem) end
end
local spare = 0
for stem in pairs(textures) do
  if not used[stem] and not (stem:match("_[nre]$") and textures[stem:sub(1, -3)]) then
    spare = spare + 1
    print("unused texture: " .. stem)
  elseif used[stem] and not (textures[stem .. "_n"] and textures[stem .. "_r"]) then problem("texture %s has no normal or roughness", stem) end
end

local oracle_states = 0
for i = 1, #arg do
  if arg[i]:sub(1, 2) ~= "--" then
    local text = assert(io.open(arg[i])):read("a")
    for key in text:gmatch('"(minecraft:[^"]+)"%s*:') do
      oracle_states = oracle_states + 1
      local name, props = key:match("^([^%[]+)%[?([^%]]*)%]?$")
      local d = blocks[name]
      if not d then problem("oracle: %s is not defined", name) else
        for pair in props:gmatch("[^,]+") do
          local k, v = pair:match("^(.-)=(.*)$")
          if not (d.properties and d.properties[k] and has(d.properties[k], v)) then problem("oracle: %s has no %s=%s", name, k, v) end
        end
      end
    end
  end
end

local vitrail = 0
for _, name in ipairs(order) do if name:match("^vitrail:") then vitrail = vitrail + 1 end end
local n_used, n_anim = 0, 0
for _ in pairs(used) do n_used = n_used + 1 end
for _ in pairs(animated) do n_anim = n_anim + 1 end
if arg[1] == "--names" then
  local list = {}
  for t in pairs(used) do list[#list + 1] = t end
  table.sort(list)
  print(table.concat(list, "\n"))
  os.exit(0)
end
print(string.format("blocks %d (vitrail %d), states %d, biomes %d, textures used %d (animated %d, unused %d), oracle states checked %d",
  #order, vitrail, states, #biomes, n_used, n_anim, spare, oracle_states))
table.sort(problems)
for i = 1, math.min(#problems, tonumber(os.getenv("SHOW") or 60)) do print("PROBLEM " .. problems[i]) end
if #problems > 0 then print(#problems .. " problems") os.exit(1) end
print("content is sound")
