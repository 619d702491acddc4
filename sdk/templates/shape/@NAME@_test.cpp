#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cstddef>
#include <numbers>

import candela.core;

using Catch::Matchers::WithinRel;

TEST_CASE("its volume is nearly that of the ellipsoid, pi / 6 times width^2 height") {
    candela::Registry registry({CANDELA_PLUGIN_DIR});
    const auto shape = registry.create<candela::Shape>(
        "@NAME@", registry.parameters(candela::PluginKind::shape, "@NAME@"), candela::ColorEncoding::none);
    const candela::Mesh mesh = candela::place(*shape, {}, {}).mesh;
    const auto p = mesh.position.span();
    float six = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
        six += dot(p[mesh.indices[t]], cross(p[mesh.indices[t + 1]], p[mesh.indices[t + 2]]));
    CHECK_THAT(six / 6, WithinRel(std::numbers::pi / 6 * 1.4, 0.01));
}
