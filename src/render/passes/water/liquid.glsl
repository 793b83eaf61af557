// Surfaces of liquids: waves, what is seen through them, what they mirror. Needs what water.frag.glsl includes before.
// WAVES: moving normals. SCENE: refraction ("scene" at unit 4, its alpha knows views; layers_at).
// MIRRORS: rays through the screen.
const float kRefraction = 1.333;

// Share of light that a smooth border mirrors (Fresnel, both polarizations). cosine: to the normal, on the side the ray
// comes from; ratio: index of refraction behind it over that before it.
float fresnel(float cosine, float ratio) {
    float g2 = ratio * ratio - 1.0 + cosine * cosine;
    if (g2 <= 0.0) return 1.0; // total
    float g = sqrt(g2);
    float a = (g - cosine) / (g + cosine), b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Microfacets (Trowbridge and Reitz 1975; Walter et al. 2007): share of the sun's light that a rough mirror sends on.
float glint(vec3 n, vec3 to_eye, vec3 to_light, float alpha2) {
    vec3 halfway = normalize(to_eye + to_light);
    float nh = max(dot(n, halfway), 0.0), nl = max(dot(n, to_light), 0.0), nv = max(dot(n, to_eye), 0.05);
    float d = nh * nh * (alpha2 - 1.0) + 1.0;
    float v = 0.5 / (nl * sqrt(alpha2 + (1.0 - alpha2) * nv * nv) + nv * sqrt(alpha2 + (1.0 - alpha2) * nl * nl) + 1e-4);
    return min(alpha2 / (3.14159265 * d * d) * v * nl, 40.0);
}

vec3 ray_of(ViewData view, vec2 uv) { // forward part 1
    vec2 ndc = uv * 2.0 - 1.0;
    return view.ray_forward.xyz + view.ray_right.xyz * ndc.x + view.ray_up.xyz * ndc.y;
}
// What the eye sees at a pixel of the solid picture; far away where it sees the sky.
vec3 place_behind(ViewData view, ivec2 pixel) {
    float depth = texelFetch(t_depth, pixel, 0).r;
    return ray_of(view, (vec2(pixel) + 0.5) * screen.zw) * min(view.fraction.w / max(depth, 1e-9), 4096.0);
}

vec3 wave_normal(vec3 n, vec3 towards, float away, ViewData view, out float variance) {
    variance = 0.0;
#ifdef WAVES
    // A pixel covers more of a surface that is seen at a low angle; half of that is seen across.
    float footprint = away * view.ray_right.w * inversesqrt(max(abs(dot(n, towards)), 0.02));
    bool level = abs(n.y) > 0.5;
    // Falling water: the same waves, running down.
    vec2 at = level ? v_world.xz : vec2(abs(n.x) > 0.5 ? v_world.z : v_world.x, v_world.y + mod(misc.x, 256.0) * 2.0);
    WaveSlope w = wave_slope(at, misc.x, footprint);
    variance = w.variance;
    // A wave that turned away from the eye would mirror the ground.
    if (level) n = normalize(n - vec3(w.slope.x, 0.0, w.slope.y) * sign(n.y) * (n.y > 0.0 ? 1.0 : -1.0));
    else n = normalize(n - (abs(n.x) > 0.5 ? vec3(0.0, w.slope.y, w.slope.x) : vec3(w.slope, 0.0)));
#endif
    return n;
}

struct Blend {
    vec3 color, through; // added; what is left of the light behind
};

Blend shade_liquid(vec3 light_up, vec4 light, vec3 towards, float away, uint number) {
    ViewData view = views[number];
    vec3 flat_normal = surface_normal(v_surface);
    bool leaves = leaves_liquid(v_surface, v_position);
    float variance;
    // The normal on the eye's side.
    vec3 plane = dot(flat_normal, towards) > 0.0 ? -flat_normal : flat_normal;
    vec3 n = wave_normal(plane, towards, away, view, variance);
    float facing = max(-dot(n, towards), 0.02);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    float sky = light.a * light.a;
    float lost = fresnel(facing, leaves ? 1.0 / kRefraction : kRefraction);
    vec3 refracted = refract(towards, n, leaves ? kRefraction : 1.0 / kRefraction);
    vec3 straight = refract(towards, plane, leaves ? kRefraction : 1.0 / kRefraction);

    // What lies behind, along the ray of this pixel or of one that the waves show instead.
    vec3 behind = place_behind(view, pixel);
    vec3 shift = vec3(0.0); // of the light behind
#ifdef SCENE
    vec2 layers = layers_at(pixel);
    // Where another surface lies between, "scene" is not what lies behind this one: it stays where it is.
    bool last = layers.r >= gl_FragCoord.z * 0.9999;
    vec3 bend = leaves ? (refracted - towards) * 2.0 : refracted - straight;
    vec4 to = view.view_proj * vec4(v_position + towards * min(distance(behind, v_position), 6.0)
                                    + bend * min(distance(behind, v_position), 6.0), 1.0);
    ivec2 other = ivec2((to.xy / max(to.w, 1e-3) * 0.5 + 0.5) * screen.xy);
    if (last && to.w > 0.0 && lost < 1.0 && all(greaterThanEqual(other, ivec2(0))) && all(lessThan(other, ivec2(screen.xy)))) {
        // Not what stands before the water or rises out of it, nor what another view shows.
        vec3 place = place_behind(view, other);
        bool good = texelFetch(t_depth, other, 0).r < gl_FragCoord.z && dot(place - v_position, plane) < 0.0;
        vec4 seen = texelFetch(t_scene, other, 0);
        good = good && (uint(seen.a + 0.5) & 7u) == number;
        if (good) {
            shift = seen.rgb - texelFetch(t_scene, pixel, 0).rgb;
            behind = place;
        }
    }
#endif

    vec3 mirror = reflect(towards, n);
    Blend result;
    float alpha2 = 0.0006 + 2.0 * variance;
    // Of the far sides of waterfalls and the like, seen from the air, only the way in is drawn: it knows where they are.
    if (leaves && view.ray_up.w == 0.0) return Blend(vec3(0.0), vec3(1.0));
    if (leaves) {
        // Seen from within: the world above through Snell's window, and around it the water mirrored.
        vec3 inside = view.murk.rgb / (1.0 - kDownwards * min(mirror.y, 0.0));
#ifdef MIRRORS
        vec4 below = march_reflection(v_position + plane * 0.02, mirror, number, noise);
        inside = mix(inside, below.rgb, below.a);
#endif
        result.through = vec3(1.0 - lost);
        result.color = inside * lost + shift * result.through;
        // The sun, drawn out by the waves.
        if (lost < 1.0 && light.a > 0.6)
            result.color += sun_light.rgb * (1.0 - lost) * min(0.02 / (0.002 + alpha2), 6.0)
                          * pow(max(dot(refracted, light_direction.xyz), 0.0), 120.0);
        vec3 covered = vec3(lost);
        result.color = through_medium(result.color, towards, away, number)
                     - (view.ray_up.w > 0.0 ? through_medium(vec3(0.0), towards, away, number) * result.through : vec3(0.0));
        return result;
    }

    Optics optics = water_optics(v_tint);
    vec3 extinction = optics.absorption + optics.scattering;
    float path = min(distance(behind, v_position), 96.0);
#ifdef SCENE
    // The liquid may end before.
    float out_at = view.fraction.w / max(-layers.g, 1e-9), here = view.fraction.w / max(gl_FragCoord.z, 1e-9);
    if (out_at > here * 1.0001) path = min(path, (out_at - here) * (away / here));
#else
    if (abs(plane.y) < 0.5) path = min(path, 1.5); // falling water is thin; what lies behind it has its own surface
#endif
    float down = clamp(-straight.y, -1.0, 1.0);
    vec3 through = exp(-extinction * path);
    vec3 scattered = light_up * scattered_on_way(extinction, optics.scattering, path, down);
    // Levels let light into water by a gray law of one a block; what it truly lets through has more of it, without red.
    float deep = clamp(v_position.y - behind.y, 0.0, 13.0);
    vec3 lit = vec3(inversesqrt(max(1.0 - deep * (1.0 / 15.0), 0.1)));
#ifndef SHADOW_COLOR
    lit *= exp(-extinction * (kDownwards * deep)); // shadow maps with color know the water
#endif
#ifdef CAUSTICS
    if (sky > 0.5) {
        vec3 ground = vec3(view.eye_block.xyz & 255) + view.fraction.xyz + behind;
        lit *= mix(1.0, caustics(ground.xz, deep, misc.x), clamp(light_direction.y * 3.0, 0.0, 1.0) * 0.75);
    }
#endif

    mirror.y = plane.y > 0.5 ? abs(mirror.y) : mirror.y; // what dips below the water comes up again
    vec3 reflected = sky_dome(vec3(mirror.x, max(mirror.y, 0.0), mirror.z)) * sky + light.rgb * (0.02 * (1.0 - sky));
#ifdef MIRRORS
    vec4 seen = march_reflection(v_position + plane * 0.02, mirror, number, noise);
    reflected = mix(reflected, seen.rgb, seen.a);
#endif
    // A film of water mirrors little: shores end softly.
    float film = smoothstep(0.0, 0.35, path);
    float share = lost * mix(0.35, 1.0, film);
    vec3 sun = light.a > 0.85 ? sun_light.rgb * (glint(n, -towards, light_direction.xyz, alpha2) * lost * film) : vec3(0.0);
    result.through = through * (1.0 - share);
    result.color = scattered * (1.0 - share) + reflected * share + sun;
    vec3 covered = max(1.0 - result.through, vec3(1e-3));
    result.color = apply_fog(result.color / covered, away, towards, number, light.a) * covered;
    result.through *= lit;
    result.color += shift * result.through;
    return result;
}
