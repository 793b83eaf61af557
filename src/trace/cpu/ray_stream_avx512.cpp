// Streams of rays through air, 16 lanes wide (AVX-512), several groups of lanes in flight so that their loads overlap.
//
// A lane makes the same steps as next_in_air (trace/kernel/air_walk.h), in float; where float is not sure which plane
// comes first or on which side of a plane the ray is, that lane's step is made by the scalar code instead, in double.
// So cells are the same, always. What was met is told apart by scalar code too, and where a ray passes what is in a
// cell (a plant, a hole between leaves, a slope of water) it queues for lanes again.
//
// Coordinates are mirrored on axes where the ray runs down (~c, and -at), so that all rays run up.
#include "trace/cpu/ray_stream_scalar.h"

#include <immintrin.h>

namespace vitrail::trace::stream {

namespace {

constexpr u32 kLanes = 16, kGroups = 8, kRefillFrom = 5; // lanes idle
constexpr u32 kBlock = 256;                              // rays made ready at once
constexpr float kTieShare = 1e-6f;                       // of a distance: more than two distances' rounding
constexpr float kNearPlane = 1e-6f;                      // blocks a block of distance: more than a position's rounding

// Rays made ready: structure of arrays.
struct alignas(64) Block {
    i32 cell[3][kBlock]; // that the ray starts in
    i32 now[3][kBlock];  // where it is, relative to that
    float at[3][kBlock], dir[3][kBlock];
    float t_max[kBlock];
    u32 id[kBlock], axis[kBlock], looked[kBlock];
    u32 next = 0, count = 0;
};

struct alignas(64) Group {
    __m512i a[3];    // mirrored cell, of the world
    __m512i base[3]; // mirrored cell that the ray starts in, less its own mirrored number (0 or -1)
    __m512i low[3];  // mirrored least cell of what holds anything
    __m512i sign[3]; // -1: mirrored
    __m512 at[3], inverse[3], dir[3];
    __m512 t_max;
    __m512i shift; // of the octant's bits in skip words
    __m512i axis;  // crossed last
    __m512i id;
    // Between the parts of a step.
    __m512i word, mask, bit; // of the brick; half of its cells; which of them
    __mmask16 live = 0, beyond = 0, before = 0;
    __mmask16 fresh = 0;  // stand where they start
    __mmask16 looked = 0; // what is in the cell lets the ray pass
};

// Rays that stopped, to be looked at together; and those that passed, to go on.
template <u32 Room>
struct alignas(64) Places {
    i32 cell[3][Room + kLanes]; // relative to the start, not mirrored
    u32 id[Room + kLanes], axis[Room + kLanes];
    float t_max[Room + kLanes];
    u32 count = 0;
};
constexpr u32 kStoppedMost = 256;
using Stopped = Places<kStoppedMost>;
// New rays are taken when none waits: those that do are no more than are in lanes, made ready and stopped by then.
using Waiting = Places<kBlock + kGroups * kLanes + kStoppedMost + kLanes>;

VX_HD i32 lane_of(const __m512i& v, u32 lane) {
    return reinterpret_cast<const i32*>(&v)[lane];
}
VX_HD float float_of(const __m512& v, u32 lane) {
    return reinterpret_cast<const float*>(&v)[lane];
}
VX_HD void set_lane(__m512i& v, u32 lane, i32 value) {
    reinterpret_cast<i32*>(&v)[lane] = value;
}

// A lane as the scalar walk has it; t of the last plane is not known here.
VX_HD Walk walk_of(const Group& g, u32 lane, const Ray& ray) {
    Walk w = start_walk(ray);
    i32* const to[3] = {&w.x, &w.y, &w.z};
    for (u32 axis = 0; axis < 3; ++axis)
        *to[axis] = (lane_of(g.a[axis], lane) - lane_of(g.base[axis], lane)) ^ lane_of(g.sign[axis], lane);
    w.axis = u32(lane_of(g.axis, lane));
    return w;
}

VX_HD void put_place(Group& g, u32 lane, const AirPlace& p) {
    const i32 r[3] = {p.r.x, p.r.y, p.r.z};
    for (u32 axis = 0; axis < 3; ++axis)
        set_lane(g.a[axis], lane, (r[axis] ^ lane_of(g.sign[axis], lane)) + lane_of(g.base[axis], lane));
    set_lane(g.axis, lane, i32(p.axis));
}

struct Range {
    i32 least[3], size[3]; // cells of the world that can hold anything
};

VX_HD bool out_of(const Range& r, IVec3 c) {
    return u32(c.x) - u32(r.least[0]) >= u32(r.size[0]) || u32(c.y) - u32(r.least[1]) >= u32(r.size[1]) ||
           u32(c.z) - u32(r.least[2]) >= u32(r.size[2]);
}

VX_HD void put_ray(Block& b, const Ray& ray, u32 id, float t_max) {
    const u32 n = b.count++;
    b.cell[0][n] = ray.from.cell.x, b.cell[1][n] = ray.from.cell.y, b.cell[2][n] = ray.from.cell.z;
    b.at[0][n] = ray.from.at.x, b.at[1][n] = ray.from.at.y, b.at[2][n] = ray.from.at.z;
    b.dir[0][n] = ray.dir.x, b.dir[1][n] = ray.dir.y, b.dir[2][n] = ray.dir.z;
    b.now[0][n] = b.now[1][n] = b.now[2][n] = 0;
    b.t_max[n] = t_max;
    b.id[n] = id, b.axis[n] = 3, b.looked[n] = 0;
}

// Rays that wait, then the next of the stream that may go by lanes; others are done at once (`alone`). on_ready(id,
// t_max) may shorten the way; false: the ray is done.
template <class OnReady, class Alone>
VX_HD void make_ready(const Rays& r, u32& from, Waiting& waiting, Block& b, OnReady&& on_ready, Alone&& alone) {
    b.next = b.count = 0;
    while (b.count < kBlock && waiting.count > 0) {
        const u32 i = --waiting.count, n = b.count;
        put_ray(b, r.rays[waiting.id[i]], waiting.id[i], waiting.t_max[i]);
        for (u32 axis = 0; axis < 3; ++axis)
            b.now[axis][n] = waiting.cell[axis][i];
        b.axis[n] = waiting.axis[i], b.looked[n] = 1;
    }
    while (b.count < kBlock && from < r.count) {
        const u32 i = from++;
        if (r.media && r.media[i]) {
            alone(i);
            continue;
        }
        float t_max = t_max_of(r, i);
        if (on_ready(i, t_max)) put_ray(b, r.rays[i], i, t_max);
    }
}

// Idle lanes take rays that are ready.
VX_HD void refill(Group& g, Block& b, const Range& range) {
    const u32 left = b.count - b.next;
    __mmask16 take = __mmask16(~g.live);
    if (u32(__builtin_popcount(take)) > left) take = __mmask16(_pdep_u32((1u << left) - 1, take));
    const u32 n = b.next;
    b.next += u32(__builtin_popcount(take));
    const __m512 least = _mm512_set1_ps(kDirLeast), one = _mm512_set1_ps(1);
    __m512i octant = _mm512_setzero_si512();
    for (u32 axis = 0; axis < 3; ++axis) {
        const __m512i cell = _mm512_maskz_expandloadu_epi32(take, &b.cell[axis][n]);
        __m512 at = _mm512_maskz_expandloadu_ps(take, &b.at[axis][n]);
        const __m512 dir = _mm512_maskz_expandloadu_ps(take, &b.dir[axis][n]);
        __m512 speed = _mm512_abs_ps(dir);
        const __mmask16 moves = _mm512_cmp_ps_mask(speed, least, _CMP_GT_OQ);
        const __mmask16 down = _mm512_mask_cmp_ps_mask(moves, dir, _mm512_setzero_ps(), _CMP_LT_OQ);
        at = _mm512_mask_mov_ps(_mm512_set1_ps(0.5f), moves, at);
        at = _mm512_mask_xor_ps(at, down, at, _mm512_set1_ps(-0.0f));
        speed = _mm512_maskz_mov_ps(moves, speed);
        const __m512 inverse = _mm512_mask_div_ps(_mm512_set1_ps(1e30f), moves, one, speed);
        const __m512i sign = _mm512_movm_epi32(down);
        const __m512i base = _mm512_mask_sub_epi32(cell, down, _mm512_setzero_si512(), cell);
        const __m512i low =
            _mm512_mask_mov_epi32(_mm512_set1_epi32(range.least[axis]), down,
                                  _mm512_set1_epi32(i32(0u - u32(range.least[axis]) - u32(range.size[axis]))));
        g.sign[axis] = _mm512_mask_mov_epi32(g.sign[axis], take, sign);
        g.base[axis] = _mm512_mask_mov_epi32(g.base[axis], take, base);
        g.low[axis] = _mm512_mask_mov_epi32(g.low[axis], take, low);
        const __m512i now = _mm512_maskz_expandloadu_epi32(take, &b.now[axis][n]);
        g.a[axis] = _mm512_mask_add_epi32(g.a[axis], take, base, _mm512_xor_si512(now, sign));
        g.at[axis] = _mm512_mask_mov_ps(g.at[axis], take, at);
        g.dir[axis] = _mm512_mask_mov_ps(g.dir[axis], take, speed);
        g.inverse[axis] = _mm512_mask_mov_ps(g.inverse[axis], take, inverse);
        octant = _mm512_mask_or_epi32(octant, __mmask16(~down), octant, _mm512_set1_epi32(1 << axis));
    }
    static_assert(skip_shift(3) == 3 * 3 + 2);
    g.shift = _mm512_mask_add_epi32(g.shift, take, _mm512_add_epi32(octant, octant),
                                    _mm512_add_epi32(octant, _mm512_set1_epi32(2)));
    g.t_max = _mm512_mask_expandloadu_ps(g.t_max, take, &b.t_max[n]);
    g.id = _mm512_mask_expandloadu_epi32(g.id, take, &b.id[n]);
    g.axis = _mm512_mask_expandloadu_epi32(g.axis, take, &b.axis[n]);
    const __m512i looked = _mm512_maskz_expandloadu_epi32(take, &b.looked[n]);
    g.live = __mmask16(g.live | take);
    g.looked = __mmask16(g.looked | _mm512_test_epi32_mask(looked, looked));
    g.fresh = __mmask16(g.fresh | (take & ~g.looked));
}

struct Events {
    __mmask16 stopped = 0; // in a cell that stops the ray, or starts in such a one
    __mmask16 gone = 0;    // nothing more comes
    __mmask16 before = 0;  // starts outside of the range
    __mmask16 unsure = 0;  // this step is to be made by scalar code
};

// A step in three parts, so that loads of all groups are under way at once. First: the word of each lane's brick.
VX_HD void load_words(Group& g, const GridView& grid, const Range& range) {
    __mmask16 beyond = 0, before = 0;
    __m512i cell[3];
    for (u32 axis = 0; axis < 3; ++axis) {
        const __m512i in = _mm512_sub_epi32(g.a[axis], g.low[axis]);
        beyond = __mmask16(beyond | _mm512_cmpge_epi32_mask(in, _mm512_set1_epi32(range.size[axis])));
        before = __mmask16(before | _mm512_movepi32_mask(in));
        cell[axis] = _mm512_xor_si512(g.a[axis], g.sign[axis]);
    }
    g.beyond = __mmask16(beyond & g.live);
    g.before = __mmask16(before & g.live & ~beyond);
    const __mmask16 on = __mmask16(g.live & ~beyond & ~before);
    const auto bits = [](__m512i v, u32 mask) { return _mm512_and_si512(v, _mm512_set1_epi32(i32(mask))); };
    const auto left = [](__m512i v, u32 by) { return _mm512_sll_epi32(v, _mm_cvtsi32_si128(i32(by))); };
    __m512i byte = bits(cell[0], grid.skip_x);
    byte = _mm512_or_si512(byte, bits(left(cell[2], grid.skip_shift_z), grid.skip_z));
    byte = _mm512_or_si512(byte, bits(left(cell[1], grid.skip_shift_y), grid.skip_y));
    g.word = _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), on, byte, reinterpret_cast<const int*>(grid.skips), 1);
    g.bit = _mm512_or_si512(_mm512_or_si512(bits(cell[0], 3), _mm512_slli_epi32(bits(cell[2], 3), 2)),
                            _mm512_slli_epi32(bits(cell[1], 3), 4));
}

// Second: bricks with anything in them: the half of their mask that has the cell's bit.
VX_HD void load_masks(Group& g, const GridView& grid) {
    const __mmask16 filled = _mm512_movepi32_mask(g.word);
    const __m512i index = _mm512_and_si512(g.word, _mm512_set1_epi32(i32(kBrickPlain - 1)));
    const __m512i at = _mm512_or_si512(_mm512_slli_epi32(index, 1), _mm512_srli_epi32(g.bit, 5));
    g.mask =
        _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), filled, at, reinterpret_cast<const int*>(grid.masks), 4);
}

// Third: the step itself.
VX_HD Events step(Group& g) {
    Events e;
    const __mmask16 on = __mmask16(g.live & ~g.beyond & ~g.before);
    e.gone = g.beyond, e.before = g.before;
    const auto bits = [](__m512i v, u32 mask) { return _mm512_and_si512(v, _mm512_set1_epi32(i32(mask))); };
    const __m512i word = g.word;
    const __mmask16 filled = _mm512_movepi32_mask(word);
    const __mmask16 set =
        _mm512_mask_test_epi32_mask(filled, _mm512_srlv_epi32(g.mask, bits(g.bit, 31)), _mm512_set1_epi32(1));
    e.stopped = __mmask16(set & ~g.looked);
    g.fresh = __mmask16(g.fresh & ~on);
    g.looked = __mmask16(g.looked & ~on);
    __m512i cell[3];

    // The box to leave: a cell, or a cube of empty bricks.
    const __mmask16 wide = __mmask16(~filled);
    const __m512i code = bits(_mm512_srlv_epi32(word, g.shift), 7);
    const __m512i one = _mm512_set1_epi32(1);
    const __m512i far = _mm512_mask_slli_epi32(one, wide, _mm512_add_epi32(code, one), 2);
    const __m512i keep = _mm512_mask_mov_epi32(_mm512_set1_epi32(-1), wide, _mm512_set1_epi32(-4));
    __m512i plane[3];
    __m512 t[3];
    for (u32 axis = 0; axis < 3; ++axis) {
        plane[axis] = _mm512_add_epi32(_mm512_and_si512(g.a[axis], keep), far);
        const __m512 k = _mm512_cvtepi32_ps(_mm512_sub_epi32(plane[axis], g.base[axis]));
        t[axis] = _mm512_mul_ps(_mm512_sub_ps(k, g.at[axis]), g.inverse[axis]);
    }
    const __m512 xy = _mm512_min_ps(t[0], t[1]), later = _mm512_max_ps(t[0], t[1]);
    const __m512 first = _mm512_min_ps(xy, t[2]);
    const __m512 second = _mm512_max_ps(xy, _mm512_min_ps(later, t[2]));
    const __mmask16 by_z = _mm512_cmp_ps_mask(t[2], xy, _CMP_LT_OQ);
    const __mmask16 by_y = __mmask16(_mm512_cmp_ps_mask(t[1], t[0], _CMP_LT_OQ) & ~by_z);
    const __mmask16 by[3] = {__mmask16(~(by_y | by_z)), by_y, by_z};
    __mmask16 unsure =
        _mm512_cmp_ps_mask(_mm512_sub_ps(second, first), _mm512_mul_ps(second, _mm512_set1_ps(kTieShare)), _CMP_NGT_UQ);

    // Where the ray is then, on the other axes.
    const __m512 near = _mm512_mul_ps(_mm512_add_ps(first, _mm512_set1_ps(1)), _mm512_set1_ps(kNearPlane));
    const __mmask16 moving = __mmask16(on & ~e.stopped);
    for (u32 axis = 0; axis < 3; ++axis) {
        const __m512 pos = _mm512_fmadd_ps(g.dir[axis], first, g.at[axis]);
        const __m512 off = _mm512_reduce_ps(pos, 0); // from the nearest integer
        unsure = __mmask16(unsure |
                           _mm512_mask_cmp_ps_mask(__mmask16(wide & ~by[axis]), _mm512_abs_ps(off), near, _CMP_NGT_UQ));
        __m512i to =
            _mm512_add_epi32(_mm512_cvt_roundps_epi32(pos, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC), g.base[axis]);
        to = _mm512_max_epi32(to, g.a[axis]);
        to = _mm512_min_epi32(to, _mm512_sub_epi32(plane[axis], one));
        to = _mm512_mask_mov_epi32(to, by[axis], plane[axis]);
        cell[axis] = to; // taken below
    }
    // The way's end.
    const __m512 end = g.t_max;
    const __mmask16 past = _mm512_cmp_ps_mask(first, _mm512_mul_ps(end, _mm512_set1_ps(1 + kTieShare)), _CMP_GT_OQ);
    const __mmask16 at_end = _mm512_cmp_ps_mask(first, _mm512_mul_ps(end, _mm512_set1_ps(1 - kTieShare)), _CMP_GE_OQ);
    unsure = __mmask16(unsure | (at_end & ~past));
    e.unsure = __mmask16(unsure & moving);
    e.gone = __mmask16(e.gone | (past & moving & ~unsure));
    const __mmask16 go = __mmask16(moving & ~unsure);
    for (u32 axis = 0; axis < 3; ++axis) {
        g.a[axis] = _mm512_mask_mov_epi32(g.a[axis], go, cell[axis]);
        g.axis = _mm512_mask_mov_epi32(g.axis, __mmask16(go & by[axis]), _mm512_set1_epi32(i32(axis)));
    }
    return e;
}

// The step of a lane that is not sure. False: the way ends.
VX_HD bool exact_step(Group& g, u32 lane, const GridView& grid, const Ray& ray, float t_max) {
    const Walk w = walk_of(g, lane, ray);
    const AirPlace p = step_exactly(grid, ray, {{w.x, w.y, w.z}, w.axis, true}, t_max);
    if (p.inside) put_place(g, lane, p);
    return p.inside;
}

// Runs rays by lanes, whose results say "nothing" beforehand. on_stopped(id, cell relative to the start, axis (3: the
// ray starts there), t_max): a cell may stop the ray; false: it goes on. on_ready, alone: of make_ready.
template <class OnStopped, class OnReady, class Alone>
VX_HD void run(const GridView& grid, const Rays& r, OnStopped&& on_stopped, OnReady&& on_ready, Alone&& alone) {
    const Range range{{grid.least.x * 16, grid.least.y * 16, grid.least.z * 16},
                      {i32(grid.extent_x * 16), i32(grid.extent_y * 16), i32(grid.extent_z * 16)}};
    const IVec3 least{range.least[0], range.least[1], range.least[2]},
        size{range.size[0], range.size[1], range.size[2]};
    Block block;
    Stopped stopped;
    Waiting waiting;
    Group groups[kGroups];
    for (Group& g : groups)
        __builtin_memset(static_cast<void*>(&g), 0, sizeof g);
    const auto look = [&] {
        for (u32 i = 0; i < stopped.count; ++i) {
            const i32 cell[3] = {stopped.cell[0][i], stopped.cell[1][i], stopped.cell[2][i]};
            if (on_stopped(stopped.id[i], cell, stopped.axis[i], stopped.t_max[i])) continue;
            const u32 n = waiting.count++;
            for (u32 axis = 0; axis < 3; ++axis)
                waiting.cell[axis][n] = cell[axis];
            waiting.id[n] = stopped.id[i], waiting.axis[n] = stopped.axis[i], waiting.t_max[n] = stopped.t_max[i];
        }
        stopped.count = 0;
    };
    u32 from = 0;
    for (;;) {
        u32 live = 0;
        for (Group& g : groups) {
            if (kLanes - u32(__builtin_popcount(g.live)) >= kRefillFrom) {
                if (block.next == block.count) make_ready(r, from, waiting, block, on_ready, alone);
                if (block.next != block.count) refill(g, block, range);
            }
            live |= g.live;
            load_words(g, grid, range);
        }
        if (live == 0) {
            if (stopped.count == 0) break;
            look();
            continue;
        }
        for (Group& g : groups)
            load_masks(g, grid);
        for (Group& g : groups) {
            const Events e = step(g);
            __mmask16 ended = __mmask16(e.gone | e.stopped);
            if (e.stopped) {
                const u32 n = stopped.count;
                for (u32 axis = 0; axis < 3; ++axis)
                    _mm512_storeu_si512(
                        &stopped.cell[axis][n],
                        _mm512_maskz_compress_epi32(
                            e.stopped, _mm512_xor_si512(_mm512_sub_epi32(g.a[axis], g.base[axis]), g.sign[axis])));
                _mm512_storeu_si512(&stopped.id[n], _mm512_maskz_compress_epi32(e.stopped, g.id));
                _mm512_storeu_si512(&stopped.axis[n], _mm512_maskz_compress_epi32(e.stopped, g.axis));
                _mm512_storeu_ps(&stopped.t_max[n], _mm512_maskz_compress_ps(e.stopped, g.t_max));
                stopped.count += u32(__builtin_popcount(e.stopped));
                if (stopped.count > kStoppedMost) look();
            }
            if (__builtin_expect(e.unsure | e.before, 0)) {
                for (u32 m = e.unsure; m; m &= m - 1) {
                    const u32 lane = u32(__builtin_ctz(m));
                    if (!exact_step(g, lane, grid, r.rays[lane_of(g.id, lane)], float_of(g.t_max, lane)))
                        ended = __mmask16(ended | 1u << lane);
                }
                for (u32 m = e.before; m; m &= m - 1) {
                    const u32 lane = u32(__builtin_ctz(m)), id = u32(lane_of(g.id, lane));
                    Walk w = walk_of(g, lane, r.rays[id]);
                    bool comes = true;
                    while (comes && out_of(range, w.cell()))
                        comes = approach(least, size, r.rays[id], w) && w.t < double(float_of(g.t_max, lane));
                    g.fresh = __mmask16(g.fresh & ~(1u << lane));
                    put_place(g, lane, {{w.x, w.y, w.z}, w.axis, true});
                    if (!comes) ended = __mmask16(ended | 1u << lane);
                }
            }
            g.live = __mmask16(g.live & ~ended);
        }
    }
}

// What a ray through air meets in the cell where it stopped. A call: cubes, the most, need none of it.
__attribute__((noinline)) bool meet_stop(const SceneView& s, const Ray& ray, const Walk& w, float t_max, Hit& hit) {
    if (w.axis == 3 && !looks_in(s, w.cell())) return false;
    CellProgress progress;
    u32 behind;
    Hit met;
    if (!meet_cell(s, ray, w, 0, t_max, progress, met, behind)) return false;
    hit = met;
    return true;
}
__attribute__((noinline)) bool light_stop(const SceneView& s, const Ray& ray, const i32* cell, u32 axis, float t_max,
                                          Lit& lit) {
    Hit met;
    if (!meet_stop(s, ray, walk_in(ray, {cell[0], cell[1], cell[2]}, axis), t_max, met)) return false;
    lit = lit_behind(s, met);
    return true;
}
__attribute__((noinline)) void trace_alone(const SceneView& s, const Rays& r, u32 i, Hit* hits) {
    trace_one(s, r, i, hits);
}
__attribute__((noinline)) void shadow_alone(const SceneView& s, const Rays& r, u32 i, Lit* lit) {
    shadow_one(s, r, i, lit);
}
__attribute__((noinline)) bool boxes_before(const SceneView& s, const Ray& ray, float t_max, bool any, Hit& hit) {
    return meet_boxes(s, ray, t_max, any, hit);
}

} // namespace

void trace_avx512(const SceneView& s, const Rays& r, Hit* hits) {
    run(
        s.grid, r,
        [&](u32 id, const i32* cell, u32 axis, float t_max) {
            const Ray& ray = r.rays[id];
            const Walk w = walk_in(ray, {cell[0], cell[1], cell[2]}, axis);
            const u32 state = state_at(s.grid, w.cell());
            if (s.states[state].kind == CellKind::cube && axis != 3) {
                face_hit(hits[id], w.t, w.cell(), state, w.face(), false);
                return true;
            }
            return meet_stop(s, ray, w, t_max, hits[id]);
        },
        [&](u32 id, float& t_max) {
            hits[id] = Hit{};
            if (s.box_count != 0 && boxes_before(s, r.rays[id], t_max, false, hits[id])) t_max = hits[id].t;
            return true;
        },
        [&](u32 id) { trace_alone(s, r, id, hits); });
}

void shadow_avx512(const SceneView& s, const Rays& r, Lit* lit) {
    run(
        s.grid, r,
        [&](u32 id, const i32* cell, u32 axis, float t_max) {
            const Ray& ray = r.rays[id];
            const IVec3 start = ray.from.cell;
            const IVec3 at{i32(u32(start.x) + u32(cell[0])), i32(u32(start.y) + u32(cell[1])),
                           i32(u32(start.z) + u32(cell[2]))};
            if (s.states[state_at(s.grid, at)].kind == CellKind::cube && axis != 3) {
                lit[id] = Lit::shadow;
                return true;
            }
            return light_stop(s, ray, cell, axis, t_max, lit[id]);
        },
        [&](u32 id, float& t_max) {
            bool dark = false;
            if (s.box_count != 0) {
                Hit box;
                dark = boxes_before(s, r.rays[id], t_max, true, box);
            }
            lit[id] = dark ? Lit::shadow : Lit::open;
            return !dark;
        },
        [&](u32 id) { shadow_alone(s, r, id, lit); });
}

} // namespace vitrail::trace::stream
