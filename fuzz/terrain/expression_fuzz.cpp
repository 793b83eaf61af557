// Any text as an expression: never a crash, and what compiles runs, with its own registers alone.
#include "base/assert.h"
#include "terrain/compile/expression.h"
#include "terrain/kernel/program_kernel.h"

#include <memory>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace vitrail;
    static const auto tables = std::make_unique<TerrainTables>();
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    TableBuilder builder(*tables); // begins anew: what stood there is overwritten
    builder.inputs = {"wet", "cold"};
    (void)parse_fractal(text, "fuzz");
    const auto program = compile_expression(text, "fuzz", builder);
    if (!program) {
        VX_ASSERT(!program.error().message.empty());
        return 0;
    }
    for (u32 i = program->first; i < u32(program->first) + program->count; ++i) {
        const Instruction& in = tables->instruction[i];
        VX_ASSERT(in.to < kProgramRegisters && in.a < kProgramRegisters && in.b < kProgramRegisters &&
                  in.c < kProgramRegisters);
    }
    const float inputs[kInputs] = {0.25f, -3.0f};
    (void)run_program<ScalarLanes>(*tables, *program, {2147483632, -512, 3, 60, 15}, inputs);
    return 0;
}
