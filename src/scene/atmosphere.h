// A clear sky by physics: Rayleigh and Mie scattering and ozone of an Earth-like air, one scattering exactly and all
// further ones by the isotropic approximation (Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering
// Technique", 2020; table of transmittance after Bruneton and Neyret, "Precomputed Atmospheric Scattering", 2008, in
// Bruneton's mapping of 2017). How a clear sky looks depends only on how high the light stands: skies for a few dozen
// heights are computed once (about 30 ms, at the first use); a sky for any time is read from between two of them.
#pragma once

#include "scene/sky_table.h"

namespace vitrail::scene {

// What is left of the light outside the air after its way to an eye near the ground. sine: of the light's height,
// -1..1. Falls smoothly to 0 as the disc (drawn a little large) sinks below the horizon.
Vec3 light_through_air(float sine);

// Mean radiance of the dome, weighted by the cosine from the zenith, for a light of irradiance 1 outside the air
// (luminance of it: Rec. 709 weights). Above 0; falls by 5 orders of magnitude in dusk.
float clear_sky_brightness(float sine);

// How the bands over the horizon are drawn; the zenith stays. The defaults: as they are.
struct SkyBands {
    float stretch = 1; // below 1: what lies near the horizon stands higher, by 1 / stretch^2
    float lowest = 0;  // the table's row (0..1) that is drawn at the horizon: above 0 without the whitest haze
};

// Adds tint times the clear sky lit from that height, divided by clear_sky_brightness(sine): the pattern alone, of mean
// luminance 1. opposite: the light stands over the last column, not the first.
void add_clear_sky(SkyTable& table, float sine, bool opposite, SkyBands bands, Vec3 tint);

// Solid angle of a texel's share of the upper half, weighted by nothing; all of them, both halves of azimuth, make 2
// pi.
float sky_texel_solid_angle(u32 column, u32 row);

} // namespace vitrail::scene
