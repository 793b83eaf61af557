#include "store/maintenance.h"

#include "store/keys.h"
#include "store/record.h"
#include "store/record_fields.h"

#include <array>
#include <fmt/format.h>
#include <set>

namespace vitrail {

static std::string name_of_key(Table table, ByteView key) {
    if (const auto c = keys::read_chunk(key); c && table == Table::chunk)
        return fmt::format("{} {} {} in dimension {}", c->at.x, c->at.y, c->at.z, u32(c->dimension));
    if (const auto c = keys::read_column(key); c && table == Table::column)
        return fmt::format("{} {} in dimension {}", c->at.x, c->at.z, u32(c->dimension));
    if (const auto n = keys::read_number(key);
        n && table != Table::player && table != Table::script && table != Table::meta)
        return fmt::format("{}", *n);
    std::string out;
    for (u8 c : key.first(std::min<std::size_t>(key.size(), 40)))
        out += c >= 32 && c < 127 ? std::string(1, char(c)) : fmt::format("\\x{:02x}", c);
    return out;
}

// Checksum and content of one record of any table.
static Result<> verify_record(Table table, ByteView key, ByteView record, const DecodeLimits& limits) {
    VX_TRY_ASSIGN(const RecordView view, open_record(table, key, stored::kVersion, record));
    const ByteView payload = view.payload;
    switch (table) {
    case Table::chunk: {
        if (!keys::read_chunk(key)) return fail(ErrorCode::damaged, "key is not a chunk's");
        VX_TRY(decode_chunk(payload, limits));
        return {};
    }
    case Table::column: {
        if (!keys::read_column(key)) return fail(ErrorCode::damaged, "key is not a column's");
        VX_TRY_ASSIGN(const auto v, decode_fields<stored::Column>(payload));
        VX_TRY(stored::from_stored(v));
        return {};
    }
    case Table::dimension: {
        VX_TRY_ASSIGN(const auto v, decode_fields<stored::Dimension>(payload));
        VX_TRY(stored::from_stored(DimensionId(), v));
        return {};
    }
    case Table::player: {
        VX_TRY_ASSIGN(const auto v, decode_fields<stored::Player>(payload));
        VX_TRY(stored::from_stored("", v));
        return {};
    }
    case Table::state: {
        if (!keys::read_number(key)) return fail(ErrorCode::damaged, "key is not a number");
        VX_TRY(parse_block_state({reinterpret_cast<const char*>(payload.data()), payload.size()}));
        return {};
    }
    case Table::quarantine: {
        VX_TRY(decode_fields<stored::Quarantined>(payload));
        return {};
    }
    default:
        return {};
    }
}

// Whether the name of a number is lost is known only by its placeholder.
static void find_lost_names(const WorldRecords& world, VerifyReport& report) {
    for (u32 id = 0; id < world.states().size(); ++id) {
        if (!world.states().info(StateId(id)).state.name.starts_with("vitrail:lost_")) continue;
        ++report.damaged;
        report.findings.push_back(fmt::format("state {}: its name is lost", id));
    }
}

Result<VerifyReport> verify_world(const std::string& folder) {
    VX_TRY_ASSIGN(auto world, WorldRecords::open(folder, std::make_shared<BlockRegistry>(), {.read_only = true}));
    WorldStore& store = world->store();
    VerifyReport report;
    auto finding = [&](std::string line) {
        ++report.damaged;
        if (report.findings.size() < 1000) report.findings.push_back(std::move(line));
    };
    if (const auto sound = store.check(); !sound) finding(sound.error().message);
    find_lost_names(*world, report);
    if (const auto level = world->load_level(); level && *level && (*level)->unfinished)
        finding(fmt::format("this is an unfinished import of {}: if it no longer runs, import it again", (*level)->source));
    const DecodeLimits limits = world->decode_limits();
    for (u8 t = 0; t < u8(Table::count); ++t) {
        const Table table = Table(t);
        const auto scanned = store.scan(table, {}, {}, [&](ByteView key, ByteView record) {
            ++report.records;
            if (table == Table::chunk) ++report.chunks;
            if (table == Table::quarantine) ++report.quarantined;
            if (const auto good = verify_record(table, key, record, limits); !good)
                finding(fmt::format("{} {}: {}", table_name(table), name_of_key(table, key), good.error().message));
            return true;
        });
        if (!scanned) finding(scanned.error().message);
    }
    return report;
}

Result<> backup_world(const std::string& folder, const std::string& target) {
    VX_TRY_ASSIGN(auto store, open_sqlite_store(folder, {.read_only = true}));
    return store->backup(target);
}

Result<InspectReport> inspect_world(const std::string& folder) {
    VX_TRY_ASSIGN(auto world, WorldRecords::open(folder, std::make_shared<BlockRegistry>(), {.read_only = true}));
    WorldStore& store = world->store();
    InspectReport report;
    VX_TRY_ASSIGN(auto level, world->load_level());
    if (level) report.level = std::move(*level);
    VX_TRY_ASSIGN(const auto dimensions, world->load_dimensions());
    std::map<u32, InspectReport::DimensionCounts> by_dimension;
    for (const auto& d : dimensions)
        by_dimension[u32(d.id)].name = d.name;

    std::vector<u64> counts(world->states().size());
    const DecodeLimits limits = world->decode_limits();
    std::array<u16, kChunkVolume> indices;
    std::map<u32, std::pair<bool, ColumnPos>> last_column;
    VX_TRY(store.scan(Table::chunk, {}, {}, [&](ByteView key, ByteView record) {
        const auto place = keys::read_chunk(key);
        const auto view = open_record(Table::chunk, key, stored::kVersion, record);
        auto chunk = view ? decode_chunk(view->payload, limits) : Result<Chunk>(tl::unexpected(view.error()));
        if (!place || !chunk) {
            ++report.damaged;
            return true;
        }
        auto& d = by_dimension[u32(place->dimension)];
        ++d.chunks;
        d.chunk_bytes += record.size();
        auto& [seen, column] = last_column[u32(place->dimension)]; // key order: a column's chunks follow each other
        if (!seen || !(column == column_of(place->at))) ++d.columns;
        seen = true;
        column = column_of(place->at);
        const auto palette = chunk->blocks.palette();
        if (chunk->blocks.uniform()) {
            counts[u32(palette[0])] += kChunkVolume;
        } else {
            chunk->blocks.unpack_indices(indices);
            std::vector<u32> local(palette.size());
            for (u16 i : indices)
                ++local[i];
            for (std::size_t i = 0; i < palette.size(); ++i)
                counts[u32(palette[i])] += local[i];
        }
        report.block_entities += chunk->block_entities.size();
        report.entities += chunk->entities.size();
        return true;
    }));
    for (u32 id = 0; id < counts.size(); ++id)
        if (counts[id] > 0 && StateId(id) != StateId::hidden)
            report.blocks[world->states().info(StateId(id)).state.to_string()] += counts[id];
    for (auto& [id, d] : by_dimension) {
        if (d.name.empty()) d.name = fmt::format("dimension {}", id);
        report.dimensions.push_back(std::move(d));
    }
    report.states = world->states().size();
    report.biomes = world->biomes().size();
    VX_TRY(store.scan(Table::player, {}, {}, [&](ByteView, ByteView) { return ++report.players, true; }));
    VX_TRY(store.scan(Table::entity, {}, {}, [&](ByteView, ByteView) { return ++report.entities, true; }));
    report.damaged += world->damage().size();
    report.size_bytes = store.size_bytes();
    return report;
}

} // namespace vitrail
