#include "store/world_records.h"

#include "base/log.h"
#include "store/keys.h"
#include "store/record.h"
#include "store/record_fields.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail {

static constexpr u8 kChunkVersion = 1;
static constexpr u8 kTextVersion = 1; // states, biomes: the payload is the text
static constexpr u8 kRawVersion = 1;  // entities, scripts: the payload is the caller's

WorldRecords::WorldRecords(std::unique_ptr<WorldStore> store, std::shared_ptr<const BlockRegistry> registry)
    : store_(std::move(store))
    , states_(std::make_shared<StateTable>(std::move(registry)))
    , biomes_(std::make_shared<BiomeTable>()) {}

Result<std::unique_ptr<WorldRecords>> WorldRecords::over(std::unique_ptr<WorldStore> store,
                                                         std::shared_ptr<const BlockRegistry> registry) {
    std::unique_ptr<WorldRecords> out(new WorldRecords(std::move(store), std::move(registry)));
    VX_TRY(out->load_tables());
    return out;
}

Result<std::unique_ptr<WorldRecords>> WorldRecords::open(const std::string& folder,
                                                         std::shared_ptr<const BlockRegistry> registry,
                                                         const OpenOptions& options) {
    VX_TRY_ASSIGN(auto store, open_sqlite_store(folder, options));
    return over(std::move(store), std::move(registry));
}

template <class T>
static Bytes seal_fields(Table table, ByteView key, const T& value) {
    return seal_record(table, key, stored::kVersion, encode_fields(value));
}

static std::string text_from(ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Reads one record; where it is damaged it is set aside and counts as absent.
template <class Parse>
auto WorldRecords::load(Table table, const Bytes& key, u8 version_most, Parse parse)
    -> Result<std::optional<typename decltype(parse(ByteView{}))::value_type>> {
    using T = typename decltype(parse(ByteView{}))::value_type;
    VX_TRY_ASSIGN(const std::optional<Bytes> record, store_->get(table, key));
    if (!record) return std::optional<T>();
    const auto view = open_record(table, key, version_most, *record);
    if (!view && view.error().code == ErrorCode::unsupported) return tl::unexpected(view.error());
    auto value = view ? parse(view->payload) : decltype(parse(ByteView{}))(tl::unexpected(view.error()));
    if (value) return std::optional<T>(std::move(*value));
    if (value.error().code == ErrorCode::unsupported) return tl::unexpected(value.error());
    set_aside(table, key, *record, value.error().message);
    return std::optional<T>();
}

// The same for a range: `visit(key, payload)` gives a Result<>; its failure means that this record is damaged.
template <class Visit>
Result<> WorldRecords::load_range(Table table, ByteView from, ByteView to, u8 version_most, Visit visit) {
    struct Bad {
        Bytes key, record;
        std::string reason;
    };
    std::vector<Bad> bad;
    Result<> outcome;
    VX_TRY(store_->scan(table, from, to, [&](ByteView key, ByteView record) {
        const auto view = open_record(table, key, version_most, record);
        const Result<> seen = view ? visit(key, view->payload) : Result<>(tl::unexpected(view.error()));
        if (seen) return true;
        if (seen.error().code == ErrorCode::unsupported) {
            outcome = seen;
            return false;
        }
        bad.push_back({Bytes(key.begin(), key.end()), Bytes(record.begin(), record.end()), seen.error().message});
        return true;
    }));
    for (const Bad& b : bad)
        set_aside(table, b.key, b.record, b.reason);
    return outcome;
}

static std::string describe(Table table, ByteView key) {
    if (const auto c = keys::read_chunk(key); c && table == Table::chunk)
        return fmt::format("chunk {} {} {} of dimension {}", c->at.x, c->at.y, c->at.z, u32(c->dimension));
    if (const auto c = keys::read_column(key); c && table == Table::column)
        return fmt::format("column {} {} of dimension {}", c->at.x, c->at.z, u32(c->dimension));
    if (const auto n = keys::read_number(key)) return fmt::format("{} {}", table_name(table), *n);
    return fmt::format("{} record \"{}\"", table_name(table), text_from(key));
}

void WorldRecords::set_aside(Table table, ByteView key, ByteView record, const std::string& reason) {
    log_error(fmt::format("world {}: {} is damaged ({}){}", store_->location(), describe(table, key), reason,
                          store_->read_only() ? "" : "; set aside"));
    {
        std::lock_guard lock(damage_mutex_);
        damage_.push_back({table, Bytes(key.begin(), key.end()), reason});
    }
    if (store_->read_only()) return;
    std::lock_guard lock(save_mutex_);
    // A good record may have been saved over it since it was read.
    const auto now = store_->get(table, key);
    if (!now || !*now || !std::equal((*now)->begin(), (*now)->end(), record.begin(), record.end())) return;
    Bytes place{u8(table)};
    place.insert(place.end(), key.begin(), key.end());
    const stored::Quarantined kept{reason, Bytes(record.begin(), record.end())};
    WriteBatch batch;
    Bytes value = seal_fields(Table::quarantine, place, kept);
    batch.put(Table::quarantine, std::move(place), std::move(value));
    batch.erase(table, Bytes(key.begin(), key.end()));
    if (auto done = store_->commit(batch); !done) log_error(done.error().message);
}

std::vector<Damage> WorldRecords::damage() const {
    std::lock_guard lock(damage_mutex_);
    return damage_;
}

// Texts by number, with holes where a record is lost; `least` of them at least.
template <class LoadRange>
static Result<std::vector<std::string>> numbered_texts(u32 least, u32 most, LoadRange load_range) {
    std::vector<std::string> texts(least);
    VX_TRY(load_range([&](ByteView key, ByteView payload) -> Result<> {
        const auto number = keys::read_number(key);
        if (!number || *number >= most || payload.empty()) return fail(ErrorCode::damaged, "key or text is not valid");
        if (*number >= texts.size()) texts.resize(*number + 1);
        texts[*number] = text_from(payload);
        return {};
    }));
    return texts;
}

Result<> WorldRecords::load_tables() {
    VX_TRY_ASSIGN(const auto counts, load(Table::meta, keys::text("counts"), stored::kVersion,
                                          [](ByteView b) { return decode_fields<stored::Counts>(b); }));
    VX_TRY_ASSIGN(const auto states,
                  numbered_texts(counts ? counts->states : 0, StateTable::kCapacity,
                                 [&](auto visit) { return load_range(Table::state, {}, {}, kTextVersion, visit); }));
    for (u32 id = 0; id < states.size(); ++id) {
        const auto state = parse_block_state(states[id]);
        const auto given = state ? states_->intern(*state) : Result<StateId>(tl::unexpected(state.error()));
        if (given && u32(*given) == id) continue;
        // Chunks still use this number: it must not come to mean another state.
        log_error(fmt::format("world {}: the name of block state {} is lost", store_->location(), id));
        VX_TRY_ASSIGN(const BlockState lost, parse_block_state(fmt::format("vitrail:lost_{}", id)));
        VX_TRY_ASSIGN(const StateId again, states_->intern(lost));
        if (u32(again) != id)
            return fail(ErrorCode::damaged,
                        fmt::format("world {}: its table of block states is beyond repair", store_->location()));
    }
    states_kept_ = u32(states.size());
    VX_TRY_ASSIGN(const auto biomes,
                  numbered_texts(counts ? counts->biomes : 0, BiomeTable::kCapacity,
                                 [&](auto visit) { return load_range(Table::biome, {}, {}, kTextVersion, visit); }));
    for (u32 id = 0; id < biomes.size(); ++id) {
        const auto given = biomes_->intern(biomes[id].empty() ? fmt::format("vitrail:lost_{}", id) : biomes[id]);
        if (!given || u32(*given) != id)
            return fail(ErrorCode::damaged,
                        fmt::format("world {}: its table of biomes is beyond repair", store_->location()));
    }
    biomes_kept_ = u32(biomes.size());
    return {};
}

// More room than a stranger gets: an imported chunk may carry very large block entities.
DecodeLimits WorldRecords::decode_limits() const {
    return {.state_count = states_->size(), .biome_count = biomes_->size(), .bytes_most = 64u << 20};
}

Result<std::optional<LevelRecord>> WorldRecords::load_level() {
    return load(Table::meta, keys::text("level"), stored::kVersion, [](ByteView b) -> Result<LevelRecord> {
        VX_TRY_ASSIGN(const auto level, decode_fields<stored::Level>(b));
        return stored::from_stored(level);
    });
}

Result<std::vector<DimensionInfo>> WorldRecords::load_dimensions() {
    std::vector<DimensionInfo> out;
    VX_TRY(load_range(Table::dimension, {}, {}, stored::kVersion, [&](ByteView key, ByteView payload) -> Result<> {
        const auto id = keys::read_number(key);
        if (!id) return fail(ErrorCode::damaged, "key is not a number");
        VX_TRY_ASSIGN(const auto dimension, decode_fields<stored::Dimension>(payload));
        VX_TRY_ASSIGN(auto info, stored::from_stored(DimensionId(*id), dimension));
        out.push_back(std::move(info));
        return {};
    }));
    return out;
}

static Result<ChunkPtr> parse_chunk(ByteView payload, const DecodeLimits& limits) {
    auto chunk = decode_chunk(payload, limits);
    // A record beyond the limit was never written by us.
    if (!chunk && chunk.error().code == ErrorCode::limit) return fail(ErrorCode::damaged, chunk.error().message);
    if (!chunk) return tl::unexpected(chunk.error());
    return std::make_shared<const Chunk>(std::move(*chunk));
}

Result<ChunkPtr> WorldRecords::load_chunk(DimensionId dimension, ChunkPos at) {
    VX_TRY_ASSIGN(auto chunk, load(Table::chunk, keys::chunk(dimension, at), kChunkVersion,
                                   [&](ByteView b) { return parse_chunk(b, decode_limits()); }));
    return chunk ? std::move(*chunk) : ChunkPtr();
}

Result<std::vector<WorldRecords::ColumnChunk>> WorldRecords::load_column_chunks(DimensionId dimension, ColumnPos at) {
    std::vector<ColumnChunk> out;
    const Bytes from = keys::column(dimension, at);
    const DecodeLimits limits = decode_limits();
    VX_TRY(load_range(Table::chunk, from, keys::after(from), kChunkVersion,
                      [&](ByteView key, ByteView payload) -> Result<> {
                          const auto place = keys::read_chunk(key);
                          if (!place) return fail(ErrorCode::damaged, "key is not a chunk's");
                          VX_TRY_ASSIGN(auto chunk, parse_chunk(payload, limits));
                          out.push_back({place->at, std::move(chunk)});
                          return {};
                      }));
    return out;
}

Result<std::optional<ColumnRecord>> WorldRecords::load_column(DimensionId dimension, ColumnPos at) {
    return load(Table::column, keys::column(dimension, at), stored::kVersion, [](ByteView b) -> Result<ColumnRecord> {
        VX_TRY_ASSIGN(const auto column, decode_fields<stored::Column>(b));
        return stored::from_stored(column);
    });
}

static Result<Bytes> raw(ByteView b) {
    return Bytes(b.begin(), b.end());
}

Result<std::optional<Bytes>> WorldRecords::load_entity(u64 id) {
    return load(Table::entity, keys::big_number(id), kRawVersion, raw);
}

static Result<PlayerRecord> parse_player(std::string name, ByteView payload) {
    VX_TRY_ASSIGN(const auto player, decode_fields<stored::Player>(payload));
    return stored::from_stored(std::move(name), player);
}

Result<std::optional<PlayerRecord>> WorldRecords::load_player(const std::string& name) {
    return load(Table::player, keys::text(name), stored::kVersion, [&](ByteView b) { return parse_player(name, b); });
}

Result<std::vector<PlayerRecord>> WorldRecords::load_players() {
    std::vector<PlayerRecord> out;
    VX_TRY(load_range(Table::player, {}, {}, stored::kVersion, [&](ByteView key, ByteView payload) -> Result<> {
        VX_TRY_ASSIGN(auto player, parse_player(text_from(key), payload));
        out.push_back(std::move(player));
        return {};
    }));
    return out;
}

Result<std::optional<Bytes>> WorldRecords::load_script(const std::string& key) {
    return load(Table::script, keys::text(key), kRawVersion, raw);
}

Result<std::map<std::string, Bytes>> WorldRecords::load_scripts() {
    std::map<std::string, Bytes> out;
    VX_TRY(load_range(Table::script, {}, {}, kRawVersion, [&](ByteView key, ByteView payload) -> Result<> {
        out.emplace(text_from(key), Bytes(payload.begin(), payload.end()));
        return {};
    }));
    return out;
}

Result<std::vector<ColumnPos>> WorldRecords::list_columns(DimensionId dimension) {
    std::vector<ColumnPos> out;
    // Leaps from column to column: no chunk's value is read but the first of each column.
    for (const Table table : {Table::column, Table::chunk}) {
        Bytes from = keys::number(u32(dimension));
        const Bytes to = keys::after(from);
        for (bool more = true; more;) {
            more = false;
            VX_TRY(store_->scan(table, from, to, [&](ByteView key, ByteView) {
                if (key.size() < 12) return true;
                const auto place = keys::read_column(key.first(12));
                out.push_back(place->at);
                from = keys::after(keys::column(dimension, place->at));
                more = true;
                return false;
            }));
            if (from.empty() || (!to.empty() && from >= to)) break;
        }
    }
    auto less = [](ColumnPos a, ColumnPos b) { return a.x != b.x ? a.x < b.x : a.z < b.z; };
    std::sort(out.begin(), out.end(), less);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

static void add_raw(WriteBatch& out, Table table, Bytes key, const std::optional<Bytes>& value) {
    if (!value) return out.erase(table, std::move(key));
    Bytes record = seal_record(table, key, kRawVersion, *value);
    out.put(table, std::move(key), std::move(record));
}

template <class T>
static void add_fields(WriteBatch& out, Table table, Bytes key, const T& value) {
    Bytes record = seal_fields(table, key, value);
    out.put(table, std::move(key), std::move(record));
}

static void add_text(WriteBatch& out, Table table, u32 number, std::string_view text) {
    Bytes key = keys::number(number);
    Bytes record = seal_record(table, key, kTextVersion, {reinterpret_cast<const u8*>(text.data()), text.size()});
    out.put(table, std::move(key), std::move(record));
}

Result<> WorldRecords::save(const SaveBatch& batch) {
    WriteBatch out;
    for (const auto& c : batch.chunks) {
        Bytes key = keys::chunk(c.dimension, c.at);
        if (!c.chunk) {
            out.erase(Table::chunk, std::move(key));
            continue;
        }
        Bytes record = begin_record();
        encode_chunk(*c.chunk, kChunkAll, record);
        finish_record(Table::chunk, key, kChunkVersion, record);
        out.put(Table::chunk, std::move(key), std::move(record));
    }
    if (batch.level) add_fields(out, Table::meta, keys::text("level"), stored::to_stored(*batch.level));
    for (const auto& d : batch.dimensions)
        add_fields(out, Table::dimension, keys::number(u32(d.id)), stored::to_stored(d));
    for (const auto& c : batch.columns)
        add_fields(out, Table::column, keys::column(c.dimension, c.at), stored::to_stored(c.column));
    for (const auto& e : batch.entities)
        add_raw(out, Table::entity, keys::big_number(e.id), e.data);
    for (const auto& p : batch.players)
        add_fields(out, Table::player, keys::text(p.name), stored::to_stored(p));
    for (const auto& s : batch.scripts)
        add_raw(out, Table::script, keys::text(s.key), s.value);

    // Every id that the chunks above use was given before they were made, so these counts cover them.
    std::lock_guard lock(save_mutex_);
    const u32 states = states_->size(), biomes = biomes_->size();
    for (u32 id = states_kept_; id < states; ++id)
        add_text(out, Table::state, id, states_->info(StateId(id)).state.to_string());
    for (u32 id = biomes_kept_; id < biomes; ++id)
        add_text(out, Table::biome, id, biomes_->name(BiomeId(id)));
    if (states_kept_ != states || biomes_kept_ != biomes)
        add_fields(out, Table::meta, keys::text("counts"), stored::Counts{states, biomes});
    VX_TRY(store_->commit(out));
    states_kept_ = states;
    biomes_kept_ = biomes;
    return {};
}

} // namespace vitrail
