// Result<T>: a value or an Error. Expected failures (files, network, scripts, arguments) return it; bugs assert.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace vitrail {

enum class ErrorCode {
    invalid_argument, // the caller's or user's words are wrong
    not_found,        // no such file, record, device, name
    damaged,          // bytes from outside do not parse or fail a checksum
    unsupported,      // well-formed, but a version or feature we do not know
    io,               // the operating system said no: permission, full disk, ...
    busy,             // someone else holds it (a second process on one world)
    limit,            // a budget (size, depth, count, time) would be exceeded
    denied,           // the rules say no
};

struct Error {
    ErrorCode code = ErrorCode::invalid_argument;
    std::string message; // one line, for a person; no trailing full stop or newline
};

template <class T = void>
using Result = tl::expected<T, Error>;

// `return fail(ErrorCode::damaged, "...")` from any function that returns a Result.
inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
    return tl::unexpected<Error>(Error{code, std::move(message)});
}

} // namespace vitrail

// VX_TRY(expr): returns the error of a Result<> from the enclosing function, else goes on.
#define VX_TRY(expr)                                                                                                   \
    do {                                                                                                               \
        auto vx_try_result_ = (expr);                                                                                  \
        if (!vx_try_result_) return tl::unexpected(std::move(vx_try_result_).error());                                 \
    } while (0)

#define VX_CONCAT_INNER(a, b) a##b
#define VX_CONCAT(a, b) VX_CONCAT_INNER(a, b)

// VX_TRY_ASSIGN(auto x, expr): x = value of a Result, or returns its error.
#define VX_TRY_ASSIGN(declaration, expr)                                                                               \
    auto VX_CONCAT(vx_result_, __LINE__) = (expr);                                                                     \
    if (!VX_CONCAT(vx_result_, __LINE__)) return tl::unexpected(std::move(VX_CONCAT(vx_result_, __LINE__)).error());   \
    declaration = std::move(*VX_CONCAT(vx_result_, __LINE__))
