-- What the ground consists of, bottom up: 12 strata and 8 loose layers.

local function stratum(name, block, thickness, amplitude, frequency, more)
  define_terrain_layer(name, merge({ block = block, thickness = thickness, amplitude = amplitude, frequency = frequency }, more))
end

stratum("blackstone", "blackstone", 32, 32, .003)
stratum("deepslate", "deepslate", 66, 20, .0045)
stratum("slate", "vitrail:slate", 6, 24, .0062)
stratum("stone", "stone", 40, 30, .005)
stratum("tuff", "tuff", 24, 42, .006)
stratum("calcite", "calcite", 20, 30, .004)
stratum("granite", "granite", 18, 36, .0034)
stratum("terracotta", "terracotta", 32, 16, .002)
stratum("marble", "vitrail:marble", 28, 56, .005)
stratum("andesite", "andesite", 24, 48, .003, { remainder = true })
-- These hang under the sand, however thick the rock below is.
stratum("red_sandstone", "red_sandstone", 3, 2, .0035, { hung = true })
stratum("sandstone", "sandstone", 3.5, 1.5, .0025, { hung = true })

local function loose(name, block, thickness, repose, steepest)
  define_terrain_layer(name, { block = block, loose = true, thickness = thickness, repose = repose, steepest = steepest })
end

loose("gravel", "gravel", 2.5, 55, 1.8)
loose("clay", "clay", 2.7, 40, 1.8)
loose("mud", "mud", 2.3, 45, 1.6)
loose("dirt", "dirt", 4.2, 40, 1.2)
loose("red_sand", "red_sand", 3.5, 30, 1.5)
loose("sand", "sand", 3.8, 35, 1.4)
loose("smooth_sand", "vitrail:smooth_sand", 4.5, 65, 4)
loose("snow", "snow_block", 2.5, 45, 1.5)
