#include "render/pass_list.h"

#include "render/passes/bloom/bloom_pass.h"
#include "render/passes/exposure/exposure_pass.h"
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
#include "render/passes/water/water_pass.h"

namespace vitrail::render {

std::vector<std::unique_ptr<RenderPass>> make_passes() {
    std::vector<std::unique_ptr<RenderPass>> passes;
    passes.push_back(std::make_unique<ShadowPass>());
    // Solid surfaces.
    passes.push_back(std::make_unique<TerrainPass>());
    passes.push_back(std::make_unique<SsaoPass>());
    passes.push_back(std::make_unique<LightingPass>());
    passes.push_back(std::make_unique<SkyPass>());
    passes.push_back(std::make_unique<SceneCopyPass>());
    passes.push_back(std::make_unique<ReflectionsPass>());
    // What lets light through, and the air.
    passes.push_back(std::make_unique<WaterPass>());
    passes.push_back(std::make_unique<FogPass>());
    passes.push_back(std::make_unique<OutlinePass>());
    // The eye.
    passes.push_back(std::make_unique<TaaPass>());
    passes.push_back(std::make_unique<ExposurePass>());
    passes.push_back(std::make_unique<BloomPass>());
    passes.push_back(std::make_unique<TonemapPass>());
    passes.push_back(std::make_unique<FxaaPass>());
    return passes;
}

} // namespace vitrail::render
