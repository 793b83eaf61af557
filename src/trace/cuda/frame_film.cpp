#if VITRAIL_CUDA

#include "trace/cuda/frame_film.h"

namespace vitrail::trace::cuda {

Result<> DeviceFilm::resize(u32 width, u32 height) {
    VX_TRY(gpu_.wait());
    planes_ = {};
    forget();
    VX_TRY(memory_.make(gpu_, film_bytes(width, height)));
    planes_ = film_planes(width, height, memory_.as());
    VX_TRY(check(cudaMemsetAsync(memory_.as(), 0, memory_.size(), gpu_.stream), "clearing the film"));
    for (const FilmGuides* g : {&planes_.now, &planes_.before})
        launch_fill(g->inverse_depth - framed_margin(planes_), film_framed_floats(planes_), kNothing, gpu_.stream);
    return check(cudaGetLastError(), "clearing the film");
}

Result<> DeviceFilm::begin(const Camera& now, const FilmSettings& settings, bool changed) {
    if (now.width != planes_.width || now.height != planes_.height) VX_TRY(resize(now.width, now.height));
    if (frames_) turn_film(planes_);
    frame_ = next_film_frame(frame_, frames_, samples_, now, settings, changed);
    return {};
}

Result<> DeviceFilm::finish() {
    VX_TRY(gpu_.use());
    for (const FilmPass& pass : film_order(frame_))
        launch_film(planes_, frame_, pass, gpu_.stream);
    ++frames_;
    return check(cudaGetLastError(), "filtering");
}

Result<std::vector<float>> DeviceFilm::read(FilmLayer layer) {
    std::vector<float> out(u64(planes_.width) * planes_.height * channels_of(layer));
    if (out.empty()) return out;
    const u64 bytes = out.size() * sizeof(float);
    VX_TRY(layer_.reach(gpu_, bytes));
    VX_TRY(gpu_.use());
    launch_read(planes_, frame_, layer, layer_.as<float>(), gpu_.stream);
    VX_TRY(check(cudaGetLastError(), "reading the film"));
    VX_TRY(check(cudaMemcpyAsync(out.data(), layer_.as(), bytes, cudaMemcpyDeviceToHost, gpu_.stream),
                 "reading the film"));
    VX_TRY(gpu_.wait());
    return out;
}

} // namespace vitrail::trace::cuda

#endif
