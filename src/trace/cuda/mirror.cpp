#if VITRAIL_CUDA

#include "trace/cuda/mirror.h"

#include <algorithm>
#include <cstring>

namespace vitrail::trace::cuda {

using Range = DirtyRanges::Range;

Result<> SceneMirror::resize(Array& a, u64 bytes) {
    a.copies.resize(gpus_.size());
    a.at.resize(gpus_.size());
    if (a.copies[0].size() < bytes) {
        VX_TRY(upload_.flush()); // pieces on their way mean the old places
        const u64 room = (std::max(bytes, a.bytes + a.bytes / 2) + 255) / 256 * 256;
        for (std::size_t i = 0; i < gpus_.size(); ++i) {
            DeviceBytes more;
            VX_TRY(more.make(gpus_[i], room));
            if (a.bytes > 0)
                VX_TRY(check(cudaMemcpyAsync(more.as(), a.at[i], a.bytes, cudaMemcpyDeviceToDevice, gpus_[i].stream),
                             "moving the world"));
            VX_TRY(gpus_[i].wait());
            a.copies[i] = std::move(more);
            a.at[i] = a.copies[i].as();
        }
    }
    a.bytes = bytes;
    return {};
}

Result<> SceneMirror::sync(u32 which, const void* from, u64 bytes, std::span<const Range> changed, bool all) {
    Array& a = arrays_[which];
    const u64 known = all ? 0 : std::min(a.bytes, bytes);
    VX_TRY(resize(a, bytes));
    const auto* source = static_cast<const std::byte*>(from);
    for (const Range& r : changed) {
        const u64 end = std::min(r.end, known);
        if (r.begin < end) VX_TRY(upload_.put(a.at, r.begin, source + r.begin, end - r.begin));
    }
    if (known < bytes) VX_TRY(upload_.put(a.at, known, source + known, bytes - known));
    return {};
}

Result<> SceneMirror::sync_grid(Grid& grid) {
    for (u32 i = 0; i < kGridBuffers; ++i) {
        const auto bytes = grid.buffer(GridBuffer(i));
        VX_TRY(sync(i, bytes.data(), bytes.size(), grid.dirty(GridBuffer(i)), false));
    }
    grid.clean();
    return {};
}

Result<> SceneMirror::sync_tables(const MirrorSource& s) {
    const bool all = s.tables != tables_, repaint = all || s.pictures != pictures_;
    tables_ = s.tables, pictures_ = s.pictures;
    VX_TRY(sync(states, s.view.states, u64(s.view.state_count) * sizeof(StateRecord), {}, all));
    VX_TRY(sync(quads, s.view.quads, s.quads * sizeof(TraceQuad), {}, all));
    VX_TRY(sync(media, s.view.media, s.media * sizeof(MediumRecord), {}, all));
    if (s.view.fixed_tints) { // few: compared
        const std::span<const u32> now(s.view.fixed_tints, 256);
        const bool same = std::ranges::equal(now, last_tints_);
        VX_TRY(sync(tints, now.data(), now.size_bytes(), {}, !same));
        last_tints_.assign(now.begin(), now.end());
    }
    const TextureView& t = s.view.textures;
    std::vector<Range> layers;
    for (u32 layer : s.changed_layers)
        layers.push_back({u64(layer) * t.layer_words * 4, u64(layer + 1) * t.layer_words * 4});
    const u64 bytes = u64(t.layers) * t.layer_words * 4;
    VX_TRY(sync(albedo, t.albedo, bytes, layers, repaint));
    return sync(material, t.material, bytes, layers, repaint);
}

Result<> SceneMirror::sync_lights(LightStore& lights, const LightView& view) {
    const LightStore::Changes c = lights.take_changes();
    const auto ranges = [](const std::vector<ArrayRange>& entries, u64 size) {
        std::vector<Range> bytes;
        for (const ArrayRange& r : entries)
            bytes.push_back({r.first * size, (u64(r.first) + r.count) * size});
        return bytes;
    };
    VX_TRY(sync(emitters, view.emitters, c.emitter_size * sizeof(Emitter), ranges(c.emitters, sizeof(Emitter)), false));
    VX_TRY(sync(nodes, view.nodes, c.node_size * sizeof(LightNode), ranges(c.nodes, sizeof(LightNode)), false));
    return sync(table, view.table, c.table_size * sizeof(u32), ranges(c.table, sizeof(u32)), false);
}

// Few, and all others in each frame in which one moves: sent whole.
Result<> SceneMirror::sync_boxes(const MirrorSource& s) {
    const bool all = s.boxes != boxes_;
    boxes_ = s.boxes;
    VX_TRY(sync(boxes, s.view.boxes, u64(s.view.box_count) * sizeof(EntityBox), {}, all));
    return sync(box_nodes, s.view.box_nodes, s.box_nodes * sizeof(BoxNode), {}, all);
}

Result<> SceneMirror::sync_sky(const SkyView& sky) {
    if (sky.dome && !(any_dome_ && std::memcmp(&last_dome_, sky.dome, sizeof last_dome_) == 0)) {
        VX_TRY(sync(dome, sky.dome, sizeof *sky.dome, {}, true));
        last_dome_ = *sky.dome;
        any_dome_ = true;
    }
    if (sky.cloud_noise && sky.cloud_noise != last_noise_) {
        // Two bytes a texel: an even number of texels would make whole words.
        std::vector<u8> whole(sky.cloud_noise, sky.cloud_noise + 2 * scene::CloudNoise::kTexels);
        whole.resize((whole.size() + 3) / 4 * 4);
        VX_TRY(sync(noise, whole.data(), whole.size(), {}, true));
        last_noise_ = sky.cloud_noise;
    }
    return {};
}

Result<> SceneMirror::update(const MirrorSource& source, const SkyView* sky) {
    VX_TRY(sync_grid(*source.grid));
    VX_TRY(sync_tables(source));
    VX_TRY(sync_boxes(source));
    if (source.lights) VX_TRY(sync_lights(*source.lights, source.view.lights));
    if (sky) VX_TRY(sync_sky(*sky));
    VX_TRY(upload_.flush());
    point(source, sky);
    return {};
}

void SceneMirror::point(const MirrorSource& source, const SkyView* sky) {
    views_.resize(gpus_.size());
    for (std::size_t i = 0; i < gpus_.size(); ++i) {
        const auto set = [&](auto& pointer, u32 which) {
            const Array& a = arrays_[which];
            pointer = static_cast<std::remove_reference_t<decltype(pointer)>>(a.bytes ? a.at[i] : nullptr);
        };
        const auto grid = [&](auto& pointer, GridBuffer which) { set(pointer, u32(which)); };
        SceneView& v = views_[i].scene;
        v = source.view;
        grid(v.grid.areas, GridBuffer::areas);
        grid(v.grid.chunks, GridBuffer::chunks);
        grid(v.grid.masks, GridBuffer::masks);
        grid(v.grid.palettes, GridBuffer::palettes);
        grid(v.grid.indices, GridBuffer::indices);
        grid(v.grid.tints, GridBuffer::tints);
        if (source.view.grid.skips) grid(v.grid.skips, GridBuffer::skips);
        set(v.states, states);
        set(v.quads, quads);
        set(v.media, media);
        set(v.fixed_tints, tints);
        set(v.textures.albedo, albedo);
        set(v.textures.material, material);
        set(v.lights.emitters, emitters);
        set(v.lights.nodes, nodes);
        set(v.lights.table, table);
        set(v.boxes, boxes);
        set(v.box_nodes, box_nodes);
        if (!source.lights) v.lights = LightView{};
        if (!sky) continue;
        SkyView& s = views_[i].sky;
        s = *sky;
        set(s.dome, dome);
        set(s.cloud_noise, noise);
        if (!sky->dome) s.dome = nullptr;
        if (!sky->cloud_noise) s.cloud_noise = nullptr;
    }
}

u64 SceneMirror::device_bytes() const {
    u64 sum = 0;
    for (const Array& a : arrays_)
        if (!a.copies.empty()) sum += a.copies[0].size();
    return sum;
}

} // namespace vitrail::trace::cuda

#endif
