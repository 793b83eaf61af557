// Replica: the client's world without graphics: what the server has told, with the player's own movement and edits
// predicted on top. One thread owns it (the game loop); workers get ChunkPtr snapshots. How to use it, each frame:
//
//     replica.poll();                                        // take in what arrived
//     if (replica.joined()) {
//         replica.move(input, seconds);                    // fixed steps of 1/60 s, predicted and sent
//         if (clicked) replica.break_block(hit.at, face, point);
//         for (DirtySection d : replica.take_dirty()) ...    // mesh or upload again
//         draw(replica.body_before(), replica.body(), replica.alpha());
//     }
//
// Predictions: an edit is applied to the replica at once by the same rules as the server's and its light flooded here.
// The server's own version of every section it touched is kept beside it; when the answers are in, that version is what
// stays, so a refused edit vanishes and the replica always ends equal to what the server told. Blocks that a predicted
// break lays bare and whose states are not known are shown as their nearest known neighbor until the answer.
#pragma once

#include "net/messages.h"
#include "net/transport.h"
#include "replica/section_asks.h"
#include "rules/movement.h"
#include "world/biome_table.h"
#include "world/dimension.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace vitrail::replica {

struct ReplicaOptions {
    std::string name = "player"; // 1..32 of A-Z a-z 0-9 _ -
    u32 view_distance = 12;      // chunks
    // Content known already (same machine, or kept from an earlier session); used where its hash equals the server's.
    std::shared_ptr<const BlockRegistry> registry;
    float ask_seconds = 0.05f; // between two messages of ask_for_sections, at least
};

// What happened to a section; a new one has kBlocksChanged | kLightChanged. The border bits say that a neighbor (of 26)
// changed where it touches: faces, ambient occlusion or smooth light along the border may differ.
enum SectionChange : u8 { kBlocksChanged = 1, kLightChanged = 2, kGone = 4, kBorderBlocks = 8, kBorderLight = 16 };

struct DirtySection {
    ChunkPos at;
    u8 what = 0; // SectionChange bits
};

// An answer to an edit, for sounds and messages.
struct EditAnswer {
    u32 sequence = 0;
    net::EditOutcome outcome{};
    std::string reason;
};

struct ReplicaStats {
    u64 messages = 0, bytes = 0, sections = 0, corrections = 0; // corrections: bodies that the server set right
    u32 pending_edits = 0, pending_commands = 0;
};

class Replica {
public:
    Replica(std::unique_ptr<net::Transport> transport, ReplicaOptions options);
    ~Replica();

    // Takes in at most `most` messages. False once the session is over.
    bool poll(std::size_t most = std::size_t(-1));
    bool joined() const { return dimension_ != nullptr; }
    bool lost() const { return lost_; }
    const std::string& lost_reason() const { return lost_reason_; }
    void leave();

    // Below: only once joined.
    Dimension& dimension() { return *dimension_; }
    const Dimension& dimension() const { return *dimension_; }
    const std::vector<DimensionInfo>& dimensions() const { return dimensions_; }
    const std::shared_ptr<StateTable>& states() const { return states_; }
    const std::shared_ptr<const BlockRegistry>& registry() const { return registry_; }
    // Same ids as in the chunks; ids never change while joined.
    const BiomeTable& biomes() const { return biomes_; }
    // Each dirty section once, with all that happened to it since the last call.
    std::vector<DirtySection> take_dirty();
    bool has_section(ChunkPos at) const { return dimension_ && dimension_->find(at) != nullptr; }

    // Asks the server for what this eye could see and is not here, what it looks at first. Call each frame; who never
    // calls gets everything nearest first.
    void ask_for_sections(const Gaze& gaze);

    // Runs as many steps of 1/60 s as have come due after `seconds` more (at most 15 a call), with this input each
    // (its number is not looked at; toggle_flying counts for the first).
    void move(const MoveCommand& input, float seconds);
    const BodyState& body() const { return body_; }
    const BodyState& body_before() const { return body_before_; }
    float alpha() const { return alpha_; } // 0 body_before .. 1 body

    // Predicts and requests; the sequence number, or why the rules say no (nothing is sent then).
    Result<u32> break_block(BlockPos at, Face face, Vec3 hit);
    // `at`: the block aimed at. `held`: block name, e.g. minecraft:oak_log.
    Result<u32> place_block(BlockPos at, Face face, Vec3 hit, const std::string& held);
    std::vector<EditAnswer> take_answers();

    void set_view_distance(u32 chunks);
    u32 view_distance() const { return view_distance_; } // granted
    void say(const std::string& text);
    // Asks the server to move the time of day and to stop it or let it go on; it may refuse (a notice comes).
    void set_time(i32 step_ticks, bool paused);
    void set_hotbar(std::vector<std::string> names, u32 selected);
    const std::vector<std::string>& hotbar() const { return hotbar_; }
    u32 hotbar_selected() const { return hotbar_selected_; }
    std::vector<net::Notice> take_notices();
    // Day ticks since the world began (world/day_clock.h); runs on smoothly between the server's messages.
    double day_ticks() const;
    float time_of_day() const; // 0..24000
    u64 seed() const { return seed_; }
    ReplicaStats stats() const;

private:
    struct PendingEdit {
        u32 sequence = 0;
        std::vector<Edit> edits; // with the guesses for blocks laid bare
    };

    // replica_messages.cpp: one function a message.
    void hear(ByteView bytes);
    Result<> take(net::Welcome&);
    Result<> take(net::RegistryData&);
    Result<> take(net::StateTexts&);
    Result<> take(net::BiomeTexts&);
    Result<> take(net::Sections&);
    Result<> take(net::AirSections&);
    Result<> take(net::SectionsGone&);
    Result<> take(net::HeightsOfColumns&);
    Result<> take(net::BlockChanges&);
    Result<> take(net::LightChanges&);
    Result<> take(net::EditResult&);
    Result<> take(net::BodyState&);
    Result<> take(net::TimeOfDay&);
    Result<> take(net::Notice&);
    Result<> take(net::Goodbye&);
    Result<StateId> own_state(u32 server_id) const;
    Result<> check_dimension(u32 id) const;
    void lose(std::string reason);

    // predicted_edits.cpp
    ChunkPtr server_chunk(ChunkPos at) const; // as the server told it, without predictions
    void put_server_chunk(ChunkPos at, ChunkPtr chunk);
    // Adds what stood before to `shown`, where nothing is in it yet.
    void predict(const std::vector<Edit>& edits, std::unordered_map<ChunkPos, ChunkPtr>& shown);
    void settle(); // shows the server's version with the pending edits on top
    void mark_difference(ChunkPos at, const Chunk* before, const Chunk* now);
    bool is_guess(BlockPos at) const;
    Result<u32> request(net::EditRequest request, std::vector<Edit> edits);
    std::vector<Edit> guess_laid_bare(const std::vector<Edit>& edits) const;
    void mark(ChunkPos at, u8 what);

    // predicted_movement.cpp
    void run_step(MoveCommand command);
    void place_body(const net::WireBody& body);
    void send_commands();

    template <class M>
    void send(net::Channel channel, const M& message);

    std::unique_ptr<net::Transport> transport_;
    ReplicaOptions options_;
    bool lost_ = false;
    std::string lost_reason_;

    std::shared_ptr<const BlockRegistry> registry_;
    bool registry_told_ = false;
    std::shared_ptr<StateTable> states_;
    std::vector<StateId> own_states_; // by the server's id
    BiomeTable biomes_;
    std::vector<DimensionInfo> dimensions_;
    std::unique_ptr<Dimension> dimension_; // null until Welcome
    ChunkPtr open_air_;                    // what every one of AirSections is
    std::unordered_map<ChunkPos, u8> dirty_;
    SectionAsks asks_;
    std::vector<ChunkPos> asked_;
    u64 ask_ns_ = 0, asked_ns_ = 0; // when it was looked, and asked, last

    // Edits.
    std::deque<PendingEdit> pending_;
    std::unordered_map<ChunkPos, ChunkPtr> server_chunks_; // of sections that predictions changed
    std::unordered_map<ColumnPos, ColumnHeights> server_heights_;
    bool unsettled_ = false;
    u32 next_sequence_ = 1;
    std::vector<EditAnswer> answers_;

    // Movement.
    struct SentCommand {
        MoveCommand command;
        BodyState after;
    };
    BodyState body_, body_before_;
    std::deque<SentCommand> commands_; // not answered
    BodyState base_;                   // the server's, after command answered_
    u32 next_command_ = 1, answered_ = 0;
    bool unsent_ = false, toggle_waits_ = false;
    float due_ = 0, alpha_ = 0; // seconds; part of a step

    u32 view_distance_ = 0;
    std::vector<std::string> hotbar_;
    u32 hotbar_selected_ = 0;
    std::vector<net::Notice> notices_;
    DayClock day_clock_;
    u64 seed_ = 0;
    u64 section_bytes_ = 0, section_bytes_told_ = 0;
    ReplicaStats stats_;
};

} // namespace vitrail::replica
