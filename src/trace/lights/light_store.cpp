#include "trace/lights/light_store.h"

#include "trace/lights/light_tree_build.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

namespace vitrail::trace {

static constexpr i32 kFarFromOrigin = 1 << 15; // blocks: boxes keep an exact 1/256

static ChunkPos beside(ChunkPos c, int face) {
    const IVec3 n = kFaceNormal[face];
    return {c.x + n.x, c.y + n.y, c.z + n.z};
}
// An order that does not depend on how the world came to be: trees of the same lamps are the same.
static bool earlier(ChunkPos a, ChunkPos b) {
    return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x);
}
static IVec3 first_cell(ChunkPos c) {
    return {c.x * kChunkSize, c.y * kChunkSize, c.z * kChunkSize};
}

void LightStore::set_states(const SceneView& scene, u32 quad_count) {
    clear();
    states_ = make_state_lights(scene, quad_count);
}

void LightStore::clear() {
    chunks_.clear();
    for (u32 level = 0; level < kLevels; ++level)
        regions_[level].clear(), dirty_[level].clear();
    marked_.clear();
    emitters_.resize(0);
    nodes_.resize(0);
    table_.resize(0);
    emitter_places_.clear();
    node_places_.clear();
    top_ = {};
    count_ = table_bits_ = 0;
    has_origin_ = false;
}

bool LightStore::may_emit(const Chunk& chunk) const {
    for (StateId id : chunk.blocks.palette())
        if (u32(id) < states_.size() && states_[u32(id)].emits) return true;
    return false;
}

void LightStore::mark(ChunkPos at, ChunkPtr chunk) {
    marked_.insert(at);
    if (chunk && may_emit(*chunk))
        chunks_[at].chunk = std::move(chunk);
    else if (auto it = chunks_.find(at); it != chunks_.end())
        it->second.chunk = nullptr; // dropped by update
    for (int f = 0; f < 6; ++f)     // what this chunk covers of its neighbors' lamps
        if (chunks_.count(beside(at, f))) marked_.insert(beside(at, f));
}

// around: states by Face.
u32 LightStore::open_faces(const StateLight& light, u32 state, const u32 (&around)[6]) const {
    u32 open = 0, sealed = 0;
    for (u32 f = 0; f < 6; ++f) {
        const StateLight* next = around[f] < states_.size() ? &states_[around[f]] : nullptr;
        const bool hides = next && next->hides, same = next && light.liquid && next->fluid == light.fluid;
        if (hides || same) ++sealed;
        // A liquid's surface lies below the top of its cell: what stands on it leaves a gap.
        const bool covered =
            same || (hides && !(light.liquid && f == 3 && light.top < 1)) || (light.joins && around[f] == state);
        if (!covered && light.face_power[f] > 0) open |= 1u << f;
    }
    if (sealed == 6) return 0;
    return open | (light.quad_power > 0 ? Emitter::kQuads : 0);
}

void LightStore::list(ChunkPos at, const Chunk& chunk, const GridView& grid, std::vector<Emitter>& out) const {
    std::array<u16, kChunkVolume> cells;
    chunk.blocks.unpack_indices(cells);
    const auto palette = chunk.blocks.palette();
    std::vector<u8> emits(palette.size());
    for (std::size_t i = 0; i < palette.size(); ++i)
        emits[i] = u32(palette[i]) < states_.size() && states_[u32(palette[i])].emits;
    const IVec3 first = first_cell(at);
    const int step[6] = {-1, 1, -256, 256, -16, 16};
    for (u32 i = 0; i < u32(kChunkVolume); ++i) {
        if (!emits[cells[i]]) continue;
        const LocalPos p(i);
        const bool inside[6] = {p.x() > 0, p.x() < 15, p.y() > 0, p.y() < 15, p.z() > 0, p.z() < 15};
        Emitter e;
        e.cell = {first.x + p.x(), first.y + p.y(), first.z + p.z()};
        e.state = u32(palette[cells[i]]);
        u32 around[6];
        for (int f = 0; f < 6; ++f) {
            const IVec3 n = kFaceNormal[f];
            around[f] = inside[f] ? u32(palette[cells[u32(int(i) + step[f])]])
                                  : state_at(grid, {e.cell.x + n.x, e.cell.y + n.y, e.cell.z + n.z});
        }
        const StateLight& light = states_[e.state];
        e.faces = open_faces(light, e.state, around);
        for (u32 f = 0; f < 6; ++f)
            if (e.faces >> f & 1) e.power += light.face_power[f];
        if (e.faces & Emitter::kQuads) e.power += light.quad_power;
        if (e.power > 0) out.push_back(e);
    }
}

LightNode LightStore::leaf_of(const Emitter& e) const {
    const StateLight& light = states_[e.state];
    float toward[6] = {};
    Vec3 low{1, 1, 1}, high{0, 0, 0};
    for (u32 f = 0; f < 6; ++f) {
        if (!(e.faces >> f & 1)) continue;
        toward[f] += light.face_power[f];
        const float top = light.liquid ? light.top : 1;
        const Vec3 a{f == 1 ? 1.0f : 0, f == 3 ? top : 0, f == 5 ? 1.0f : 0},
            b{f == 0 ? 0 : 1.0f, f == 2 ? 0 : top, f == 4 ? 0 : 1.0f};
        low = {std::fmin(low.x, a.x), std::fmin(low.y, a.y), std::fmin(low.z, a.z)};
        high = {std::fmax(high.x, b.x), std::fmax(high.y, b.y), std::fmax(high.z, b.z)};
    }
    if (e.faces & Emitter::kQuads) {
        for (u32 f = 0; f < 6; ++f)
            toward[f] += light.quad_power * light.quad_shares[f];
        const Vec3 a = light.quad_least, b = light.quad_most;
        low = {std::fmin(low.x, a.x), std::fmin(low.y, a.y), std::fmin(low.z, a.z)};
        high = {std::fmax(high.x, b.x), std::fmax(high.y, b.y), std::fmax(high.z, b.z)};
    }
    LightNode n;
    const Vec3 at{float(e.cell.x - from_.x), float(e.cell.y - from_.y), float(e.cell.z - from_.z)};
    n.least = at + low;
    n.most = at + high;
    n.power = e.power;
    n.leaf = 1;
    for (u32 f = 0; f < 6; ++f) {
        const float share = std::ceil(toward[f] / e.power * 255);
        n.shares[f] = u8(share < 255 ? share : 255);
    }
    return n;
}

void LightStore::release(Tree& tree) {
    if (tree.first != kNone) node_places_.give(tree.first, std::bit_ceil(tree.count));
    tree = {};
}

// Tells what hangs from this node where it hangs.
void LightStore::attach(u32 slot) {
    const LightNode& n = nodes_[slot];
    if (n.leaf) {
        emitters_.edit(n.first).node = slot;
        return;
    }
    const u32 pair = n.first;
    nodes_.edit(pair).parent = slot;
    nodes_.edit(pair + 1).parent = slot;
}

LightNode LightStore::plant(Tree& tree, const std::vector<LightNode>& items) {
    release(tree);
    const BuiltTree built = build_light_tree(items);
    tree.root = built.root;
    if (built.nodes.empty()) return tree.root;
    tree.count = u32(built.nodes.size());
    tree.first = node_places_.take(std::bit_ceil(tree.count));
    if (nodes_.size() < node_places_.end()) nodes_.resize(node_places_.end());
    tree.root.first += tree.first;
    for (u32 i = 0; i < tree.count; ++i) {
        LightNode n = built.nodes[i];
        if (!built.own[i]) n.first += tree.first;
        n.parent = n.parent == BuiltTree::kRootParent ? 0 : n.parent + tree.first;
        nodes_.edit(tree.first + i) = n;
    }
    for (u32 slot : built.placed)
        attach(slot + tree.first);
    return tree.root;
}

void LightStore::drop_chunk(ChunkPos at) {
    const auto it = chunks_.find(at);
    if (it == chunks_.end()) return;
    ChunkLights& c = it->second;
    for (u32 i = 0; i < c.count; ++i) {
        table_erase(c.first + i);
        emitters_.edit(c.first + i) = {};
    }
    if (c.first != kNone) emitter_places_.give(c.first, std::bit_ceil(c.count));
    count_ -= c.count;
    c.first = kNone;
    c.count = 0;
    if (c.tree.root.power > 0) remove_member(0, at);
    release(c.tree);
}

// member, of that level's regions (0: a chunk), has lamps now, or other ones.
void LightStore::add_member(u32 level, ChunkPos member) {
    const ChunkPos at = parent_of(member);
    std::vector<ChunkPos>& members = regions_[level][at].members;
    const auto place = std::lower_bound(members.begin(), members.end(), member, earlier);
    if (place == members.end() || !(*place == member)) members.insert(place, member);
    dirty_[level].insert(at);
}
void LightStore::remove_member(u32 level, ChunkPos member) {
    const ChunkPos at = parent_of(member);
    std::erase(regions_[level][at].members, member);
    dirty_[level].insert(at);
}

// The trees of a level's regions that changed; the next level is told.
void LightStore::replant(u32 level) {
    std::vector<LightNode> items;
    for (ChunkPos at : dirty_[level]) {
        Region& region = regions_[level].at(at);
        if (region.members.empty()) {
            release(region.tree);
            regions_[level].erase(at);
            if (level + 1 < kLevels) remove_member(level + 1, at);
            continue;
        }
        items.clear();
        for (ChunkPos member : region.members)
            items.push_back(level == 0 ? chunks_.at(member).tree.root : regions_[level - 1].at(member).tree.root);
        plant(region.tree, items);
        if (level + 1 < kLevels) add_member(level + 1, at);
    }
    dirty_[level].clear();
}

void LightStore::replant_top() {
    if (nodes_.size() == 0) nodes_.resize(1);
    const auto& regions = regions_[kLevels - 1];
    if (regions.empty()) {
        release(top_);
        return;
    }
    std::vector<ChunkPos> order;
    for (const auto& [at, region] : regions)
        order.push_back(at);
    std::sort(order.begin(), order.end(), earlier);
    std::vector<LightNode> items;
    for (ChunkPos at : order)
        items.push_back(regions.at(at).tree.root);
    LightNode root = plant(top_, items);
    root.parent = 0;
    nodes_.edit(0) = root;
    attach(0);
}

bool LightStore::same_lamps(const ChunkLights& c, const std::vector<Emitter>& found) const {
    if (c.count != found.size()) return false;
    for (u32 i = 0; i < c.count; ++i) {
        const Emitter& held = emitters_[c.first + i];
        if (!(held.cell == found[i].cell) || held.state != found[i].state || held.faces != found[i].faces) return false;
    }
    return true;
}

void LightStore::relist(ChunkPos at, const GridView& grid) {
    const auto it = chunks_.find(at);
    if (it == chunks_.end()) return;
    if (!it->second.chunk || !in_window(grid, {at.x, at.y, at.z})) {
        drop_chunk(at);
        chunks_.erase(it);
        return;
    }
    ChunkLights& c = it->second;
    std::vector<Emitter> found;
    list(at, *c.chunk, grid, found);
    if (c.from == from_ && same_lamps(c, found)) return;
    drop_chunk(at);
    if (found.empty()) return;
    c.from = from_;
    c.count = u32(found.size());
    c.first = emitter_places_.take(std::bit_ceil(c.count));
    if (emitters_.size() < emitter_places_.end()) emitters_.resize(emitter_places_.end());
    count_ += c.count;
    table_reserve(count_);
    std::vector<LightNode> leaves(c.count);
    for (u32 i = 0; i < c.count; ++i) {
        emitters_.edit(c.first + i) = found[i];
        leaves[i] = leaf_of(found[i]);
        leaves[i].first = c.first + i;
        table_insert(c.first + i);
    }
    plant(c.tree, leaves);
    add_member(0, at);
}

// Boxes stay relative to one block until the window is far from it.
void LightStore::move_origin(const GridView& grid) {
    const IVec3 middle{(grid.first.x + (1 << grid.bits_x) / 2) * kChunkSize,
                       (grid.first.y + (1 << grid.bits_y) / 2) * kChunkSize,
                       (grid.first.z + (1 << grid.bits_z) / 2) * kChunkSize};
    const auto far = [](i32 a, i32 b) { return std::abs(i64(a) - i64(b)) > kFarFromOrigin; };
    if (has_origin_ && !far(middle.x, from_.x) && !far(middle.y, from_.y) && !far(middle.z, from_.z)) return;
    from_ = middle;
    has_origin_ = true;
    for (const auto& [at, c] : chunks_)
        marked_.insert(at);
}

void LightStore::update(const GridView& grid) {
    move_origin(grid);
    if (!(grid.first == window_first_)) {
        window_first_ = grid.first;
        for (const auto& [at, c] : chunks_)
            if (!in_window(grid, {at.x, at.y, at.z})) marked_.insert(at);
    }
    if (marked_.empty()) return;
    for (ChunkPos at : marked_)
        relist(at, grid);
    marked_.clear();
    bool changed = false;
    for (u32 level = 0; level < kLevels; ++level) {
        changed |= !dirty_[level].empty();
        replant(level);
    }
    if (changed || nodes_.size() == 0) replant_top();
}

LightView LightStore::view() const {
    LightView v;
    v.emitters = emitters_.data();
    v.nodes = nodes_.data();
    v.table = table_.data();
    v.table_bits = table_bits_;
    v.count = count_;
    v.from = from_;
    return v;
}

std::size_t LightStore::memory_bytes() const {
    return emitters_.size() * sizeof(Emitter) + nodes_.size() * sizeof(LightNode) + table_.size() * sizeof(u32) +
           states_.size() * sizeof(StateLight);
}

LightStore::Changes LightStore::take_changes() {
    Changes c;
    c.emitters = emitters_.take_changes();
    c.nodes = nodes_.take_changes();
    c.table = table_.take_changes();
    c.emitter_size = emitters_.size();
    c.node_size = nodes_.size();
    c.table_size = table_.size();
    return c;
}

void LightStore::table_reserve(u32 count) {
    if (table_bits_ && count * 2 <= table_.size()) return;
    u32 bits = table_bits_ ? table_bits_ : 6;
    while ((1u << bits) < count * 2)
        ++bits;
    std::vector<u32> held;
    for (u32 i = 0; i < table_.size(); ++i)
        if (table_[i]) held.push_back(table_[i] - 1);
    table_bits_ = bits;
    table_.assign(1u << bits, 0);
    for (u32 e : held)
        table_insert(e);
}

void LightStore::table_insert(u32 emitter) {
    const u32 mask = table_.size() - 1;
    u32 i = light_cell_hash(emitters_[emitter].cell, table_bits_);
    while (table_[i])
        i = (i + 1) & mask;
    table_.edit(i) = emitter + 1;
}

// Entries behind the gap that would not be found any more move into it (Knuth, The Art of Computer Programming 3, 6.4,
// algorithm R).
void LightStore::table_erase(u32 emitter) {
    const u32 mask = table_.size() - 1;
    u32 i = light_cell_hash(emitters_[emitter].cell, table_bits_);
    while (table_[i] != emitter + 1)
        i = (i + 1) & mask;
    for (u32 next = (i + 1) & mask; table_[next]; next = (next + 1) & mask) {
        const u32 home = light_cell_hash(emitters_[table_[next] - 1].cell, table_bits_);
        if (((next - home) & mask) < ((next - i) & mask)) continue;
        table_.edit(i) = table_[next];
        i = next;
    }
    table_.edit(i) = 0;
}

} // namespace vitrail::trace
