// What the player asks for, predicted by the same rules that the server judges by.
#include "replica/replica.h"

namespace vitrail::replica {

Result<u32> Replica::break_block(BlockPos at, Face face, Vec3 hit) {
    net::EditRequest message;
    message.kind = net::EditKind::break_block;
    message.at = net::to_wire(at), message.face = u8(face);
    message.hit_x = hit.x, message.hit_y = hit.y, message.hit_z = hit.z;
    return request(std::move(message), {{at, StateId::air}});
}

Result<u32> Replica::place_block(BlockPos at, Face face, Vec3 hit, const std::string& held) {
    net::EditRequest message;
    message.kind = net::EditKind::place_block;
    message.at = net::to_wire(at), message.face = u8(face);
    message.hit_x = hit.x, message.hit_y = hit.y, message.hit_z = hit.z;
    message.held = held;
    VX_TRY_ASSIGN(BlockState state, parse_block_state(held));
    VX_TRY_ASSIGN(StateId id, states_->intern_with_defaults(state));
    return request(std::move(message), {{neighbor(at, face), id}});
}

} // namespace vitrail::replica
