#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

namespace {

Double3 mirrored(Double3 n, Double3 l) { return 2 * dot(n, l) * n - l; }

/// A material that shows max(R.V, 0) itself: k_s 1, shininess 1, no diffuse light.
std::unique_ptr<ReflectionModel> cosine_of_alpha() {
    return instance<ReflectionModel>("phong", {{"ka", 0.0}, {"kd", 0.0}, {"ks", 1.0}, {"shininess", 1.0}});
}

Vec3 direction(Double3 d) {
    const Double3 u = unit(d);
    return {static_cast<float>(u.x), static_cast<float>(u.y), static_cast<float>(u.z)};
}

float highlight(const ReflectionModel& model, Double3 n, Double3 v, Double3 l) {
    const ReflectionSample sample{direction(n), direction(v), direction(l), {1, 1, 1}, {1, 1, 1}};
    return reflect(model, {sample}, {1, 1, 1})[0].specular.x;
}

}  // namespace

TEST_CASE("reflection/phong is IM3: k_s I_L max(R.V, 0)^alpha where N.L > 0, and Lambert's diffuse light") {
    for (const double shininess : {0.0, 1.0, 10.0, 32.0, 150.0}) {
        INFO("shininess " << shininess);
        const auto model =
            instance<ReflectionModel>("phong", {{"kd", 0.6}, {"ks", 0.4}, {"shininess", shininess}});
        check_reflection(
            *model,
            [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                const double cosine = dot(n, l);
                if (cosine <= 0) return {};
                const double h = 0.4 * std::pow(std::max(dot(mirrored(n, l), v), 0.0), shininess);
                return {0.6 * cosine * color, {h, h, h}};
            },
            1e-5 + 1e-6 * shininess);
    }
}

TEST_CASE("RE example 1: light from (-4, 2, 0) on a floor is reflected along (0.8944, 0.4472, 0)") {
    const auto model = cosine_of_alpha();
    // The highlight is R.V, so that three observers along the axes measure R itself.
    CHECK(agree(highlight(*model, {0, 1, 0}, {1, 0, 0}, {-4, 2, 0}), 0.8944, 0, 5e-5));
    CHECK(agree(highlight(*model, {0, 1, 0}, {0, 1, 0}, {-4, 2, 0}), 0.4472, 0, 5e-5));
    CHECK(highlight(*model, {0, 1, 0}, {0, 0, 1}, {-4, 2, 0}) < 1e-6f);
}

TEST_CASE("RE example 2: cos theta is 0.7071 and cos alpha 0.8575 at the corner of the face") {
    // Light (-10, 10, 0), observer (20, 5, 0), point (0, 0, 0), N (0, 1, 0).
    CHECK(agree(highlight(*cosine_of_alpha(), {0, 1, 0}, {20, 5, 0}, {-10, 10, 0}), 0.8575, 0, 5e-5));
    const auto diffuse = instance<ReflectionModel>("phong", {{"kd", 1.0}, {"ks", 0.0}});
    const ReflectionSample sample{
        {0, 1, 0}, direction({20, 5, 0}), direction({-10, 10, 0}), {1, 1, 1}, {1, 1, 1}};
    CHECK(agree(reflect(*diffuse, {sample}, {1, 1, 1})[0].diffuse.x, 0.7071, 0, 5e-5));
}

TEST_CASE("RE example 3, corrected: the red intensity at V1 is 0.4353 where R.V is -0.5514") {
    const auto material = instance<ReflectionModel>("phong", {{"ka", Vec3{0.1f, 0.1f, 0.1f}},
                                                              {"kd", Vec3{0.8f, 0.8f, 0.9f}},
                                                              {"ks", Vec3{0.2f, 0.2f, 0.1f}},
                                                              {"shininess", 10.0}});
    const auto lamp = instance<candela::Light>("point", {{"position", Vec3{0.3f, 0.8f, 0.4f}},
                                                         {"attenuation", std::string("offset-linear")},
                                                         {"attenuation_offset", 0.01}});
    // The note rounds on its way: 2 * 0.6667 * 0.4135 is 0.5514, 2 * 2/3 * 0.41345 is 0.5513.
    const double k_decimals = 2e-4;
    const auto incident = illuminate(*lamp, {Vec3{0.7f, 0.1f, 0.4f}})[0];
    CHECK(agree(incident.to_light, Double3{-0.4962, 0.8683, 0}, 0, k_decimals));
    const Vec3 n = direction({1, 2, -2});
    CHECK(agree(dot(n, incident.to_light), 0.4135, 0, k_decimals));
    CHECK(agree(highlight(*cosine_of_alpha(), exact(n), {0, 0, -1}, exact(incident.to_light)), 0.5514, 0,
                k_decimals));

    // -0.5514 is R.V for an observer on the side of +z: an even power must not make that a highlight.
    const ReflectionSample from_behind{n, {0, 0, 1}, incident.to_light, incident.diffuse, incident.specular};
    const auto reflected = reflect(*material, {from_behind}, {1, 1, 1})[0];
    CHECK(reflected.specular.x < 1e-6f);
    const auto ambient = reflect_ambient(*material, {from_behind}, {1, 1, 1}, {0.3f, 0.2f, 0.1f})[0];
    CHECK(agree(ambient.x, 0.03, 0, k_decimals));
    CHECK(agree(ambient.x + reflected.diffuse.x + reflected.specular.x, 0.4353, 0, k_decimals));

    // For an observer on the side of -z, R.V is +0.5514, and there is one: 0.2 * 0.5514^10 / 0.8162.
    ReflectionSample from_the_front = from_behind;
    from_the_front.to_observer = {0, 0, -1};
    CHECK(agree(reflect(*material, {from_the_front}, {1, 1, 1})[0].specular.x, 0.000637, 0.005));
}

TEST_CASE("reflection/phong keeps the highlight's colour the light's, not the object's") {
    const auto model = instance<ReflectionModel>("phong", {{"kd", 0.0}, {"ks", 1.0}});
    const ReflectionSample sample{{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {1, 1, 1}, {0.9f, 0.5f, 0.1f}};
    CHECK(agree(reflect(*model, {sample}, {1, 0, 0})[0].specular, Vec3{0.9f, 0.5f, 0.1f}, 1e-5));
}
