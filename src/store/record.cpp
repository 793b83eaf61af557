#include "store/record.h"

#include "base/assert.h"

#include <cstring>
#include <fmt/format.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace vitrail {

// One hash pass over the payload; key and header, both short, enter as its seed.
static u64 checksum(Table table, u8 version, ByteView key, ByteView payload) {
    const u64 seed = XXH3_64bits_withSeed(key.data(), key.size(), u64(table) << 8 | version);
    return XXH3_64bits_withSeed(payload.data(), payload.size(), seed);
}

Bytes begin_record() {
    return Bytes(kRecordHeaderBytes);
}

void finish_record(Table table, ByteView key, u8 version, Bytes& record) {
    VX_ASSERT(record.size() >= kRecordHeaderBytes);
    record[0] = u8(0xa0 | u8(table));
    record[1] = version;
    const u64 sum = checksum(table, version, key, ByteView(record).subspan(kRecordHeaderBytes));
    std::memcpy(record.data() + 2, &sum, sizeof sum);
}

Bytes seal_record(Table table, ByteView key, u8 version, ByteView payload) {
    Bytes record;
    record.reserve(kRecordHeaderBytes + payload.size());
    record.resize(kRecordHeaderBytes);
    record.insert(record.end(), payload.begin(), payload.end());
    finish_record(table, key, version, record);
    return record;
}

Result<RecordView> open_record(Table table, ByteView key, u8 version_most, ByteView record) {
    if (record.size() < kRecordHeaderBytes) return fail(ErrorCode::damaged, "record is shorter than its header");
    if (record[0] != u8(0xa0 | u8(table))) return fail(ErrorCode::damaged, "record is not of this table's kind");
    u64 sum;
    std::memcpy(&sum, record.data() + 2, sizeof sum);
    const ByteView payload = record.subspan(kRecordHeaderBytes);
    if (sum != checksum(table, record[1], key, payload)) return fail(ErrorCode::damaged, "checksum is wrong");
    if (record[1] > version_most)
        return fail(ErrorCode::unsupported,
                    fmt::format("record of version {}, newer than {}", record[1], version_most));
    return RecordView{record[1], payload};
}

} // namespace vitrail
