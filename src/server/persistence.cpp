#include "server/persistence.h"

#include "base/clock.h"
#include "base/log.h"
#include "math/angle.h"
#include "net/registry_codec.h"
#include "pipeline/new_world.h"
#include "server/interest.h"
#include "terrain/cuda/device.h"

#include <algorithm>
#include <fmt/format.h>
#include <random>

namespace vitrail::server {

namespace {

u64 seed_of_new_world(const ServerOptions& options) {
    if (options.seed) return *options.seed;
    std::random_device device;
    return u64(device()) << 32 | device();
}

// Null: the CPU makes the land.
Result<std::shared_ptr<ColumnBatches>> open_device(const std::string& name, std::shared_ptr<const TerrainGenerator> generator) {
    if (name != "cpu" && name != "cuda" && name != "auto")
        return fail(ErrorCode::invalid_argument, fmt::format("--device is cpu, cuda or auto, not '{}'", name));
    if (name == "cpu" || !generator) return nullptr;
    CudaOptions cuda;
    cuda.batches = 1;
    cuda.columns_most = ColumnBatches::kSide * ColumnBatches::kSide;
    auto maker = open_cuda_batches(std::move(generator), cuda);
    if (!maker) {
        if (name == "cuda") return tl::unexpected(maker.error());
        log_info(fmt::format("land is made on the CPU: {}", maker.error().message));
        return nullptr;
    }
    log_info(fmt::format("land is made on {}", (*maker)->device_name()));
    return std::make_shared<ColumnBatches>(std::move(*maker));
}

} // namespace

Result<std::unique_ptr<ServerWorld>> open_world(ServerOptions options, const Content& content) {
    const std::shared_ptr<const BlockRegistry> registry = content.registry;
    if (options.day_minutes && *options.day_minutes > kMostDayMinutes)
        return fail(ErrorCode::invalid_argument,
                    fmt::format("a day takes 0 to {} minutes, not {}", kMostDayMinutes, *options.day_minutes));
    auto world = std::make_unique<ServerWorld>();
    world->registry = registry;
    world->registry_bytes = net::encode_registry(*registry);
    world->content_hash = net::registry_hash(*registry);
    OpenOptions open;
    open.create = options.create && !options.read_only;
    open.read_only = options.read_only;
    VX_TRY_ASSIGN(world->records, WorldRecords::open(options.folder, registry, open));
    VX_TRY_ASSIGN(auto level, world->records->load_level());
    if (level && level->unfinished)
        return fail(ErrorCode::denied,
                    fmt::format("world {} is an unfinished import of {}: if it no longer runs, import it again",
                                options.folder, level->source));
    if (!level && options.read_only)
        return fail(ErrorCode::not_found, fmt::format("{} holds no level yet", options.folder));
    // Before anything is written: a world whose land cannot be gone on with stays as it is.
    const u64 seed = level ? level->seed : seed_of_new_world(options);
    auto generator = open_generator(level ? level->generator : options.generator,
                                    level ? level->generator_version : kGeneratorVersion, content.terrain.get(), seed);
    if (!generator)
        return fail(generator.error().code, fmt::format("world {}: {}", options.folder, generator.error().message));
    ChunkSourceOptions source{*generator, DimensionId::overworld};
    VX_TRY_ASSIGN(source.device, open_device(options.device, *generator));
    if (level) {
        world->level = std::move(*level);
    } else {
        VX_TRY_ASSIGN(world->level,
                      make_new_level(*world->records, options.name, seed, generator->get(), world->content_hash));
    }
    if (options.day_minutes && world->level.day_minutes != *options.day_minutes) {
        world->level.day_minutes = *options.day_minutes;
        world->level_dirty = true;
    }
    if (world->level.content_hash != world->content_hash) {
        world->level.content_hash = world->content_hash;
        world->level_dirty = true;
    }
    VX_TRY_ASSIGN(auto infos, world->records->load_dimensions());
    if (infos.empty()) infos.push_back(DimensionInfo{});
    for (const DimensionInfo& info : infos) {
        world->dimensions.emplace(info.id, ServerDimension(Dimension(info, world->records->states_ptr())));
    }

    SaveQueueOptions save_options;
    save_options.group_ms = options.save_group_ms;
    save_options.on_trouble = [](const std::optional<Error>& error) {
        if (error)
            log_error(fmt::format("saving the world fails, trying again: {}", error->message));
        else
            log_info("saving the world works again");
    };
    world->saves = std::make_unique<SaveQueue>(*world->records, save_options);
    VX_TRY_ASSIGN(world->source,
                  ChunkSource::create(*world->records, *world->saves, std::move(source)));
    world->pool = std::make_unique<ThreadPool>(options.threads);
    GenerationOptions generation;
    // Inside the tick, columns are few a tick and always the same ones.
    generation.budget_us_a_second = u64(options.generation_us_a_second) * options.threads;
    generation.columns_most = options.threads == 0 ? 2 : 24 + 24 * options.threads;
    generation.jobs_most = 2 + 2 * options.threads;
    for (auto& [id, dimension] : world->dimensions)
        dimension.scheduler = std::make_unique<GenerationScheduler>(
            *world->pool, make_column_work(*world->source, dimension.dimension.info()), generation);
    world->options = std::move(options);
    return world;
}

PlayerRecord player_record(const Session& session) {
    PlayerRecord record;
    record.name = session.name;
    record.at = session.body.feet;
    record.yaw = session.body.yaw * kDegreesARadian, record.pitch = session.body.pitch * kDegreesARadian;
    record.hotbar = session.hotbar;
    record.hotbar_slot = u8(session.hotbar_selected);
    record.flying = session.body.flying;
    return record;
}

// Hovering, so that the eye stays where it is wanted.
static Result<> place_at_start(const ServerWorld& world, Session& session) {
    const StartPlace& start = *world.options.start;
    session.body.feet.dimension = world.level.spawn.dimension;
    if (!start.dimension.empty()) {
        const auto found = std::find_if(world.dimensions.begin(), world.dimensions.end(), [&](const auto& entry) {
            const std::string& name = entry.second.dimension.info().name;
            return name == start.dimension || name == "minecraft:" + start.dimension;
        });
        if (found == world.dimensions.end())
            return fail(ErrorCode::not_found, fmt::format("the world has no dimension '{}'", start.dimension));
        session.body.feet.dimension = found->first;
    } else if (!world.dimensions.contains(session.body.feet.dimension)) {
        session.body.feet.dimension = world.dimensions.begin()->first;
    }
    session.body.feet.at = clamp_to_world({start.eye.x, start.eye.y - kBodyEye, start.eye.z});
    session.body.flying = true;
    session.hotbar = world.registry->hotbar;
    if (session.hotbar.size() > 16) session.hotbar.resize(16);
    return {};
}

void put_at_start(const ServerWorld& world, Session& session) {
    const BodyState before = session.body;
    session.body.velocity = {};
    if (!place_at_start(world, session) || session.dimension() != before.feet.dimension) session.body = before;
    session.commands.clear();
    session.tell_body = true;
}

Result<> restore_player(ServerWorld& world, Session& session) {
    std::optional<PlayerRecord> record;
    if (const auto left = world.players_left.find(session.name); left != world.players_left.end())
        record = left->second;
    else {
        VX_TRY_ASSIGN(record, world.records->load_player(session.name));
    }
    session.body = {};
    if (world.options.start) return place_at_start(world, session);
    if (record && world.dimensions.contains(record->at.dimension)) {
        session.body.feet = {record->at.dimension, clamp_to_world(record->at.at)};
        session.body.flying = record->flying;
        session.body.yaw = record->yaw * kRadiansADegree, session.body.pitch = record->pitch * kRadiansADegree;
        session.hotbar = record->hotbar;
        session.hotbar_selected = record->hotbar_slot;
        return {};
    }
    session.body.feet.dimension = world.dimensions.contains(world.level.spawn.dimension)
                                      ? world.level.spawn.dimension
                                      : world.dimensions.begin()->first;
    session.body.feet.at = corner_of(world.level.spawn.at);
    session.body.feet.at.x += kFixedOne / 2, session.body.feet.at.z += kFixedOne / 2;
    session.body.yaw = world.level.spawn_yaw * kRadiansADegree;
    session.hotbar = world.registry->hotbar;
    if (session.hotbar.size() > 16) session.hotbar.resize(16);
    session.player_dirty = true;
    return {};
}

namespace {

// All that waits, moved into one batch. `everything`: players and level whether they changed or not.
SaveBatch gather(ServerWorld& world, bool everything) {
    SaveBatch batch;
    for (auto& [id, dimension] : world.dimensions) {
        for (ColumnPos at : dimension.dirty_columns) {
            auto found = dimension.columns.find(at);
            if (found == dimension.columns.end()) continue;
            Column& column = found->second;
            const ColumnHeights* heights = dimension.dimension.heights(at);
            ColumnRecord record;
            if (heights) record.heights = *heights;
            record.generated = column.made;
            batch.columns.push_back({id, at, record});
            if (column.stored) continue;
            // The first change in a generated column: from now on the store has all of it.
            const DimensionInfo& info = dimension.dimension.info();
            for (i32 y = info.min_y >> 4; y < info.max_y >> 4; ++y) {
                const ChunkPos p{at.x, y, at.z};
                if (dimension.dirty_chunks.contains(p)) continue;
                ChunkPtr chunk = dimension.dimension.find(p);
                if (!chunk) continue;
                const bool air = chunk->blocks.uniform() && chunk->blocks.palette()[0] == StateId::air;
                if (!air || !chunk->entities.empty()) batch.chunks.push_back({id, p, std::move(chunk)});
            }
            column.stored = true;
        }
        for (ChunkPos at : dimension.dirty_chunks)
            if (ChunkPtr chunk = dimension.dimension.find(at)) batch.chunks.push_back({id, at, std::move(chunk)});
        dimension.dirty_columns.clear();
        dimension.dirty_chunks.clear();
    }
    for (auto& session : world.sessions) {
        if (!session->joined || (!everything && !session->player_dirty && session->unkept_sequence == 0)) continue;
        batch.players.push_back(player_record(*session));
        session->player_dirty = false;
    }
    if (everything || world.level_dirty) {
        batch.level = world.level;
        world.level_dirty = false;
    }
    return batch;
}

} // namespace

void save_changes(ServerWorld& world) {
    if (world.options.read_only) return;
    bool any = world.level_dirty;
    for (auto& [id, dimension] : world.dimensions)
        any |= !dimension.dirty_chunks.empty() || !dimension.dirty_columns.empty();
    for (auto& session : world.sessions)
        any |= session->player_dirty || session->unkept_sequence != 0;
    if (!any) return;
    std::vector<std::pair<u32, u32>> kept;
    SaveBatch batch = gather(world, false);
    for (auto& session : world.sessions) {
        if (session->unkept_sequence == 0) continue;
        kept.emplace_back(session->id, session->unkept_sequence);
        session->unkept_sequence = 0;
    }
    world.saves->submit(std::move(batch), [mailbox = world.mailbox, kept = std::move(kept)] {
        if (kept.empty()) return;
        std::lock_guard lock(mailbox->mutex);
        mailbox->kept.insert(mailbox->kept.end(), kept.begin(), kept.end());
    });
}

Result<> save_all(ServerWorld& world) {
    if (world.options.read_only) return {};
    save_changes(world);
    world.saves->submit(gather(world, true));
    return world.saves->flush();
}

void tell_kept(ServerWorld& world) {
    std::vector<std::pair<u32, u32>> kept;
    {
        std::lock_guard lock(world.mailbox->mutex);
        kept.swap(world.mailbox->kept);
    }
    for (const auto& [id, sequence] : kept)
        for (auto& session : world.sessions)
            if (session->id == id)
                send(*session, net::Channel::world, net::EditResult{sequence, net::EditOutcome::kept, {}});
}

} // namespace vitrail::server
