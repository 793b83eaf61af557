#include "trace/tracer.h"

#include "base/log.h"
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
    if (options.device != Device::cpu) {
        auto tracer = make_cuda_tracer(options);
        if (tracer || options.device == Device::cuda) return tracer;
        if (tracer.error().code != ErrorCode::unsupported) // there is a device, and yet
            log_warning(fmt::format("the CPU traces: {}", tracer.error().message));
    }
    return std::unique_ptr<Tracer>(std::make_unique<CpuTracer>(options));
}

Result<> Tracer::possible_on(Device device) {
    return device == Device::cuda ? cuda_possible() : Result<>();
}

} // namespace vitrail::trace
