#include "client/section_feeder.h"

#include "base/clock.h"

#include <algorithm>
#include <iterator>
#include <utility>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace vitrail::client {

// A section that keeps changing while the world streams in is meshed once it has been quiet for this long; when little
// waits (an edit) nothing is delayed.
static constexpr u64 kQuietNs = 60'000'000;
static constexpr u32 kFewSections = 96;
// Bounds of in_flight_most_; at 60 frames a second the least is plenty.
static constexpr u32 kInFlightLeast = 48, kInFlightMost = 512;
static constexpr std::size_t kJobsBetweenClocks = 16;
static constexpr double kBudgetMs = 3, kBudgetShare = 0.08, kBudgetMsMost = 20;

// Bursts of land leave the heap with holes between what stays (messages, snapshots, meshes), a tenth of all memory: its
// pages go back after so many sections, or fewer where nothing more is to do.
static constexpr u64 kUploadsBeforeReturn = 2048, kUploadsBeforeRest = 256;

double feed_budget_ms(double frame_seconds) {
    return std::clamp(frame_seconds * 1000 * kBudgetShare, kBudgetMs, kBudgetMsMost);
}

SectionFeeder::SectionFeeder(render::Renderer& renderer, ThreadPool& pool, std::shared_ptr<const scene::PackLooks> packs)
    : renderer_(renderer), pool_(pool), packs_(std::move(packs)), models_(std::make_unique<scene::BlockModels>(packs_)),
      in_flight_most_(kInFlightLeast) {}

SectionFeeder::~SectionFeeder() { pool_.wait_idle(); }

void SectionFeeder::set_packs(std::shared_ptr<const scene::PackLooks> packs) {
    pool_.wait_idle(); // jobs read the old models
    {
        std::lock_guard lock(shared_->mutex);
        shared_->ready.clear();
    }
    taken_.clear();
    packs_ = std::move(packs);
    models_ = std::make_unique<scene::BlockModels>(packs_);
    renderer_.clear_sections(); // their quads count into the old table
    renderer_.forget_models();
    tints_.clear();
    const u64 now = now_ns();
    in_flight_ = waiting_ = 0;
    waiting_at_.clear();
    for (auto& [at, section] : sections_) {
        section = {};
        mark(at, true, now - kQuietNs);
    }
}

void SectionFeeder::mark(ChunkPos at, bool mesh, u64 now) {
    const auto it = sections_.find(at);
    if (it == sections_.end()) return;
    Section& s = it->second;
    if (!mesh && !s.draws && !s.mesh && !s.in_flight) return;
    if (!s.mesh && !s.light) ++waiting_;
    (mesh ? s.mesh : s.light) = true;
    s.dirty_since_ns = now;
    if (!std::exchange(s.listed, true)) waiting_at_.push_back(at);
}

void SectionFeeder::mark_by_neighbor(ChunkPos at, u64 now) {
    const auto it = sections_.find(at);
    if (it != sections_.end() && !it->second.air) mark(at, true, now);
}

static i64 distance_squared(ChunkPos a, ChunkPos b) {
    const i64 x = i64(a.x) - b.x, y = i64(a.y) - b.y, z = i64(a.z) - b.z;
    return x * x + y * y + z * z;
}

void SectionFeeder::update(replica::Replica& replica, BlockPos eye, double budget_ms) {
    const u64 start = now_ns();
    dimension_ = replica.dimension().info().id;
    for (const replica::DirtySection& dirty : replica.take_dirty()) {
        if (listener_) listener_(dirty);
        if (dirty.what & replica::kGone) {
            const auto it = sections_.find(dirty.at);
            if (it != sections_.end()) {
                waiting_ -= it->second.mesh || it->second.light;
                in_flight_ -= it->second.in_flight;
                sections_.erase(it);
                renderer_.remove_section(dirty.at, dimension_);
            }
            continue; // neighbors keep their meshes: what was hidden by it is out of sight
        }
        if (dirty.what & (replica::kBlocksChanged | replica::kLightChanged)) sections_.try_emplace(dirty.at);
        // The replica names the neighbors whose meshes or light a change reaches, so nothing is widened here.
        if (dirty.what & replica::kBlocksChanged) mark(dirty.at, true, start);
        else if (dirty.what & replica::kBorderBlocks) mark_by_neighbor(dirty.at, start);
        else mark(dirty.at, false, start);
    }
    if (tints_.size() != replica.biomes().size()) {
        tints_.clear();
        for (const std::string& name : replica.biomes().names()) {
            const BiomeDef& biome = replica.registry()->biome_named(name);
            render::BiomeTint tint{biome.grass, biome.foliage, biome.water};
            if (packs_) tint = {packs_->grass(biome).value_or(tint.grass), packs_->foliage(biome).value_or(tint.foliage), tint.water};
            tints_.push_back(tint);
        }
    }
    models_->ensure(*replica.states());
    take_answers();
    if (waiting_ > 0 && meshing_) start_jobs(replica, eye, start, budget_ms / 3);

    renderer_.sync_models(*models_); // meshing may have interned liquid quads
    std::size_t done = 0;
    while (done < taken_.size() && (done == 0 || seconds_since(start) * 1e3 < budget_ms)) upload(taken_[done++]);
    taken_.erase(taken_.begin(), taken_.begin() + std::ptrdiff_t(done));
    const u64 fresh = uploaded_ - uploaded_at_return_;
    if (fresh >= kUploadsBeforeReturn || (fresh >= kUploadsBeforeRest && settled())) return_memory();
}

// A few milliseconds of a worker.
void SectionFeeder::return_memory() {
    uploaded_at_return_ = uploaded_;
#ifdef __GLIBC__
    pool_.submit([] { (void)malloc_trim(0); }, 0);
#endif
}

void SectionFeeder::take_answers() {
    const std::size_t left = taken_.size();
    {
        std::lock_guard lock(shared_->mutex);
        std::move(shared_->ready.begin(), shared_->ready.end(), std::back_inserter(taken_));
        shared_->ready.clear();
    }
    if (left > 0) return; // uploading is what takes longest
    // All made: the workers may have waited for us. Less than half: nearer sections had better not stand in line.
    if (in_flight_ >= in_flight_most_ && taken_.size() >= in_flight_) in_flight_most_ = std::min(in_flight_most_ * 2, kInFlightMost);
    else if (taken_.size() < in_flight_ / 2) in_flight_most_ = std::max(in_flight_most_ / 2, kInFlightLeast);
}

void SectionFeeder::start_jobs(replica::Replica& replica, BlockPos eye, u64 now, double budget_ms) {
    struct Candidate {
        i64 distance;
        ChunkPos at;
        bool operator<(const Candidate& other) const { return distance > other.distance; } // heaps give the nearest
    };
    std::vector<Candidate> candidates;
    const ChunkPos center = chunk_of(eye);
    const bool few = waiting_ <= kFewSections;
    std::erase_if(waiting_at_, [&](ChunkPos at) {
        const auto found = sections_.find(at);
        if (found == sections_.end()) return true;
        Section& s = found->second;
        s.listed = s.mesh || s.light;
        if (!s.listed) return true;
        if (!s.in_flight && (few || now - s.dirty_since_ns >= kQuietNs))
            candidates.push_back({distance_squared(at, center), at});
        return false;
    });
    std::make_heap(candidates.begin(), candidates.end());
    const u64 begin = now_ns();
    for (std::size_t looked = 1; !candidates.empty() && in_flight_ < in_flight_most_; ++looked) {
        if (looked % kJobsBetweenClocks == 0 && seconds_since(begin) * 1e3 > budget_ms) break;
        std::pop_heap(candidates.begin(), candidates.end());
        const auto [distance, at] = candidates.back();
        candidates.pop_back();
        Section& s = sections_[at];
        if ((!s.mesh && !s.light) || s.in_flight) continue; // listed twice: it went and came again
        const bool mesh = std::exchange(s.mesh, false);
        s.light = false;
        --waiting_;
        const ChunkPtr chunk = replica.dimension().find(at);
        if (!chunk) continue;
        render::MeshInput alone;
        alone.chunks[render::MeshInput::kCenter] = chunk.get();
        alone.models = models_.get();
        alone.absent_is_opaque = false; // so that only air draws nothing
        if (mesh && chunk->blocks.uniform() && render::draws_nothing(alone)) {
            render::mesh_section(alone, no_mesh_, scratch_);
            renderer_.set_section(at, dimension_, no_mesh_);
            s.draws = false, s.air = true;
            ++without_job_;
            continue;
        }
        s.in_flight = true, s.air = false;
        ++in_flight_;
        submit(replica, at, s.job = ++jobs_, mesh, distance);
    }
}

void SectionFeeder::submit(const replica::Replica& replica, ChunkPos at, u64 job, bool mesh, i64 priority) {
    std::array<ChunkPtr, 27> around;
    for (i32 dx = -1; dx <= 1; ++dx)
        for (i32 dy = -1; dy <= 1; ++dy)
            for (i32 dz = -1; dz <= 1; ++dz)
                around[render::MeshInput::index(dx, dy, dz)] = replica.dimension().find({at.x + dx, at.y + dy, at.z + dz});
    // Above the dimension there is open air, not the unknown: tops of the highest sections are drawn.
    static const ChunkPtr kOpenAir = [] {
        auto air = std::make_shared<Chunk>();
        air->light = std::make_shared<LightVolume>(Light(15, 0, 0, 0));
        return air;
    }();
    if ((at.y + 1) * 16 >= replica.dimension().info().max_y)
        for (i32 dx = -1; dx <= 1; ++dx)
            for (i32 dz = -1; dz <= 1; ++dz) around[render::MeshInput::index(dx, 1, dz)] = kOpenAir;
    pool_.submit(
        [at, job, mesh, around = std::move(around), models = models_.get(), tints = tints_, shared = shared_] {
            static thread_local render::MeshScratch scratch;
            render::MeshInput input;
            for (std::size_t k = 0; k < 27; ++k) input.chunks[k] = around[k].get();
            input.at = at;
            input.models = models;
            Answer answer;
            answer.at = at;
            answer.job = job;
            answer.has_mesh = mesh;
            if (mesh) render::mesh_section(input, answer.mesh, scratch);
            answer.mesh.quads.shrink_to_fit();
            answer.light_needed = !mesh || !answer.mesh.empty();
            if (answer.light_needed) {
                if (mesh) answer.tints = render::build_tint_grid(input, tints);
                answer.brick = std::make_unique<render::LightBrick>();
                render::build_light_brick(input, *answer.brick);
            }
            std::lock_guard lock(shared->mutex);
            shared->ready.push_back(std::move(answer));
        },
        priority);
}

void SectionFeeder::upload(const Answer& answer) {
    const auto it = sections_.find(answer.at);
    if (it == sections_.end() || it->second.job != answer.job) return; // gone meanwhile
    Section& s = it->second;
    if (s.in_flight) --in_flight_;
    s.in_flight = false;
    if (answer.has_mesh) {
        renderer_.set_section(answer.at, dimension_, answer.mesh);
        s.draws = !answer.mesh.empty();
        ++meshed_;
    }
    if (answer.light_needed && answer.brick && renderer_.has_section(answer.at, dimension_)) {
        renderer_.set_section_light(answer.at, dimension_, *answer.brick);
        if (answer.has_mesh) renderer_.set_section_tints(answer.at, dimension_, answer.tints);
    }
    ++uploaded_;
}

bool SectionFeeder::settled() const {
    std::lock_guard lock(shared_->mutex);
    return (waiting_ == 0 || !meshing_) && in_flight_ == 0 && taken_.empty() && shared_->ready.empty();
}

FeederStats SectionFeeder::stats() const {
    FeederStats s;
    s.waiting = waiting_;
    s.in_flight = in_flight_;
    s.meshed = meshed_;
    s.uploaded = uploaded_;
    s.without_job = without_job_;
    s.in_flight_most = in_flight_most_;
    return s;
}

} // namespace vitrail::client
