#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "support/highlight.h"
#include "support/microfacets.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

namespace {

constexpr double k_pi = std::numbers::pi;

/// The parameters, with glTF's defaults of the extensions.
struct Surface {
    double metallic = 0, roughness = 0.5, specular = 1;
    Vec3 specular_color{1, 1, 1};
    double ior = 1.5, clearcoat = 0, clearcoat_roughness = 0;
    Vec3 sheen_color{};
    double sheen_roughness = 0, anisotropy_strength = 0, anisotropy_rotation = 0;  // degrees
    double iridescence = 0, iridescence_ior = 1.3, iridescence_thickness = 400;
};

std::unique_ptr<ReflectionModel> model_of(const Surface& m) {
    return instance<ReflectionModel>("metallic-roughness",
                                     {{"metallic", m.metallic},
                                      {"roughness", m.roughness},
                                      {"specular", m.specular},
                                      {"specular_color", m.specular_color},
                                      {"ior", m.ior},
                                      {"clearcoat", m.clearcoat},
                                      {"clearcoat_roughness", m.clearcoat_roughness},
                                      {"sheen_color", m.sheen_color},
                                      {"sheen_roughness", m.sheen_roughness},
                                      {"anisotropy_strength", m.anisotropy_strength},
                                      {"anisotropy_rotation", m.anisotropy_rotation},
                                      {"iridescence", m.iridescence},
                                      {"iridescence_ior", m.iridescence_ior},
                                      {"iridescence_thickness", m.iridescence_thickness}});
}

double mix(double a, double b, double share) { return a + (b - a) * share; }
Double3 mix(Double3 a, Double3 b, double share) { return (1 - share) * a + share * b; }
double largest(Double3 v) { return std::max({v.x, v.y, v.z}); }
Double3 times(Double3 a, Double3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Double3 each(const std::function<double(double)>& f, Double3 v) { return {f(v.x), f(v.y), f(v.z)}; }

double schlick(double f0, double cosine) { return mix(f0, 1, std::pow(1 - std::abs(cosine), 5)); }

/// KHR_materials_sheen: Charlie.
double sheen(double roughness, double sin_h, double n_v, double n_l) {
    const double alpha = std::pow(std::max(roughness, 0.07), 2);
    const double t = std::pow(1 - alpha, 2);
    const auto l = [&](double x) {
        return mix(21.5473, 25.3245, t) /
                   (1 + mix(3.82987, 3.32435, t) * std::pow(x, mix(0.19823, 0.16801, t))) +
               mix(-1.97760, -1.27393, t) * x + mix(-4.32054, -4.85967, t);
    };
    const auto lambda = [&](double x) { return x < 0.5 ? std::exp(l(x)) : std::exp(2 * l(0.5) - l(1 - x)); };
    const double d = (2 + 1 / alpha) * std::pow(sin_h, 1 / alpha) / (2 * k_pi);
    return d / ((1 + lambda(n_v) + lambda(n_l)) * 4 * n_v * n_l);
}

/// The spectral sensitivities of the eye as the extension has them, Gaussians over wave numbers in 1/m.
struct Gaussian {
    double height, centre, variance;
};
constexpr std::array<Gaussian, 4> k_eye{{{5.4856e-13, 1.6810e+06, 4.3278e+09},
                                         {4.4201e-13, 1.7953e+06, 9.3046e+09},
                                         {5.2481e-13, 2.2084e+06, 6.6121e+09},
                                         {9.7470e-14, 2.2399e+06, 4.5282e+09}}};
constexpr double k_eye_unit = 1.0685e-7;

Double3 rgb_of(Double3 xyz) {
    return {dot({3.2404542, -1.5371385, -0.4985314}, xyz), dot({-0.9692660, 1.8760108, 0.0415560}, xyz),
            dot({0.0556434, -0.2040259, 1.0572252}, xyz)};
}

/// KHR_materials_iridescence.
Double3 film(const Surface& m, double cosine, Double3 f0) {
    const double n = m.iridescence_ior;
    const double below = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
    const double outer = schlick(std::pow((n - 1) / (n + 1), 2), cosine), through = 1 - outer;
    const double path = 2 * n * m.iridescence_thickness * below * 1e-9;
    const Double3 base = each(
        [](double f) {
            const double guarded = std::min(f + 0.0001, 0.9999);
            return (1 + std::sqrt(guarded)) / (1 - std::sqrt(guarded));
        },
        f0);
    const Double3 inner =
        each([&](double i) { return schlick(std::pow((i - n) / (i + n), 2), below); }, base);
    const Double3 turn = each([&](double i) { return k_pi + (i < n ? k_pi : 0); }, base);
    const Double3 r123 = each([&](double r) { return std::clamp(outer * r, 1e-5, 0.9999); }, inner);
    const auto of = [&](double r23, double r) { return through * through * r23 / (1 - r); };
    const Double3 sum{of(inner.x, r123.x), of(inner.y, r123.y), of(inner.z, r123.z)};
    Double3 result = Double3{outer, outer, outer} + sum, c = sum - Double3{through, through, through};
    for (int k = 1; k <= 2; ++k) {
        const double phase = 2 * k_pi * k * path;
        const auto wave = [&](const Gaussian& g, double shift) {
            return g.height * std::sqrt(2 * k_pi * g.variance) / k_eye_unit *
                   std::cos(g.centre * phase + k * shift) * std::exp(-phase * phase * g.variance);
        };
        c = times(c, each([](double r) { return std::sqrt(r); }, r123));
        result = result + 2 * times(c, rgb_of({wave(k_eye[0], turn.x) + wave(k_eye[3], turn.x),
                                               wave(k_eye[1], turn.y), wave(k_eye[2], turn.z)}));
    }
    return each([](double x) { return std::max(x, 0.0); }, result);
}

/// `albedo`: the share of light that white sheen reflects from a direction of that cosine to N.
ExactPair exact_of(const Surface& m, Double3 n, Double3 v, Double3 l, Double3 color,
                   const std::function<double(double)>& albedo) {
    if (dot(n, l) <= 0) return {};
    const double turn = m.anisotropy_rotation * k_pi / 180;
    const Double3 u = tangent_at(n), t = std::cos(turn) * u + std::sin(turn) * cross(n, u), h = unit(l + v);
    const Polar to_h = polar(n, t, h), to_v = polar(n, t, v), to_l = polar(n, t, l);
    const double alpha = std::max(m.roughness * m.roughness, 0.001);
    const double lobe =
        ggx(mix(alpha, 1, m.anisotropy_strength * m.anisotropy_strength), alpha, to_h, to_v, to_l);
    const double v_h = std::cos(std::atan2(length(cross(v, l)), dot(v, l)) / 2), n_v = dot(n, v);

    const double from_ior = std::pow((1 - m.ior) / (1 + m.ior), 2);
    const Double3 f0 = each([&](double c) { return std::min(from_ior * c, 1.0); }, exact(m.specular_color));
    const auto fresnel = [&](Double3 at_normal) {
        return each([&](double f) { return schlick(f, v_h); }, at_normal);
    };
    const Double3 mirrored = mix(m.specular * fresnel(f0), film(m, n_v, m.specular * f0), m.iridescence);
    const Double3 metal = mix(fresnel(color), film(m, n_v, color), m.iridescence);

    Double3 diffuse = (1 - m.metallic) * std::max(1 - largest(mirrored), 0.0) / k_pi * color;
    Double3 specular = lobe * mix(mirrored, metal, m.metallic);
    const double base = 1 - largest(exact(m.sheen_color)) * std::max(albedo(n_v), albedo(dot(n, l)));
    diffuse = base * diffuse;
    specular = base * specular +
               sheen(m.sheen_roughness, std::sin(to_h.theta), n_v, dot(n, l)) * exact(m.sheen_color);
    const double coat = m.clearcoat * schlick(0.04, n_v);
    const double coat_alpha = std::max(std::pow(m.clearcoat_roughness, 2), 0.001);
    const double varnish = ggx(coat_alpha, coat_alpha, to_h, to_v, to_l);
    specular = mix(specular, {varnish, varnish, varnish}, coat);
    return {k_pi * dot(n, l) * (1 - coat) * diffuse, k_pi * dot(n, l) * specular};
}

double no_albedo(double) { return 0; }

/// Compares 10^5 random points, of 500 surfaces, within 1e-5; and where facets are less rough than 0.05, or
/// fibres than 0.02, within as much more as turning H by its last bits changes the light.
void check_random_points(unsigned seed, const std::function<Surface(Random&)>& surface_of,
                         double color_limit) {
    Random random(seed);
    for (int i = 0; i < 500; ++i) {
        const Surface m = surface_of(random);
        const auto model = model_of(m);
        const auto channel = [&] { return static_cast<float>(random.number(0, color_limit)); };
        const candela::Rgb color{channel(), channel(), channel()};
        const double alpha =
            std::max(std::min(m.roughness, m.clearcoat > 0 ? m.clearcoat_roughness : 1.0), 0.032);
        std::vector<ReflectionSample> samples;
        for (int k = 0; k < 200; ++k) samples.push_back(random_sample(random, alpha * alpha));
        const auto found = reflect(*model, samples, color);
        const double fibres = largest(exact(m.sheen_color)) > 0 ? std::max(m.sheen_roughness, 0.07) : 1;
        const double tolerance = 1e-5 * std::max({1.0, 0.05 / (alpha * alpha), 0.02 / (fibres * fibres)});
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const ReflectionSample& s = samples[k];
            const ExactPair expected = exact_of(m, exact(s.normal), exact(s.to_observer), exact(s.to_light),
                                                {color.r, color.g, color.b}, no_albedo);
            INFO("metallic " << m.metallic << ", roughness " << m.roughness << ", ior " << m.ior << ", coat "
                             << m.clearcoat << " " << m.clearcoat_roughness << ", sheen " << m.sheen_roughness
                             << ", anisotropy " << m.anisotropy_strength << " " << m.anisotropy_rotation
                             << ", film " << m.iridescence << " " << m.iridescence_ior << " "
                             << m.iridescence_thickness << "\nN " << text(s.normal) << " V "
                             << text(s.to_observer) << " L " << text(s.to_light) << "\ndiffuse "
                             << text(found[k].diffuse) << ", expected " << text(expected.diffuse)
                             << "; specular " << text(found[k].specular) << ", expected "
                             << text(expected.specular));
            REQUIRE(agree(found[k].diffuse, expected.diffuse, 1e-5, 1e-5));
            // A film's colour is a difference of large numbers.
            const double size = std::max(1.0, largest(expected.specular));
            REQUIRE(agree(found[k].specular, expected.specular, tolerance, tolerance * size));
        }
    }
}

double in_single(double x) { return static_cast<double>(static_cast<float>(x)); }

Double3 at(double degrees, double phi = 0) {
    const double theta = degrees * k_pi / 180;
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

/// The light that a surface facing +y reflects.
ReflectedPair seen(const Surface& m, Double3 v, Double3 l, candela::Rgb color = {1, 1, 1}) {
    return reflect(*model_of(m), {{{0, 1, 0}, rounded(v), rounded(l), {1, 1, 1}, {1, 1, 1}}}, color)[0];
}

}  // namespace

TEST_CASE("reflection/metallic-roughness is glTF's material at 10^5 random points, without sheen, to 1e-5") {
    check_random_points(
        1,
        [](Random& random) {
            const auto number = [&](double low, double high) { return in_single(random.number(low, high)); };
            const auto often = [&](double otherwise) {
                return number(0, 1) < 0.5 ? number(0, 1) : otherwise;
            };
            const auto channel = [&] { return static_cast<float>(number(0, 2)); };
            Surface m{.metallic = often(number(0, 1) < 0.5 ? 0 : 1),
                      .roughness = number(0, 1),
                      .specular = often(1)};
            if (number(0, 1) < 0.5) m.specular_color = {channel(), channel(), channel()};
            m.ior = number(0, 1) < 0.1 ? 0 : number(1, 3);
            m.clearcoat = often(0);
            m.clearcoat_roughness = number(0, 1);
            m.anisotropy_strength = often(0);
            m.anisotropy_rotation = number(-180, 180);
            m.iridescence = often(0);
            m.iridescence_ior = number(1.1, 2.5);
            m.iridescence_thickness = number(0, 1200);
            return m;
        },
        1);
}

TEST_CASE(
    "reflection/metallic-roughness has glTF's sheen at 10^5 random points of a black surface, to 1e-5") {
    check_random_points(
        2,
        [](Random& random) {
            const auto channel = [&] { return static_cast<float>(random.number(0, 1)); };
            Surface m{.specular = 0, .sheen_color = {channel(), channel(), channel()}};
            m.sheen_roughness = in_single(random.number(0, 1));
            m.clearcoat = random.number(0, 1) < 0.5 ? 0 : in_single(random.number(0, 1));
            m.clearcoat_roughness = in_single(random.number(0.2, 1));
            return m;
        },
        0);
}

TEST_CASE("reflection/metallic-roughness: sheen leaves the base what it does not reflect itself, to 0.01") {
    for (const double roughness : {0.1, 0.2, 0.3, 0.5, 0.75, 1.0}) {
        const Surface white{.specular = 0, .sheen_color = {1, 1, 1}, .sheen_roughness = roughness};
        for (const double degrees : {0.0, 20.0, 40.0, 60.0, 75.0, 85.0}) {
            // Light from above finds less sheen than light from the side of the observer.
            const double cosine = at(degrees).y;
            const double albedo = over_hemisphere([&](Double3 l) {
                return sheen(roughness, length(cross({0, 1, 0}, unit(l + at(degrees)))), cosine, l.y) * l.y;
            });
            INFO("roughness " << roughness << ", " << degrees << " degrees, albedo " << albedo);
            const double base = static_cast<double>(seen(white, at(degrees), at(0)).diffuse.x);
            CHECK(std::abs(base - (1 - std::min(albedo, 1.0))) < 0.01);
            const double turned = static_cast<double>(seen(white, at(0), at(degrees)).diffuse.x);
            CHECK(agree(turned, base * cosine, 1e-3, 1e-5));
        }
    }
}

TEST_CASE(
    "reflection/metallic-roughness computes the same with all instruction sets, in batches and one by one") {
    const Surface m{.metallic = 0.4,
                    .roughness = 0.6,
                    .specular = 0.8,
                    .specular_color = {0.5f, 1, 2},
                    .ior = 1.8,
                    .clearcoat = 0.7,
                    .clearcoat_roughness = 0.4,
                    .anisotropy_strength = 0.5,
                    .anisotropy_rotation = 30,
                    .iridescence = 0.6};
    check_reflection(
        *model_of(m),
        [&](Double3 n, Double3 v, Double3 l, Double3 color) {
            return exact_of(m, n, v, l, color, no_albedo);
        },
        1e-3);
}

TEST_CASE("reflection/metallic-roughness: plastic reflects 4 % at normal incidence, metal its colour") {
    // F D pi / 4 = f / (4 * 0.25^2) for a roughness of 0.5.
    const candela::Rgb gold{0.9f, 0.6f, 0.2f};
    const ReflectedPair plastic = seen({}, at(0), at(0), gold),
                        metal = seen({.metallic = 1}, at(0), at(0), gold);
    CHECK(agree(plastic.specular, Double3{0.16, 0.16, 0.16}, 1e-4));
    CHECK(agree(plastic.diffuse, Double3{0.96 * 0.9, 0.96 * 0.6, 0.96 * 0.2}, 1e-4));
    CHECK(metal.diffuse == Vec3{});
    CHECK(agree(metal.specular, Double3{4 * 0.9, 4 * 0.6, 4 * 0.2}, 1e-4));
    // With an infinite index, the colour of the highlight is that of any metal: specular-glossiness.
    const ReflectedPair glossy = seen({.specular_color = {0.9f, 0.6f, 0.2f}, .ior = 0}, at(0), at(0));
    CHECK(agree(glossy.specular, metal.specular, 1e-4));
    CHECK(agree(glossy.diffuse, Double3{0.1, 0.1, 0.1}, 1e-4));
}

TEST_CASE(
    "reflection/metallic-roughness: light and observer may change places, except under a coat or film") {
    const Surface m{.metallic = 0.3,
                    .roughness = 0.4,
                    .sheen_color = {0.8f, 0.5f, 0.2f},
                    .sheen_roughness = 0.4,
                    .anisotropy_strength = 0.6,
                    .anisotropy_rotation = 40};
    Random random(7);
    for (int i = 0; i < 500; ++i) {
        const ReflectionSample s = random_sample(random, 0.16);
        const ReflectionSample turned{s.normal, s.to_light, s.to_observer, s.diffuse, s.specular};
        const auto pair = reflect(*model_of(m), {s, turned}, {0.8f, 0.5f, 0.25f});
        const double n_l = dot(exact(s.normal), exact(s.to_light)),
                     n_v = dot(exact(s.normal), exact(s.to_observer));
        REQUIRE(agree(pair[1].diffuse, n_v / n_l * exact(pair[0].diffuse), 1e-3, 1e-5));
        REQUIRE(agree(pair[1].specular, n_v / n_l * exact(pair[0].specular), 1e-3, 1e-5));
    }
}

TEST_CASE(
    "reflection/metallic-roughness in a white furnace: metal loses light, plastic gains some at the rim") {
    for (const double roughness : {0.2, 0.5, 1.0}) {
        for (const double degrees : {0.0, 45.0, 70.0, 85.0}) {
            INFO("roughness " << roughness << ", " << degrees << " degrees");
            const double metal =
                directional_albedo(*model_of({.metallic = 1, .roughness = roughness}), rounded(at(degrees)));
            CHECK(metal < 1.002);
            CHECK(metal > 0.3);
            // Facets of every direction: the integral of cos / (1 + cos).
            if (roughness == 1 && degrees == 0) CHECK(agree(metal, 1 - std::numbers::ln2, 1e-3));
            const double plastic =
                directional_albedo(*model_of({.roughness = roughness}), rounded(at(degrees)));
            CHECK(plastic < 1.45);
            CHECK(plastic > 0.9);
            if (degrees < 60) CHECK(plastic < 1.02);
        }
    }
}

TEST_CASE(
    "reflection/metallic-roughness: a film's colour is that of Airy's formula, integrated over the "
    "spectrum") {
    for (const double thickness : {150.0, 300.0, 450.0, 800.0}) {
        const Surface m{
            .roughness = 0.5, .iridescence = 1, .iridescence_ior = 1.8, .iridescence_thickness = thickness};
        const double r12 = std::pow(0.8 / 2.8, 2);
        const double base = (1 + std::sqrt(0.0401)) / (1 - std::sqrt(0.0401));
        const double r23 = std::pow((base - 1.8) / (base + 1.8), 2);
        // The outer surface turns the phase by pi, the inner, to a lower index, does not.
        const auto airy = [&](double wave_number) {
            const double phase = 2 * k_pi * wave_number * 2 * 1.8 * thickness * 1e-9;
            const double wave = 2 * std::sqrt(r12 * r23) * std::cos(phase);
            return (r12 + r23 - wave) / (1 + r12 * r23 - wave);
        };
        const double mean = r12 + std::pow(1 - r12, 2) * r23 / (1 - r12 * r23);
        const auto integral = [&](const Gaussian& g) {
            double sum = 0;
            const double deviation = std::sqrt(2 * g.variance);
            for (int i = -600; i <= 600; ++i) {
                const double z = i / 100.0;
                sum += (airy(g.centre + z * deviation) - mean) * std::exp(-z * z / 2) / 100;
            }
            return g.height * std::sqrt(g.variance) / k_eye_unit * sum;
        };
        const Double3 change =
            rgb_of({integral(k_eye[0]) + integral(k_eye[3]), integral(k_eye[1]), integral(k_eye[2])});
        const ReflectedPair found = seen(m, at(0), at(0));
        const Double3 expected = 4 * (Double3{mean, mean, mean} + change);
        INFO(thickness << " nm: " << text(found.specular) << ", expected " << text(expected));
        CHECK(agree(found.specular, expected, 1e-2, 5e-3));
    }
}

TEST_CASE(
    "reflection/metallic-roughness: an anisotropic highlight is long along u, and across after a quarter "
    "turn") {
    const auto spread = [](const std::string& values) {
        return highlight_aspect("metallic-roughness", "ka = 0, metallic = 1, roughness = 0.4, " + values);
    };
    const double along = spread("anisotropy_strength = 0.6");
    CHECK(along > 1.5);
    CHECK(spread("anisotropy_strength = 0.6, anisotropy_rotation = 90") < 0.5);
    CHECK(agree(spread("anisotropy_strength = 0"), 1, 0.02));
}
