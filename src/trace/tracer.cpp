#include "trace/tracer.h"

#include "trace/cpu/cpu_tracer.h"
#include "trace/cuda/cuda_tracer.h"

#include <bit>
#include <fmt/format.h>

namespace vitrail::trace {

Result<std::unique_ptr<Tracer>> Tracer::create(const TracerOptions& options) {
    if (!std::has_single_bit(options.window_chunks) || options.window_chunks < 4 || options.window_chunks > 128)
        return fail(
            ErrorCode::invalid_argument,
            fmt::format("a window of {} chunks: powers of two from 4 to 128 are possible", options.window_chunks));
    if (options.device == Device::cuda) return make_cuda_tracer(options);
    return std::unique_ptr<Tracer>(std::make_unique<CpuTracer>(options));
}

} // namespace vitrail::trace
