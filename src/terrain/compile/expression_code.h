// What is between the text of an expression and its instructions: a tree of nodes, folded where all is known.
#pragma once

#include "base/result.h"
#include "terrain/tables.h"

#include <vector>

namespace vitrail::expression {

inline constexpr u32 kNodesMost = 1024;

enum class Call : u8 {
    constant,
    input,
    value,
    noise,
    negate,
    absolute,
    square_root,
    square,
    cube,
    add,
    subtract,
    multiply,
    divide,
    least,
    greatest,
    power,
    smoothstep,
    warp
};
struct Node {
    Call call = Call::constant;
    Op op = Op::constant;    // of noise
    u16 a = 0, b = 0, c = 0; // nodes, earlier in the tree
    u16 index = 0;           // input, value or noise
    float k = 0;
};
constexpr u32 operands_of(Call call) {
    return call < Call::negate ? 0 : call < Call::add ? 1 : call < Call::smoothstep ? 2 : 3;
}

struct Tree {
    std::vector<Node> nodes;
    std::vector<u16> values; // roots of the named values, in order
    u16 root = 0;
    // Folds operations on constants, with the kernels' own arithmetic.
    u16 add(Node node);
    // base ^ exponent: whole powers up to 4 become products.
    u16 add_power(u16 base, u16 exponent);
};

// Instructions that leave the root's value in register 0. Errors: limit (registers).
Result<std::vector<Instruction>> generate(const Tree& tree);

} // namespace vitrail::expression
