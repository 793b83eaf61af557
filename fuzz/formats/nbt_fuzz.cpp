// NBT of any kind: every tag is walked, every compound is kept as a document of its own and read again.
#include "formats/nbt.h"

#include <cstdlib>

using namespace vitrail;

static void walk(const nbt::Tag& tag, int depth, u64& sum) {
    sum += tag.name().size() + u64(tag.integer());
    for (const char c : tag.text())
        sum += u8(c);
    for (const u8 b : tag.payload())
        sum += b;
    if (tag.size() > 0) sum += u64(tag.integer_at(tag.size() - 1));
    if (depth > 40) return; // payloads of outer tags were read whole; deeper ones are parts of them
    std::size_t n = 0;
    for (const nbt::Tag child : tag)
        walk(child, depth + 1, sum), ++n;
    if (tag.is(nbt::Type::compound) && n != tag.size()) std::abort();
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    nbt::Document doc;
    const bool whole = doc.parse({data, size});
    if (whole == doc.error().has_value()) std::abort();
    u64 sum = 0;
    walk(doc.root(), 0, sum);
    const Bytes own = nbt::document_of(doc.root());
    if (whole == own.empty()) std::abort();
    nbt::Document again;
    if (!own.empty() && (!again.parse(own) || again.root().size() != doc.root().size())) std::abort();
    return sum == 1 ? 0 : 0;
}
