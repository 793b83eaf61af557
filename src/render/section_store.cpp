#include "render/section_store.h"

#include "base/assert.h"
#include "render/translucent_order.h"

#include <algorithm>
#include <cstdlib>
#include <epoxy/gl.h>

namespace vitrail::render {

SectionStore::SectionStore(u64 quad_bytes_start, bool software)
    : light_(software) {
    const u32 quads = u32(std::clamp<u64>(quad_bytes_start / sizeof(Quad), 1024, 1u << 28));
    quads_ = gfx::make_buffer(u64(quads) * sizeof(Quad), GL_DYNAMIC_STORAGE_BIT);
    ranges_.grow(quads);
}

Section* SectionStore::find(SectionKey key) {
    const auto at = sections_.find(key);
    return at == sections_.end() ? nullptr : at->second.get();
}

Section& SectionStore::obtain(SectionKey key) {
    std::unique_ptr<Section>& at = sections_[key];
    if (!at) {
        at = std::make_unique<Section>();
        at->at = key.at;
        at->dimension = key.dimension;
        at->index = u32(all_.size());
        if (free_slots_.empty()) {
            at->slot = slot_count_++;
        } else {
            at->slot = free_slots_.back();
            free_slots_.pop_back();
        }
        all_.push_back(at.get());
        places_.push_back({key.at, key.dimension, 0});
        ++revision_;
    }
    return *at;
}

void SectionStore::release_quads(Section& section) {
    if (section.quad_count) ranges_.free(section.first_quad, section.quad_count);
    section.first_quad = section.quad_count = 0;
    places_[section.index].quad_count = 0;
}

void SectionStore::set(SectionKey key, const SectionMesh& mesh) {
    VX_ASSERT(mesh.first.back() == mesh.quads.size());
    Section& section = obtain(key);
    if (section.quad_count > 0 || !mesh.quads.empty()) changes_.push_back(key);
    release_quads(section);
    const SectionSight sight{mesh.connections, mesh.openings};
    if (!(section.sight == sight)) ++revision_;
    section.sight = sight;
    section.first = mesh.first;
    const u32 translucent_first = mesh.first[SectionMesh::group(QuadPass::translucent, 0)];
    section.translucent.assign(mesh.quads.begin() + translucent_first, mesh.quads.end());
    cut_where_planes_cross(section.translucent);
    section.translucent.shrink_to_fit();
    for (u32 direction = 1; direction <= SectionMesh::kDirections; ++direction) // sorting mixes them: the first has all
        section.first[SectionMesh::group(QuadPass::translucent, direction)] =
            translucent_first + u32(section.translucent.size());
    section.sorted_from = {-128, 0, 0};
    if (mesh.quads.empty()) return;
    const u32 count = section.first.back();
    std::optional<u32> offset = ranges_.allocate(count);
    if (!offset) {
        const u32 old = ranges_.capacity();
        ranges_.grow(std::max(old * 2, old + count));
        gfx::grow_buffer(quads_, u64(ranges_.capacity()) * sizeof(Quad), u64(old) * sizeof(Quad));
        offset = ranges_.allocate(count);
        VX_ASSERT(offset.has_value());
    }
    section.first_quad = *offset, section.quad_count = count;
    places_[section.index].quad_count = count;
    const auto write = [&](u32 first, u32 quads, const Quad* data) {
        if (quads > 0)
            glNamedBufferSubData(quads_.name(), GLintptr((u64(*offset) + first) * sizeof(Quad)),
                                 GLsizeiptr(u64(quads) * sizeof(Quad)), data);
    };
    write(0, translucent_first, mesh.quads.data());
    write(translucent_first, count - translucent_first, section.translucent.data());
}

void SectionStore::set_light(SectionKey key, const LightBrick& brick) {
    Section& section = obtain(key);
    section.light_slot = light_.set(section.light_slot, brick);
    u32 any = brick.uniform ? brick.value.bits : 0;
    if (!brick.uniform)
        for (u16 cell : brick.cells)
            any |= cell;
    const bool sky_lit = Light(u16(any)).sky() > 0;
    if (sky_lit != section.sky_lit && section.quad_count > 0) changes_.push_back(key);
    section.sky_lit = sky_lit;
}

void SectionStore::set_tints(SectionKey key, const TintGrid& tints) {
    Section& section = obtain(key);
    const u32 slot = tints_.add(tints);
    tints_.free(section.tint_slot);
    section.tint_slot = slot;
}

void SectionStore::remove(SectionKey key) {
    const auto at = sections_.find(key);
    if (at == sections_.end()) return;
    Section& section = *at->second;
    if (section.quad_count > 0) changes_.push_back(key);
    release_quads(section);
    light_.free(section.light_slot);
    tints_.free(section.tint_slot);
    free_slots_.push_back(section.slot);
    all_[section.index] = all_.back(), places_[section.index] = places_.back();
    all_[section.index]->index = section.index;
    all_.pop_back(), places_.pop_back();
    sections_.erase(at);
    ++revision_;
}

void SectionStore::clear() {
    while (!all_.empty())
        remove({all_.back()->at, all_.back()->dimension});
}

u32 SectionStore::sort_translucent(Section& section, std::array<i8, 3> from) {
    if (section.sorted_from == from) return 0;
    section.sorted_from = from;
    const u32 count = u32(section.translucent.size());
    if (count < 2) return 0;
    sort_back_to_front(section.translucent, from);
    const u32 at = section.first_quad + section.first[SectionMesh::group(QuadPass::translucent, 0)];
    glNamedBufferSubData(quads_.name(), GLintptr(u64(at) * sizeof(Quad)), GLsizeiptr(u64(count) * sizeof(Quad)),
                         section.translucent.data());
    return count;
}

u64 SectionStore::gpu_bytes() const {
    return quads_.bytes + light_.texture().bytes() + tints_.gpu_bytes();
}

u64 SectionStore::cpu_bytes() const {
    u64 sum = all_.size() * (sizeof(Section) + 64) + all_.capacity() * sizeof(Section*) +
              places_.capacity() * sizeof(SectionPlace);
    for (const Section* s : all_)
        sum += s->translucent.capacity() * sizeof(Quad);
    return sum;
}

} // namespace vitrail::render
