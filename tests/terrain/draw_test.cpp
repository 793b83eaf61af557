// Drawing of features: the same as one large voxelisation of all solids, column by column, for every shape; solids
// against true distances; boxes, flags, shares, vector sets.
#include "tests/terrain/shape_voxels.h"

#include "terrain/cpu/features_stage.h"
#include "terrain/cpu/stages.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tuple>

namespace vitrail {
namespace {

constexpr i32 kEdgeColumn = kWorldEdge / 16;
using shape_voxels::row_of;

FeaturePlace place_of(Shape shape) {
    switch (shape) {
    case Shape::coral:
    case Shape::kelp:
        return FeaturePlace::sea_floor;
    case Shape::iceberg:
        return FeaturePlace::sea_surface;
    case Shape::stormlight:
    case Shape::crystal_pillar:
    case Shape::fungus:
        return FeaturePlace::cave_floor;
    case Shape::glowstone_cluster:
    case Shape::cave_vine:
        return FeaturePlace::cave_ceiling;
    default:
        return FeaturePlace::surface;
    }
}

// A world of one kind of ground: land at 140, or sea with its floor at 90, or a cave from 40 to 79.
struct World {
    std::unique_ptr<TerrainTables> t = std::make_unique<TerrainTables>();
    std::unique_ptr<GroundTile> ground = std::make_unique<GroundTile>();
    std::unique_ptr<CaveTile> caves = std::make_unique<CaveTile>();

    explicit World(FeaturePlace place) {
        t->seed = 7;
        TableBuilder noises(*t);
        t->shape_noise[0] = noises.add_noise(NoiseKind::simplex3, 0.13, 3, purpose_of("shape fine")).value();
        t->shape_noise[1] = noises.add_noise(NoiseKind::simplex3, 0.035, 3, purpose_of("shape coarse")).value();
        t->biomes = t->cave_biomes = 1;
        const bool sea = place == FeaturePlace::sea_floor || place == FeaturePlace::sea_surface;
        for (i32 i = 0; i < kColumnCells; ++i) {
            ground->top[i] = ground->land[i] = sea ? 90.0f : 140.0f;
            for (i32 y = 40; y < 80 && place >= FeaturePlace::cave_floor; ++y)
                caves->open[y >> 5][i] |= 1u << (y & 31);
        }
    }
    void add(Shape shape, u16 cell, u16 padding, float chance) {
        FeatureRow row = row_of(shape);
        row.place = place_of(shape);
        row.cell = cell;
        row.padding = padding;
        row.chance = chance;
        t->feature[t->features++] = row;
    }
    Block block_at(i32 index, i32 y) const {
        if (y == 0) return kBedrock;
        if (caves->open[y >> 5][index] >> (y & 31) & 1)
            return y < 44 ? kLava : kAir; // lava on the floor keeps its place
        if (float(y) < ground->top[index]) return 5;
        return y < kTerrainSeaLevel ? kWater : kAir;
    }
    void fill(BlockTile& out) const {
        out.top = 140;
        for (i32 i = 0; i < kTerrainHeight * kColumnCells; ++i)
            out.block[i] = block_at(i & 255, i >> 8);
    }
};

// Columns first.x .. first.x + side - 1 likewise in z, and the features of the three around them.
struct Area {
    ColumnPos first;
    i32 side;
    std::vector<FeatureTile> features; // (side + 6)^2
    Area(const World& w, ColumnPos at, i32 columns)
        : first(at)
        , side(columns)
        , features(size_t((side + 6) * (side + 6))) {
        for (i32 i = 0; i < (side + 6) * (side + 6); ++i)
            features_stage(*w.t, {first.x - 3 + i % (side + 6), first.z - 3 + i / (side + 6)}, *w.ground, *w.caves,
                           features[size_t(i)]);
    }
    void ring(i32 x, i32 z, const FeatureTile* out[49]) const {
        for (i32 i = 0; i < 49; ++i)
            out[i] = &features[size_t((z + i / 7) * (side + 6) + x + i % 7)];
    }
};

// Every solid voxelised on its own in one large array, whatever its reach; y as it comes.
std::vector<Block> brute_force(const World& w, const Area& area) {
    const i32 wide = area.side * 16;
    std::vector<Block> block(size_t(wide) * size_t(wide) * kTerrainHeight);
    std::vector<u8> taken(block.size());
    const auto cell = [&](i32 x, i32 y, i32 z) {
        return (size_t(y) * size_t(wide) + size_t(z)) * size_t(wide) + size_t(x);
    };
    for (i32 y = 0; y < kTerrainHeight; ++y)
        for (i32 z = 0; z < wide; ++z)
            for (i32 x = 0; x < wide; ++x)
                block[cell(x, y, z)] = w.block_at((x & 15) | (z & 15) << 4, y);
    for (const FeatureTile& tile : area.features)
        for (u32 p = 0; p < tile.placements; ++p)
            for (u32 k = 0; k < tile.placement[p].count; ++k) {
                const Placement& place = tile.placement[p];
                const Primitive& s = tile.primitive[place.first + k];
                const SolidFrame frame = solid_frame(s);
                const i64 corner_x = i64(place.x) - i64(area.first.x) * 16,
                          corner_z = i64(place.z) - i64(area.first.z) * 16;
                for (i32 dz = s.low[2]; dz <= s.high[2]; ++dz)
                    for (i32 dx = s.low[0]; dx <= s.high[0]; ++dx)
                        for (i32 dy = s.low[1]; dy <= s.high[1]; ++dy) {
                            const i64 x = corner_x + dx, z = corner_z + dz;
                            const i32 y = place.y + dy;
                            if (x < 0 || z < 0 || x >= wide || z >= wide || y < 0 || y >= kTerrainHeight) continue;
                            const size_t at = cell(i32(x), y, i32(z));
                            const Block before = block[at];
                            if (taken[at] || before == kBedrock || before == kLava) continue;
                            const bool water = before == kWater, air = before == kAir;
                            const bool only = s.flags & solid_only_water;
                            if (only ? !water
                                     : !(air || (water && (s.flags & solid_in_water)) ||
                                         (!water && (s.flags & solid_over_ground))))
                                continue;
                            // The voxel by itself, seen from its own column.
                            const ColumnPos own{area.first.x + i32(x >> 4), area.first.z + i32(z >> 4)};
                            const Row<ScalarLanes> row = thread_row(own, i32(x & 15) | i32(z & 15) << 4);
                            const float px = float(dx) + .5f, py = float(dy) + .5f, pz = float(dz) + .5f;
                            float d = solid_distance<ScalarLanes>(s, frame, px, py, pz);
                            if (s.wobble > 0) {
                                const Noise n = w.t->noise[s.noise];
                                const float v =
                                    fractal3<ScalarLanes>(&w.t->octave[n.first], n.octaves, row.spot(float(y)));
                                d = d + std::min(std::max(v, -1.0f), 1.0f) * s.wobble;
                            }
                            if (!(d < 0)) continue;
                            const u32 bits = random_bits(w.t->feature[place.feature].key, u32(own.x) * 16 + u32(x & 15),
                                                         u32(y), u32(own.z) * 16 + u32(z & 15));
                            if ((bits & 255) < s.missing_share) continue;
                            block[at] = (bits >> 8 & 255) < s.other_share ? s.other : s.block;
                            taken[at] = 1;
                        }
            }
    return block;
}

// The number of voxels that features put, or -1 where a column differs from the large voxelisation.
i64 check_area(const World& w, ColumnPos first, i32 side) {
    const Area area(w, first, side);
    const std::vector<Block> want = brute_force(w, area);
    auto tile = std::make_unique<BlockTile>(), before = std::make_unique<BlockTile>();
    w.fill(*before);
    i64 put = 0;
    for (i32 cz = 0; cz < side; ++cz)
        for (i32 cx = 0; cx < side; ++cx) {
            const FeatureTile* ring[49];
            area.ring(cx, cz, ring);
            *tile = *before;
            terrain_stages(Isa::portable).draw(*w.t, {first.x + cx, first.z + cz}, ring, *tile);
            i32 top = 0;
            for (i32 y = 0; y < kTerrainHeight; ++y)
                for (i32 i = 0; i < kColumnCells; ++i) {
                    const Block b = tile->block[i | y << 8];
                    const i32 wide = side * 16, x = cx * 16 + (i & 15), z = cz * 16 + (i >> 4);
                    if (b != want[(size_t(y) * size_t(wide) + size_t(z)) * size_t(wide) + size_t(x)]) {
                        ADD_FAILURE() << "column " << cx << "," << cz << " block " << (i & 15) << "," << y << ","
                                      << (i >> 4);
                        return -1;
                    }
                    put += b != before->block[i | y << 8];
                    if (b != kAir) top = y + 1;
                }
            EXPECT_EQ(tile->top, std::max(top, 140));
        }
    return put;
}

class DrawShape : public ::testing::TestWithParam<u32> {};

TEST_P(DrawShape, IsNotCutAtBordersOfColumns) {
    const Shape shape = Shape(GetParam());
    World w(place_of(shape));
    w.add(shape, 41, 2, .9f);
    for (const ColumnPos first : {ColumnPos{-5, -4}, ColumnPos{kEdgeColumn - 9, -kEdgeColumn}})
        EXPECT_GT(check_area(w, first, 9), 8) << "at " << first.x; // something is drawn, and all of it as it should be
}

TEST_P(DrawShape, CrowdsTakeTurns) {
    const Shape shape = Shape(GetParam());
    World w(place_of(shape));
    w.add(shape, shape == Shape::iceberg ? 31 : 9, 0, .8f);
    EXPECT_GT(check_area(w, {-2, -1}, 3), 8);
}

// The shape's declared reach and bounds cut nothing off, whatever the numbers of its row within their ranges.
TEST_P(DrawShape, StaysWithinItsReach) {
    const Shape shape = Shape(GetParam());
    const ShapeInfo& info = shape_infos()[GetParam()];
    std::mt19937 random(GetParam() + 1);
    u32 placed = 0;
    for (i32 round = 0; round < 60; ++round) {
        World w(place_of(shape));
        w.add(shape, 16, 0, 1);
        FeatureRow& row = w.t->feature[0];
        if (w.ground->top[0] < float(kTerrainSeaLevel)) // from deep to shallow seas
            std::fill_n(w.ground->top, kColumnCells, round % 3 == 0 ? 45.0f : round % 3 == 1 ? 90.0f : 121.0f);
        for (u32 i = 0; i < kFeatureNumbers; ++i) {
            const ShapeNumber& n = info.numbers[i];
            if (!n.name) continue;
            const float share = std::uniform_int_distribution<i32>(0, 2)(random) * 0.5f; // ends and middle
            row.numbers[i] = n.least + (n.most - n.least) * share;
        }
        for (u32 i = 0; i + 1 < kFeatureNumbers; ++i) { // "..._least", "..._most" pairs in order
            const char* name = info.numbers[i].name;
            if (name && std::string_view(name).ends_with("_least") && row.numbers[i] > row.numbers[i + 1])
                std::swap(row.numbers[i], row.numbers[i + 1]);
        }
        FeatureTile tile;
        features_stage(*w.t, {i32(random() % 1000), -i32(random() % 1000)}, *w.ground, *w.caves, tile);
        for (u32 p = 0; p < tile.placements; ++p) {
            Placement bounded = tile.placement[p];
            ++placed;
            auto make = [&](const FeatureRow& r) {
                shape_voxels::Built built;
                *built.tables = *w.t;
                built.tables->feature[0] = r;
                features_stage(*built.tables, {bounded.x >> 4, bounded.z >> 4}, *w.ground, *w.caves, *built.tile);
                built.placement = built.tile->placement[p];
                EXPECT_LE(built.tile->placements, 1u);
                return shape_voxels::draw(built);
            };
            FeatureRow free = row;
            free.reach = 300;
            free.bound_low = -300;
            free.bound_high = 300;
            const shape_voxels::Voxels all = make(free);
            for (i32 y = all.low[1]; y < all.low[1] + all.size[1]; ++y)
                for (i32 z = all.low[2]; z < all.low[2] + all.size[2]; ++z)
                    for (i32 x = all.low[0]; x < all.low[0] + all.size[0]; ++x) {
                        if (all.get(x, y, z) == kAir) continue;
                        // Roots end in the rock that they stand in, or hang from.
                        const bool hangs = row.place == FeaturePlace::cave_ceiling;
                        const bool in = (y >= info.bound_low || !hangs) && (y <= info.bound_high || hangs) &&
                                        std::abs(x) <= info.reach && std::abs(z) <= info.reach;
                        ASSERT_TRUE(in) << "a voxel at " << x << "," << y << "," << z << " of " << info.name;
                    }
        }
    }
    EXPECT_GT(placed, 20u);
}

TEST_P(DrawShape, IsTheSameUnderEveryVectorSet) {
    const Shape shape = Shape(GetParam());
    World w(place_of(shape));
    w.add(shape, 23, 1, .9f);
    const ColumnPos at{-1, 7};
    const Area area(w, at, 1);
    const FeatureTile* ring[49];
    area.ring(0, 0, ring);
    auto first = std::make_unique<BlockTile>(), other = std::make_unique<BlockTile>();
    w.fill(*first);
    terrain_stages(Isa::portable).draw(*w.t, at, ring, *first);
    for (i32 isa = 1; isa <= i32(best_isa()); ++isa) {
        w.fill(*other);
        terrain_stages(Isa(isa)).draw(*w.t, at, ring, *other);
        EXPECT_EQ(first->top, other->top);
        EXPECT_TRUE(std::equal(first->block, first->block + kTerrainHeight * kColumnCells, other->block))
            << "isa " << isa;
    }
}

INSTANTIATE_TEST_SUITE_P(All, DrawShape, ::testing::Range(0u, u32(Shape::count)),
                         [](const auto& of) { return std::string(shape_infos()[of.param].name); });

// True distances, in double precision, by other means than the kernel's: below 0 inside.
double true_side(const Primitive& s, double x, double y, double z) {
    const double a[3] = {s.a.x, s.a.y, s.a.z}, b[3] = {s.b.x, s.b.y, s.b.z}, p[3] = {x, y, z};
    double axis[3], along = 0, length = 0;
    for (int i = 0; i < 3; ++i)
        axis[i] = b[i] - a[i], length += axis[i] * axis[i];
    length = std::sqrt(length);
    for (int i = 0; i < 3; ++i)
        along += (p[i] - a[i]) * axis[i] / length;
    double away = 0;
    for (int i = 0; i < 3; ++i)
        away += std::pow(p[i] - a[i] - axis[i] / length * along, 2);
    away = std::sqrt(away);
    const double share = std::min(std::max(along / length, 0.0), 1.0), radius = s.ra + (s.rb - s.ra) * share;
    switch (s.solid) {
    case Solid::ball:
    case Solid::dome: {
        double k = 0;
        for (int i = 0; i < 3; ++i)
            k += std::pow((p[i] - a[i]) / b[i], 2);
        const double d = (std::sqrt(k) - 1) * std::min({b[0], b[1], b[2]});
        return s.solid == Solid::dome ? std::max(d, a[1] - p[1]) : d;
    }
    case Solid::cone: {
        double square = 0;
        for (int i = 0; i < 3; ++i)
            square += std::pow(p[i] - a[i] - axis[i] * share, 2);
        return std::sqrt(square) - radius;
    }
    case Solid::cylinder:
        return std::max({away - radius, -along, along - length});
    case Solid::prism: {
        // The hexagon whose first side faces the level direction u rotated a quarter about the axis: six half planes.
        const double level = std::hypot(axis[0], axis[2]);
        const double u[3] = {level / length > 1e-3 ? axis[2] / level : 1, 0,
                             level / length > 1e-3 ? -axis[0] / level : 0};
        const double w[3] = {axis[0] / length, axis[1] / length, axis[2] / length};
        const double v[3] = {w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2], w[0] * u[1] - w[1] * u[0]};
        double pu = 0, pv = 0, most = -1e9;
        for (int i = 0; i < 3; ++i)
            pu += (p[i] - a[i]) * u[i], pv += (p[i] - a[i]) * v[i];
        for (int k = 0; k < 6; ++k) {
            const double turn = M_PI / 2 + k * M_PI / 3;
            most = std::max(most, pu * std::cos(turn) + pv * std::sin(turn));
        }
        return std::max({most - radius, -along, along - length});
    }
    case Solid::box: {
        double d = -1e9;
        for (int i = 0; i < 3; ++i)
            d = std::max({d, std::min(a[i], b[i]) - p[i], p[i] - std::max(a[i], b[i])});
        return d;
    }
    }
    return 1;
}

struct RandomSolids {
    shape_voxels::Built built;
    FeatureRow row;
    std::mt19937 random{11};
    RandomSolids() {
        row.reach = 47;
        row.bound_low = -60;
        row.bound_high = 60;
        row.key = {5, 6};
        row.blocks[0] = 9;
    }
    float in(float a, float b) { return std::uniform_real_distribution<float>(a, b)(random); }
    Vec3 point(float r) { return {in(-r, r), in(-r, r), in(-r, r)}; }
    // One solid of a random kind; nothing where it holds no voxel.
    const Primitive* next(float wobble, bool hollow) {
        const auto one = [&](ShapeBuilder<ScalarLanes>& b) {
            Brush p = b.wobbly(b.paint(0), wobble, random() % 2);
            const Solid kind = Solid(hollow ? random() % 2 : random() % 6);
            Vec3 first = point(9),
                 second = random() % 4 ? point(9) : Vec3{first.x, in(-9, 9), first.z}; // upright ones too
            float ra = in(.3f, 6), rb = random() % 3 ? in(.1f, 6) : ra;
            if (kind == Solid::ball || kind == Solid::dome) {
                const float r = in(2, 8);
                second = random() % 2 ? Vec3{r, r, r} : Vec3{in(2, 9), in(2, 9), in(2, 9)};
                ra = in(.8f, 2);
            }
            if (hollow) p.flags = solid_hollow;
            if (wobble > 0 && kind >= Solid::cylinder) rb = ra + in(-1, 1) * .5f < .2f ? ra : ra + in(-1, 1) * .5f;
            b.add(kind, first, second, ra, rb, p);
        };
        built.make(row, u32(random()), one, 1000, 100, -77);
        return built.tile->primitives ? &built.tile->primitive[0] : nullptr;
    }
    bool inside(const Primitive& s, i32 x, i32 y, i32 z) {
        const Placement& p = built.placement;
        const ColumnPos column{(p.x + x) >> 4, (p.z + z) >> 4};
        const Row<ScalarLanes> row_at = thread_row(column, ((p.x + x) & 15) | ((p.z + z) & 15) << 4);
        const i16 low[3] = {-100, -100, -100}, high[3] = {100, 100, 100};
        u32 block = 0;
        return draw_row<ScalarLanes>(*built.tables, s, solid_frame(s), draw_span(p, low, high, column), row.key, row_at,
                                     p.y + y, room_open, block);
    }
};

TEST(Draw, SolidsAreWhatTheySay) {
    RandomSolids r;
    std::map<Solid, i64> seen;
    for (i32 round = 0; round < 600; ++round) {
        const Primitive* s = r.next(0, false);
        if (!s) continue;
        if (std::abs(s->a.x - s->b.x) + std::abs(s->a.y - s->b.y) + std::abs(s->a.z - s->b.z) < .5f) continue;
        for (i32 n = 0; n < 400; ++n) {
            const i32 x = i32(r.in(-18, 18)), y = i32(r.in(-18, 18)), z = i32(r.in(-18, 18));
            const double d = true_side(*s, x + .5, y + .5, z + .5);
            if (std::abs(d) < 1e-3) continue; // rounding may decide
            ASSERT_EQ(r.inside(*s, x, y, z), d < 0)
                << "solid " << i32(s->solid) << " at " << x << "," << y << "," << z << " d " << d;
            seen[s->solid] += d < 0;
        }
    }
    for (i32 kind = 0; kind < 6; ++kind)
        EXPECT_GT(seen[Solid(kind)], 100) << kind;
}

TEST(Draw, ShellsAreAsThickAsTheySay) {
    RandomSolids r;
    i64 shell = 0, hole = 0;
    for (i32 round = 0; round < 300; ++round) {
        const Primitive* s = r.next(0, true);
        if (!s || !(s->b.x == s->b.y && s->b.y == s->b.z)) continue; // a sphere's distances are true
        for (i32 n = 0; n < 300; ++n) {
            const i32 x = i32(r.in(-18, 18)), y = i32(r.in(-18, 18)), z = i32(r.in(-18, 18));
            const double far = std::hypot(x + .5 - s->a.x, y + .5 - s->a.y, z + .5 - s->a.z);
            double d = std::max(far - s->b.x, s->b.x - s->ra - far);
            if (s->solid == Solid::dome) d = std::max(d, s->a.y - (y + .5));
            if (std::abs(d) < 1e-3) continue;
            ASSERT_EQ(r.inside(*s, x, y, z), d < 0);
            shell += d < 0;
            hole += far < s->b.x - s->ra;
        }
    }
    EXPECT_GT(shell, 300);
    EXPECT_GT(hole, 300);
}

TEST(Draw, BoxesHoldAllVoxels) {
    RandomSolids r;
    for (const float wobble : {0.0f, 0.4f, 1.5f}) {
        for (i32 round = 0; round < 120; ++round) {
            const Primitive* s = r.next(wobble, round % 5 == 0);
            if (!s) continue;
            i64 in = 0;
            for (i32 y = s->low[1] - 4; y <= s->high[1] + 4; ++y)
                for (i32 z = s->low[2] - 4; z <= s->high[2] + 4; ++z)
                    for (i32 x = s->low[0] - 4; x <= s->high[0] + 4; ++x) {
                        if (!r.inside(*s, x, y, z)) continue;
                        ++in;
                        const bool held = x >= s->low[0] && x <= s->high[0] && y >= s->low[1] && y <= s->high[1] &&
                                          z >= s->low[2] && z <= s->high[2];
                        ASSERT_TRUE(held) << "solid " << i32(s->solid) << " wobble " << wobble << " at " << x << ","
                                          << y << "," << z << " ra " << s->ra << " rb " << s->rb;
                    }
            if (wobble == 0 && s->solid != Solid::box && s->ra > 1.5f && !(s->flags & solid_hollow)) {
                EXPECT_GT(in, 0);
            }
        }
    }
}

// Hand-placed solids around one column.
struct Hand {
    World w{FeaturePlace::surface};
    std::vector<FeatureTile> tiles{49};
    std::unique_ptr<BlockTile> blocks = std::make_unique<BlockTile>();
    Hand() {
        w.t->feature[0].key = {77, 88};
        w.t->feature[0].reach = 47;
        w.t->feature[0].bound_low = -200;
        w.t->feature[0].bound_high = 200;
        for (u32 i = 0; i < kFeatureBlocks; ++i)
            w.t->feature[0].blocks[i] = Block(100 + i);
        w.t->features = 1;
        w.fill(*blocks);
    }
    template <class Build>
    void place(i32 tile, i32 x, i32 y, i32 z, const Build& build) {
        FeatureTile& out = tiles[size_t(tile)];
        Placement& p = out.placement[out.placements++];
        p = Placement{};
        p.x = x;
        p.y = i16(y);
        p.z = z;
        p.first = u16(out.primitives);
        ShapeBuilder<ScalarLanes> b{*w.t, w.t->feature[0], p, out};
        build(b);
        ASSERT_TRUE(b.fits);
    }
    void draw() {
        const FeatureTile* ring[49];
        for (size_t i = 0; i < 49; ++i)
            ring[i] = &tiles[i];
        terrain_stages(best_isa()).draw(*w.t, {0, 0}, ring, *blocks);
    }
    Block at(i32 x, i32 y, i32 z) const { return blocks->block[x | z << 4 | y << 8]; }
};

TEST(Draw, TheFirstSolidKeepsItsVoxels) {
    Hand h;
    const auto box = [](u32 paint) {
        return [paint](ShapeBuilder<ScalarLanes>& b) { b.box({0, 0, 0}, {4, 4, 4}, b.paint(paint)); };
    };
    h.place(24, 3, 200, 3, box(1));  // the column's own
    h.place(24, 5, 200, 3, box(2));  // later in the same tile
    h.place(25, 1, 202, 3, box(3));  // a later tile
    h.place(23, -1, 202, 3, box(4)); // an earlier one
    h.draw();
    EXPECT_EQ(h.at(3, 200, 4), 101);
    EXPECT_EQ(h.at(6, 200, 4), 101);
    EXPECT_EQ(h.at(7, 200, 4), 102);
    EXPECT_EQ(h.at(2, 202, 4), 104);
    EXPECT_EQ(h.at(3, 202, 4), 101); // the earlier tile's box ends at x = 2
    EXPECT_EQ(h.at(4, 204, 4), 103);
    EXPECT_EQ(h.blocks->top, 206);
}

TEST(Draw, ReplacesOnlyWhatItsFlagsAllow) {
    for (const u8 flags : {u8(0), u8(solid_over_ground), u8(solid_in_water), u8(solid_only_water),
                           u8(solid_over_ground | solid_in_water)}) {
        Hand h;
        for (i32 i = 0; i < kColumnCells; ++i)
            for (i32 y = 0; y < 6; ++y)
                h.blocks->block[i | y << 8] = Block(y == 4   ? 7
                                                    : y == 5 ? kAir
                                                    : y == 0 ? kBedrock
                                                    : y == 1 ? kLava
                                                    : y == 2 ? kWater
                                                             : 30);
        h.place(24, 5, 0, 5, [&](ShapeBuilder<ScalarLanes>& b) {
            Brush p = b.paint(0);
            p.flags = flags;
            b.box({0, 0, 0}, {1, 6, 1}, p);
        });
        h.draw();
        const bool only = flags & solid_only_water;
        EXPECT_EQ(h.at(5, 0, 5), kBedrock);
        EXPECT_EQ(h.at(5, 1, 5), kLava);
        EXPECT_EQ(h.at(5, 2, 5), only || (flags & solid_in_water) ? 100 : kWater);
        EXPECT_EQ(h.at(5, 3, 5), (flags & solid_over_ground) ? 100 : 30);
        EXPECT_EQ(h.at(5, 5, 5), only ? kAir : 100);
    }
}

TEST(Draw, SharesAreSharesOfVoxels) {
    Hand h;
    h.place(24, 0, 150, 0, [](ShapeBuilder<ScalarLanes>& b) {
        Brush p = b.paint(0, 1, 0.2f);
        p.missing_share = 102; // .4
        b.box({0, 0, 0}, {16, 200, 16}, p);
    });
    h.draw();
    double kept = 0, other = 0;
    for (i32 y = 150; y < 350; ++y)
        for (i32 i = 0; i < kColumnCells; ++i) {
            kept += h.blocks->block[i | y << 8] != kAir;
            other += h.blocks->block[i | y << 8] == 101;
        }
    const double n = 200 * 256;
    EXPECT_NEAR(kept / n, 1 - 102 / 256.0, 4.5 * std::sqrt(.24 / n));
    EXPECT_NEAR(other / kept, 51 / 256.0, 4.5 * std::sqrt(.16 / kept));
    EXPECT_EQ(h.blocks->top, 350);
}

TEST(Draw, NothingIsDrawnBeyondTheWorld) {
    Hand h;
    h.place(24, 8, 380, 8, [](ShapeBuilder<ScalarLanes>& b) { b.ball(b.root(), 12, b.paint(0)); });
    h.place(24, 8, 2, 8, [](ShapeBuilder<ScalarLanes>& b) {
        Brush p = b.paint(0);
        p.flags = solid_over_ground;
        b.ball(b.root(), 12, p);
    });
    h.place(0, -48, 200, -48, [](ShapeBuilder<ScalarLanes>& b) { b.ball(b.root(), 40, b.paint(0)); }); // reaches x = -8
    h.draw();
    EXPECT_EQ(h.blocks->top, kTerrainHeight);
    EXPECT_EQ(h.at(8, 383, 8), 100);
    EXPECT_EQ(h.at(8, 0, 8), kBedrock);
    EXPECT_EQ(h.at(0, 200, 0), kAir);
}

} // namespace
} // namespace vitrail
