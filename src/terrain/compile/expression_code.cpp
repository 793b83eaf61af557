#include "terrain/compile/expression_code.h"

#include "terrain/kernel/program_kernel.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail::expression {

namespace {

Op op_of(const Node& node) {
    switch (node.call) {
    case Call::constant:
        return Op::constant;
    case Call::input:
        return Op::input;
    case Call::noise:
        return node.op;
    case Call::negate:
        return Op::negate;
    case Call::absolute:
        return Op::absolute;
    case Call::square_root:
        return Op::square_root;
    case Call::add:
        return Op::add;
    case Call::subtract:
        return Op::subtract;
    case Call::multiply:
    case Call::square:
    case Call::cube:
        return Op::multiply;
    case Call::divide:
        return Op::divide;
    case Call::least:
        return Op::least;
    case Call::greatest:
        return Op::greatest;
    case Call::power:
        return Op::power;
    case Call::smoothstep:
        return Op::smoothstep;
    case Call::value:
    case Call::warp:
        break;
    }
    return Op::warp;
}

// The value of an operation on constants: what run_program would say.
float fold(Call call, float a, float b, float c) {
    using L = ScalarLanes;
    switch (call) {
    case Call::negate:
        return -a;
    case Call::absolute:
        return absolute<L>(a);
    case Call::square_root:
        return square_root(greatest(a, 0.0f));
    case Call::square:
        return a * a;
    case Call::cube:
        return a * a * a;
    case Call::add:
        return a + b;
    case Call::subtract:
        return a - b;
    case Call::multiply:
        return a * b;
    case Call::divide:
        return program_detail::divide<L>(a, b);
    case Call::least:
        return least(a, b);
    case Call::greatest:
        return greatest(a, b);
    case Call::power:
        return power_of<L>(a, b);
    case Call::smoothstep:
        return program_detail::smoothstep<L>(a, b, c);
    default:
        return 0;
    }
}

class Generator {
public:
    explicit Generator(const Tree& tree)
        : tree_(tree) {
        // Least number of registers for every node, children before parents.
        need_.resize(tree.nodes.size());
        for (std::size_t i = 0; i < tree.nodes.size(); ++i)
            need_[i] = need_of(tree.nodes[i]);
    }

    Result<std::vector<Instruction>> run() {
        for (const u16 value : tree_.values) {
            const int r = emit(value);
            if (r < 0) return too_many();
            values_.push_back(r);
        }
        const int result = emit(tree_.root);
        if (result < 0) return too_many();
        for (const Node& node : tree_.nodes)
            if (!(node.k >= -1e30f && node.k <= 1e30f))
                return fail(ErrorCode::invalid_argument, "a part's value is out of range");
        for (Instruction& in : code_) { // the result belongs into register 0: rename it with what is there
            for (u8* r : {&in.to, &in.a, &in.b, &in.c}) {
                if (r == &in.a && in.op == Op::input) continue;
                *r = *r == 0 ? u8(result) : *r == result ? u8(0) : *r;
            }
        }
        return std::move(code_);
    }

private:
    static tl::unexpected<Error> too_many() {
        return fail(ErrorCode::limit, fmt::format("needs more than {} numbers at once", kProgramRegisters));
    }

    u32 need_of(const Node& node) const {
        const u16 of[3] = {node.a, node.b, node.c};
        const u32 count = operands_of(node.call);
        u32 needs[3] = {};
        for (u32 i = 0; i < count; ++i)
            needs[i] = need_[of[i]];
        if (node.call == Call::warp) return std::max({needs[0], needs[1] + 1, needs[2]});
        if (needs[0] < needs[1]) std::swap(needs[0], needs[1]); // the largest first; unused ones are 0
        if (needs[1] < needs[2]) std::swap(needs[1], needs[2]);
        if (needs[0] < needs[1]) std::swap(needs[0], needs[1]);
        u32 most = node.call == Call::cube ? 2 : 1;
        for (u32 i = 0; i < count; ++i)
            most = std::max(most, needs[i] + i);
        return most;
    }

    Instruction& push(Op op, int to, int a, int b = 0, int c = 0) {
        Instruction& in = code_.emplace_back();
        in.op = op;
        in.to = u8(to);
        in.a = u8(a);
        in.b = u8(b);
        in.c = u8(c);
        return in;
    }
    int take() {
        for (u32 i = 0; i < kProgramRegisters; ++i)
            if (!(used_ >> i & 1)) {
                used_ |= 1u << i;
                return int(i);
            }
        return -1;
    }
    void release(int r) {
        for (const int v : values_)
            if (v == r) return; // a named value's register stays
        used_ &= ~(1u << r);
    }

    // The register that holds the node's value; -1 where none is left.
    int emit(u16 index) {
        const Node& node = tree_.nodes[index];
        if (node.call == Call::value) return values_[node.index];
        if (node.call == Call::warp) return emit_warp(node);
        const u16 of[3] = {node.a, node.b, node.c};
        const u32 count = operands_of(node.call);
        u32 order[3] = {0, 1, 2};
        // The hungriest first: it may use what the others will hold.
        std::sort(order, order + count,
                  [&](u32 x, u32 y) { return need_[of[x]] != need_[of[y]] ? need_[of[x]] > need_[of[y]] : x < y; });
        int r[3] = {};
        for (u32 i = 0; i < count; ++i)
            if ((r[order[i]] = emit(of[order[i]])) < 0) return -1;
        const int squared = node.call == Call::cube ? take() : 0;
        if (squared < 0) return -1;
        if (node.call == Call::cube) {
            push(Op::multiply, squared, r[0], r[0]);
            used_ &= ~(1u << squared);
            r[1] = squared;
        } else if (node.call == Call::square) {
            r[1] = r[0];
        }
        for (u32 i = 0; i < count; ++i)
            release(r[i]);
        const int to = take();
        if (to < 0) return -1;
        Instruction& in = push(op_of(node), to, r[0], r[1], r[2]);
        in.k = node.k;
        if (node.call == Call::input) in.a = u8(node.index);
        if (node.call == Call::noise) in.noise = node.index;
        return to;
    }

    int emit_warp(const Node& node) {
        const int x = emit(node.a), z = x < 0 ? -1 : emit(node.b);
        if (z < 0) return -1;
        push(Op::warp, 0, x, z);
        release(x);
        release(z);
        const int r = emit(node.c);
        push(Op::unwarp, 0, 0);
        return r;
    }

    const Tree& tree_;
    std::vector<u32> need_;
    std::vector<int> values_;
    std::vector<Instruction> code_;
    u32 used_ = 0;
};

} // namespace

u16 Tree::add(Node node) {
    const u32 count = operands_of(node.call);
    const auto constant = [&](u16 i) { return nodes[i].call == Call::constant; };
    const bool known = count > 0 && node.call != Call::warp && constant(node.a) && (count < 2 || constant(node.b)) &&
                       (count < 3 || constant(node.c));
    if (known) node = {.call = Call::constant, .k = fold(node.call, nodes[node.a].k, nodes[node.b].k, nodes[node.c].k)};
    nodes.push_back(node);
    return u16(nodes.size() - 1);
}

u16 Tree::add_power(u16 base, u16 exponent) {
    const float n = nodes[exponent].call == Call::constant ? nodes[exponent].k : 0;
    if (n == 1) return base;
    if (n == 2) return add({.call = Call::square, .a = base});
    if (n == 3) return add({.call = Call::cube, .a = base});
    if (n == 4) return add({.call = Call::square, .a = add({.call = Call::square, .a = base})});
    return add({.call = Call::power, .a = base, .b = exponent});
}

Result<std::vector<Instruction>> generate(const Tree& tree) {
    return Generator(tree).run();
}

} // namespace vitrail::expression
