// Mirror reflections of smooth solid surfaces (ice, glazed and polished stone, metal): rays through the screen, the sky
// where they find nothing. Drawn over the lit picture before what is translucent, reading the copy "scene".
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

class ReflectionsPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ProgramRef program_;
};

// What includes ssr/ssr.glsl is built with these.
std::vector<std::string> march_defines(const Effects& effects);

} // namespace vitrail::render
