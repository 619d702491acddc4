// Encodes intensities for a screen or a file: exposed, then a tone curve (ToneCurve), then IEC 61966-2-1 (sRGB), or unchanged.
uniform sampler2D sum;
uniform bool is_srgb;
uniform float exposure;
uniform int tone;
out vec4 pixel;

float encoded(float x) {
    float c = clamp(x, 0.0, 1.0);
    return !is_srgb ? c : (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(max(c, 0.0031308), 1.0 / 2.4) - 0.055);
}

vec3 toned(vec3 c) {
    if (tone == 1) return tone_khronos_neutral(c);
    if (tone == 2) return tone_aces(c);
    if (tone == 3) return tone_agx(c);
    if (tone == 4) return tone_reinhard(c);
    return c;
}

void main() {
    vec3 i = exposure * texelFetch(sum, ivec2(gl_FragCoord.xy), 0).rgb;
    if (tone > 0) i = toned(clamp(i, 0.0, 1.0e12));
    pixel = vec4(encoded(i.r), encoded(i.g), encoded(i.b), 1.0);
}
