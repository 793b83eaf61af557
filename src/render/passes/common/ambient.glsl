// Light of the whole sky on a surface that sees all of its hemisphere, by the surface's direction: nine harmonics
// (Ramamoorthi and Hanrahan 2001) with their constants taken in (scene::sky_irradiance is the same in C++).
vec3 sky_irradiance(vec3 n) {
    vec3 sum = sky_sh[0].rgb + sky_sh[1].rgb * n.y + sky_sh[2].rgb * n.z + sky_sh[3].rgb * n.x;
    sum += sky_sh[4].rgb * (n.x * n.y) + sky_sh[5].rgb * (n.y * n.z) + sky_sh[6].rgb * (3.0 * n.z * n.z - 1.0);
    sum += sky_sh[7].rgb * (n.x * n.z) + sky_sh[8].rgb * (n.x * n.x - n.y * n.y);
    return max(sum, vec3(0.0));
}
