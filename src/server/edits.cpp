#include "server/edits.h"

#include "light/relight.h"
#include "rules/breaking.h"
#include "rules/pick.h"
#include "rules/placement.h"
#include "server/chunk_loading.h"
#include "server/interest.h"

#include <algorithm>

namespace vitrail::server {

namespace {

constexpr float kReachSlack = 1.0f; // blocks: commands on their way move the eye

float distance_to(const Session& session, const net::EditRequest& request) {
    // No block's boxes reach further than half a block above its cell.
    const Vec3 point{std::clamp(request.hit_x, 0.0f, 1.0f), std::clamp(request.hit_y, 0.0f, 1.5f),
                     std::clamp(request.hit_z, 0.0f, 1.0f)};
    return length(view_from(eye_of(session.body), net::from_wire(request.at)).v + point);
}

std::vector<BodyState> bodies_in(const ServerWorld& world, DimensionId dimension) {
    std::vector<BodyState> bodies;
    for (const auto& session : world.sessions)
        if (session->joined && session->dimension() == dimension) bodies.push_back(session->body);
    return bodies;
}

// What the request does, or why not.
Result<EditBatch> judge(ServerWorld& world, ServerDimension& dimension, const Session& session,
                        const net::EditRequest& request) {
    const BlockPos at = net::from_wire(request.at);
    const StateTable& states = world.states();
    if (!dimension.dimension.contains(at)) return fail(ErrorCode::denied, "the world ends here");
    if (distance_to(session, request) > kReach + kReachSlack) return fail(ErrorCode::denied, "too far away");
    if (!ready(dimension, column_of(chunk_of(at)))) return fail(ErrorCode::denied, "nothing is loaded here");
    if (!request.target.empty() && states.info(dimension.dimension.state_at(at)).state.to_string() != request.target)
        return fail(ErrorCode::denied, "the block has changed");
    if (is_hidden(
            at, [&](BlockPos p) { return state_for_surface(dimension, p); }, opaque_states(states)))
        return fail(ErrorCode::denied, "this block cannot be seen");
    if (request.kind == net::EditKind::break_block) return break_block(dimension.dimension, at);
    if (request.kind != net::EditKind::place_block) return fail(ErrorCode::unsupported, "an edit of an unknown kind");
    // Absent air becomes a chunk where something is put into it: up to two blocks high.
    const BlockPos into = neighbor(at, Face(request.face));
    for (const BlockPos p : {at, into, neighbor(into, Face::up)})
        if (dimension.dimension.contains(p)) require_chunk(dimension, chunk_of(p));
    const PlaceRequest place{request.held,
                             at,
                             Face(request.face),
                             {std::clamp(request.hit_x, 0.0f, 1.0f), std::clamp(request.hit_y, 0.0f, 1.0f),
                              std::clamp(request.hit_z, 0.0f, 1.0f)},
                             request.yaw,
                             request.pitch,
                             session.body.sneaking};
    return place_block(dimension.dimension, place, bodies_in(world, session.dimension()));
}

} // namespace

ChangeSet edit_world(ServerWorld& world, ServerDimension& dimension, const EditBatch& batch) {
    EditBatch loaded;
    for (const Edit& e : batch.edits)
        if (dimension.dimension.contains(e.at) && require_chunk(dimension, chunk_of(e.at))) loaded.edits.push_back(e);
    ChangeSet changes = apply(dimension.dimension, loaded);
    relight(dimension.dimension, changes);
    for (ChunkPos at : changes.block_chunks) {
        dimension.dirty_chunks.insert(at);
        dimension.dirty_columns.insert(column_of(at));
    }
    dimension.light_changed.insert(changes.light_chunks.begin(), changes.light_chunks.end());
    tell_block_changes(world, dimension, changes);
    return changes;
}

void run_edits(ServerWorld& world) {
    for (auto& session : world.sessions) {
        if (!session->joined) continue;
        for (const net::EditRequest& request : session->requests) {
            ServerDimension& dimension = world.dimensions.at(session->dimension());
            auto verdict = judge(world, dimension, *session, request);
            if (!verdict) {
                session->results.push_back(
                    {request.sequence, net::EditOutcome::refused, verdict.error().message.substr(0, 256)});
                continue;
            }
            edit_world(world, dimension, *verdict);
            session->results.push_back({request.sequence, net::EditOutcome::accepted, {}});
            session->unkept_sequence = request.sequence;
        }
        session->requests.clear();
    }
}

} // namespace vitrail::server
