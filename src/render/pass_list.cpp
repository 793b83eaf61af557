#include "render/pass_list.h"

#include "render/passes/bloom/bloom_pass.h"
#include "render/passes/exposure/exposure_pass.h"
#include "render/passes/film/film_pass.h"
#include "render/passes/fog/fog_pass.h"
#include "render/passes/fxaa/fxaa_pass.h"
#include "render/passes/lighting/lighting_pass.h"
#include "render/passes/outline/outline_pass.h"
#include "render/passes/scene_copy/scene_copy_pass.h"
#include "render/passes/shadow/shadow_pass.h"
#include "render/passes/sky/sky_pass.h"
#include "render/passes/ssao/ssao_pass.h"
#include "render/passes/ssr/reflections_pass.h"
#include "render/passes/taa/taa_pass.h"
#include "render/passes/terrain/terrain_pass.h"
#include "render/passes/tonemap/tonemap_pass.h"
#include "render/passes/upscale/upscale_pass.h"
#include "render/passes/water/water_pass.h"

namespace vitrail::render {

template <class Pass>
static Pass* add(PassList& list, bool raster, bool traced) {
    auto made = std::make_unique<Pass>();
    Pass* pass = made.get();
    list.all.push_back(std::move(made));
    if (raster) list.raster.push_back(pass);
    if (traced) list.traced.push_back(pass);
    return pass;
}

PassList make_passes() {
    PassList list;
    add<ShadowPass>(list, true, false);
    // Solid surfaces.
    add<TerrainPass>(list, true, false);
    add<SsaoPass>(list, true, false);
    add<LightingPass>(list, true, false);
    add<SkyPass>(list, true, false);
    add<SceneCopyPass>(list, true, false);
    add<ReflectionsPass>(list, true, false);
    // What lets light through, and the air.
    add<WaterPass>(list, true, false);
    add<FogPass>(list, true, false);
    // All of these at once, by the path tracer.
    list.film = add<FilmPass>(list, false, true);
    add<OutlinePass>(list, true, true);
    // The eye.
    add<TaaPass>(list, true, false);
    add<ExposurePass>(list, true, true);
    add<BloomPass>(list, true, true);
    add<TonemapPass>(list, true, true);
    add<FxaaPass>(list, true, true);
    add<UpscalePass>(list, true, true);
    return list;
}

} // namespace vitrail::render
