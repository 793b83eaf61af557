#include "terrain/compile/shape_info.h"

#include "terrain/kernel/shapes/parts.h"

#include <array>
#include <initializer_list>

namespace vitrail {
namespace {

struct At {
    int place;
    ShapeNumber number;
};
struct Named {
    int place;
    const char* name;
};

constexpr ShapeInfo shape(const char* name, i16 low, i16 high, i16 reach, std::initializer_list<At> numbers,
                          std::initializer_list<Named> blocks) {
    ShapeInfo s;
    s.name = name;
    for (const At& a : numbers)
        s.numbers[a.place] = a.number;
    for (const Named& b : blocks)
        s.blocks[b.place] = b.name;
    s.bound_low = low;
    s.bound_high = high;
    s.reach = reach;
    return s;
}

// A log's three axes and a fourth part.
#define VITRAIL_WOOD(SHAPE)                                                                                            \
    {parts::SHAPE::trunk, "trunk"}, {parts::SHAPE::trunk_x, "trunk_x"}, {parts::SHAPE::trunk_z, "trunk_z"}, {          \
        parts::SHAPE::leaves, "leaves"                                                                                 \
    }

constexpr std::array<ShapeInfo, u32(Shape::count)> make_infos() {
    namespace p = parts;
    std::array<ShapeInfo, u32(Shape::count)> all{};
    const auto add = [&](Shape which, const ShapeInfo& info) { all[u32(which)] = info; };
    add(Shape::coral,
        shape("coral", -3, 12, 9,
              {{p::coral::size_least, {"size_least", 3, 1, 6}}, {p::coral::size_most, {"size_most", 6, 1, 6}}},
              {{p::coral::tube, "tube"},
               {p::coral::brain, "brain"},
               {p::coral::bubble, "bubble"},
               {p::coral::fire, "fire"},
               {p::coral::horn, "horn"}}));
    add(Shape::kelp,
        shape("kelp", 0, 20, 1,
              {{p::kelp::height_least, {"height_least", 4, 1, 20}}, {p::kelp::height_most, {"height_most", 20, 1, 20}}},
              {{p::kelp::stalk, "stalk"}, {p::kelp::tip, "tip"}}));
    add(Shape::iceberg, shape("iceberg", -64, 140, 47,
                              {{p::iceberg::radius_least, {"radius_least", 20, 6, 32}},
                               {p::iceberg::radius_most, {"radius_most", 32, 6, 32}}},
                              {{p::iceberg::ice, "ice"}, {p::iceberg::core, "core"}, {p::iceberg::snow, "snow"}}));
    add(Shape::acacia, shape("acacia", -1, 15, 14,
                             {{p::acacia::height_least, {"height_least", 8, 6, 12}},
                              {p::acacia::height_most, {"height_most", 12, 6, 12}}},
                             {VITRAIL_WOOD(acacia)}));
    add(Shape::redwood, shape("redwood", -5, 75, 14,
                              {{p::redwood::height_least, {"height_least", 27, 15, 40}},
                               {p::redwood::height_most, {"height_most", 40, 15, 40}},
                               {p::redwood::giant_share, {"giant_share", 0.12f, 0, 1}}},
                              {VITRAIL_WOOD(redwood)}));
    add(Shape::cypress, shape("cypress", -3, 50, 22,
                              {{p::cypress::height_least, {"height_least", 26, 14, 42}},
                               {p::cypress::height_most, {"height_most", 40, 14, 42}},
                               {p::cypress::branches_least, {"branches_least", 6, 3, 10}},
                               {p::cypress::branches_most, {"branches_most", 10, 3, 10}}},
                              {VITRAIL_WOOD(cypress)}));
    add(Shape::birch, shape("birch", -1, 30, 6,
                            {{p::birch::height_least, {"height_least", 10, 6, 17}},
                             {p::birch::height_most, {"height_most", 16, 6, 17}},
                             {p::birch::tall_share, {"tall_share", 0.08f, 0, 1}},
                             {p::birch::yellow_share, {"yellow_share", 0.1f, 0, 1}},
                             {p::birch::orange_share, {"orange_share", 0.1f, 0, 1}}},
                            {{p::birch::trunk, "trunk"},
                             {p::birch::leaves, "leaves"},
                             {p::birch::leaves_yellow, "leaves_yellow"},
                             {p::birch::leaves_orange, "leaves_orange"}}));
    add(Shape::pine, shape("pine", -3, 20, 14,
                           {{p::pine::height_least, {"height_least", 7, 4, 16}},
                            {p::pine::height_most, {"height_most", 13, 4, 16}},
                            {p::pine::lean, {"lean", 0.35f, 0, 0.6f}}},
                           {VITRAIL_WOOD(pine)}));
    add(Shape::shrub, shape("shrub", -1, 6, 6,
                            {{p::shrub::radius_least, {"radius_least", 1.5f, 1.2f, 3}},
                             {p::shrub::radius_most, {"radius_most", 2.6f, 1.2f, 3}}},
                            {{p::shrub::trunk, "trunk"}, {p::shrub::leaves, "leaves"}}));
    add(Shape::rafflesia, shape("rafflesia", -3, 26, 20,
                                {{p::rafflesia::stem_least, {"stem_least", 3, 1, 12}},
                                 {p::rafflesia::stem_most, {"stem_most", 8, 1, 12}},
                                 {p::rafflesia::petal_least, {"petal_least", 6, 4, 11}},
                                 {p::rafflesia::petal_most, {"petal_most", 10, 4, 11}}},
                                {{p::rafflesia::stem, "stem"},
                                 {p::rafflesia::petal, "petal"},
                                 {p::rafflesia::core, "core"},
                                 {p::rafflesia::leaves, "leaves"}}));
    add(Shape::jungle_tree, shape("jungle_tree", -4, 50, 24,
                                  {{p::jungle_tree::height_least, {"height_least", 24, 16, 40}},
                                   {p::jungle_tree::height_most, {"height_most", 36, 16, 40}}},
                                  {VITRAIL_WOOD(jungle_tree)}));
    add(Shape::small_jungle_tree, shape("small_jungle_tree", -1, 26, 12,
                                        {{p::small_jungle_tree::height_least, {"height_least", 8, 2, 18}},
                                         {p::small_jungle_tree::height_most, {"height_most", 14, 2, 18}},
                                         {p::small_jungle_tree::crown_least, {"crown_least", 2.8f, 1.5f, 5}},
                                         {p::small_jungle_tree::crown_most, {"crown_most", 4.2f, 1.5f, 5}}},
                                        {VITRAIL_WOOD(small_jungle_tree)}));
    const std::initializer_list<Named> mushroom = {{p::mushroom::stem, "stem"},
                                                   {p::mushroom::stem_x, "stem_x"},
                                                   {p::mushroom::stem_z, "stem_z"},
                                                   {p::mushroom::cap, "cap"},
                                                   {p::mushroom::gills, "gills"}};
    add(Shape::mushroom, shape("mushroom", -4, 120, 28,
                               {{p::mushroom::height_least, {"height_least", 35, 20, 98}},
                                {p::mushroom::height_most, {"height_most", 95, 20, 98}},
                                {p::mushroom::cap_radius_least, {"cap_radius_least", 12, 8, 19}},
                                {p::mushroom::cap_radius_most, {"cap_radius_most", 19, 8, 19}}},
                               mushroom));
    add(Shape::medium_mushroom, shape("medium_mushroom", -2, 30, 16,
                                      {{p::mushroom::height_least, {"height_least", 7, 4, 20}},
                                       {p::mushroom::height_most, {"height_most", 17, 4, 20}},
                                       {p::mushroom::cap_radius_least, {"cap_radius_least", 3.5f, 2.5f, 8}},
                                       {p::mushroom::cap_radius_most, {"cap_radius_most", 6.5f, 2.5f, 8}}},
                                      mushroom));
    add(Shape::crystal,
        shape("crystal", -8, 64, 26,
              {{p::crystal::height_least, {"height_least", 26, 5, 55}},
               {p::crystal::height_most, {"height_most", 50, 5, 55}},
               {p::crystal::radius_least, {"radius_least", 3.5f, 1, 7}},
               {p::crystal::radius_most, {"radius_most", 6, 1, 7}},
               {p::crystal::shards_least, {"shards_least", 4, 0, 12}},
               {p::crystal::shards_most, {"shards_most", 9, 0, 12}}},
              {{p::crystal::first, "first"}, {p::crystal::second, "second"}, {p::crystal::third, "third"}}));
    add(Shape::palm,
        shape("palm", -2, 28, 16,
              {{p::palm::height_least, {"height_least", 9, 5, 18}}, {p::palm::height_most, {"height_most", 16, 5, 18}}},
              {VITRAIL_WOOD(palm)}));
    add(Shape::cactus, shape("cactus", -3, 16, 6,
                             {{p::cactus::height_least, {"height_least", 7, 2, 15}},
                              {p::cactus::height_most, {"height_most", 13, 2, 15}},
                              {p::cactus::arms_least, {"arms_least", 0, 0, 4}},
                              {p::cactus::arms_most, {"arms_most", 3, 0, 4}}},
                             {{p::cactus::body, "body"}}));
    add(Shape::stormlight,
        shape("stormlight", -26, 24, 14,
              {{p::stormlight::radius_least, {"radius_least", 2.5f, 1.5f, 8}},
               {p::stormlight::radius_most, {"radius_most", 5.5f, 1.5f, 8}},
               {p::stormlight::hanging, {"hanging", 0, 0, 1}}},
              {{p::stormlight::core, "core"}, {p::stormlight::shell, "shell"}, {p::stormlight::cord, "cord"}}));
    add(Shape::crystal_pillar, shape("crystal_pillar", -6, 90, 20,
                                     {{p::crystal_pillar::radius_least, {"radius_least", 1.8f, 1, 5}},
                                      {p::crystal_pillar::radius_most, {"radius_most", 4.2f, 1, 5}}},
                                     {{p::crystal_pillar::first, "first"},
                                      {p::crystal_pillar::second, "second"},
                                      {p::crystal_pillar::third, "third"}}));
    add(Shape::glowstone_cluster, shape("glowstone_cluster", -16, 4, 12,
                                        {{p::glowstone_cluster::size_least, {"size_least", 3, 1, 8}},
                                         {p::glowstone_cluster::size_most, {"size_most", 6, 1, 8}}},
                                        {{p::glowstone_cluster::glow, "glow"}}));
    add(Shape::cave_vine,
        shape("cave_vine", -15, 0, 1,
              {{p::cave_vine::length_least, {"length_least", 3, 1, 16}},
               {p::cave_vine::length_most, {"length_most", 15, 1, 16}},
               {p::cave_vine::glowing_share, {"glowing_share", 0.2f, 0, 1}}},
              {{p::cave_vine::vine, "vine"}, {p::cave_vine::glowing, "glowing"}, {p::cave_vine::tip, "tip"}}));
    add(Shape::fungus, shape("fungus", -4, 24, 12,
                             {{p::fungus::height_least, {"height_least", 5, 2, 16}},
                              {p::fungus::height_most, {"height_most", 13, 2, 16}},
                              {p::fungus::cap_radius_least, {"cap_radius_least", 2.4f, 1, 6}},
                              {p::fungus::cap_radius_most, {"cap_radius_most", 4.8f, 1, 6}}},
                             {{p::fungus::stem, "stem"}, {p::fungus::cap, "cap"}, {p::fungus::light, "light"}}));
    return all;
}
#undef VITRAIL_WOOD

constexpr auto kInfos = make_infos();

constexpr bool complete() {
    for (const ShapeInfo& s : kInfos)
        if (!s.name || s.reach < 0 || s.reach > 47 || s.bound_low > s.bound_high) return false;
    return true;
}
static_assert(complete(), "a shape without a row, or one that reaches beyond the ring of feature tiles");

} // namespace

std::span<const ShapeInfo> shape_infos() {
    return kInfos;
}

} // namespace vitrail
