// Entities' boxes: the tree against every box by itself, and what is told of changes.
#include "base/rng.h"
#include "trace/boxes.h"
#include "trace/kernel/box_hit.h"

#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace vitrail::trace {
namespace {

std::vector<StateRecord> some_states() {
    std::vector<StateRecord> states(3);
    states[2].kind = CellKind::cube;
    return states;
}

scene::EntityBox box_at(double x, double y, double z, Vec3 size) {
    return {{DimensionId{}, world_pos_from_numbers(x, y, z)}, size, StateId(2)};
}

TEST(BoxTree, FindsTheNearestOfThousands) {
    const auto states = some_states();
    Rng rng(3);
    const auto within = [&](double r) { return (rng.unit() * 2 - 1) * r; };
    // Near the world's middle, and where floats hold no blocks any more.
    for (const double far : {0.0, 2e9}) {
        const WorldPos middle = world_pos_from_numbers(far, 80, -far);
        std::vector<scene::EntityBox> entities;
        for (u32 i = 0; i < 3000; ++i) {
            const Vec3 to{float(within(50)), float(within(15)), float(within(50))};
            const Vec3 size{float(0.3 + rng.unit()), float(0.3 + 2 * rng.unit()), float(0.3 + rng.unit())};
            entities.push_back({{DimensionId{}, offset_by(middle, to)}, size, StateId(2)});
        }
        for (u32 i = 0; i < 20; ++i)
            entities.push_back(entities[0]); // at the same place
        BoxTree tree;
        EXPECT_TRUE(tree.update(entities, DimensionId{}, place_of(middle), states));
        SceneView scene;
        tree.fill(scene);
        ASSERT_EQ(scene.box_count, entities.size());
        u32 met = 0;
        for (u32 i = 0; i < 1500; ++i) {
            Ray ray;
            ray.from = place_of(offset_by(middle, {float(within(70)), float(within(20)), float(within(70))}));
            ray.dir = normalized({float(within(1)), float(within(0.3)), float(within(1))});
            if (i % 5 == 0) ray.dir.y = 0, ray.dir = normalized(ray.dir);
            if (i % 7 == 0) ray.dir = {0, 0, i % 2 ? 1.0f : -1.0f};
            float nearest = kFar;
            for (u32 b = 0; b < scene.box_count; ++b) {
                float t;
                u32 face;
                const EntityBox& box = scene.boxes[b];
                if (enter_box(offset(box.least, ray.from), ray.dir, {}, box.size, kFar, t, face) && t >= 0)
                    nearest = std::min(nearest, t);
            }
            Hit hit, any;
            ASSERT_EQ(meet_boxes(scene, ray, kFar, false, hit), nearest < kFar) << far << ' ' << i;
            ASSERT_EQ(meet_boxes(scene, ray, kFar, true, any), nearest < kFar);
            if (nearest == kFar) continue;
            ++met;
            ASSERT_EQ(hit.t, nearest) << far << ' ' << i;
            ASSERT_EQ(hit.kind, HitKind::box);
            ASSERT_GE(any.t, nearest);
        }
        EXPECT_GT(met, 200u);
    }
}

TEST(BoxTree, IsShallowAndHoldsEveryBoxOnce) {
    const auto states = some_states();
    std::vector<scene::EntityBox> entities;
    for (u32 i = 0; i < 1000; ++i) // in a row, ever farther apart: a split in space would be deep
        entities.push_back(box_at(std::pow(1.01, i), 64, 0, {0.5f, 0.5f, 0.5f}));
    BoxTree tree;
    tree.update(entities, DimensionId{}, place_of({}), states);
    SceneView scene;
    tree.fill(scene);
    std::vector<u32> seen(scene.box_count);
    u32 deepest = 0;
    const std::function<void(u32, u32)> visit = [&](u32 n, u32 depth) {
        ASSERT_LT(n, tree.nodes());
        const BoxNode& node = scene.box_nodes[n];
        deepest = std::max(deepest, depth);
        if (node.count == 0) {
            visit(node.first, depth + 1), visit(node.first + 1, depth + 1);
            return;
        }
        EXPECT_LE(node.count, 4u);
        for (u32 i = node.first; i < node.first + node.count; ++i)
            ++seen[i];
    };
    visit(0, 1);
    EXPECT_LE(deepest, 9u); // 4 * 2^8 boxes
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1u), 1000);
}

TEST(BoxTree, LeavesOutWhatCannotBeSeen) {
    const auto states = some_states();
    const float nan = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();
    std::vector<scene::EntityBox> entities;
    for (Vec3 size : {Vec3{0, 1, 1}, {1, -1, 1}, {1, 1, nan}, {endless, 1, 1}, {1, 1, 1}})
        entities.push_back(box_at(1, 2, 3, size));
    entities.push_back(entities.back()), entities.back().least.dimension = DimensionId(1);
    entities.push_back(box_at(4, 5, 6, {1, 1, 1})), entities.back().looks_like = StateId::air;
    entities.push_back(box_at(4, 5, 6, {1, 1, 1})), entities.back().looks_like = StateId(99);
    BoxTree tree;
    EXPECT_TRUE(tree.update(entities, DimensionId{}, place_of({}), states));
    SceneView scene;
    tree.fill(scene);
    ASSERT_EQ(scene.box_count, 1u);
    EXPECT_EQ(scene.boxes[0].least.cell, (IVec3{1, 2, 3}));
    // In the other dimension there is another one.
    EXPECT_TRUE(tree.update(std::span(entities).subspan(0, 6), DimensionId(1), place_of({}), states) == false)
        << "the same box there";
    tree.fill(scene);
    EXPECT_EQ(scene.box_count, 1u);
}

TEST(BoxTree, TellsChanges) {
    const auto states = some_states();
    std::vector<scene::EntityBox> entities{box_at(1, 2, 3, {1, 1, 1}), box_at(9, 2, 3, {1, 2, 1})};
    const Place here = place_of(world_pos_from_numbers(0.5, 70, 0.5)),
                there = place_of(world_pos_from_numbers(8, 70, 0));
    BoxTree tree;
    EXPECT_FALSE(tree.update({}, DimensionId{}, here, states));
    EXPECT_EQ(tree.generation(), 0u);
    EXPECT_TRUE(tree.update(entities, DimensionId{}, here, states));
    const u64 first = tree.generation();
    EXPECT_FALSE(tree.update(entities, DimensionId{}, here, states));
    EXPECT_EQ(tree.generation(), first);
    // Where the eye is changes numbers, not what is seen.
    EXPECT_FALSE(tree.update(entities, DimensionId{}, there, states));
    EXPECT_GT(tree.generation(), first);
    entities[1].least.at.x += 1 << 20;
    EXPECT_TRUE(tree.update(entities, DimensionId{}, there, states));
    EXPECT_TRUE(tree.update({}, DimensionId{}, there, states));
    SceneView scene;
    tree.fill(scene);
    EXPECT_EQ(scene.box_count, 0u);
    EXPECT_FALSE(tree.update({}, DimensionId{}, here, states));
}

} // namespace
} // namespace vitrail::trace
