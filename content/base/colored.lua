-- The sixteen dyes and everything they color.

for _, c in ipairs(COLORS) do
  block(c .. "_wool", { texture = c .. "_wool", material = "wool", hardness = 0.8 })
  block(c .. "_carpet", { texture = c .. "_wool", shape = "carpet", material = "wool", hardness = 0.1, opacity = 0 })
  block(c .. "_concrete", merge(STONE, { texture = c .. "_concrete", hardness = 1.8 }))
  block(c .. "_concrete_powder", { texture = c .. "_concrete_powder", material = "sand", hardness = 0.5 })
  block(c .. "_terracotta", merge(STONE, { texture = c .. "_terracotta", hardness = 1.25 }))
  -- Listed as side and end, so that the picture turns with the facing.
  block(c .. "_glazed_terracotta", merge(STONE, { texture = { c .. "_glazed_terracotta", c .. "_glazed_terracotta" }, hardness = 1.4 }), "facing")
  local glass = { material = "glass", hardness = 0.3, layer = "translucent", transparency = 0.6, opacity = 0 }
  block(c .. "_stained_glass", merge(glass, { texture = c .. "_stained_glass" }))
  block(c .. "_stained_glass_pane", merge(glass, { texture = { c .. "_stained_glass", c .. "_stained_glass_pane_top" }, shape = "pane" }),
    SIDES4 .. " wl")
  local cloth = { material = "wool", hardness = 0.2, opacity = 0 }
  block(c .. "_bed", merge(cloth, { shape = "bed", texture = { c .. "_bed_side", c .. "_bed_foot", "oak_planks" },
    variants = { ["part=head"] = { texture = { c .. "_bed_side", c .. "_bed_head", "oak_planks" } } } }), "facing occupied? part=foot|head")
  local pole = { { 7, 0, 7, 9, 16, 9, "oak_planks" }, { 1, 1, 6, 15, 16, 7 } }
  local facings = turned(pole)
  local banner = merge(cloth, { shape = "boxes", texture = c .. "_wool", collision = false, hardness = 1 })
  block(c .. "_banner", merge(banner, { boxes = pole, variants = by_rotation(function(f) return facings["facing=" .. f] end) }), "rotation:0-15")
  local hung = { { 1, 14, 14, 15, 16, 16, "oak_planks" }, { 2, 0, 14, 14, 15, 15 } }
  block(c .. "_wall_banner", merge(banner, { boxes = hung, variants = turned(hung) }), "facing")
end

for _, c in ipairs { "", "white_", "orange_", "magenta_", "light_blue_", "yellow_", "lime_", "pink_", "gray_", "light_gray_", "cyan_",
  "purple_", "blue_", "brown_", "green_", "red_", "black_" } do
  local s = c .. "shulker_box"
  block(s, merge(STONE, { texture = { s .. "_side", s .. "_top", s .. "_bottom" }, hardness = 2 }), "facing_up")

  -- Candles: one box each, so the count is read from the boxes.
  local t, sets = c .. "candle", {
    { { 7, 0, 7, 9, 6, 9 } },
    { { 5, 0, 7, 7, 5, 9 }, { 9, 0, 6, 11, 6, 8 } },
    { { 5, 0, 7, 7, 5, 9 }, { 8, 0, 5, 10, 6, 7 }, { 8, 0, 9, 10, 3, 11 } },
    { { 5, 0, 5, 7, 5, 7 }, { 8, 0, 5, 10, 6, 7 }, { 6, 0, 8, 8, 3, 10 }, { 9, 0, 8, 11, 5, 10 } } }
  local variants = { ["lit=true"] = { texture = { t, t .. "_lit_top", t } } }
  for i = 1, 4 do
    variants["candles=" .. i] = { boxes = sets[i] }
    variants["candles=" .. i .. ",lit=true"] = { light = { 3 * i, 2 * i + 1, i } }
  end
  block(t, merge(DECOR, { shape = "boxes", texture = t, hardness = 0.1, boxes = sets[1], variants = variants }), "candles:1-4 lit? wl")
  block(t .. "_cake", merge(DECOR, { shape = "boxes", texture = { "cake_side", "cake_top", "cake_bottom" },
    boxes = { { 1, 0, 1, 15, 8, 15 }, { 7, 8, 7, 9, 14, 9, t } }, material = "wool", variants = { ["lit=true"] = { light = 3,
      boxes = { { 1, 0, 1, 15, 8, 15 }, { 7, 8, 7, 9, 14, 9, t }, { 7, 14, 7, 9, 14.5, 9, t .. "_lit_top" } } } } }), "lit?")
end

block("terracotta", merge(STONE, { texture = "terracotta", hardness = 1.25 }))
block("glass", merge(GLASS, { texture = "glass" }))
block("glass_pane", merge(GLASS, { texture = { "glass", "glass_pane_top" }, shape = "pane" }), SIDES4 .. " wl")
block("tinted_glass", { texture = "tinted_glass", material = "glass", hardness = 0.3, layer = "translucent", transparency = 0.3, opacity = 15 })
