#include "render/frame_context.h"

#include <cstring>

namespace vitrail::render {

TerrainInputs upload_draws(FrameContext& frame, const DrawList& list, u32 view) {
    TerrainInputs in = frame.terrain;
    in.view = view;
    if (list.records.empty()) return in;
    const auto records = frame.ring->allocate(list.records.size() * sizeof(SectionRecord), 256);
    std::memcpy(records.data, list.records.data(), records.bytes);
    in.records = records.buffer, in.records_offset = records.offset;
    u64 bytes = 0;
    for (const auto& commands : list.commands)
        bytes += commands.size() * sizeof(DrawCommand);
    const auto slice = frame.ring->allocate(bytes, 256);
    in.commands = slice.buffer;
    u64 at = 0;
    for (u32 k = 0; k < u32(DrawKind::count); ++k) {
        const auto& commands = list.commands[k];
        in.ranges[k] = {slice.offset + at, u32(commands.size())};
        if (!commands.empty()) std::memcpy(slice.data + at, commands.data(), commands.size() * sizeof(DrawCommand));
        at += commands.size() * sizeof(DrawCommand);
    }
    return in;
}

} // namespace vitrail::render
