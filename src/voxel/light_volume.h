// LightVolume: sky and RGB block light of a chunk, 4 bits each, 0 dark to 15 full (docs/decisions/0003-light.md).
#pragma once

#include "base/types.h"
#include "voxel/coords.h"

#include <array>
#include <memory>

namespace vitrail {

// sky | red << 4 | green << 8 | blue << 12
struct Light {
    u16 bits = 0;
    constexpr Light() = default;
    constexpr explicit Light(u16 b)
        : bits(b) {}
    constexpr Light(u32 sky, u32 r, u32 g, u32 b)
        : bits(u16(sky | r << 4 | g << 8 | b << 12)) {}
    constexpr u32 sky() const { return bits & 15; }
    constexpr u32 red() const { return bits >> 4 & 15; }
    constexpr u32 green() const { return bits >> 8 & 15; }
    constexpr u32 blue() const { return bits >> 12; }
    friend constexpr bool operator==(const Light&, const Light&) = default;
};

// Uniform volumes (open sky, deep rock) hold one value; others 8 KiB.
class LightVolume {
public:
    explicit LightVolume(Light fill = Light{})
        : fill_(fill) {}
    LightVolume(const LightVolume& o)
        : fill_(o.fill_)
        , cells_(o.cells_ ? std::make_unique<Cells>(*o.cells_) : nullptr) {}
    LightVolume(LightVolume&&) = default;
    LightVolume& operator=(LightVolume&&) = default;
    LightVolume& operator=(const LightVolume& o) { return *this = LightVolume(o); }

    Light get(LocalPos at) const { return cells_ ? (*cells_)[at.index] : fill_; }
    void set(LocalPos at, Light light) {
        if (!cells_ && light == fill_) return;
        writable()[at.index] = light;
    }
    bool uniform() const { return !cells_; }
    using Cells = std::array<Light, kChunkVolume>;
    // The 4096 cells in LocalPos order; null for a uniform volume, whose value is get(LocalPos()).
    const Cells* cells() const { return cells_.get(); }
    Cells& writable() {
        if (!cells_) {
            cells_ = std::make_unique<Cells>();
            cells_->fill(fill_);
        }
        return *cells_;
    }
    // Becomes uniform where all cells are equal.
    void compact() {
        if (!cells_) return;
        for (const Light& l : *cells_)
            if (!(l == (*cells_)[0])) return;
        fill_ = (*cells_)[0];
        cells_.reset();
    }
    std::size_t memory_bytes() const { return sizeof *this + (cells_ ? sizeof(Cells) : 0); }
    friend bool operator==(const LightVolume& a, const LightVolume& b) {
        for (u32 i = 0; i < kChunkVolume; ++i)
            if (!(a.get(LocalPos(i)) == b.get(LocalPos(i)))) return false;
        return true;
    }

private:
    Light fill_;
    std::unique_ptr<Cells> cells_;
};

} // namespace vitrail
