// The two queues: withdrawal takes what came from a lost source, spread refills from what stays. Each cell carries its
// four channels together; a channel that does not change costs nothing more.
#include "light/light_field.h"

namespace vitrail {

void LightField::run_withdrawal() {
    for (std::size_t head = 0; head < withdrawn.size(); ++head) {
        const Withdrawn from = withdrawn[head];
        const i32 own = i32(from.cell >> 12);
        const u32 index = from.cell & 4095;
        const u32 taken_lanes = lanes_lit(from.light);
        for (u32 face = 0; face < 6; ++face) {
            bool crosses;
            const u32 next = step_index(index, face, crosses);
            i32 to = own;
            if (crosses && (to = beside(own, face)) == kNone) continue;
            Slot* s = &slots_[std::size_t(to)];
            if (s->pending) continue;
            const u32 has = spread_light(s->cells ? s->cells[next] : s->now->get(LocalPos(next))) & taken_lanes;
            if (!has) continue;
            const u32 cost = s->costs ? s->costs[next] & kCostBits : cost_of(*s, next);
            const u32 came = lanes_less(from.light, cost);
            // Equal: it came from here, perhaps only from here. More: it has another source, which can refill the dark.
            const u32 equal = lanes_equal(has, came) & lanes_lit(has);
            if (lanes_minus(has, came)) rising.push_back(u32(to) << 12 | next);
            if (!equal) continue;
            if (!s->cells) {
                open(to);
                s = &slots_[std::size_t(to)];
            }
            u32 left = spread_light(s->cells[next]) & ~equal;
            if (s->costs[next] & kEmits) {
                const u32 own_light = emission_of(*s, next) & equal;
                left |= own_light;
                if (own_light) rising.push_back(u32(to) << 12 | next);
            }
            s->cells[next] = pack_light(left);
            withdrawn.push_back({u32(to) << 12 | next, has & equal});
        }
    }
    withdrawn.clear();
}

void LightField::run_spread() {
    for (std::size_t head = 0; head < rising.size(); ++head) {
        const u32 cell = rising[head];
        const i32 own = i32(cell >> 12);
        const u32 index = cell & 4095;
        const Slot& from = slots_[std::size_t(own)];
        const u32 light = spread_light(from.cells ? from.cells[index] : from.now->get(LocalPos(index)));
        const u32 most = lanes_less(light, 1);
        if (!most) continue;
        for (u32 face = 0; face < 6; ++face) {
            bool crosses;
            const u32 next = step_index(index, face, crosses);
            i32 to = own;
            if (crosses && (to = beside(own, face)) == kNone) continue;
            Slot* s = &slots_[std::size_t(to)];
            if (s->pending) continue;
            const u32 has = spread_light(s->cells ? s->cells[next] : s->now->get(LocalPos(next)));
            if (!lanes_minus(most, has)) continue;
            const u32 cost = s->costs ? s->costs[next] & kCostBits : cost_of(*s, next);
            const u32 raised = lanes_max(lanes_less(light, cost), has);
            if (raised == has) continue;
            if (!s->cells) {
                open(to);
                s = &slots_[std::size_t(to)];
            }
            s->cells[next] = pack_light(raised);
            rising.push_back(u32(to) << 12 | next);
        }
    }
    rising.clear();
}

u32 LightField::inflow(i32 own, u32 index, u32 cost, u32 least) {
    for (u32 face = 0; face < 6; ++face) {
        bool crosses;
        const u32 next = step_index(index, face, crosses);
        i32 from = own;
        if (crosses && (from = beside(own, face)) == kNone) continue;
        const Slot& s = slots_[std::size_t(from)];
        if (s.pending) continue;
        least = lanes_max(lanes_less(spread_light(s.now->get(LocalPos(next))), cost), least);
    }
    return least;
}

void LightField::gather(i32 own, u32 index) {
    const Slot& s = slots_[std::size_t(own)];
    const u32 most = inflow(own, index, s.costs[index] & kCostBits, spread_light(s.cells[index]));
    slots_[std::size_t(own)].cells[index] = pack_light(most);
}

void LightField::withdraw_unsupported(i32 own, u32 face) {
    const LightVolume* now = slots_[std::size_t(own)].now;
    if (now->uniform() && (now->get(LocalPos()).bits == 0 || now->get(LocalPos()) == Light(15, 0, 0, 0))) return;
    for (u32 i = 0; i < 256; ++i) {
        const u32 a = i & 15, b = i >> 4, end = face & 1 ? 15 : 0;
        const u32 index = face < 2 ? end | a << 4 | b << 8 : face < 4 ? i | end << 8 : a | end << 4 | b << 8;
        const u32 has = spread_light(slots_[std::size_t(own)].now->get(LocalPos(index)));
        // Full sky light is the open sky's own.
        if ((has & ~kSkyLane) == 0 && (has == 0 || has == kSkyFull)) continue;
        const Slot& s = slots_[std::size_t(own)];
        u32 held = emission_of(s, index);
        if ((has & kSkyLane) == kSkyFull) held |= kSkyFull;
        const u32 cost = cost_of(s, index);
        const u32 lost = lanes_lit(lanes_minus(has, inflow(own, index, cost, held)));
        if (!lost) continue;
        open(own);
        slots_[std::size_t(own)].cells[index] = pack_light((has & ~lost) | (held & lost));
        withdrawn.push_back({u32(own) << 12 | index, has & lost});
        rising.push_back(u32(own) << 12 | index);
    }
}

} // namespace vitrail
