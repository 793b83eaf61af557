// Messages from both sides, column heights and the registry: whatever reads must write back to something that reads the
// same.
#include "net/heights_codec.h"
#include "net/messages.h"
#include "net/registry_codec.h"

#include <cstdlib>

using namespace vitrail;
using namespace vitrail::net;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    const ByteView bytes(data, size);
    if (auto message = decode_client_message(bytes)) {
        const Bytes once = encode_any(*message);
        auto again = decode_client_message(once);
        if (!again || encode_any(*again) != once) std::abort();
    }
    if (auto message = decode_server_message(bytes)) {
        const Bytes once = encode_any(*message);
        auto again = decode_server_message(once);
        if (!again || encode_any(*again) != once) std::abort();
    }
    if (auto heights = unpack_heights(bytes)) {
        auto again = unpack_heights(pack_heights(*heights));
        if (!again || again->above != heights->above) std::abort();
    }
    (void)decode_registry(bytes);
    return 0;
}
