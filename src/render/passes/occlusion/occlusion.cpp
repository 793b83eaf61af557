#include "render/passes/occlusion/occlusion.h"

#include <algorithm>
#include <cstring>
#include <epoxy/gl.h>

namespace vitrail::render {

// A box this near to the eye may be cut by the near plane: its section counts as seen.
static constexpr float kNear = 0.4f;
static constexpr u32 kAlways = 1u << 31; // of a slot: do not test
static constexpr u32 kGroup = 64;        // threads of a compute group

Occlusion::~Occlusion() {
    for (void* fence : fences_)
        if (fence) glDeleteSync(static_cast<GLsync>(fence));
}

Result<> Occlusion::build(const BuildContext& context) {
    if (!context.effects.culling.occlusion) return {};
    VX_TRY_ASSIGN(first_, context.shaders.compute_program("occlusion/first.comp.glsl"));
    VX_TRY_ASSIGN(boxes_, context.shaders.program("occlusion/boxes.vert.glsl", "occlusion/boxes.frag.glsl"));
    VX_TRY_ASSIGN(late_, context.shaders.compute_program("occlusion/late.comp.glsl"));
    if (!counts_) {
        counts_ = gfx::make_buffer(sizeof(Counts), GL_DYNAMIC_STORAGE_BIT);
        const u32 flags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        answers_ = gfx::make_buffer(kAnswers * sizeof(Counts), flags);
        answers_mapped_ =
            static_cast<const Counts*>(glMapNamedBufferRange(answers_.name(), 0, kAnswers * sizeof(Counts), flags));
    }
    return {};
}

// At least this large, zero from the start; what it held is kept.
static void reserve_zeroed(gfx::Buffer& buffer, u64 bytes) {
    if (buffer.bytes >= bytes) return;
    gfx::Buffer larger = gfx::make_buffer(std::max<u64>(bytes, buffer.bytes * 2), GL_DYNAMIC_STORAGE_BIT);
    glClearNamedBufferData(larger.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    if (buffer) glCopyNamedBufferSubData(buffer.name(), larger.name(), 0, 0, GLsizeiptr(buffer.bytes));
    buffer = std::move(larger);
}

void Occlusion::take_answers(FrameStats& stats) {
    for (u32 k = 0; k < kAnswers; ++k) { // oldest first
        const u32 i = (next_answer_ + k) % kAnswers;
        if (!fences_[i]) continue;
        const auto fence = static_cast<GLsync>(fences_[i]);
        if (glClientWaitSync(fence, 0, 0) == GL_TIMEOUT_EXPIRED) continue;
        glDeleteSync(fence);
        fences_[i] = nullptr;
        if (answers_mapped_) last_ = answers_mapped_[i], answered_ = true;
    }
    if (!answered_) return;
    stats.sections_visible = std::min(last_.sections, stats.sections_in_sight);
    stats.draws = last_.draws, stats.quads = last_.quads;
}

void Occlusion::prepare(FrameContext& frame, ViewDraws& draws) {
    draws.occlusion = false;
    ++now_;
    records_ = u32(draws.list.records.size());
    if (records_ == 0 || !late_) return;
    take_answers(*frame.stats);
    draws.occlusion = true;

    const auto slots = frame.ring->allocate(records_ * sizeof(u32), 256);
    auto* out = reinterpret_cast<u32*>(slots.data);
    const Vec4 f = frame.uniforms.views[0].fraction;
    for (u32 i = 0; i < records_; ++i) {
        const VisibleSection& v = draws.visible[i];
        const float reach = kSectionReach + kNear;
        const auto near = [reach](i32 offset, float fraction) {
            const float least = float(offset) - fraction;
            return least - reach < 0 && least + float(kChunkSize) + reach > 0;
        };
        const bool always = near(v.offset.x, f.x) && near(v.offset.y, f.y) && near(v.offset.z, f.z);
        out[i] = v.section->slot | (always ? kAlways : 0);
    }
    slots_ = slots.buffer, slots_offset_ = slots.offset;
    reserve_zeroed(seen_, u64(frame.sections->slot_count()) * sizeof(u32));

    command_count_ = 0;
    for (const auto& commands : draws.list.commands)
        command_count_ += u32(commands.size());
    const u64 list_bytes = (command_count_ * sizeof(DrawCommand) + 255) & ~u64(255);
    list_words_ = u32(list_bytes / 4);
    if (commands_.bytes < 3 * list_bytes)
        commands_ = gfx::make_buffer(std::max(3 * list_bytes, commands_.bytes * 2), 0);
    source_ = draws.inputs.commands, source_offset_ = draws.inputs.ranges[0].offset;
    const auto list = [&](u32 number) {
        TerrainInputs in = draws.inputs;
        in.commands = commands_.name();
        for (auto& range : in.ranges)
            range.offset = range.offset - source_offset_ + number * list_bytes;
        return in;
    };
    draws.first = list(0), draws.late = list(1), draws.inputs = list(2);

    const auto bind = [](u32 index, u32 buffer, u64 offset, u64 bytes) {
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, index, buffer, GLintptr(offset), GLsizeiptr(bytes));
    };
    bind(0, source_, source_offset_, command_count_ * sizeof(DrawCommand));
    bind(1, commands_.name(), 0, 3 * list_bytes);
    bind(4, slots_, slots_offset_, records_ * sizeof(u32));
    bind(5, seen_.name(), 0, seen_.bytes);
    glUseProgram(first_->name());
    glProgramUniform2ui(first_->name(), 0, command_count_, now_);
    glDispatchCompute((command_count_ + kGroup - 1) / kGroup, 1, 1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void Occlusion::test(const FrameContext& frame, const ViewDraws& draws) {
    const auto bind = [](u32 index, u32 buffer, u64 offset, u64 bytes) {
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, index, buffer, GLintptr(offset), GLsizeiptr(bytes));
    };
    bind_terrain(draws.first);
    bind(4, slots_, slots_offset_, records_ * sizeof(u32));
    bind(5, seen_.name(), 0, seen_.bytes);
    if (frame.stencil) { // where other views are seen their depth stands
        glEnable(GL_STENCIL_TEST);
        glStencilFunc(GL_EQUAL, 0, 0xff);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    }
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glDepthMask(GL_FALSE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDisable(GL_CULL_FACE);
    glUseProgram(boxes_->name());
    glProgramUniform1ui(boxes_->name(), 0, now_);
    glDrawArraysInstanced(GL_TRIANGLES, 0, 18, GLsizei(records_));
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    glDisable(GL_STENCIL_TEST);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    const Counts zero{};
    glNamedBufferSubData(counts_.name(), 0, sizeof zero, &zero);
    bind(0, source_, source_offset_, command_count_ * sizeof(DrawCommand));
    bind(1, commands_.name(), 0, commands_.bytes);
    bind(2, counts_.name(), 0, sizeof(Counts));
    glUseProgram(late_->name());
    glProgramUniform4ui(late_->name(), 0, command_count_, now_, list_words_, records_);
    glDispatchCompute((std::max(command_count_, records_) + kGroup - 1) / kGroup, 1, 1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);

    if (fences_[next_answer_]) return; // the GPU is far behind: this frame is not counted
    glCopyNamedBufferSubData(counts_.name(), answers_.name(), 0, GLintptr(next_answer_ * sizeof(Counts)),
                             sizeof(Counts));
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    fences_[next_answer_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    next_answer_ = (next_answer_ + 1) % kAnswers;
}

} // namespace vitrail::render
