// Between a face that looks up and a vertex normal that looks along x, the normal is the diagonal.
#include <cmath>
#include <cstdio>

import candela.core;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    candela::Registry registry({argv[1]});
    const auto model = registry.create<candela::ShadingModel>(
        "@NAME@", registry.parameters(candela::PluginKind::shading, "@NAME@"), candela::ColorEncoding::none);

    const float zero = 0, one = 1;
    float out[3] = {};
    model->normals({.count = 1,
                    .face_normal = {&zero, &one, &zero},
                    .vertex_normal = {&one, &zero, &zero},
                    .barycentric = {&one, &zero, &zero},
                    .uv = {},
                    .dpdu = {},
                    .dpdv = {}},
                   {out, out + 1, out + 2});
    std::printf("(%g, %g, %g), expected (0.7071, 0.7071, 0)\n", static_cast<double>(out[0]), static_cast<double>(out[1]),
                static_cast<double>(out[2]));
    return std::abs(out[0] - std::sqrt(0.5f)) < 1e-6f && std::abs(out[1] - std::sqrt(0.5f)) < 1e-6f ? 0 : 1;
}
