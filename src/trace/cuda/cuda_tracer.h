// Tracer on CUDA devices: the kernels of the CPU, a thread a path, over a mirror of the same scene. Several devices
// share a picture by bands of rows; the first of them keeps the film.
#pragma once

#include "trace/tracer.h"

namespace vitrail::trace {

// Errors: unsupported (no device or one too old, no driver, built without CUDA), limit (memory).
Result<std::unique_ptr<Tracer>> make_cuda_tracer(const TracerOptions& options);

// Could it be made, as far as can be told without taking memory? Errors: unsupported.
Result<> cuda_possible();

// One line for `vitrail doctor`: what could trace, or why nothing can.
std::string cuda_tracer_summary();

} // namespace vitrail::trace
