// All states of the base content as records: sane numbers, the optics that the documents promise, quads that cover
// what the rasterizer draws.
#include "tests/trace/content_fixture.h"

#include "trace/content/emission.h"
#include "trace/content/model_quads.h"

#include <chrono>
#include <cmath>
#include <gmock/gmock.h>

namespace vitrail::trace {
namespace {

using scene::ModelKind;

bool finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

TEST(TraceContent, EveryStateIsSane) {
    const BaseContent& c = base_content();
    const ContentTables& t = c.tables;
    ASSERT_EQ(t.states().size(), c.states->size());
    EXPECT_GT(t.states().size(), 20000u);
    const u32 layers = t.textures().view().layers;
    u32 lamps = 0;
    for (u32 id = 0; id < t.states().size(); ++id) {
        const StateRecord& r = t.states()[id];
        const StateInfo& info = c.states->info(StateId(id));
        const ModelKind kind = c.models.kinds()[id];
        const std::string name = info.state.to_string();
        ASSERT_EQ(r.kind == CellKind::empty, kind == ModelKind::nothing) << name;
        ASSERT_EQ(r.kind == CellKind::cube || r.kind == CellKind::detailed, scene::hides(kind)) << name;
        ASSERT_EQ(r.kind == CellKind::liquid, kind == ModelKind::liquid) << name;
        ASSERT_EQ(r.kind == CellKind::model, kind == ModelKind::model) << name;
        ASSERT_LT(r.medium, t.media().size()) << name;
        ASSERT_LE(r.optics, u8(Optics::water)) << name;
        ASSERT_LE(u64(r.first_quad) + r.quads, t.quads().size()) << name;
        if (r.kind == CellKind::model) {
            ASSERT_EQ(r.quads == 0, c.models.quads(StateId(id)).empty()) << name; // a vine on nothing
            ASSERT_EQ(r.medium, info.in_water ? ContentTables::kWater : 0) << name;
            for (const u64 face : r.faces) // those of the fluid that it stands in show no picture
                ASSERT_EQ(face, 0u) << name;
        } else if (r.kind != CellKind::empty)
            for (u32 f = 0; f < 6; ++f) {
                ASSERT_LT(look_texture(r.faces[f]), layers) << name;
                ASSERT_EQ(look_face(r.faces[f]), f) << name;
            }
        for (u32 i = r.first_quad; i < r.first_quad + r.quads; ++i) {
            const TraceQuad& q = t.quads()[i];
            ASSERT_LT(q.texture, layers) << name;
            ASSERT_NEAR(length(q.normal), 1, 1e-5) << name;
            ASSERT_NEAR(dot(q.normal, q.edge_a), 0, 1e-5) << name;
            ASSERT_NEAR(dot(q.normal, q.edge_b), 0, 1e-5) << name;
            ASSERT_LT(q.medium, t.media().size()) << name;
            for (const Vec3 p : {q.corner, q.corner + q.edge_a, q.corner + q.edge_b})
                ASSERT_TRUE(std::fabs(p.x - 0.5f) < 1.6f && std::fabs(p.y - 0.5f) < 1.6f &&
                            std::fabs(p.z - 0.5f) < 1.6f)
                    << name;
        }
        const auto& light = info.look->light;
        const bool shines = r.emission[0] || r.emission[1] || r.emission[2];
        if (r.kind != CellKind::empty && (r.kind != CellKind::model || r.quads) && (light[0] || light[1] || light[2])) {
            ++lamps;
            ASSERT_TRUE(shines) << name;
        }
    }
    EXPECT_GT(lamps, 100u);
    for (const MediumRecord& m : t.media()) {
        EXPECT_TRUE(m.ior >= 1 && m.ior < 4);
        EXPECT_TRUE(finite(m.absorption) && m.absorption.x >= 0 && m.absorption.y >= 0 && m.absorption.z >= 0);
        EXPECT_TRUE(finite(m.scattering) && m.scattering.x >= 0 && m.scattering.y >= 0 && m.scattering.z >= 0);
    }
}

TEST(TraceContent, BlocksMeetLightAsDocumented) {
    const BaseContent& c = base_content();
    const auto optics = [&](const char* state) { return Optics(c.record(state).optics); };
    for (const char* metal : {"gold_block", "iron_block", "copper_block", "waxed_cut_copper", "netherite_block"})
        EXPECT_EQ(optics(metal), Optics::metal) << metal;
    for (const char* matte :
         {"stone", "grass_block", "oak_planks", "diamond_block", "raw_gold_block", "oxidized_copper", "packed_ice",
          "lava", "oak_fence", "torch", "amethyst_block", "redstone_block"})
        EXPECT_EQ(optics(matte), Optics::matte) << matte;
    for (const char* leaf : {"oak_leaves", "short_grass", "poppy", "wheat", "vine", "fern"})
        EXPECT_EQ(optics(leaf), Optics::leaf) << leaf;
    for (const char* thin : {"glass", "red_stained_glass", "glass_pane", "blue_stained_glass_pane", "tinted_glass"})
        EXPECT_EQ(optics(thin), Optics::thin) << thin;
    for (const char* clear : {"ice", "slime_block", "honey_block", "vitrail:cyan_crystal"})
        EXPECT_EQ(optics(clear), Optics::dielectric) << clear;
    EXPECT_EQ(optics("water"), Optics::water);

    EXPECT_EQ(c.record("glass").kind, CellKind::medium);
    EXPECT_EQ(c.record("glass").medium, 0) << "air between sheets";
    EXPECT_EQ(c.record("oak_leaves").kind, CellKind::cutout);
    EXPECT_EQ(c.record("water").medium, ContentTables::kWater);
    EXPECT_EQ(c.record("water").liquid_height, 227);
    EXPECT_EQ(c.record("oak_slab[waterlogged=true]").medium, ContentTables::kWater);
    EXPECT_EQ(c.record("oak_slab[waterlogged=true]").liquid_height, 227);
    EXPECT_EQ(c.record("water[level=4]").medium, ContentTables::kWater);
    EXPECT_NE(c.record("lava").medium, 0);
    EXPECT_EQ(c.record("lava").medium, c.record("lava[level=3]").medium);
    EXPECT_NE(c.record("lava").medium, ContentTables::kWater);
    const auto medium = [&](const char* state) { return c.tables.media()[c.record(state).medium]; };
    EXPECT_EQ(medium("ice").ior, 1.31f);
    EXPECT_GT(medium("ice").scattering.x, 0.05f);
    EXPECT_EQ(medium("vitrail:cyan_crystal").ior, 2.3f);
    EXPECT_GT(medium("vitrail:cyan_crystal").absorption.x, 2 * medium("vitrail:cyan_crystal").absorption.z);
    EXPECT_GT(medium("vitrail:magenta_crystal").absorption.y, 2 * medium("vitrail:magenta_crystal").absorption.x);
    EXPECT_EQ(medium("water").ior, 1.333f);
    EXPECT_TRUE(medium("water").tinted);
    const StateRecord& honey = c.record("honey_block");
    ASSERT_GT(honey.quads, 0);
    const TraceQuad& side = c.tables.quads()[honey.first_quad];
    EXPECT_EQ(c.tables.media()[side.medium].ior, 1.48f);
    EXPECT_TRUE(side.look & TraceQuad::kTwoSided) << "met from within, too";
    const StateRecord& pane = c.record("glass_pane");
    EXPECT_FALSE(c.tables.quads()[pane.first_quad].look & TraceQuad::kCutout) << "holes are panes";
    const StateRecord& door = c.record("oak_door");
    EXPECT_TRUE(c.tables.quads()[door.first_quad].look & TraceQuad::kCutout);
    EXPECT_TRUE(c.tables.quads()[c.record("poppy").first_quad].look & TraceQuad::kUnshaded);
}

// New states come behind the old ones, which stay as they are.
TEST(TraceContent, GrowsWithItsStates) {
    BaseContent& all = base_content();
    StateTable states(all.registry);
    scene::BlockModels models;
    ContentTables tables;
    EXPECT_EQ(tables.update(models, states, nullptr).error().code, ErrorCode::invalid_argument);
    for (const char* first : {"stone", "torch", "red_stained_glass"})
        ASSERT_TRUE(states.intern_with_defaults(*parse_block_state(first)));
    models.ensure(states);
    ASSERT_TRUE(tables.update(models, states, &all.pictures));
    const std::vector<StateRecord> before = tables.states();
    const u32 generation = tables.generation();
    for (const char* more : {"water", "oak_stairs", "ice", "glowstone"})
        ASSERT_TRUE(states.intern_with_defaults(*parse_block_state(more)));
    models.ensure(states);
    ASSERT_TRUE(tables.update(models, states, nullptr));
    EXPECT_EQ(tables.generation(), generation);
    ASSERT_EQ(tables.states().size(), before.size() + 4);
    EXPECT_EQ(std::memcmp(tables.states().data(), before.data(), before.size() * sizeof(StateRecord)), 0);
    EXPECT_EQ(tables.states()[before.size()].medium, ContentTables::kWater);
    ASSERT_TRUE(tables.update(models, states, &all.pictures));
    EXPECT_NE(tables.generation(), generation);
}

double area_of(const scene::ModelQuad& g, int a, int b, int c) {
    const auto at = [&](int i) {
        const auto& p = g.corners[std::size_t(i)];
        return Vec3{float(p.x), float(p.y), float(p.z)} * (1.0f / 256);
    };
    return 0.5 * length(cross(at(b) - at(a), at(c) - at(a)));
}

TEST(TraceContent, QuadsCoverWhatIsDrawn) {
    const BaseContent& c = base_content();
    const auto quads = c.models.model_quads(0);
    ASSERT_GT(quads.size(), 1000u);
    u32 whole = 0, split = 0;
    for (const scene::ModelQuad& g : quads) {
        std::vector<TraceQuad> out;
        add_trace_quads(g, {}, Optics::matte, 0, out);
        double area = 0;
        for (const TraceQuad& q : out) {
            area += length(cross(q.edge_a, q.edge_b)) * (q.look & TraceQuad::kTriangle ? 0.5 : 1.0);
            // Each corner of the piece is one of the model's, with its texture coordinates.
            const std::pair<float, float> places[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
            for (u32 k = 0; k < (q.look & TraceQuad::kTriangle ? 3u : 4u); ++k) {
                const auto [a, b] = places[k];
                const Vec3 p = q.corner + q.edge_a * a + q.edge_b * b;
                const float u = q.u0 + a * q.ua + b * q.ub, v = q.v0 + a * q.va + b * q.vb;
                bool found = false;
                for (std::size_t i = 0; i < 4; ++i) {
                    const auto& m = g.corners[i];
                    found |= std::fabs(p.x - float(m.x) / 256) + std::fabs(p.y - float(m.y) / 256) +
                                 std::fabs(p.z - float(m.z) / 256) + std::fabs(u - float(m.s) / 256) +
                                 std::fabs(v - float(g.t[i]) / 256) <
                             1e-5f;
                }
                EXPECT_TRUE(found);
            }
            const Vec3 front{float(g.normal[0]), float(g.normal[1]), float(g.normal[2])};
            EXPECT_GT(dot(q.normal, normalized(front)), 0.98f);
        }
        EXPECT_NEAR(area, area_of(g, 0, 1, 2) + area_of(g, 0, 2, 3), 1e-6);
        (out.size() == 1 ? whole : split) += 1;
    }
    EXPECT_GT(whole, 9 * split) << "most are parallelograms";
}

TEST(TraceContent, PicturesMove) {
    const BaseContent& c = base_content();
    TextureStore store;
    store.load(c.pictures);
    const u32 lava = u32(*c.registry->find_texture("lava_still")), stone = u32(*c.registry->find_texture("stone"));
    EXPECT_TRUE(store.painted_emission(lava));
    EXPECT_FALSE(store.painted_emission(stone));
    const TextureView view = store.view();
    std::vector<u32> changed;
    store.animate(0, changed);
    EXPECT_EQ(changed.size(), c.pictures.animations.size()) << "all are shown for the first time";
    changed.clear();
    store.animate(0.01, changed);
    EXPECT_TRUE(changed.empty());
    const auto& animation = *std::find_if(c.pictures.animations.begin(), c.pictures.animations.end(),
                                          [&](const scene::PictureAnimation& a) { return a.layer == lava; });
    for (const double seconds : {0.33, 0.9, 2.0}) {
        changed.clear();
        store.animate(seconds, changed);
        EXPECT_THAT(changed, testing::Contains(lava));
        EXPECT_THAT(changed, testing::Not(testing::Contains(stone)));
        const scene::PictureAnimation::Moment now = animation.at(seconds);
        ASSERT_EQ(now.from, now.to);
        EXPECT_EQ(std::memcmp(view.albedo + std::size_t(lava) * view.layer_words,
                              animation.albedo[now.from].levels[0].data(), 1024 * 4),
                  0);
    }
}

// Stone with gems: what is bright in the lamp's own hue shines, all else stays as painted.
TEST(TraceContent, LampsWithoutAPictureOfEmissionShineByTheirBrightTexels) {
    const BaseContent& c = base_content();
    TextureStore store;
    store.load(c.pictures);
    const u32 ore = u32(*c.registry->find_texture("redstone_ore"));
    ASSERT_FALSE(store.painted_emission(ore));
    const TextureView view = store.view();
    const std::size_t first = std::size_t(ore) * view.layer_words;
    const std::vector<u32> before(view.material + first, view.material + first + view.layer_words);
    store.derive_emission(ore, {9, 2, 1});
    u32 shining = 0;
    for (u32 i = 0; i < 1024; ++i) {
        const Vec3 color = linear_from_srgb(color_of(view.albedo[first + i]));
        const float emission = material_of(view.material[first + i]).emission;
        EXPECT_EQ(view.material[first + i] & 0xffffff, before[i] & 0xffffff);
        if (emission > 0.5f) {
            ++shining;
            EXPECT_GT(color.x, 2 * color.y) << "red";
        }
    }
    EXPECT_GT(shining, 10u);
    EXPECT_LT(shining, 400u);
    EXPECT_FALSE(store.painted_emission(ore)) << "found, not painted";
}

} // namespace
} // namespace vitrail::trace
