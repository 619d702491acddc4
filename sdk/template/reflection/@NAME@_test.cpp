// Light from 60 degrees off the normal: half of what kd lets through.
#include <cmath>
#include <cstdio>
#include <vector>

import candela.core;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    candela::Registry registry({argv[1]});
    candela::ParamSet values = registry.parameters(candela::PluginKind::reflection, "@NAME@");
    values.set("kd", 0.8);
    const auto model = registry.create<candela::ReflectionModel>("@NAME@", values, candela::ColorEncoding::none);

    const float zero = 0, one = 1, half = 0.5f, sine = std::sqrt(0.75f);
    float out[9] = {};
    model->reflect({.count = 1, .normal = {&zero, &one, &zero}, .to_observer = {&zero, &one, &zero}, .tangent = {}, .color = {1, 1, 1}},
                   {.to_light = {&sine, &half, &zero}, .diffuse = {&one, &one, &one}, .specular = {&one, &one, &one}},
                   {.ambient = {out, out + 1, out + 2}, .diffuse = {out + 3, out + 4, out + 5}, .specular = {out + 6, out + 7, out + 8}});
    std::printf("diffuse %g, expected 0.4\n", static_cast<double>(out[3]));
    return std::abs(out[3] - 0.4f) < 1e-6f ? 0 : 1;
}
