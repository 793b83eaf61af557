#include "net/messages.h"

#include <fmt/format.h>

namespace vitrail::net {

namespace {

template <class Variant, std::size_t I = 0>
Result<Variant> decode_one(u8 type, ByteView payload) {
    if constexpr (I == std::variant_size_v<Variant>) {
        return fail(ErrorCode::unsupported, fmt::format("unknown message type {}", type));
    } else {
        using M = std::variant_alternative_t<I, Variant>;
        if (type != u8(M::kType)) return decode_one<Variant, I + 1>(type, payload);
        auto message = decode_fields<M>(payload);
        if (!message) return fail(ErrorCode::damaged, fmt::format("{} does not parse", message_name(M::kType)));
        return Variant(std::move(*message));
    }
}

// What field limits cannot say: lists that go together have one length, cells lie inside a chunk.
Result<> check_deltas(const std::vector<WireChunkDelta>& chunks) {
    for (const WireChunkDelta& d : chunks) {
        if (d.cells.size() != d.values.size()) return fail(ErrorCode::damaged, "delta of unequal lists");
        for (u16 cell : d.cells)
            if (cell >= kChunkVolume) return fail(ErrorCode::damaged, "delta outside its section");
    }
    return {};
}

template <class Variant>
Result<Variant> decode_any(ByteView bytes) {
    if (bytes.empty()) return fail(ErrorCode::damaged, "empty message");
    if (bytes.size() > kMostMessageBytes) return fail(ErrorCode::limit, "message is too long");
    return decode_one<Variant>(bytes[0], bytes.subspan(1));
}

} // namespace

Result<ClientMessage> decode_client_message(ByteView bytes) {
    return decode_any<ClientMessage>(bytes);
}

Result<ServerMessage> decode_server_message(ByteView bytes) {
    VX_TRY_ASSIGN(ServerMessage message, decode_any<ServerMessage>(bytes));
    if (auto* blocks = std::get_if<BlockChanges>(&message)) VX_TRY(check_deltas(blocks->chunks));
    if (auto* light = std::get_if<LightChanges>(&message)) VX_TRY(check_deltas(light->chunks));
    return message;
}

Bytes encode_any(const ClientMessage& message) {
    return std::visit([](const auto& m) { return encode_message(m); }, message);
}
Bytes encode_any(const ServerMessage& message) {
    return std::visit([](const auto& m) { return encode_message(m); }, message);
}

const char* message_name(MessageType type) {
    switch (type) {
    case MessageType::hello:
        return "hello";
    case MessageType::move_commands:
        return "move_commands";
    case MessageType::edit_request:
        return "edit_request";
    case MessageType::set_view:
        return "set_view";
    case MessageType::section_ack:
        return "section_ack";
    case MessageType::leave:
        return "leave";
    case MessageType::say:
        return "say";
    case MessageType::hotbar:
        return "hotbar";
    case MessageType::ask_sections:
        return "ask_sections";
    case MessageType::set_time:
        return "set_time";
    case MessageType::welcome:
        return "welcome";
    case MessageType::registry_data:
        return "registry_data";
    case MessageType::state_texts:
        return "state_texts";
    case MessageType::biome_texts:
        return "biome_texts";
    case MessageType::sections:
        return "sections";
    case MessageType::air_sections:
        return "air_sections";
    case MessageType::sections_gone:
        return "sections_gone";
    case MessageType::column_heights:
        return "column_heights";
    case MessageType::block_changes:
        return "block_changes";
    case MessageType::light_changes:
        return "light_changes";
    case MessageType::edit_result:
        return "edit_result";
    case MessageType::body_state:
        return "body_state";
    case MessageType::time_of_day:
        return "time_of_day";
    case MessageType::notice:
        return "notice";
    case MessageType::goodbye:
        return "goodbye";
    }
    return "unknown";
}

} // namespace vitrail::net
