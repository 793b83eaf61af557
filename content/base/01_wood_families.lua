-- What is made of one wood. Apart from wood.lua, so that files that sort before it can have woods too.

WOOD_SIGN = "rotation:0-15 wl"

--- What is made of planks, the same for every wood, bamboo and fungus stems included.
function plank_family(wood, def)
  def = merge(WOOD, def)
  local planks = wood .. "_planks"
  block(planks, merge(def, { texture = TEX(planks) }))
  local t = TEX(planks)
  stairs(wood .. "_stairs", t, def)
  slab(wood .. "_slab", t, def)
  fence(wood .. "_fence", t, def)
  fence_gate(wood .. "_fence_gate", t, def)
  button(wood .. "_button", t, merge(def, { hardness = 0.5 }))
  pressure_plate(wood .. "_pressure_plate", t, merge(def, { hardness = 0.5 }))
  door(wood .. "_door", def)
  trapdoor(wood .. "_trapdoor", def)
  local sign = merge(def, { texture = t, hardness = 1, opacity = 0, collision = false })
  block(wood .. "_sign", merge(sign, { shape = "sign" }), WOOD_SIGN)
  block(wood .. "_wall_sign", merge(sign, { shape = "wall_sign" }), "facing wl")
  local hang = { { 1, 0, 7, 15, 10, 9 }, { 2, 10, 8, 4, 16, 8, "chain" }, { 12, 10, 8, 14, 16, 8, "chain" } }
  block(wood .. "_hanging_sign", merge(sign, { shape = "boxes", layer = "cutout", boxes = hang,
    variants = by_rotation(function(facing)
      return { boxes = (facing == "east" or facing == "west") and quarter(hang) or hang }
    end) }), "attached? " .. WOOD_SIGN)
  local bracket = { { 0, 14, 6, 16, 16, 10 } }
  for _, b in ipairs(hang) do bracket[#bracket + 1] = b end
  block(wood .. "_wall_hanging_sign", merge(sign, { shape = "boxes", layer = "cutout", boxes = bracket, variants = turned(bracket) }),
    "facing wl")
end

--- Log, stripped log and the all-bark blocks. `log` and `bark` name them: log/wood, or stem/hyphae.
function log_family(wood, log, bark, def)
  def = merge(WOOD, def)
  for _, strip in ipairs { "", "stripped_" } do
    local space, base = string.match(wood, "^(.-:?)([^:]+)$")
    local name = space .. strip .. base
    local side = strip .. base .. "_" .. log
    pillar(name .. "_" .. log, { side, side .. "_top" }, def)
    pillar(name .. "_" .. bark, { side, side }, def)
  end
end
