// A player's body: an upright box in fixed-point coordinates, and what it is told to do in one step.
#pragma once

#include "base/fields.h"
#include "base/types.h"
#include "math/vec.h"
#include "voxel/coords.h"

namespace vitrail {

inline constexpr i32 kStepsPerSecond = 60;
inline constexpr float kStepSeconds = 1.0f / 60.0f;

// Sizes in 2^-32 block, as positions are.
inline constexpr i64 kBodyHalfWidth = kFixedOne * 3 / 10;
inline constexpr i64 kBodyHeight = kFixedOne * 18 / 10;
inline constexpr i64 kBodySneakHeight = kFixedOne * 15 / 10;
inline constexpr i64 kBodyEye = kFixedOne * 162 / 100;
inline constexpr i64 kBodySneakEye = kFixedOne * 127 / 100;
inline constexpr i64 kStepUp = kFixedOne * 6 / 10; // the highest edge that is walked up

struct BodyState {
    Located<WorldPos> feet; // the middle of the box's lower face
    Vec3 velocity;          // blocks a second
    bool on_ground = false, flying = false, sneaking = false;
    bool in_liquid = false, climbing = false; // as of the last step; they follow from the position
    float yaw = 0, pitch = 0;                 // radians, as look_direction (math/mat.h) takes them
    friend bool operator==(const BodyState&, const BodyState&) = default;
};

// What the player wants in one step of 1/60 s.
struct MoveCommand {
    u32 number = 0;             // counts up from 1; the server answers with the last one it took
    i8 forward = 0, strafe = 0; // -1, 0, 1; strafe positive to the right
    bool jump = false, sneak = false, sprint = false;
    bool toggle_flying = false; // in this step only
    float yaw = 0, pitch = 0;
    friend bool operator==(const MoveCommand&, const MoveCommand&) = default;
    static constexpr auto fields =
        std::tuple{field<1>("number", &MoveCommand::number),
                   field<2>("forward", &MoveCommand::forward, {.least_value = -1, .most_value = 1}),
                   field<3>("strafe", &MoveCommand::strafe, {.least_value = -1, .most_value = 1}),
                   field<4>("jump", &MoveCommand::jump),
                   field<5>("sneak", &MoveCommand::sneak),
                   field<6>("sprint", &MoveCommand::sprint),
                   field<7>("toggle_flying", &MoveCommand::toggle_flying),
                   field<8>("yaw", &MoveCommand::yaw),
                   field<9>("pitch", &MoveCommand::pitch)};
};

inline i64 height_of(const BodyState& body) {
    return body.sneaking ? kBodySneakHeight : kBodyHeight;
}
inline WorldPos eye_of(const BodyState& body) {
    const WorldPos p = body.feet.at;
    return {p.x, p.y + (body.sneaking ? kBodySneakEye : kBodyEye), p.z};
}

} // namespace vitrail
