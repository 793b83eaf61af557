// One step of a body, 1/60 s: the same function moves it on the server and predicts it on the client, so both must
// agree bit for bit from the same state, command and blocks. docs/decisions/0004-movement.md says why it is as it is.
#pragma once

#include "rules/body.h"
#include "world/dimension.h"

namespace vitrail {

// Blocks a second, as players know them.
inline constexpr float kWalkSpeed = 4.317f, kSprintSpeed = 5.612f, kSneakSpeed = 1.295f;
inline constexpr float kFlySpeed = 10.92f, kFlyVerticalSpeed = 7.5f; // twice that when sprinting
inline constexpr float kSpeedMost = 1000.0f; // an axis; beyond any use, it bounds the work of a step

// The state after the command. Bodies never end inside a block's boxes that they did not begin in, and never pass
// through any, at any speed. Unknown cells (absent chunks) and the edge of the world are walls; a body that is in an
// unknown cell stays where it is. Values of the command that are out of range or not finite count as zero.
BodyState step(const Dimension& dimension, BodyState body, const MoveCommand& command);

} // namespace vitrail
