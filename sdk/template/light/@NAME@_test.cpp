// Two metres away, a quarter of the light arrives.
#include <cmath>
#include <cstdio>

import candela.core;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    candela::Registry registry({argv[1]});
    candela::ParamSet values = registry.parameters(candela::PluginKind::light, "@NAME@");
    values.set("position", candela::Vec3{0, 2, 0});
    values.set("intensity", 3.0);
    const auto light = registry.create<candela::Light>("@NAME@", values, candela::ColorEncoding::none);

    const float zero = 0, one = 1;
    float out[9] = {};
    light->illuminate(0, {.count = 1, .position = {&zero, &zero, &zero}, .normal = {&zero, &one, &zero}},
                      {.to_light = {out, out + 1, out + 2}, .diffuse = {out + 3, out + 4, out + 5}, .specular = {out + 6, out + 7, out + 8}});
    std::printf("from (%g, %g, %g), %g, expected from (0, 1, 0), 0.75\n", static_cast<double>(out[0]), static_cast<double>(out[1]),
                static_cast<double>(out[2]), static_cast<double>(out[3]));
    return out[1] == 1 && std::abs(out[3] - 0.75f) < 1e-6f ? 0 : 1;
}
