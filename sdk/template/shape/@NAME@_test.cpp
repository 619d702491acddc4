// Its volume is near that of the ellipsoid, pi / 6 times width^2 height.
#include <cmath>
#include <cstdio>
#include <numbers>

import candela.core;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    candela::Registry registry({argv[1]});
    const auto shape = registry.create<candela::Shape>(
        "@NAME@", registry.parameters(candela::PluginKind::shape, "@NAME@"), candela::ColorEncoding::none);
    const candela::Mesh mesh = candela::place(*shape, {}, {}).mesh;
    const auto p = mesh.position.span();
    float six = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
        six += dot(p[mesh.indices[t]], cross(p[mesh.indices[t + 1]], p[mesh.indices[t + 2]]));
    const float expected = std::numbers::pi_v<float> / 6 * 1.4f;
    std::printf("volume %g, expected %g\n", static_cast<double>(six / 6), static_cast<double>(expected));
    return std::abs(six / 6 - expected) < 0.01f * expected ? 0 : 1;
}
