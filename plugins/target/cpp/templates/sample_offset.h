// Where a sample of a light with an extent is for a pixel, within its part of the light: -1/2 to 1/2 in both directions. From
// pixel to pixel, and from sample to sample, these points are as evenly spread as the multiples of the golden ratio (Roberts
// 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"); as integers, so that all programs agree.
vec2 sample_offset(const ShadowPlace& at, int sample) {
    const auto k = static_cast<std::uint32_t>(sample);
    const std::uint32_t u = at.pixel.x * 3679390609u + at.pixel.y * 3152041523u + k * 3242174889u;
    const std::uint32_t v = at.pixel.x * 2700274806u + at.pixel.y * 2313257605u + k * 2447445414u;
    const auto centred = [](std::uint32_t bits) { return static_cast<float>(static_cast<std::int32_t>(bits) >> 8) * 0x1p-24f; };
    return vec2(centred(u), centred(v));
}
