// VX_ROW before a loop over lanes that do not read what others write: made of vectors, branches as masks.
#pragma once

#ifdef __clang__
#pragma clang diagnostic ignored "-Wpass-failed" // sanitizers keep loops as they are
#define VX_ROW _Pragma("clang loop vectorize(assume_safety)")
#else
#define VX_ROW _Pragma("GCC ivdep")
#endif
