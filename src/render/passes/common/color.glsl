// sRGB bytes to linear light: a cubic fit of the transfer curve, off by less than 0.002 (no power function a pixel).
vec3 linear_from_srgb(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }
