// ModelBuilder: quads of one state's model, from boxes and planes given in 1/16 block as if the block faced north and
// stood on a floor, then turned into place.
#pragma once

#include "scene/block_model.h"

#include <array>
#include <string_view>
#include <vector>

namespace vitrail::scene {

// A quad before its texture is packed.
struct BuiltQuad {
    ModelQuad geometry;
    TextureId texture{};
    u8 cull = StateQuad::kNoCull;
    Face facing = Face::up; // nearest axis of the normal
};

struct Span3 {
    float x0 = 0, y0 = 0, z0 = 0, x1 = 16, y1 = 16, z1 = 16; // 1/16 block
};

// Texture up and right of a face in block space (block_model.h).
IVec3 texture_right(Face face);
IVec3 texture_down(Face face);
// Quarter turns after which the top of the picture on `face` points along the axis direction `up`; 0 where it cannot.
u32 turns_towards(Face face, IVec3 up);

class ModelBuilder {
public:
    static constexpr u32 kAllFaces = 63;
    static constexpr u32 face_bit(Face f) { return 1u << u32(f); }

    // Rotations for what is added next, applied in this order.
    void tilt(float degrees, float y, float z); // about the x axis through (y, z): positive leans the top to the north
    enum class Mount { floor, wall, ceiling };
    void mount(Mount m) { mount_ = m; } // wall: what stood on the floor now stands out from a wall to the south
    void turn(float quarters) { turn_ = quarters; } // about the vertical axis, north to east
    void reset();

    // Textures by final direction (by_model: by direction before turning).
    void textures(const std::array<TextureId, 6>& faces, bool by_model = false) {
        faces_ = faces;
        by_model_ = by_model;
    }
    void texture(TextureId all) { faces_.fill(all); }
    // Texture coordinates follow the block (default: pictures line up between blocks) or the model before turning.
    void follow_model(bool yes) { follow_model_ = yes; }
    void mirror(bool yes) { mirror_ = yes; } // s runs the other way, with follow_model

    // The faces of a box. A box flat along an axis becomes one two-sided quad.
    void box(const Span3& b, u32 faces = kAllFaces);
    // One face of a box with its own texture coordinates (corners from the picture's lower left, counterclockwise).
    void box_with_uv(const Span3& b, Face face, const std::array<Vec2, 4>& uv);
    // A plane from (x0, z0) to (x1, z1), y0 to y1, two-sided; the whole width of the texture lies along it.
    void upright(float x0, float z0, float x1, float z1, float y0, float y1, bool unshaded, float s0 = 0,
                 float s1 = 16);
    // A sheet over the cell, texture upright to the north at turn 0; y at the north and south end.
    void sheet(float y_north, float y_south, const Span3& extent = {});
    // Cells of a 2 x 2 x 2 grid, bit x | z << 1 | y << 2, as one body without inner faces.
    void half_cells(u32 occupied);

    const std::vector<BuiltQuad>& quads() const { return quads_; }

private:
    struct Point {
        float x, y, z;
    };
    Point place(Point p, bool direction) const;
    void emit(const std::array<Point, 4>& corners, Point normal, const std::array<Vec2, 4>& model_uv, TextureId texture,
              u8 flags);

    std::vector<BuiltQuad> quads_;
    std::array<TextureId, 6> faces_{};
    bool by_model_ = false, follow_model_ = false, mirror_ = false;
    float tilt_ = 0, tilt_y_ = 0, tilt_z_ = 0, turn_ = 0;
    Mount mount_ = Mount::floor;
};

// The quads of a state whose shape is not a cube or a liquid (block_model_shapes.cpp, all ShapeKinds).
std::vector<BuiltQuad> build_shape(const StateInfo& info, const BlockRegistry& registry);

} // namespace vitrail::scene
