// Stored records on any bytes: the envelope, and every payload with fields behind it.
// Input: one byte table, one byte key length, key, record. The payload readers also see the bytes without a valid
// checksum.
#include "base/assert.h"
#include "store/record.h"
#include "store/record_fields.h"

template <class T>
static void read_fields(vitrail::ByteView payload) {
    if (const auto value = vitrail::decode_fields<T>(payload)) {
        const auto again = vitrail::decode_fields<T>(vitrail::encode_fields(*value));
        VX_ASSERT(again);
    }
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace vitrail;
    ByteReader in({data, size});
    const Table table = Table(in.get_u8() % u8(Table::count));
    const ByteView key = in.get_bytes(in.get_u8());
    const ByteView rest = in.get_bytes(in.remaining());
    if (const auto view = open_record(table, key, 255, rest))
        VX_ASSERT(view->payload.size() + kRecordHeaderBytes == rest.size());
    const Bytes sealed = seal_record(table, key, 3, rest);
    VX_ASSERT(open_record(table, key, 3, sealed));
    read_fields<stored::Counts>(rest);
    read_fields<stored::Level>(rest);
    read_fields<stored::Dimension>(rest);
    read_fields<stored::Player>(rest);
    read_fields<stored::Quarantined>(rest);
    if (const auto level = decode_fields<stored::Level>(rest)) (void)stored::from_stored(*level);
    if (const auto column = decode_fields<stored::Column>(rest))
        if (const auto record = stored::from_stored(*column))
            VX_ASSERT(stored::to_stored(*record).above == column->above);
    if (const auto player = decode_fields<stored::Player>(rest)) (void)stored::from_stored("x", *player);
    return 0;
}
