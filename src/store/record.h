// The envelope of every record: kind, format version, checksum, payload (docs/formats/store.md).
//
//     byte 0     0xA0 | table number: kind and magic in one
//     byte 1     format version of the payload
//     byte 2..9  XXH3 (64 bits, little-endian) of the payload, seeded by that of the key, seeded by table << 8 |
//     version byte 10..  payload
//
// The key is part of the checksum, so a record found under another key is damage too.
#pragma once

#include "store/world_store.h"

namespace vitrail {

inline constexpr std::size_t kRecordHeaderBytes = 10;

struct RecordView {
    u8 version = 0;
    ByteView payload; // into the sealed bytes
};

// Starts a record: the header's room; append the payload and call finish_record.
Bytes begin_record();
void finish_record(Table table, ByteView key, u8 version, Bytes& record);
Bytes seal_record(Table table, ByteView key, u8 version, ByteView payload);

// Errors: damaged (short, wrong kind, wrong checksum), unsupported (version above `version_most`).
Result<RecordView> open_record(Table table, ByteView key, u8 version_most, ByteView record);

} // namespace vitrail
