// Bodies and movement commands to and from the wire. Templates, because net and rules are of one layer and neither
// knows the other: Body is rules' BodyState, Command its MoveCommand.
#pragma once

#include "net/messages.h"

namespace vitrail::net {

template <class Body>
WireBody wire_body(const Body& b) {
    WireBody w;
    w.dimension = u32(b.feet.dimension);
    w.at = to_wire(b.feet.at);
    w.vx = b.velocity.x, w.vy = b.velocity.y, w.vz = b.velocity.z;
    w.yaw = b.yaw, w.pitch = b.pitch;
    w.bits =
        u32(b.on_ground) | u32(b.flying) << 1 | u32(b.sneaking) << 2 | u32(b.in_liquid) << 3 | u32(b.climbing) << 4;
    return w;
}

template <class Body>
Body body_from_wire(const WireBody& w) {
    Body b;
    b.feet.dimension = DimensionId(w.dimension);
    b.feet.at = from_wire(w.at);
    b.velocity = {w.vx, w.vy, w.vz};
    b.yaw = w.yaw, b.pitch = w.pitch;
    b.on_ground = w.bits & 1, b.flying = w.bits & 2, b.sneaking = w.bits & 4;
    b.in_liquid = w.bits & 8, b.climbing = w.bits & 16;
    return b;
}

// buttons: forward + 1 in bits 0..1, strafe + 1 in bits 2..3, then jump, sneak, sprint, toggle_flying.
template <class Command>
WireCommand wire_command(const Command& c) {
    const auto way = [](int v) { return u32(v < 0 ? 0 : v > 0 ? 2 : 1); };
    return {c.number,
            way(c.forward) | way(c.strafe) << 2 | u32(c.jump) << 4 | u32(c.sneak) << 5 | u32(c.sprint) << 6 |
                u32(c.toggle_flying) << 7,
            c.yaw, c.pitch};
}

template <class Command>
Command command_from_wire(const WireCommand& w) {
    const auto way = [](u32 v) { return i8(v == 0 ? -1 : v == 2 ? 1 : 0); };
    Command c;
    c.number = w.number;
    c.forward = way(w.buttons & 3), c.strafe = way(w.buttons >> 2 & 3);
    c.jump = w.buttons & 16, c.sneak = w.buttons & 32, c.sprint = w.buttons & 64, c.toggle_flying = w.buttons & 128;
    c.yaw = w.yaw, c.pitch = w.pitch;
    return c;
}

} // namespace vitrail::net
