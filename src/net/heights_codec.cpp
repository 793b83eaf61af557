#include "net/heights_codec.h"

namespace vitrail::net {

Bytes pack_heights(const ColumnHeights& heights) {
    ByteWriter out;
    i32 last = 0;
    for (u32 i = 0; i < 256;) {
        const i32 difference = i32(u32(heights.above[i]) - u32(last));
        last = heights.above[i];
        out.put_svarint(difference);
        ++i;
        if (difference != 0) continue;
        u32 more = 0;
        while (i < 256 && heights.above[i] == last)
            ++i, ++more;
        out.put_varint(more);
    }
    return out.take();
}

Result<ColumnHeights> unpack_heights(ByteView bytes) {
    ByteReader in(bytes);
    ColumnHeights heights;
    i32 last = 0;
    for (u32 i = 0; i < 256;) {
        const i64 difference = in.get_svarint();
        if (in.failed() || difference < -i64(1) << 32 || difference > i64(1) << 32)
            return fail(ErrorCode::damaged, "column heights do not parse");
        last = i32(u32(last) + u32(difference));
        heights.above[i++] = last;
        if (difference != 0) continue;
        const u64 more = in.get_varint();
        if (more > 256 - i) return fail(ErrorCode::damaged, "column heights do not parse");
        for (u64 k = 0; k < more; ++k)
            heights.above[i++] = last;
    }
    if (!in.finished()) return fail(ErrorCode::damaged, "column heights do not parse");
    return heights;
}

} // namespace vitrail::net
