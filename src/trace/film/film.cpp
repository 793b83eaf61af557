#include "trace/film/film.h"

#include "trace/film/stages.h"

#include <algorithm>

namespace vitrail::trace {

Film::Film()
    : stages_(&film_stages(best_film_vectors())) {}
Film::~Film() = default;

void Film::resize(u32 width, u32 height) {
    memory_.assign(film_bytes(width, height) / sizeof(float) + 16, 0.0f);
    const auto at = reinterpret_cast<std::uintptr_t>(memory_.data());
    planes_ = film_planes(width, height, memory_.data() + (64 - at % 64) % 64 / sizeof(float));
    for (const FilmGuides* g : {&planes_.now, &planes_.before})
        std::fill_n(g->inverse_depth - framed_margin(planes_), film_framed_floats(planes_), kNothing);
    records_ = {};
    use_records_ = false;
    dropped_ = 0;
    forget();
}

void Film::forget() {
    frames_ = 0;
    samples_ = 0;
}

const Camera& Film::begin(const Camera& now, const FilmSettings& settings, bool changed) {
    settings_ = settings;
    if (now.width != planes_.width || now.height != planes_.height) resize(now.width, now.height);
    if (frames_) turn_film(planes_);
    frame_ = next_film_frame(frame_, frames_, samples_, now, settings, changed);
    use_records_ = false;
    return frame_.now;
}

void Film::put(u32 x, u32 y, const SampleMean& mean) {
    const u32 dropped = put_samples(planes_, frame_, x, y, mean);
    if (dropped) dropped_.fetch_add(dropped, std::memory_order_relaxed);
}

void Film::put(u32 x, u32 y, const PixelSample& sample) {
    SampleMean mean;
    add_sample(mean, sample);
    put(x, y, mean);
}

std::span<PixelSample> Film::frame() {
    records_.resize(std::size_t(planes_.width) * planes_.height);
    use_records_ = true;
    return records_;
}

void Film::finish(ThreadPool* pool) {
    const auto rows = [&](u32 count, u32 step, const auto& body) { // body(first row, end row)
        const u32 blocks = (count + step - 1) / step;
        const auto block = [&](u32 b) { body(b * step, std::min(count, (b + 1) * step)); };
        if (pool && blocks > 1)
            pool->parallel_for(blocks, block);
        else
            for (u32 b = 0; b < blocks; ++b)
                block(b);
    };
    if (use_records_)
        rows(planes_.height, 16, [&](u32 y0, u32 y1) {
            for (u32 y = y0; y < y1; ++y)
                for (u32 x = 0; x < planes_.width; ++x)
                    put(x, y, records_[std::size_t(y) * planes_.width + x]);
        });
    for (const FilmPass& pass : film_order(frame_)) {
        const FilmStage stage = stages_->stages[u32(pass.stage)];
        rows(film_rows(pass.stage, planes_), 8, [&](u32 y0, u32 y1) { stage(planes_, frame_, pass.level, y0, y1); });
    }
    ++frames_;
}

std::span<const Vec4> Film::color() const {
    return {planes_.color, std::size_t(planes_.width) * planes_.height};
}

std::vector<float> Film::albedo() const {
    std::vector<float> out;
    for (u32 i = 0; i < planes_.width * planes_.height; ++i) {
        const Vec4 a = frame_.sum ? planes_.sum_albedo[i] : planes_.albedo[i];
        const float n = frame_.sum ? ratio_or(1, planes_.sum_normal[i].w, 0) : 1;
        out.insert(out.end(), {a.x * n, a.y * n, a.z * n});
    }
    return out;
}

std::vector<float> Film::normal() const {
    std::vector<float> out;
    for (u32 y = 0; y < planes_.height; ++y)
        for (u32 x = 0; x < planes_.width; ++x) {
            const Vec4 s = planes_.sum_normal[level_at(planes_, i32(x), i32(y))];
            const i32 j = framed_at(planes_, i32(x), i32(y));
            const Framed3& g = planes_.now.normal;
            const Vec3 n = normalized(frame_.sum ? Vec3{s.x, s.y, s.z} : Vec3{g.r[j], g.g[j], g.b[j]});
            out.insert(out.end(), {n.x, n.y, n.z});
        }
    return out;
}

std::vector<float> Film::distance() const {
    std::vector<float> out;
    for (u32 i = 0; i < planes_.width * planes_.height; ++i)
        out.push_back(frame_.sum ? mean_of(planes_, i).w : planes_.albedo[i].w);
    return out;
}

std::vector<float> Film::counts() const {
    std::vector<float> out;
    for (u32 y = 0; y < planes_.height; ++y)
        for (u32 x = 0; x < planes_.width; ++x)
            out.push_back(frame_.sum ? planes_.sum[level_at(planes_, i32(x), i32(y))].w
                          : planes_.light.r[framed_at(planes_, i32(x), i32(y))] >= 0 ? 1.0f
                                                                                     : 0.0f);
    return out;
}

} // namespace vitrail::trace
