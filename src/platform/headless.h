// OpenGL without a window, through EGL: a hardware device where there is one, else Mesa's software renderer.
#pragma once

#include "base/result.h"

#include <memory>
#include <string>

namespace vitrail::platform {

class HeadlessContext {
public:
    // An OpenGL 4.5 core context, current on the calling thread. The environment variable VITRAIL_GL=software skips
    // hardware. Errors: not_found, where no EGL display gives such a context; the message says what was tried.
    static Result<std::unique_ptr<HeadlessContext>> create(bool debug = false);
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    Result<> make_current();
    void release();                                                 // from this thread
    const std::string& description() const { return description_; } // which EGL platform

private:
    HeadlessContext() = default;
    void* display_ = nullptr;
    void* context_ = nullptr;
    std::string description_;
};

} // namespace vitrail::platform
