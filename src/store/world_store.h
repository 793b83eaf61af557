// WorldStore: what Vitrail asks of a storage engine: ordered byte keys to byte values in a few tables, atomic batches.
// Implementations: SQLite (store/sqlite_store.h). The typed layer above is store/world_records.h; docs/formats/store.md
// has the keys and values.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vitrail {

// Numbers are stored (in quarantine keys and checksums): append only.
enum class Table : u8 { meta, dimension, state, biome, chunk, column, entity, player, script, quarantine, count };
const char* table_name(Table table);

// Applied as one transaction, in order.
struct WriteBatch {
    struct Write {
        Table table;
        Bytes key;
        std::optional<Bytes> value; // none: the record goes
    };
    std::vector<Write> writes;
    void put(Table table, Bytes key, Bytes value) { writes.push_back({table, std::move(key), std::move(value)}); }
    void erase(Table table, Bytes key) { writes.push_back({table, std::move(key), std::nullopt}); }
};

// Safe to call from any thread; commits wait for each other, reads do not wait for commits. A read that starts after a
// commit returned sees it.
class WorldStore {
public:
    // Gives the next record in key order; false stops the scan. Views last for the call only. The store may be read,
    // not written, from inside.
    using ScanCallback = std::function<bool(ByteView key, ByteView value)>;

    virtual ~WorldStore() = default;
    // Nothing where there is no such record. Errors: io, damaged (the engine's own structure).
    virtual Result<std::optional<Bytes>> get(Table table, ByteView key) = 0;
    // Records with from <= key < to in byte order, from one moment; an empty `to` means to the end.
    virtual Result<> scan(Table table, ByteView from, ByteView to, const ScanCallback& callback) = 0;
    // All or nothing; on success it survives the loss of power. Errors: io (full disk, ...): nothing changed, and the
    // store goes on; the same batch may be committed again. denied: opened read-only.
    virtual Result<> commit(const WriteBatch& batch) = 0;
    // A consistent copy of this moment into `target` (a folder that must not hold a world yet), while others read and
    // write.
    virtual Result<> backup(const std::string& target) = 0;
    // The engine's own full integrity check. Errors: damaged, with the first findings.
    virtual Result<> check() = 0;
    virtual bool read_only() const = 0;
    // Bytes on disk, log included.
    virtual u64 size_bytes() const = 0;
    // For messages: the folder.
    virtual const std::string& location() const = 0;
};

} // namespace vitrail
