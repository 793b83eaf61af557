// VX_ASSERT(condition): a bug in Vitrail itself; active in every build, ends the program with file and line.
// Never use it on input from outside: that is a Result (base/result.h).
#pragma once

namespace vitrail {

[[noreturn]] void assertion_failed(const char* expression, const char* file, int line);

} // namespace vitrail

#define VX_ASSERT(expr) (static_cast<bool>(expr) ? void(0) : ::vitrail::assertion_failed(#expr, __FILE__, __LINE__))

#ifdef NDEBUG
#define VX_DEBUG_ASSERT(expr) ((void)0)
#else
#define VX_DEBUG_ASSERT(expr) VX_ASSERT(expr)
#endif
