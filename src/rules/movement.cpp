#include "rules/movement.h"

#include "rules/collision.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

constexpr float kGravity = 32.0f;   // blocks/s^2
constexpr float kAirDrag = 0.408f;  // 1/s: falls end at 78.4 blocks/s
constexpr float kJumpSpeed = 9.33f; // rises 1.25 blocks under gravity and drag
constexpr float kClimbSpeed = 2.35f, kClimbFallSpeed = 3.0f, kClimbSideSpeed = 3.0f;
constexpr float kLeapSpeed = 6.0f;             // out of a liquid, onto its bank
constexpr i64 kWadeDepth = kFixedOne * 4 / 10; // a body that stands less deep walks rather than swims

// Shares of the way to the wanted speed gone in a step: 1 - exp(-rate / 60), written out so that no library's exp
// matters.
constexpr float kGroundGrip = 0.1825f; // rate 12.1/s
constexpr float kAirGrip = 0.0311f;    // rate 1.9/s
constexpr float kFlyGrip = 0.0952f;    // rate 6/s
constexpr float kLiquidGrip = 0.0716f; // rate 4.46/s

float finite_or_zero(float v) {
    return v - v == 0.0f ? v : 0.0f;
}

// Sine and cosine by our own polynomial: the library's may differ between two machines, and prediction must not.
void sin_cos(float angle, float& sine, float& cosine) {
    constexpr double half_pi = 1.5707963267948966;
    const double turns = std::floor(double(angle) / half_pi + 0.5);
    const double x = double(angle) - turns * half_pi, q = x * x;
    const double s = x * (1 + q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040 + q * (1.0 / 362880)))));
    const double c = 1 + q * (-1.0 / 2 + q * (1.0 / 24 + q * (-1.0 / 720 + q * (1.0 / 40320))));
    const int quarter = int(turns - 4 * std::floor(turns / 4));
    sine = float(quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c);
    cosine = float(quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s);
}

// What the body stands in.
struct Medium {
    float viscosity = 0; // the greatest of all cells it overlaps
    i64 depth = 0;       // of the liquid above its feet, 2^-32 block; 0: none
    bool climbable = false;
    bool unknown = false; // some cell is not loaded
};

bool is_liquid(const StateTable& states, StateId id) {
    return states.flags(id) & kLiquid;
}

bool fills_cell(const StateTable& states, StateId below, StateId above) {
    return states.info(below).in_water || is_liquid(states, above) || states.info(above).in_water;
}

Medium medium_of(const Dimension& dimension, WorldPos feet, i64 height) {
    Medium out;
    const StateTable& states = dimension.states();
    const FixedBox box = body_box(feet, height);
    const BlockPos feet_cell = block_of(feet);
    for (i32 y = i32(box.min[1] >> 32); y <= i32((box.max[1] - 1) >> 32); ++y)
        for (i32 z = i32(box.min[2] >> 32); z <= i32((box.max[2] - 1) >> 32); ++z)
            for (i32 x = i32(box.min[0] >> 32); x <= i32((box.max[0] - 1) >> 32); ++x) {
                const BlockPos at{x, y, z};
                if (!in_world(at)) continue; // a wall
                const CellKind kind = cell_kind(dimension, at);
                out.unknown |= kind == CellKind::unknown;
                if (kind != CellKind::loaded) continue;
                const StateId id = dimension.state_at(at);
                if (id == StateId::air) continue;
                const StateInfo& info = states.info(id);
                if (at == feet_cell && states.flags(id) & kClimbable) out.climbable = true;
                const bool logged = info.in_water;
                if (is_liquid(states, id) || logged) {
                    const i32 units = fills_cell(states, id, dimension.state_at({x, y + 1, z}))
                                          ? kShapeUnit
                                          : liquid_height(info.liquid_level);
                    const i64 surface = i64(y) * kFixedOne + units * (kFixedOne / kShapeUnit);
                    if (surface <= feet.y) continue;
                    out.depth = std::max(out.depth, surface - feet.y);
                    out.viscosity = std::max(out.viscosity, logged ? 0.2f : info.look->viscosity);
                } else if (info.shape.collision.empty()) {
                    out.viscosity = std::max(out.viscosity, info.look->viscosity); // webs and the like
                }
            }
    return out;
}

i64 fixed_of(float blocks) {
    return i64(double(blocks) * 4294967296.0);
}

// The body while it moves: its box and the world's boxes around all it can reach in this step.
class Mover {
public:
    Mover(const Dimension& dimension, WorldPos feet, i64 height, const i64 (&by)[3])
        : box_(body_box(feet, height)) {
        FixedBox region = box_;
        for (int a = 0; a < 3; ++a) {
            region.min[a] += std::min<i64>(by[a], 0);
            region.max[a] += std::max<i64>(by[a], 0);
        }
        region.min[1] -= kStepUp;
        region.max[1] += std::max(kStepUp, kBodyHeight - height);
        gather_boxes(dimension, region, boxes_);
    }

    i64 go(int axis, i64 by) {
        const i64 gone = sweep(box_, axis, by, boxes_);
        box_ = box_.moved(axis, gone);
        return gone;
    }
    bool free(const FixedBox& box) const { return !any_overlap(box, boxes_); }
    const FixedBox& box() const { return box_; }
    void set_box(const FixedBox& box) { box_ = box; }
    void set_height(i64 height) { box_.max[1] = box_.min[1] + height; }
    WorldPos feet() const { return {box_.min[0] + kBodyHalfWidth, box_.min[1], box_.min[2] + kBodyHalfWidth}; }

    // Whether something to stand on lies within a step below the box moved by (x, z).
    bool supported(i64 x, i64 z) const {
        const FixedBox there = box_.moved(0, x).moved(2, z);
        return sweep(there, 1, -kStepUp, boxes_) != -kStepUp;
    }

private:
    FixedBox box_;
    std::vector<FixedBox> boxes_;
};

// Shortens a sneaking step until it ends over ground.
void hold_at_edges(const Mover& mover, i64& x, i64& z) {
    const auto shorter = [](i64 v, i64 piece) { return v > piece ? v - piece : v < -piece ? v + piece : 0; };
    const i64 px = std::max<i64>(std::abs(x) / 64, kFixedOne / 2048),
              pz = std::max<i64>(std::abs(z) / 64, kFixedOne / 2048);
    if (!mover.supported(0, 0)) return; // falling already
    while (x != 0 && !mover.supported(x, 0))
        x = shorter(x, px);
    while (z != 0 && !mover.supported(0, z))
        z = shorter(z, pz);
    while ((x != 0 || z != 0) && !mover.supported(x, z)) {
        x = shorter(x, px);
        z = shorter(z, pz);
    }
}

// Both horizontal axes, the longer first: so a body slides along walls and does not catch on corners it would pass.
void go_sideways(Mover& mover, const i64 (&by)[3], i64 (&gone)[3]) {
    const int first = std::abs(by[0]) >= std::abs(by[2]) ? 0 : 2, second = 2 - first;
    gone[first] = mover.go(first, by[first]);
    gone[second] = mover.go(second, by[second]);
}

double squared(i64 x, i64 z) {
    return double(x) * double(x) + double(z) * double(z);
}

// A body that blocks were put into: out by the shortest way of at most a block. False where there is none.
bool push_out(const Dimension& dimension, BodyState& body) {
    const i64 height = height_of(body);
    const FixedBox box = body_box(body.feet.at, height);
    std::vector<FixedBox> boxes;
    FixedBox region = box;
    for (int a = 0; a < 3; ++a) {
        region.min[a] -= kFixedOne;
        region.max[a] += kFixedOne;
    }
    gather_boxes(dimension, region, boxes);
    if (!any_overlap(box, boxes)) return true;
    i64 best = kFixedOne + 1;
    int best_axis = -1;
    for (const FixedBox& b : boxes) {
        if (!b.overlaps(box)) continue;
        for (int a = 0; a < 3; ++a)
            for (const i64 by : {b.max[a] - box.min[a], b.min[a] - box.max[a]}) {
                if (a == 1 && by < 0) continue; // never down, through a floor
                if (std::abs(by) < std::abs(best) && !any_overlap(box.moved(a, by), boxes)) {
                    best = by;
                    best_axis = a;
                }
            }
    }
    if (best_axis < 0) return false;
    i64& coordinate = best_axis == 0 ? body.feet.at.x : best_axis == 1 ? body.feet.at.y : body.feet.at.z;
    coordinate += best;
    return true;
}

// Feet of a body that is whole within the edge of the world.
WorldPos held_inside_world(WorldPos p) {
    constexpr i64 edge = i64(kWorldEdge) * kFixedOne;
    return {std::clamp(p.x, kBodyHalfWidth - edge, edge - kBodyHalfWidth), std::clamp(p.y, -edge, edge - kBodyHeight),
            std::clamp(p.z, kBodyHalfWidth - edge, edge - kBodyHalfWidth)};
}

struct Wish {
    float x = 0, z = 0; // unit length or nothing
};

Wish wish_of(const MoveCommand& command, float yaw) {
    const float forward = float(std::clamp<int>(command.forward, -1, 1)),
                strafe = float(std::clamp<int>(command.strafe, -1, 1));
    float sine, cosine;
    sin_cos(yaw, sine, cosine);
    // Yaw 0 looks to +z and grows clockwise seen from above; right of it lies -x.
    Wish wish{-sine * forward - cosine * strafe, cosine * forward - sine * strafe};
    if (forward != 0 && strafe != 0) wish = {wish.x * 0.70710678f, wish.z * 0.70710678f};
    return wish;
}

float toward(float v, float wanted, float share) {
    return v + (wanted - v) * share;
}

// The velocity after forces, before collisions. `swimming`: in a liquid deep enough.
Vec3 accelerate(const BodyState& body, const MoveCommand& command, const Wish& wish, const Medium& medium,
                bool swimming) {
    Vec3 v = body.velocity;
    const float thin = 1 - std::clamp(medium.viscosity, 0.0f, 1.0f);
    const bool sprint = command.sprint && command.forward > 0 && !body.sneaking;
    if (body.flying) {
        const float twice = command.sprint ? 2.0f : 1.0f;
        const float lift = kFlyVerticalSpeed * twice * float(int(command.jump) - int(command.sneak));
        return {toward(v.x, wish.x * kFlySpeed * twice, kFlyGrip), toward(v.y, lift, 2 * kFlyGrip),
                toward(v.z, wish.z * kFlySpeed * twice, kFlyGrip)};
    }
    float speed = (body.sneaking ? kSneakSpeed : sprint ? kSprintSpeed : kWalkSpeed) * thin;
    if (swimming) {
        speed *= 0.6f;
        const float rise = command.jump ? 3.0f : command.sneak ? -4.0f : -1.6f;
        const float grip = std::min(1.0f, kLiquidGrip * (1 + 2 * medium.viscosity));
        return {toward(v.x, wish.x * speed, grip), toward(v.y, rise * thin, grip), toward(v.z, wish.z * speed, grip)};
    }
    const float grip = body.on_ground || medium.climbable ? kGroundGrip : std::max(kAirGrip, medium.viscosity * 0.3f);
    v.x = toward(v.x, wish.x * speed, grip);
    v.z = toward(v.z, wish.z * speed, grip);
    if (command.jump && body.on_ground) v.y = kJumpSpeed * (medium.depth > 0 || medium.viscosity > 0 ? thin : 1.0f);
    v.y -= (kGravity + kAirDrag * v.y) * kStepSeconds;
    if (medium.viscosity > 0) v.y = toward(v.y, -kWalkSpeed * thin * thin, medium.viscosity * 0.3f);
    if (medium.climbable) {
        v.x = std::clamp(v.x, -kClimbSideSpeed, kClimbSideSpeed);
        v.z = std::clamp(v.z, -kClimbSideSpeed, kClimbSideSpeed);
        v.y = std::max(v.y, body.sneaking ? 0.0f : -kClimbFallSpeed);
        if (command.jump) v.y = kClimbSpeed;
    }
    return v;
}

} // namespace

BodyState step(const Dimension& dimension, BodyState body, const MoveCommand& command) {
    const float half_turn = 1.5707964f;
    body.yaw = finite_or_zero(command.yaw);
    body.pitch = std::clamp(finite_or_zero(command.pitch), -half_turn, half_turn);
    body.velocity = {finite_or_zero(body.velocity.x), finite_or_zero(body.velocity.y), finite_or_zero(body.velocity.z)};
    body.feet.at = held_inside_world(body.feet.at);
    if (command.toggle_flying) body.flying = !body.flying;

    const Medium before = medium_of(dimension, body.feet.at, height_of(body));
    if (before.unknown) { // held until its surroundings are there
        body.velocity = {};
        return body;
    }
    if (!push_out(dimension, body) && !body.flying) {
        body.velocity = {};
        return body;
    }

    // Pose: standing up needs room.
    const bool was_sneaking = body.sneaking;
    body.sneaking = command.sneak && !body.flying;
    if (was_sneaking && !body.sneaking && !body_fits(dimension, body.feet.at, kBodyHeight)) body.sneaking = true;

    const bool swimming = before.depth > kWadeDepth || (before.depth > 0 && !body.on_ground);
    const Vec3 old = body.velocity;
    Vec3 v = accelerate(body, command, wish_of(command, body.yaw), before, swimming);
    v = {clamp(v.x, -kSpeedMost, kSpeedMost), clamp(v.y, -kSpeedMost, kSpeedMost), clamp(v.z, -kSpeedMost, kSpeedMost)};

    // The mean of both speeds, so that a jump's height does not hang on the length of a step; a new jump starts at its
    // own.
    const float mean_y = v.y > old.y + 1 ? v.y : clamp((v.y + old.y) * 0.5f, -kSpeedMost, kSpeedMost);
    i64 by[3] = {fixed_of(v.x * kStepSeconds), fixed_of(mean_y * kStepSeconds), fixed_of(v.z * kStepSeconds)};
    const bool was_on_ground = body.on_ground;
    Mover mover(dimension, body.feet.at, height_of(body), by);
    i64 gone[3] = {};
    gone[1] = mover.go(1, by[1]);
    body.on_ground = by[1] < 0 && gone[1] != by[1];

    if (body.sneaking && was_on_ground && by[1] <= 0 && !swimming) hold_at_edges(mover, by[0], by[2]);
    const FixedBox start = mover.box();
    go_sideways(mover, by, gone);
    if ((gone[0] != by[0] || gone[2] != by[2]) && (was_on_ground || body.on_ground) && !body.flying) {
        // Blocked: the same way, raised by a step, if that leads further.
        const FixedBox low = mover.box();
        mover.set_box(start);
        const i64 raised = mover.go(1, kStepUp);
        i64 high[3] = {};
        go_sideways(mover, by, high);
        const i64 lowered = mover.go(1, -raised);
        const bool lands = lowered != -raised;
        if (lands && squared(high[0], high[2]) > squared(gone[0], gone[2])) {
            gone[0] = high[0];
            gone[2] = high[2];
            body.on_ground = true;
        } else
            mover.set_box(low);
    }
    body.feet.at = mover.feet();

    // What was run into stops the speed along that axis.
    const bool blocked = gone[0] != by[0] || gone[2] != by[2];
    if (gone[0] != by[0]) v.x = 0;
    if (gone[2] != by[2]) v.z = 0;
    if (gone[1] != by[1]) v.y = 0;
    if (blocked && before.climbable && !body.flying) v.y = std::max(v.y, kClimbSpeed);
    if (blocked && swimming && command.jump) v.y = std::max(v.y, kLeapSpeed * (1 - before.viscosity));
    if (body.flying && body.on_ground && command.sneak) body.flying = false;
    body.velocity = v;
    body.in_liquid = swimming;
    body.climbing = before.climbable && !body.on_ground && !body.flying;
    return body;
}

} // namespace vitrail
