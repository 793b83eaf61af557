// Automatic exposure, on the GPU alone: nothing is read back. Target "exposure", 1 x 1: the factor by which the tone
// mapping multiplies, and its log2. Without a frame before (the first one, forget, a jump) it is at once what it would
// settle at; else the way to it shrinks exponentially with time, whatever the frame rate.
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

// What the eye does with a mean luminance L (log-average, robust): stops = slope * (log2 reference - log2 L), held.
struct ExposureCurve {
    float reference_log2 = -2.5f;     // log2 of the luminance that is left as it is: land at noon
    float slope = 0.45f;              // 1 would make day of every night
    float least = -1.0f, most = 2.0f; // stops
};
inline constexpr ExposureCurve kExposureCurve;
// Eyes grow used to light faster than to darkness: the factor on Effects::Exposure::speed when exposure falls.
inline constexpr float kFasterToBright = 2.5f;

class ExposurePass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ProgramRef measure_, adapt_;
};

} // namespace vitrail::render
