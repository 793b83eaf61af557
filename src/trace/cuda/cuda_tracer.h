// Tracer on CUDA devices: the kernels of the CPU, a thread a path, over a mirror of the same scene. Several devices
// share a picture by bands of rows; the first of them keeps the film.
#pragma once

#include "trace/tracer.h"

namespace vitrail::trace {

// Errors: unsupported (no device, no driver, built without CUDA), limit (memory).
Result<std::unique_ptr<Tracer>> make_cuda_tracer(const TracerOptions& options);

// One line for `vitrail doctor`: what could trace, or why nothing can.
std::string cuda_tracer_summary();

} // namespace vitrail::trace
