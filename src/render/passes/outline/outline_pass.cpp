#include "render/passes/outline/outline_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> OutlinePass::build(const BuildContext& context) {
    VX_TRY_ASSIGN(program_, context.shaders.program("outline/outline.vert.glsl", "outline/outline.frag.glsl"));
    return {};
}

void OutlinePass::declare(DeclareContext& c) {
    c.graph.add_pass({"outline", {}, {c.color}, [this](const gfx::PassContext&) { draw(); }, "depth"});
}

void OutlinePass::draw() {
    const scene::View& view = frame_->frame->views[0];
    std::vector<Box> boxes; // camera-relative
    for (const scene::Outline& picked : frame_->frame->outlines) {
        if (picked.at.dimension != view.eye.dimension) continue;
        const Vec3 corner = view_from(view.eye.at, picked.at.at).v;
        for (const Box& box : picked.boxes)
            boxes.push_back({corner + box.min, corner + box.max});
    }
    if (boxes.empty()) return;
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    glUseProgram(program_->name());
    glProgramUniform1ui(program_->name(), 0, 0);
    glBindVertexArray(frame_->plain_array);
    for (const Box& box : boxes) {
        glVertexAttrib4f(0, box.min.x, box.min.y, box.min.z, 0);
        glVertexAttrib4f(1, box.max.x, box.max.y, box.max.z, 0);
        glDrawArrays(GL_TRIANGLES, 0, 72);
    }
    glDisable(GL_BLEND);
}

} // namespace vitrail::render
