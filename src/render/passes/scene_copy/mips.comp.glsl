// Smaller levels of a picture, up to five at once: each texel the mean of four. Drivers draw them as triangles, one level
// after the other.
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) uniform sampler2D t_from;
layout(location = 0) uniform ivec2 u_levels; // the level that is there; how many are made
layout(binding = 0, rgba16f) writeonly uniform image2D i_to[5];

shared vec4 s_tile[16][16];

void main() {
    ivec2 group = ivec2(gl_WorkGroupID.xy), local = ivec2(gl_LocalInvocationID.xy);
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = textureSize(t_from, u_levels.x) - 1;
    ivec2 a = min(at * 2, last), b = min(at * 2 + 1, last);
    vec4 mean = 0.25 * (texelFetch(t_from, a, u_levels.x) + texelFetch(t_from, ivec2(b.x, a.y), u_levels.x)
                        + texelFetch(t_from, ivec2(a.x, b.y), u_levels.x) + texelFetch(t_from, b, u_levels.x));
    if (all(lessThan(at, imageSize(i_to[0])))) imageStore(i_to[0], at, mean);
    s_tile[local.y][local.x] = mean;
    for (int k = 1; k < u_levels.y; ++k) {
        barrier();
        int side = 16 >> k;
        bool works = all(lessThan(local, ivec2(side)));
        // In the tile; a side of one texel has no second.
        last = max(imageSize(i_to[k - 1]) - 1 - group * (side * 2), 0);
        a = min(local * 2, ivec2(15)), b = min(min(local * 2 + 1, last), ivec2(15));
        mean = 0.25 * (s_tile[a.y][a.x] + s_tile[a.y][b.x] + s_tile[b.y][a.x] + s_tile[b.y][b.x]);
        barrier();
        if (!works) continue;
        s_tile[local.y][local.x] = mean;
        at = group * side + local;
        if (all(lessThan(at, imageSize(i_to[k])))) imageStore(i_to[k], at, mean);
    }
}
