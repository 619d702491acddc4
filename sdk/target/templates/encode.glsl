// Encodes intensities for a screen or a file: IEC 61966-2-1 (sRGB), or unchanged.
uniform sampler2D sum;
uniform bool is_srgb;
out vec4 pixel;

float encoded(float x) {
    float c = clamp(x, 0.0, 1.0);
    return !is_srgb ? c : (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(max(c, 0.0031308), 1.0 / 2.4) - 0.055);
}

void main() {
    vec3 i = texelFetch(sum, ivec2(gl_FragCoord.xy), 0).rgb;
    pixel = vec4(encoded(i.r), encoded(i.g), encoded(i.b), 1.0);
}
