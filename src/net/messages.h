// Every message between a client and a server, as data. One set of messages and codecs serves the in-process loopback
// and any socket (net/transport.h). docs/formats/protocol.md tells who sends what when.
//
// On the wire: one byte of MessageType, then the struct's numbered fields (base/fields.h). A receiver skips fields it
// does not know and refuses a type it does not know. Every count is bounded here; both sides check on reading.
//
// Channels (reliable and ordered each, but for `motion`): `control` greetings, requests and talk; `world` welcome, all
// that changes a replica's blocks and the answers to edits, so that state texts come before sections that use them,
// deltas after the section they change, and an answer after the changes it speaks of; `motion` commands and bodies,
// which may be lost: each batch repeats what was not answered yet.
#pragma once

#include "base/fields.h"
#include "voxel/coords.h"
#include "world/day_clock.h"

#include <string>
#include <variant>
#include <vector>

namespace vitrail::net {

inline constexpr u32 kProtocolVersion = 1;
inline constexpr u64 kMostMessageBytes = 4u << 20; // a longer message ends the session
inline constexpr u32 kMostCommandsABatch = 240;    // 4 seconds of steps
inline constexpr u32 kMostSectionsAMessage = 256;
inline constexpr u32 kMostSectionsAsked = 512;
inline constexpr u32 kMostViewDistance = 32; // chunks

enum class MessageType : u8 {
    // client to server
    hello = 1,
    move_commands = 2,
    edit_request = 3,
    set_view = 4,
    section_ack = 5,
    leave = 6,
    say = 7,
    hotbar = 8,
    ask_sections = 9,
    set_time = 10,
    // server to client
    welcome = 64,
    registry_data = 65,
    state_texts = 66,
    biome_texts = 67,
    sections = 68,
    air_sections = 69,
    sections_gone = 70,
    column_heights = 71,
    block_changes = 72,
    light_changes = 73,
    edit_result = 74,
    body_state = 75,
    time_of_day = 76,
    notice = 77,
    goodbye = 78,
};

// --- parts ---

struct WireChunkPos {
    i32 x = 0, y = 0, z = 0;
    static constexpr auto fields =
        std::tuple{field<1>("x", &WireChunkPos::x), field<2>("y", &WireChunkPos::y), field<3>("z", &WireChunkPos::z)};
    friend bool operator==(const WireChunkPos&, const WireChunkPos&) = default;
};
constexpr WireChunkPos to_wire(ChunkPos p) {
    return {p.x, p.y, p.z};
}
constexpr ChunkPos from_wire(WireChunkPos p) {
    return {p.x, p.y, p.z};
}

struct WireBlockPos {
    i32 x = 0, y = 0, z = 0;
    static constexpr auto fields =
        std::tuple{field<1>("x", &WireBlockPos::x), field<2>("y", &WireBlockPos::y), field<3>("z", &WireBlockPos::z)};
    friend bool operator==(const WireBlockPos&, const WireBlockPos&) = default;
};
constexpr WireBlockPos to_wire(BlockPos p) {
    return {p.x, p.y, p.z};
}
constexpr BlockPos from_wire(WireBlockPos p) {
    return {p.x, p.y, p.z};
}

struct WireWorldPos {
    i64 x = 0, y = 0, z = 0; // 32.32 fixed point
    static constexpr auto fields =
        std::tuple{field<1>("x", &WireWorldPos::x), field<2>("y", &WireWorldPos::y), field<3>("z", &WireWorldPos::z)};
    friend bool operator==(const WireWorldPos&, const WireWorldPos&) = default;
};
constexpr WireWorldPos to_wire(WorldPos p) {
    return {p.x, p.y, p.z};
}
constexpr WorldPos from_wire(WireWorldPos p) {
    return {p.x, p.y, p.z};
}

// One movement step of 1/60 s (rules/movement.h; net/body_codec.h packs the buttons).
struct WireCommand {
    u32 number = 0; // counts from 1, without gaps
    u32 buttons = 0;
    float yaw = 0, pitch = 0; // radians
    static constexpr auto fields =
        std::tuple{field<1>("number", &WireCommand::number), field<2>("buttons", &WireCommand::buttons),
                   field<3>("yaw", &WireCommand::yaw), field<4>("pitch", &WireCommand::pitch)};
    friend bool operator==(const WireCommand&, const WireCommand&) = default;
};

// All of a body that the movement step reads and writes (rules/body.h).
struct WireBody {
    u32 dimension = 0;
    WireWorldPos at;              // middle of the soles
    float vx = 0, vy = 0, vz = 0; // blocks a second
    float yaw = 0, pitch = 0;     // radians
    u32 bits = 0;                 // on_ground, flying, sneaking, in_liquid, climbing, from bit 0
    static constexpr auto fields = std::tuple{field<1>("dimension", &WireBody::dimension),
                                              field<2>("at", &WireBody::at),
                                              field<3>("vx", &WireBody::vx),
                                              field<4>("vy", &WireBody::vy),
                                              field<5>("vz", &WireBody::vz),
                                              field<6>("yaw", &WireBody::yaw),
                                              field<7>("pitch", &WireBody::pitch),
                                              field<8>("bits", &WireBody::bits)};
    friend bool operator==(const WireBody&, const WireBody&) = default;
};

struct WireDimension {
    u32 id = 0;
    std::string name;
    i32 min_y = 0, max_y = 0;
    bool has_sky = true;
    i32 sea_level = 63;
    static constexpr auto fields =
        std::tuple{field<1>("id", &WireDimension::id),           field<2>("name", &WireDimension::name, {.most = 256}),
                   field<3>("min_y", &WireDimension::min_y),     field<4>("max_y", &WireDimension::max_y),
                   field<5>("has_sky", &WireDimension::has_sky), field<6>("sea_level", &WireDimension::sea_level)};
    friend bool operator==(const WireDimension&, const WireDimension&) = default;
};

// --- client to server ---

struct Hello {
    static constexpr MessageType kType = MessageType::hello;
    u32 version = kProtocolVersion;
    std::string name; // 1..32 of A-Z a-z 0-9 _ -
    u32 view_distance = 8;
    u64 content_hash = 0; // of the registry held; equal to the server's: it is not sent again
    static constexpr auto fields = std::tuple{
        field<1>("version", &Hello::version), field<2>("name", &Hello::name, {.most = 32}),
        field<3>("view_distance", &Hello::view_distance, {.least_value = 1, .most_value = kMostViewDistance}),
        field<4>("content_hash", &Hello::content_hash)};
};

struct MoveCommands {
    static constexpr MessageType kType = MessageType::move_commands;
    std::vector<WireCommand> commands; // ascending numbers; all not answered by a BodyState yet
    static constexpr auto fields =
        std::tuple{field<1>("commands", &MoveCommands::commands, {.most = kMostCommandsABatch})};
};

enum class EditKind : u8 { break_block = 0, place_block = 1 };

struct EditRequest {
    static constexpr MessageType kType = MessageType::edit_request;
    u32 sequence = 0; // counts from 1
    EditKind kind = EditKind::break_block;
    WireBlockPos at;                       // the block aimed at: what breaks, or what is placed against
    u8 face = 0;                           // Face aimed at
    float hit_x = 0, hit_y = 0, hit_z = 0; // where the ray met, in blocks from the lower corner of `at`
    std::string held;                      // block name to place
    std::string target;                    // state text the player sees at `at`; another one there: refused
    float yaw = 0, pitch = 0;              // radians
    u32 after_command = 0;                 // the last movement command before it
    static constexpr auto fields = std::tuple{field<1>("sequence", &EditRequest::sequence),
                                              field<2>("kind", &EditRequest::kind),
                                              field<3>("at", &EditRequest::at),
                                              field<4>("face", &EditRequest::face, {.most_value = 5}),
                                              field<5>("hit_x", &EditRequest::hit_x),
                                              field<6>("hit_y", &EditRequest::hit_y),
                                              field<7>("hit_z", &EditRequest::hit_z),
                                              field<8>("held", &EditRequest::held, {.most = 256}),
                                              field<9>("yaw", &EditRequest::yaw),
                                              field<10>("pitch", &EditRequest::pitch),
                                              field<11>("after_command", &EditRequest::after_command),
                                              field<12>("target", &EditRequest::target, {.most = 1024})};
};

struct SetView {
    static constexpr MessageType kType = MessageType::set_view;
    u32 view_distance = 8; // chunks
    static constexpr auto fields = std::tuple{
        field<1>("view_distance", &SetView::view_distance, {.least_value = 1, .most_value = kMostViewDistance})};
};

// Flow control: the sum of section bytes this client has taken in since Welcome.
struct SectionAck {
    static constexpr MessageType kType = MessageType::section_ack;
    u64 bytes = 0;
    static constexpr auto fields = std::tuple{field<1>("bytes", &SectionAck::bytes)};
};

struct Leave {
    static constexpr MessageType kType = MessageType::leave;
    u32 reason = 0;
    static constexpr auto fields = std::tuple{field<1>("reason", &Leave::reason)};
};

struct Say {
    static constexpr MessageType kType = MessageType::say;
    std::string text;
    static constexpr auto fields = std::tuple{field<1>("text", &Say::text, {.most = 256})};
};

// The hotbar as the player arranged it; kept with the player.
struct Hotbar {
    static constexpr MessageType kType = MessageType::hotbar;
    std::vector<std::string> names;
    u32 selected = 0;
    static constexpr auto fields = std::tuple{field<1>("names", &Hotbar::names, {.most = 16}),
                                              field<2>("selected", &Hotbar::selected, {.most_value = 15})};
};

// Sections that the player could see and the client does not hold, the most wanted first. Replaces what was asked
// before; the server answers with those that it would send anyway, sooner.
struct AskSections {
    static constexpr MessageType kType = MessageType::ask_sections;
    u32 dimension = 0;
    std::vector<WireChunkPos> at;
    static constexpr auto fields = std::tuple{field<1>("dimension", &AskSections::dimension),
                                              field<2>("at", &AskSections::at, {.most = kMostSectionsAsked})};
};

// Time of day, for all players: moved by `step` day ticks (back only to midnight of the first day), and standing still
// or not. The server answers by time_of_day, or by a notice where players may not do that.
struct SetTime {
    static constexpr MessageType kType = MessageType::set_time;
    i32 step = 0; // -24000..24000; more is held
    bool paused = false;
    static constexpr auto fields = std::tuple{field<1>("step", &SetTime::step), field<2>("paused", &SetTime::paused)};
};

// --- server to client ---

struct Welcome {
    static constexpr MessageType kType = MessageType::welcome;
    u32 version = kProtocolVersion;
    u32 player = 0; // this session's number
    std::vector<WireDimension> dimensions;
    WireBody body;
    u64 tick = 0;
    u32 time_of_day = 0; // 0..23999
    u64 content_hash = 0;
    u32 view_distance = 8; // granted
    std::vector<std::string> hotbar;
    u32 hotbar_selected = 0;
    u64 seed = 0;
    u32 day = 0; // days since the world began
    u32 day_minutes = kUsualDayMinutes;
    static constexpr auto fields = std::tuple{
        field<1>("version", &Welcome::version),
        field<2>("player", &Welcome::player),
        field<3>("dimensions", &Welcome::dimensions, {.most = 256}),
        field<4>("body", &Welcome::body),
        field<5>("tick", &Welcome::tick),
        field<6>("time_of_day", &Welcome::time_of_day, {.most_value = kDayTicks - 1}),
        field<7>("content_hash", &Welcome::content_hash),
        field<8>("view_distance", &Welcome::view_distance, {.least_value = 1, .most_value = kMostViewDistance}),
        field<9>("hotbar", &Welcome::hotbar, {.most = 16}),
        field<10>("hotbar_selected", &Welcome::hotbar_selected, {.most_value = 15}),
        field<11>("seed", &Welcome::seed),
        field<12>("day", &Welcome::day),
        field<13>("day_minutes", &Welcome::day_minutes, {.most_value = kMostDayMinutes})};
};

// The content registry (net/registry_codec.h); comes before Welcome where the client's hash differs.
struct RegistryData {
    static constexpr MessageType kType = MessageType::registry_data;
    Bytes data;
    static constexpr auto fields = std::tuple{field<1>("data", &RegistryData::data, {.most = kMostMessageBytes})};
};

// Texts of the server's state ids first, first+1, ...; ids 0 and 1 are known.
struct StateTexts {
    static constexpr MessageType kType = MessageType::state_texts;
    u32 first = 0;
    std::vector<std::string> texts;
    static constexpr auto fields =
        std::tuple{field<1>("first", &StateTexts::first), field<2>("texts", &StateTexts::texts, {.most = 4096})};
};

struct BiomeTexts {
    static constexpr MessageType kType = MessageType::biome_texts;
    u32 first = 0;
    std::vector<std::string> texts;
    static constexpr auto fields =
        std::tuple{field<1>("first", &BiomeTexts::first), field<2>("texts", &BiomeTexts::texts, {.most = 4096})};
};

struct WireSection {
    WireChunkPos at;
    u64 revision = 0;
    Bytes chunk; // voxel/chunk_codec.h, of the surface chunk: hidden blocks replaced, light included, nothing private
    static constexpr auto fields =
        std::tuple{field<1>("at", &WireSection::at), field<2>("revision", &WireSection::revision),
                   field<3>("chunk", &WireSection::chunk, {.most = 1u << 17})};
    friend bool operator==(const WireSection&, const WireSection&) = default;
};

struct Sections {
    static constexpr MessageType kType = MessageType::sections;
    u32 dimension = 0;
    std::vector<WireSection> sections;
    static constexpr auto fields =
        std::tuple{field<1>("dimension", &Sections::dimension),
                   field<2>("sections", &Sections::sections, {.most = kMostSectionsAMessage})};
};

// Sections of nothing but air under the open sky (light 15 everywhere) with one biome: a few bytes each.
struct AirSections {
    static constexpr MessageType kType = MessageType::air_sections;
    u32 dimension = 0;
    std::vector<WireChunkPos> at;
    static constexpr auto fields =
        std::tuple{field<1>("dimension", &AirSections::dimension), field<2>("at", &AirSections::at, {.most = 4096})};
};

struct SectionsGone {
    static constexpr MessageType kType = MessageType::sections_gone;
    u32 dimension = 0;
    std::vector<WireChunkPos> at;
    static constexpr auto fields =
        std::tuple{field<1>("dimension", &SectionsGone::dimension), field<2>("at", &SectionsGone::at, {.most = 4096})};
};

struct WireHeights {
    i32 x = 0, z = 0; // ColumnPos
    Bytes packed;     // pack_heights: 256 heights, run-length zigzag differences
    static constexpr auto fields = std::tuple{field<1>("x", &WireHeights::x), field<2>("z", &WireHeights::z),
                                              field<3>("packed", &WireHeights::packed, {.most = 2048})};
    friend bool operator==(const WireHeights&, const WireHeights&) = default;
};

struct HeightsOfColumns {
    static constexpr MessageType kType = MessageType::column_heights;
    u32 dimension = 0;
    std::vector<WireHeights> columns;
    static constexpr auto fields = std::tuple{field<1>("dimension", &HeightsOfColumns::dimension),
                                              field<2>("columns", &HeightsOfColumns::columns, {.most = 256})};
};

// Cells of one section that changed as the client may see them: the edits, blocks they laid bare and blocks they hid.
struct WireChunkDelta {
    WireChunkPos at;
    u64 revision = 0; // after it
    std::vector<u16> cells;
    std::vector<u32> values; // state ids, or Light bits; one a cell
    static constexpr auto fields =
        std::tuple{field<1>("at", &WireChunkDelta::at), field<2>("revision", &WireChunkDelta::revision),
                   field<3>("cells", &WireChunkDelta::cells, {.most = 4096}),
                   field<4>("values", &WireChunkDelta::values, {.most = 4096})};
    friend bool operator==(const WireChunkDelta&, const WireChunkDelta&) = default;
};

struct BlockChanges {
    static constexpr MessageType kType = MessageType::block_changes;
    u32 dimension = 0;
    std::vector<WireChunkDelta> chunks;
    static constexpr auto fields = std::tuple{field<1>("dimension", &BlockChanges::dimension),
                                              field<2>("chunks", &BlockChanges::chunks, {.most = 4096})};
};

struct LightChanges {
    static constexpr MessageType kType = MessageType::light_changes;
    u32 dimension = 0;
    std::vector<WireChunkDelta> chunks;
    static constexpr auto fields = std::tuple{field<1>("dimension", &LightChanges::dimension),
                                              field<2>("chunks", &LightChanges::chunks, {.most = 4096})};
};

// `accepted` and `refused` come once each request, after the BlockChanges of an accepted one; `kept` follows when the
// store has it on disk.
enum class EditOutcome : u8 { refused = 0, accepted = 1, kept = 2 };

struct EditResult {
    static constexpr MessageType kType = MessageType::edit_result;
    u32 sequence = 0; // for `kept`: this and all accepted ones before it
    EditOutcome outcome = EditOutcome::refused;
    std::string reason; // where refused: one line for a person
    static constexpr auto fields = std::tuple{field<1>("sequence", &EditResult::sequence),
                                              field<2>("outcome", &EditResult::outcome, {.most_value = 2}),
                                              field<3>("reason", &EditResult::reason, {.most = 256})};
};

// The server's body after `last_command`; a replica that computed another one takes this and replays what follows.
struct BodyState {
    static constexpr MessageType kType = MessageType::body_state;
    u32 last_command = 0;
    WireBody body;
    static constexpr auto fields =
        std::tuple{field<1>("last_command", &BodyState::last_command), field<2>("body", &BodyState::body)};
};

struct TimeOfDay {
    static constexpr MessageType kType = MessageType::time_of_day;
    u64 tick = 0;
    u32 time_of_day = 0;                // 0..23999
    u32 day = 0;                        // days since the world began
    u32 day_minutes = kUsualDayMinutes; // how fast it goes on (world/day_clock.h)
    static constexpr auto fields =
        std::tuple{field<1>("tick", &TimeOfDay::tick),
                   field<2>("time_of_day", &TimeOfDay::time_of_day, {.most_value = kDayTicks - 1}),
                   field<3>("day", &TimeOfDay::day),
                   field<4>("day_minutes", &TimeOfDay::day_minutes, {.most_value = kMostDayMinutes})};
};

struct Notice {
    static constexpr MessageType kType = MessageType::notice;
    std::string from; // player's name; empty: the server
    std::string text;
    static constexpr auto fields =
        std::tuple{field<1>("from", &Notice::from, {.most = 32}), field<2>("text", &Notice::text, {.most = 1024})};
};

// Ends the session; the transport closes after it.
struct Goodbye {
    static constexpr MessageType kType = MessageType::goodbye;
    std::string reason;
    static constexpr auto fields = std::tuple{field<1>("reason", &Goodbye::reason, {.most = 256})};
};

using ClientMessage =
    std::variant<Hello, MoveCommands, EditRequest, SetView, SectionAck, Leave, Say, Hotbar, AskSections, SetTime>;
using ServerMessage =
    std::variant<Welcome, RegistryData, StateTexts, BiomeTexts, Sections, AirSections, SectionsGone, HeightsOfColumns,
                 BlockChanges, LightChanges, EditResult, BodyState, TimeOfDay, Notice, Goodbye>;

// One byte of type, then the fields.
template <class M>
Bytes encode_message(const M& message) {
    ByteWriter out;
    out.put_u8(u8(M::kType));
    detail::encode_struct(out, message);
    return out.take();
}

// Errors: damaged (does not parse, a value out of its bounds), unsupported (unknown type), limit (too long).
Result<ClientMessage> decode_client_message(ByteView bytes);
Result<ServerMessage> decode_server_message(ByteView bytes);

Bytes encode_any(const ClientMessage& message);
Bytes encode_any(const ServerMessage& message);
const char* message_name(MessageType type);

} // namespace vitrail::net
