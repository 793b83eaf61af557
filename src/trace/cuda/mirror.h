// The scene in the memory of devices: copies of the host's arrays, kept equal by sending what changed.
//
//     SceneMirror mirror(gpus);
//     VX_TRY(mirror.open());
//     each frame: VX_TRY(mirror.update(source, sky)); launch with mirror.scene(0), mirror.sky(0)
#pragma once

#include "trace/cuda/mirror_source.h"
#include "trace/cuda/upload.h"
#include "trace/kernel/sky_view.h"

#include <array>

namespace vitrail::trace::cuda {

class SceneMirror {
public:
    explicit SceneMirror(std::span<const Gpu> gpus)
        : gpus_(gpus)
        , upload_(gpus) {}
    Result<> open() { return upload_.open(); }

    // What is launched after it on the devices' streams sees the new scene. sky: null where rays alone are traced.
    // Errors: limit (memory of the device).
    Result<> update(const MirrorSource& source, const SkyView* sky);
    // Views of one device: `source`'s and `sky`'s of the last update with other pointers.
    const SceneView& scene(std::size_t gpu) const { return views_[gpu].scene; }
    const SkyView& sky(std::size_t gpu) const { return views_[gpu].sky; }

    u64 device_bytes() const; // of one device
    u64 sent_bytes() const { return upload_.sent(); }

private:
    // One array: `bytes` of it stand on each device.
    struct Array {
        u64 bytes = 0;
        std::vector<DeviceBytes> copies;
        std::vector<void*> at; // of the copies
    };
    enum Which : u32 {
        states = kGridBuffers,
        quads,
        media,
        tints,
        albedo,
        material,
        emitters,
        nodes,
        table,
        dome,
        noise,
        boxes,
        box_nodes,
        kArrays
    };
    struct Views {
        SceneView scene;
        SkyView sky;
    };

    Result<> resize(Array& a, u64 bytes);
    // changed: byte ranges; what has grown is sent by itself, all: everything.
    Result<> sync(u32 which, const void* from, u64 bytes, std::span<const DirtyRanges::Range> changed, bool all);
    Result<> sync_grid(Grid& grid);
    Result<> sync_tables(const MirrorSource& source);
    Result<> sync_lights(LightStore& lights, const LightView& view);
    Result<> sync_boxes(const MirrorSource& source);
    Result<> sync_sky(const SkyView& sky);
    void point(const MirrorSource& source, const SkyView* sky);

    std::span<const Gpu> gpus_;
    Upload upload_;
    std::array<Array, kArrays> arrays_;
    std::vector<Views> views_;
    u64 tables_ = ~u64(0), pictures_ = ~u64(0), boxes_ = ~u64(0);
    std::vector<u32> last_tints_;
    scene::SkyTable last_dome_;
    bool any_dome_ = false;
    const u8* last_noise_ = nullptr;
};

} // namespace vitrail::trace::cuda
