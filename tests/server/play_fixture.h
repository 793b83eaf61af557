// A world in a temporary folder, a server ticked by hand and clients on loopback: tests read as sentences.
#pragma once

#include "net/loopback.h"
#include "replica/replica.h"
#include "script/content_loader.h"
#include "server/chunk_loading.h"
#include "server/edits.h"
#include "server/interest.h"
#include "server/server.h"
#include "server/world.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace vitrail {

inline const Content& base_content() {
    static const Content content = [] {
        const std::filesystem::path roots[1] = {std::filesystem::path(VITRAIL_SOURCE_DIR) / "content/base"};
        auto loaded = load_content(roots);
        if (!loaded) throw std::runtime_error(loaded.error().message);
        return *loaded;
    }();
    return content;
}

class Play {
public:
    // "endless", or "" for a flat world: stone below y = 64, with whatever `carve` makes of it.
    using Carve = std::function<void(Dimension&)>;
    explicit Play(std::string generator = "", Carve carve = {}, i32 radius = 6) {
        folder_ = std::filesystem::temp_directory_path() /
                  ("vitrail-play-" + std::to_string(::getpid()) + "-" + std::to_string(count_++));
        std::filesystem::remove_all(folder_);
        generator_ = std::move(generator);
        if (generator_.empty()) make_flat(carve, radius);
        open();
    }
    ~Play() {
        clients.clear();
        server.reset();
        std::filesystem::remove_all(folder_);
    }

    void open() {
        server::ServerOptions options;
        options.folder = folder_.string();
        options.seed = 7;
        options.generator = generator_;
        options.threads = 0;
        options.save_group_ms = 1;
        auto opened = server::Server::open(options, base_content());
        if (!opened) throw std::runtime_error(opened.error().message);
        server = std::move(*opened);
    }
    // A clean stop and a new start; clients are gone.
    void restart() {
        clients.clear();
        const auto stopped = server->stop();
        EXPECT_TRUE(stopped) << stopped.error().message;
        server.reset();
        open();
    }

    replica::Replica& join(const std::string& name, u32 view_distance = 3, net::LoopbackOptions link = {},
                           bool know_content = false) {
        auto [near_end, far_end] = net::make_loopback(std::move(link));
        server->connect(std::move(far_end));
        replica::ReplicaOptions options;
        options.name = name, options.view_distance = view_distance;
        options.ask_seconds = 0; // ticks here take no time
        if (know_content) options.registry = base_content().registry;
        clients.push_back(std::make_unique<replica::Replica>(std::move(near_end), options));
        tick();
        EXPECT_TRUE(clients.back()->joined()) << clients.back()->lost_reason();
        settle();
        return *clients.back();
    }

    void tick(int count = 1) {
        for (; count > 0; --count) {
            server->tick_once();
            for (auto& client : clients)
                client->poll();
        }
    }
    // Until everything that is to be loaded and sent has been.
    void settle() {
        for (int i = 0; i < 5000; ++i) {
            tick();
            bool busy = false;
            for (auto& [id, dimension] : world().dimensions)
                busy |= dimension.scheduler->pending() > 0;
            for (auto& session : world().sessions)
                busy |= !session->wanted.empty() || !session->columns_complete ||
                        session->walked_opened != world().dimensions.at(session->dimension()).opened;
            if (!busy) return;
        }
        ADD_FAILURE() << "the world never settles";
    }
    // Until the store has answered for all accepted edits of this client.
    void until_kept(replica::Replica& client, u32 sequence) {
        for (int i = 0; i < 2000; ++i) {
            tick();
            for (const auto& answer : client.take_answers())
                if (answer.outcome == net::EditOutcome::kept && answer.sequence >= sequence) return;
            ::usleep(1000);
        }
        ADD_FAILURE() << "edit " << sequence << " is never kept";
    }

    server::ServerWorld& world() { return server->world(); }
    server::ServerDimension& dimension() { return world().dimensions.at(DimensionId::overworld); }
    server::Session& session(const std::string& name) {
        for (auto& s : world().sessions)
            if (s->name == name) return *s;
        throw std::runtime_error("no session of " + name);
    }
    StateId state(const std::string& text) { return *world().states().intern_with_defaults(*parse_block_state(text)); }
    std::string block(BlockPos at) { return world().states().info(dimension().dimension.state_at(at)).state.name; }
    const std::filesystem::path& folder() const { return folder_; }

    std::unique_ptr<server::Server> server;
    std::vector<std::unique_ptr<replica::Replica>> clients;

private:
    void make_flat(const Carve& carve, i32 radius) {
        open();
        EXPECT_TRUE(server->stop());
        server.reset();
        auto records = WorldRecords::open(folder_.string(), base_content().registry);
        ASSERT_TRUE(records) << records.error().message;
        const StateId stone = *(*records)->states().intern_with_defaults(*parse_block_state("minecraft:stone"));
        Dimension dimension(DimensionInfo{}, (*records)->states_ptr());
        for (i32 z = -radius; z <= radius; ++z)
            for (i32 x = -radius; x <= radius; ++x)
                for (i32 y = -4; y < 4; ++y) {
                    Chunk chunk;
                    chunk.blocks = BlockStorage(stone);
                    dimension.put({x, y, z}, std::make_shared<const Chunk>(std::move(chunk)));
                }
        if (carve) carve(dimension);
        SaveBatch batch;
        for (const auto& [at, chunk] : dimension.chunks())
            batch.chunks.push_back({DimensionId::overworld, at, chunk});
        for (i32 z = -radius; z <= radius; ++z)
            for (i32 x = -radius; x <= radius; ++x) {
                ColumnRecord column;
                column.heights = compute_heights(dimension, {x, z});
                column.generated = true;
                batch.columns.push_back({DimensionId::overworld, {x, z}, column});
            }
        const auto saved = (*records)->save(batch);
        ASSERT_TRUE(saved) << saved.error().message;
    }

    std::filesystem::path folder_;
    std::string generator_;
    static inline int count_ = 0;
};

// The text of what a replica shows at a place.
inline std::string seen(replica::Replica& client, BlockPos at) {
    if (!client.dimension().find(chunk_of(at))) return "(nothing)";
    return client.states()->info(client.dimension().state_at(at)).state.name;
}

// Every section a client holds equals the surface of the server's, light included, and none holds what is hidden.
inline void expect_equal_surface(Play& play, replica::Replica& client) {
    auto& dimension = play.dimension();
    u32 sections = 0;
    for (const auto& [at, chunk] : client.dimension().chunks()) {
        ++sections;
        ChunkPtr truth = dimension.dimension.find(at);
        if (!truth) {
            ASSERT_TRUE(chunk->blocks.uniform());
            continue;
        }
        const Chunk surface = server::surface_of(dimension, at, *truth);
        u32 wrong = 0, wrong_light = 0;
        for (u32 i = 0; i < u32(kChunkVolume); ++i) {
            const LocalPos l(i);
            const auto& mine = client.states()->info(chunk->blocks.get(l)).state;
            const auto& theirs = play.world().states().info(surface.blocks.get(l)).state;
            wrong += !(mine == theirs);
            const Light light = surface.light ? surface.light->get(l) : Light{};
            wrong_light += !(chunk->light->get(l) == light);
        }
        ASSERT_EQ(wrong, 0u) << "section " << at.x << " " << at.y << " " << at.z;
        ASSERT_EQ(wrong_light, 0u) << "light of section " << at.x << " " << at.y << " " << at.z;
    }
    EXPECT_GT(sections, 0u);
}

} // namespace vitrail
