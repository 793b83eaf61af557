#if VITRAIL_CUDA

#include "trace/cuda/gl_share.h"

#include <epoxy/gl.h>
// After epoxy, which stands for GL/gl.h.
#include <cuda_gl_interop.h>

#include <algorithm>

namespace vitrail::trace::cuda {

GlShare::~GlShare() {
    drop();
}

void GlShare::drop() {
    if (resource_) {
        cudaSetDevice(gpu_.id);
        cudaStreamSynchronize(gpu_.stream);
        cudaGraphicsUnregisterResource(resource_);
        glDeleteBuffers(1, &buffer_);
    }
    resource_ = nullptr, buffer_ = 0, bytes_ = 0;
}

// Is the current context on this device?
bool GlShare::shares() const {
    int devices[8];
    unsigned count = 0;
    const bool known = cudaGLGetDevices(&count, devices, 8, cudaGLDeviceListAll) == cudaSuccess;
    (void)cudaGetLastError(); // "no": an answer, not a fault
    return known && std::find(devices, devices + std::min(count, 8u), gpu_.id) != devices + std::min(count, 8u);
}

Result<> GlShare::register_buffer(u64 bytes) {
    drop();
    glCreateBuffers(1, &buffer_);
    glNamedBufferStorage(buffer_, GLsizeiptr(bytes), nullptr, 0);
    const auto done = check(cudaGraphicsGLRegisterBuffer(&resource_, buffer_, cudaGraphicsRegisterFlagsWriteDiscard),
                            "sharing a buffer");
    if (!done) {
        glDeleteBuffers(1, &buffer_);
        buffer_ = 0, resource_ = nullptr;
        (void)cudaGetLastError();
        return done;
    }
    bytes_ = bytes;
    return {};
}

Result<> GlShare::write(u32 texture, const void* pixels, u32 width, u32 height) {
    const u64 bytes = u64(width) * height * 4 * sizeof(float);
    VX_TRY(gpu_.use());
    if (!broken_ && bytes != bytes_) broken_ = !shares() || !register_buffer(bytes);
    if (!broken_) {
        VX_TRY(check(cudaGraphicsMapResources(1, &resource_, gpu_.stream), "mapping the shared buffer"));
        void* to = nullptr;
        std::size_t room = 0;
        auto done = check(cudaGraphicsResourceGetMappedPointer(&to, &room, resource_), "mapping the shared buffer");
        if (done) done = check(cudaMemcpyAsync(to, pixels, bytes, cudaMemcpyDeviceToDevice, gpu_.stream), "showing");
        VX_TRY(check(cudaGraphicsUnmapResources(1, &resource_, gpu_.stream), "unmapping the shared buffer"));
        VX_TRY(done);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer_);
        glTextureSubImage2D(texture, 0, 0, 0, GLsizei(width), GLsizei(height), GL_RGBA, GL_FLOAT, nullptr);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
        return {};
    }
    VX_TRY(host_.reach({}, bytes));
    VX_TRY(check(cudaMemcpyAsync(host_.as(), pixels, bytes, cudaMemcpyDeviceToHost, gpu_.stream), "showing"));
    VX_TRY(gpu_.wait());
    glTextureSubImage2D(texture, 0, 0, 0, GLsizei(width), GLsizei(height), GL_RGBA, GL_FLOAT, host_.as());
    return {};
}

} // namespace vitrail::trace::cuda

#endif
