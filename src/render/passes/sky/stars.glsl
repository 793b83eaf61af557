// Stars on the six faces of a cube that turns with the sky: at most one a cell, kept away from the cell's border, so that
// none is cut; never smaller than a pixel, its light spread instead, so that nothing flickers while the view turns.
uint mixed(uvec3 v) { // three rounds of a multiplicative hash
    uint h = v.x * 0x9E3779B1u ^ v.y * 0x85EBCA77u ^ v.z * 0xC2B2AE3Du;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 12;
    h *= 0x297A2D39u;
    return h ^ h >> 15;
}

vec3 star_color(float t) { // cool to hot
    vec3 warm = mix(vec3(1.0, 0.62, 0.38), vec3(1.0, 0.92, 0.78), smoothstep(0.0, 0.45, t));
    return mix(warm, vec3(0.66, 0.78, 1.0), smoothstep(0.45, 1.0, t));
}

// d: direction in the sky's own frame; cells: a side of a cube's face; share: of cells that hold a star; edge: radians of
// a pixel; twinkle: 0..1.
vec3 star_layer(vec3 d, float cells, float share, float edge, float twinkle, uint seed) {
    vec3 a = abs(d);
    float most = max(a.x, max(a.y, a.z));
    uint face;
    vec2 uv;
    if (most == a.x) { face = d.x > 0.0 ? 0u : 1u; uv = d.yz; }
    else if (most == a.y) { face = d.y > 0.0 ? 2u : 3u; uv = d.xz; }
    else { face = d.z > 0.0 ? 4u : 5u; uv = d.xy; }
    uv = uv / most * 0.5 + 0.5;
    vec2 cell = min(floor(uv * cells), cells - 1.0);
    uint h = mixed(uvec3(uvec2(cell), face + seed * 8u));
    if (float(h & 0xffffu) * (1.0 / 65536.0) >= share) return vec3(0.0);
    uint k = mixed(uvec3(h, h >> 7, 17u));
    vec2 at = (cell + 0.25 + 0.5 * vec2(float(k & 255u), float(k >> 8 & 255u)) * (1.0 / 255.0)) / cells * 2.0 - 1.0;
    float side = (face & 1u) == 0u ? 1.0 : -1.0;
    vec3 star = normalize(face < 2u ? vec3(side, at) : face < 4u ? vec3(at.x, side, at.y) : vec3(at, side));
    float magnitude = float(k >> 16 & 255u) * (1.0 / 255.0);
    float bright = magnitude * magnitude;
    bright *= bright;
    bright = 0.02 + bright * bright * 1.4; // few are bright
    float width = max(0.0008 + 0.0005 * bright, edge * 0.5);
    vec3 off = d - star;
    float light = bright * (0.0011 * 0.0011) / (width * width) * exp(-dot(off, off) / (2.0 * width * width));
    light *= 1.0 + twinkle * sin(misc.x * (2.0 + 3.0 * float(k >> 20 & 15u) * (1.0 / 15.0)) + float(h >> 16));
    return star_color(float(k >> 24) * (1.0 / 255.0)) * light;
}

// Radiance of all stars and of the milky way in a direction of the world.
vec3 stars_at(vec3 d, float turn, float edge, sampler2D noise) {
    // About the pole by the hour, then stars' own frame: x, y in the plane of the sun's path, z the pole.
    vec3 pole = sky_pole.xyz;
    vec3 y = vec3(0.0, pole.z, -pole.y);
    vec2 flat_part = vec2(d.x, dot(d, y));
    float s = sin(turn), c = cos(turn);
    vec3 own = vec3(flat_part.x * c + flat_part.y * s, flat_part.y * c - flat_part.x * s, dot(d, pole));
    // The milky way lies askew to the sun's path.
    const vec3 galaxy = vec3(0.36, 0.48, 0.80), center = vec3(-0.8, 0.6, 0.0);
    float latitude = dot(own, galaxy), along = dot(own, center);
    float band = exp(-latitude * latitude * 16.0);
    vec2 p = vec2(atan(dot(own, cross(galaxy, center)), along) * 0.318309886, latitude);
    float cloudy = textureLod(noise, p * vec2(3.0, 1.3), 2.0).r * 0.6 + textureLod(noise, p * vec2(9.0, 4.1) + 0.3, 1.0).r * 0.4;
    float rift = smoothstep(0.10, 0.0, abs(latitude + 0.05 * (cloudy - 0.5))) * smoothstep(0.42, 0.62, cloudy);
    float core = 0.55 + 0.45 * along;
    float glow = band * band * (0.25 + 1.2 * cloudy * cloudy) * core * (1.0 - 0.72 * rift);
    vec3 sum = mix(vec3(0.55, 0.70, 1.05), vec3(1.05, 0.86, 0.72), core * core * band) * (glow * 0.012);
    float twinkle = 0.10 + 0.25 * (1.0 - clamp(d.y * 3.0, 0.0, 1.0));
    sum += star_layer(own, 40.0, 0.24, edge, twinkle, 1u) * 2.6;
    sum += star_layer(own, 104.0, 0.16 + 0.50 * band * (1.0 - rift), edge, twinkle * 0.5, 2u) * 0.5;
    // Low ones shine through more air.
    return sum * (2.0 * smoothstep(-0.01, 0.22, d.y));
}
