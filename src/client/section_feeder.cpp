#include "client/section_feeder.h"

#include "base/clock.h"

#include <algorithm>

namespace vitrail::client {

// A section that keeps changing while the world streams in is meshed once it has been quiet for this long; when little
// waits (an edit) nothing is delayed.
static constexpr u64 kQuietNs = 60'000'000;
static constexpr u32 kFewSections = 96;
static constexpr u32 kMostInFlight = 48;

SectionFeeder::SectionFeeder(render::Renderer& renderer, ThreadPool& pool) : renderer_(renderer), pool_(pool) {}

SectionFeeder::~SectionFeeder() { pool_.wait_idle(); }

void SectionFeeder::mark(ChunkPos at, bool mesh, u64 now) {
    const auto it = sections_.find(at);
    if (it == sections_.end()) return;
    Section& s = it->second;
    if (!s.mesh && !s.light) ++waiting_;
    (mesh ? s.mesh : s.light) = true;
    s.dirty_since_ns = now;
}

static i64 distance_squared(ChunkPos a, ChunkPos b) {
    const i64 x = i64(a.x) - b.x, y = i64(a.y) - b.y, z = i64(a.z) - b.z;
    return x * x + y * y + z * z;
}

void SectionFeeder::update(replica::Replica& replica, BlockPos eye, double budget_ms) {
    const u64 start = now_ns();
    dimension_ = replica.dimension().info().id;
    for (const replica::DirtySection& dirty : replica.take_dirty()) {
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
        if (dirty.what & (replica::kBlocksChanged | replica::kBorderBlocks)) mark(dirty.at, true, start);
        else mark(dirty.at, false, start);
    }
    if (tints_.size() != replica.biomes().size()) {
        tints_.clear();
        for (const std::string& name : replica.biomes().names()) {
            const BiomeDef& biome = replica.registry()->biome_named(name);
            tints_.push_back({biome.grass, biome.foliage, biome.water});
        }
    }
    models_.ensure(*replica.states());
    if (waiting_ > 0) start_jobs(replica, eye, start);

    if (taken_.empty()) {
        std::lock_guard lock(shared_->mutex);
        taken_.swap(shared_->ready);
    }
    renderer_.sync_models(models_); // meshing may have interned liquid quads
    std::size_t done = 0;
    while (done < taken_.size() && (done == 0 || seconds_since(start) * 1e3 < budget_ms)) upload(taken_[done++]);
    taken_.erase(taken_.begin(), taken_.begin() + std::ptrdiff_t(done));
}

void SectionFeeder::start_jobs(replica::Replica& replica, BlockPos eye, u64 now) {
    if (in_flight_ >= kMostInFlight) return;
    struct Candidate {
        i64 distance;
        ChunkPos at;
    };
    std::vector<Candidate> candidates;
    const ChunkPos center = chunk_of(eye);
    const bool few = waiting_ <= kFewSections;
    for (const auto& [at, s] : sections_) {
        if ((!s.mesh && !s.light) || s.in_flight) continue;
        if (!few && now - s.dirty_since_ns < kQuietNs) continue;
        candidates.push_back({distance_squared(at, center), at});
    }
    const std::size_t room = std::min<std::size_t>(kMostInFlight - in_flight_, candidates.size());
    std::partial_sort(candidates.begin(), candidates.begin() + std::ptrdiff_t(room), candidates.end(),
                      [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    for (std::size_t i = 0; i < room; ++i) {
        const ChunkPos at = candidates[i].at;
        Section& s = sections_[at];
        std::array<ChunkPtr, 27> around;
        for (i32 dx = -1; dx <= 1; ++dx)
            for (i32 dy = -1; dy <= 1; ++dy)
                for (i32 dz = -1; dz <= 1; ++dz)
                    around[render::MeshInput::index(dx, dy, dz)] = replica.dimension().find({at.x + dx, at.y + dy, at.z + dz});
        --waiting_;
        if (!around[render::MeshInput::kCenter]) {
            s.mesh = s.light = false;
            continue;
        }
        const bool mesh = s.mesh;
        s.mesh = s.light = false;
        s.in_flight = true;
        ++in_flight_;
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
            [at, mesh, around = std::move(around), models = &models_, tints = tints_, shared = shared_] {
                static thread_local render::MeshScratch scratch;
                render::MeshInput input;
                for (std::size_t k = 0; k < 27; ++k) input.chunks[k] = around[k].get();
                input.models = models;
                Answer answer;
                answer.at = at;
                answer.has_mesh = mesh;
                if (mesh) {
                    render::mesh_section(input, answer.mesh, scratch);
                    answer.mesh.quads.shrink_to_fit();
                    answer.tints = render::build_tint_grid(input, tints);
                }
                answer.light_needed = !mesh || !answer.mesh.empty();
                if (answer.light_needed) {
                    answer.brick = std::make_unique<render::LightBrick>();
                    render::build_light_brick(input, *answer.brick);
                }
                std::lock_guard lock(shared->mutex);
                shared->ready.push_back(std::move(answer));
            },
            candidates[i].distance);
    }
}

void SectionFeeder::upload(const Answer& answer) {
    const auto it = sections_.find(answer.at);
    if (it == sections_.end()) return; // gone meanwhile
    Section& s = it->second;
    if (s.in_flight) --in_flight_;
    s.in_flight = false;
    if (answer.has_mesh) {
        renderer_.set_section(answer.at, dimension_, answer.mesh);
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
    return waiting_ == 0 && in_flight_ == 0 && taken_.empty() && shared_->ready.empty();
}

FeederStats SectionFeeder::stats() const {
    FeederStats s;
    s.waiting = waiting_;
    s.in_flight = in_flight_;
    s.meshed = meshed_;
    s.uploaded = uploaded_;
    return s;
}

} // namespace vitrail::client
