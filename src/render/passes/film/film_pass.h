// Shows a picture that was traced (Renderer::show_film) to the passes that follow: light as the color target, distances
// as depth.
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

class FilmPass : public RenderPass {
public:
    void set_film(u32 texture) { film_ = texture; }
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ProgramRef program_;
    u32 film_ = 0;
};

} // namespace vitrail::render
