// What the player asks for, predicted by the same rules that the server judges by.
#include "replica/replica.h"
#include "rules/breaking.h"
#include "rules/pick.h"
#include "rules/placement.h"

namespace vitrail::replica {

namespace {

net::EditRequest request_of(net::EditKind kind, BlockPos at, Face face, Vec3 hit) {
    net::EditRequest message;
    message.kind = kind;
    message.at = net::to_wire(at), message.face = u8(face);
    message.hit_x = hit.x, message.hit_y = hit.y, message.hit_z = hit.z;
    return message;
}

Result<> check_reach(const BodyState& body, BlockPos at, Vec3 hit) {
    if (length(view_from(eye_of(body), at).v + hit) > kReach + 0.01f) return fail(ErrorCode::denied, "too far away");
    return {};
}

} // namespace

Result<u32> Replica::break_block(BlockPos at, Face face, Vec3 hit) {
    VX_TRY(check_reach(body_, at, hit));
    VX_TRY_ASSIGN(EditBatch batch, vitrail::break_block(*dimension_, at));
    return request(request_of(net::EditKind::break_block, at, face, hit), std::move(batch.edits));
}

Result<u32> Replica::place_block(BlockPos at, Face face, Vec3 hit, const std::string& held) {
    VX_TRY(check_reach(body_, at, hit));
    const PlaceRequest place{held, at, face, hit, body_.yaw, body_.pitch, body_.sneaking};
    const BodyState bodies[1] = {body_};
    VX_TRY_ASSIGN(EditBatch batch, vitrail::place_block(*dimension_, place, bodies));
    net::EditRequest message = request_of(net::EditKind::place_block, at, face, hit);
    message.held = held;
    return request(std::move(message), std::move(batch.edits));
}

} // namespace vitrail::replica
