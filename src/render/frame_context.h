// What the passes know of the frame being drawn, and the numbers of texture units and buffers that shaders agree on.
#pragma once

#include "gfx/context.h"
#include "gfx/upload_ring.h"
#include "render/culling.h"
#include "render/draw_list.h"
#include "render/effects.h"
#include "render/frame_stats.h"
#include "render/frame_uniforms.h"
#include "render/passes/terrain/terrain_draw.h"
#include "render/section_store.h"
#include "render/texture_set.h"
#include "scene/frame_view.h"

#include <vector>

namespace vitrail::render {

// Texture units by what they hold; shaders say layout(binding = N) with the same numbers.
enum class Unit : u32 {
    albedo = 0,   // terrain: texture array; screen passes: G-buffer
    light = 1,    // terrain: light atlas; screen passes: G-buffer
    material = 2, // terrain: texture array; screen passes: G-buffer "surface"
    depth = 3,
    color = 4,        // the HDR picture so far
    shadow = 5,       // depth array, compared
    shadow_color = 6, // what stained glass lets through
    shadow_depth = 7, // depth array, read plainly
    ao = 8,           // of the screen
    sky = 9,          // the dome as a table
    clouds = 10,      // their shapes, tiling
    fog = 12,         // light of the air
    exposure = 13,    // 1 x 1
    // 14, 15: free for a pass's own use
};

// Uniform buffers: 0 Frame (common/frame.glsl), 1 shadows, 2 fog, 3 a pass's own.
// Storage buffers: 0 quads, 1 tints, 2 fixed tints, 3 models, 4 and up a pass's own.

struct ViewDraws {
    std::vector<VisibleSection> visible; // nearest first
    DrawList list;
    TerrainInputs inputs;
    // Where occlusion culling splits the list (passes/occlusion/): solid surfaces draw these two; `inputs` holds what
    // they drew, once they have.
    bool occlusion = false;
    TerrainInputs first, late;
};

struct FrameContext {
    const scene::FrameView* frame = nullptr;
    const Effects* effects = nullptr;
    const gfx::ContextInfo* context = nullptr;
    FrameUniforms uniforms;
    Vec2 jitter{};           // of this frame, in pixels -0.5..0.5, set by begin()
    u64 number = 0;          // frames drawn before
    float seconds_since = 0; // the last frame, 0..1 (frame.seconds)
    bool continues = false;  // the last frame showed the same views from nearly the same place, at the same size
    bool exact = false;      // a test's background is on: the view stays where it is, pixels what they are
    bool stencil = false;
    std::vector<ViewDraws> views; // by view
    SectionStore* sections = nullptr;
    const TextureSet* textures = nullptr;
    gfx::UploadRing* ring = nullptr;
    TerrainInputs terrain;                        // what all draws of terrain share; list and view are missing
    u32 plain_array = 0;                          // vertex array without attributes, for screen passes
    u32 target_framebuffer = 0;                   // "screen"
    const gfx::Texture* target_texture = nullptr; // what it draws into, where that is known: threads may write it
    FrameStats* stats = nullptr;
};

// What draws of this list read, uploaded for this frame. view: number in the frame's uniforms.
TerrainInputs upload_draws(FrameContext& frame, const DrawList& list, u32 view);

} // namespace vitrail::render
