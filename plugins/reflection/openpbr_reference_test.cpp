#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "support/microfacets.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

namespace {

constexpr double k_pi = std::numbers::pi;

/// The parameters, with the specification's defaults, but a white base.
struct Surface {
    double base_weight = 1;
    Vec3 base_color{1, 1, 1};
    double base_metalness = 0, base_diffuse_roughness = 0, specular_weight = 1;
    Vec3 specular_color{1, 1, 1};
    double specular_roughness = 0.3, specular_roughness_anisotropy = 0, specular_ior = 1.5, coat_weight = 0;
    Vec3 coat_color{1, 1, 1};
    double coat_roughness = 0, coat_roughness_anisotropy = 0, coat_ior = 1.6, coat_darkening = 1,
           fuzz_weight = 0;
    Vec3 fuzz_color{1, 1, 1};
    double fuzz_roughness = 0.5;
};

std::unique_ptr<ReflectionModel> model_of(const Surface& m) {
    return instance<ReflectionModel>("openpbr",
                                     {{"base_weight", m.base_weight},
                                      {"base_color", m.base_color},
                                      {"base_metalness", m.base_metalness},
                                      {"base_diffuse_roughness", m.base_diffuse_roughness},
                                      {"specular_weight", m.specular_weight},
                                      {"specular_color", m.specular_color},
                                      {"specular_roughness", m.specular_roughness},
                                      {"specular_roughness_anisotropy", m.specular_roughness_anisotropy},
                                      {"specular_ior", m.specular_ior},
                                      {"coat_weight", m.coat_weight},
                                      {"coat_color", m.coat_color},
                                      {"coat_roughness", m.coat_roughness},
                                      {"coat_roughness_anisotropy", m.coat_roughness_anisotropy},
                                      {"coat_ior", m.coat_ior},
                                      {"coat_darkening", m.coat_darkening},
                                      {"fuzz_weight", m.fuzz_weight},
                                      {"fuzz_color", m.fuzz_color},
                                      {"fuzz_roughness", m.fuzz_roughness}});
}

std::unique_ptr<ReflectionModel> matt(double roughness, Vec3 color) {
    return instance<ReflectionModel>("eon", {{"roughness", roughness}, {"kd", color}});
}

double lerp(double a, double b, double share) { return (1 - share) * a + share * b; }
Double3 lerp(Double3 a, Double3 b, double share) { return (1 - share) * a + share * b; }
Double3 times(Double3 a, Double3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Double3 each(const std::function<double(double)>& f, Double3 v) { return {f(v.x), f(v.y), f(v.z)}; }
Double3 each(const std::function<double(double, double)>& f, Double3 a, Double3 b) {
    return {f(a.x, b.x), f(a.y, b.y), f(a.z, b.z)};
}

/// A polynomial in two variables: coefficients of y^0, y^1, ... for each power of x.
double polynomial(std::initializer_list<std::initializer_list<double>> rows, double x, double y) {
    double sum = 0, power = 1;
    for (const auto& row : rows) {
        double factor = power;
        for (const double coefficient : row) {
            sum += coefficient * factor;
            factor *= y;
        }
        power *= x;
    }
    return sum;
}

/// The fit of the light that GGX's facets do not reflect to the observer, if they reflect all light.
double masked(double alpha, double cosine) {
    const double u = 1 / (1 + alpha / cosine);
    const double e = polynomial({{0.22751, 0.42209, 4.3269, -0.46521},
                                 {-0.0031264, -0.36867, -14.953, -9.0657},
                                 {2.1437, -6.4294, 88.435, 52.112},
                                 {4.7383, 4.8634, -120.2, -187.48},
                                 {-7.4466, 9.2351, 69.068, 192.53}},
                                u, alpha);
    return std::clamp(u * std::pow(1 - u, 2) * e, 0.0, 1.0);
}

/// A rough surface between media of that ratio of indices.
struct Facets {
    double alpha_t, alpha_b, ior;

    double lobe(Polar h, Polar v, Polar l) const { return ggx(alpha_t, alpha_b, h, v, l); }
    double albedo(Polar v) const {
        const double across = std::hypot(alpha_t * std::cos(v.phi), alpha_b * std::sin(v.phi));
        const double mean_square = (alpha_t * alpha_t + alpha_b * alpha_b) / 2, cosine = std::cos(v.theta);
        const double alpha =
            std::min(1.0, std::hypot(across * std::sin(v.theta), std::sqrt(mean_square) * cosine));
        const double u = 1 / (1 + alpha / cosine), r = std::sqrt(alpha);
        const double q = std::cbrt(std::min((ior - 1) / (ior + 1), 0.5));
        const double change = polynomial(
            {{polynomial({{0.0093216, -0.17065, 0.13313},
                          {0.024257, 2.2904, -1.9505},
                          {-0.026633, -0.73175, 0.90077}},
                         r, q)},
             {polynomial(
                 {{-0.015998, 0.22896, -0.19566}, {0.22939, -1.1177, 1.3872}, {-1.0617, 5.7727, -5.9757}}, r,
                 q)},
             {polynomial({{0.021927, -0.17019, 0.1645}, {-0.68655, 2.2322, -2.6034}, {3.2, -15.177, 14.612}},
                         r, q)}},
            u, 1);
        const double mean = std::clamp(cosine + (1 - u) * change, 0.0, 1.0);
        return (1 - masked(alpha, cosine)) * exact_fresnel(mean, ior);
    }
};

Facets facets(double roughness, double anisotropy, double ior) {
    const double narrow = 1 - anisotropy;
    const double alpha = roughness * roughness * std::sqrt(2 / (1 + narrow * narrow));
    return {std::max(alpha, 0.001), std::max(narrow * alpha, 0.001), ior};
}

double schlick(double f0, double cosine) { return lerp(f0, 1, std::pow(1 - cosine, 5)); }

/// F82-tint, and its mean over the hemisphere by quadrature.
double metal(double f0, double tint, double cosine) {
    const auto lazanyi = [](double x) { return x * std::pow(1 - x, 6); };
    const double edge = 1.0 / 7;
    return std::max(schlick(f0, cosine) - lazanyi(cosine) / lazanyi(edge) * (1 - tint) * schlick(f0, edge),
                    0.0);
}
double metal_mean(double f0, double tint) {
    const double edge = 1.0 / 7, dip = (1 - tint) * schlick(f0, edge) / (edge * std::pow(1 - edge, 6));
    return f0 + (1 - f0) / 21 - dip * 2 * std::tgamma(3.0) * std::tgamma(7.0) / std::tgamma(10.0);
}

/// The fits of the fuzz's table.
struct Fuzz {
    double share, stretch, shear;
};
Fuzz fuzz(double roughness, double u) {
    const double y = std::max(roughness, 0.1);
    return {std::exp(
                -polynomial({{0.14603, -0.93669, 8.2296, -5.61},
                             {0.97916, 17.358, -6.6156},
                             {26.932, -7.0552},
                             {-15.847}},
                            u, y) /
                polynomial({{0, 1, 13.122, -7.6516}, {-1.2934, 6.2252, 21.983}, {3.7918, -21.905}, {0.93996}},
                           u, y)),
            std::max(polynomial({{0.015784, 0.12616, 0.36665, 0.61968},
                                 {-0.19007, 4.2215, -1.1266},
                                 {-2.0811, 4.6833},
                                 {2.3589}},
                                u, y) /
                         polynomial({{1, -0.1038, 0.63623}, {-1.1091, 3.6786}, {5.8779}}, u, y),
                     0.02),
            std::sqrt(1 - u) * (1 - y) * y * y *
                polynomial({{0.33788, -18.177, -15.457}, {32.396, 28.231}, {-110.94}}, u, y) /
                polynomial({{1, -12.89, 57.248}, {27.56, -113.21}, {131.89}}, u, y)};
}

/// A linearly transformed cosine (Heitz et al. 2016, eq. 1) of that inverse matrix, in the observer's frame.
double transformed_cosine(const Fuzz& f, Polar v, Polar l) {
    const double phi = l.phi - v.phi;
    const Double3 d{std::sin(l.theta) * std::cos(phi), std::sin(l.theta) * std::sin(phi), std::cos(l.theta)};
    const Double3 original{f.stretch * d.x + f.shear * d.z, f.stretch * d.y, d.z};
    const double determinant = f.stretch * f.stretch, size = length(original);
    return unit(original).z / k_pi * determinant / std::pow(size, 3);
}

/// `base`: the light of reflection/eon.
ExactPair exact_of(const Surface& m, Double3 n, Double3 v, Double3 l, Double3 object, Double3 base) {
    if (dot(n, l) <= 0) return {};
    const Double3 t = tangent_at(n), h = unit(l + v), white{1, 1, 1};
    const Polar to_h = polar(n, t, h), to_v = polar(n, t, v), to_l = polar(n, t, l);
    const double v_h = std::cos(std::atan2(length(cross(v, l)), dot(v, l)) / 2), n_v = dot(n, v),
                 n_l = dot(n, l);
    const Double3 color = times(exact(m.base_color), object), tint = exact(m.specular_color);
    const double c = m.coat_weight, metalness = m.base_metalness;

    // Its index is the larger one within the coat, if that covers all.
    const double in_air = m.specular_ior, in_coat = std::exp(std::abs(std::log(m.specular_ior / m.coat_ior)));
    const double ratio = lerp(in_air, in_coat, c);
    const double f0 = std::min(m.specular_weight * std::pow((1 - ratio) / (1 + ratio), 2), 0.999);
    const double r4 = std::pow(m.specular_roughness, 4) + 2 * std::pow(m.coat_roughness, 4);
    const double roughness = lerp(m.specular_roughness, std::pow(std::min(r4, 1.0), 0.25), c);
    const Facets dielectric =
        facets(roughness, m.specular_roughness_anisotropy, (1 + std::sqrt(f0)) / (1 - std::sqrt(f0)));
    const double lobe = dielectric.lobe(to_h, to_v, to_l);
    Double3 diffuse = ((1 - metalness) * m.base_weight * (1 - dielectric.albedo(to_v))) * base;
    Double3 specular = (1 - metalness) * exact_fresnel(v_h, dielectric.ior) * lobe * tint;

    const double a = std::max(roughness * roughness, 0.001);
    const double lost =
        a * a * polynomial({{1.8121, 146.88, -48.492}}, 1, a) / polynomial({{1, 36.544, 132.31}}, 1, a);
    const double weight = std::min(m.specular_weight, 1.0);
    const Double3 f = m.base_weight * color;
    specular = specular + (metalness * weight) *
                              each(
                                  [&](double f0_, double tint_) {
                                      const double mean = metal_mean(f0_, tint_);
                                      const double often = mean * mean * (1 - lost) / (1 - mean * lost);
                                      return metal(f0_, tint_, v_h) * lobe +
                                             often * masked(a, n_l) * masked(a, n_v) / (k_pi * lost);
                                  },
                                  f, tint);

    const Facets coat = facets(m.coat_roughness, m.coat_roughness_anisotropy, m.coat_ior);
    const auto crossing = [&](double theta) { return 1 / std::cos(std::asin(std::sin(theta) / m.coat_ior)); };
    const double path = crossing(to_v.theta) + crossing(to_l.theta);
    const Double3 transmitted =
        each([&](double x) { return std::pow(std::sqrt(x), path); }, exact(m.coat_color));
    const Double3 albedo = lerp(f0 * tint + (1 - f0) * m.base_weight * color, weight * f, metalness);
    const double index = std::min(m.coat_ior, 3.0);
    const double mean = std::log((10893 * index - 1438.2) / (-774.4 * index * index + 10212 * index + 1));
    const double rough = lerp(lerp(1, m.specular_roughness, f0), m.specular_roughness, metalness);
    const double k = lerp(exact_fresnel(n_v, m.coat_ior), 1 - (1 - mean) / (m.coat_ior * m.coat_ior), rough);
    const Double3 below = each(
        [&](double transmitted_, double albedo_) {
            return lerp(1, transmitted_ * (1 - coat.albedo(to_v)), c) *
                   lerp(1, (1 - k) / (1 - albedo_ * k), c * m.coat_darkening);
        },
        transmitted, albedo);
    diffuse = times(diffuse, below);
    specular =
        times(specular, below) + (c * exact_fresnel(v_h, m.coat_ior) * coat.lobe(to_h, to_v, to_l)) * white;

    const Fuzz fibres = fuzz(m.fuzz_roughness, n_v);
    const double rest = 1 - m.fuzz_weight * fibres.share;
    const double at_fibres = m.fuzz_weight * fibres.share * transformed_cosine(fibres, to_v, to_l);
    return {rest * diffuse, k_pi * (n_l * rest * specular + at_fibres * exact(m.fuzz_color))};
}

/// Compares 10^5 random points, of 500 surfaces, within 1e-5; and where facets are less rough than 0.05,
/// within as much more as turning H by its last bits changes the light.
void check_random_points(unsigned seed, const std::function<Surface(Random&)>& surface_of) {
    Random random(seed);
    for (int i = 0; i < 500; ++i) {
        const Surface m = surface_of(random);
        const auto channel = [&] { return static_cast<float>(random.number(0, 1)); };
        const candela::Rgb color{channel(), channel(), channel()};
        const auto narrowest = [](double roughness, double anisotropy) {
            const double ratio = 1 - anisotropy;
            return std::max(roughness * roughness * std::sqrt(2 / (1 + ratio * ratio)) * ratio, 0.001);
        };
        const double alpha =
            std::min(narrowest(m.specular_roughness, m.specular_roughness_anisotropy),
                     m.coat_weight > 0 ? narrowest(m.coat_roughness, m.coat_roughness_anisotropy) : 1.0);
        std::vector<ReflectionSample> samples;
        for (int k = 0; k < 200; ++k) samples.push_back(random_sample(random, alpha));
        const auto found = reflect(*model_of(m), samples, color);
        const auto base = reflect(*matt(m.base_diffuse_roughness, m.base_color), samples, color);
        const double tolerance = 1e-5 * std::max(1.0, 0.05 / alpha);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const ReflectionSample& s = samples[k];
            const ExactPair expected = exact_of(m, exact(s.normal), exact(s.to_observer), exact(s.to_light),
                                                {color.r, color.g, color.b}, exact(base[k].diffuse));
            INFO("surface " << i << ", point " << k << ": metalness " << m.base_metalness << ", roughness "
                            << m.specular_roughness << " " << m.specular_roughness_anisotropy << ", ior "
                            << m.specular_ior << ", weight " << m.specular_weight << ", coat "
                            << m.coat_weight << " " << m.coat_roughness << " " << m.coat_ior << ", fuzz "
                            << m.fuzz_weight << " " << m.fuzz_roughness << "\nN " << text(s.normal) << " V "
                            << text(s.to_observer) << " L " << text(s.to_light) << "\ndiffuse "
                            << text(found[k].diffuse) << ", expected " << text(expected.diffuse)
                            << "; specular " << text(found[k].specular) << ", expected "
                            << text(expected.specular));
            REQUIRE(agree(found[k].diffuse, expected.diffuse, 1e-5, 1e-5));
            // A metal's edge is a difference of large numbers.
            const double size =
                std::max({1.0, expected.specular.x, expected.specular.y, expected.specular.z});
            REQUIRE(agree(found[k].specular, expected.specular, tolerance, tolerance * size));
        }
    }
}

double in_single(double x) { return static_cast<double>(static_cast<float>(x)); }

Surface random_surface(Random& random) {
    const auto number = [&](double low, double high) { return in_single(random.number(low, high)); };
    const auto often = [&](double otherwise) { return number(0, 1) < 0.5 ? number(0, 1) : otherwise; };
    const auto channel = [&] { return static_cast<float>(number(0, 1)); };
    const auto color = [&] { return Vec3{channel(), channel(), channel()}; };
    Surface m{.base_weight = often(1),
              .base_color = color(),
              .base_metalness = often(number(0, 1) < 0.5 ? 0 : 1),
              .base_diffuse_roughness = often(0),
              .specular_weight = number(0, 1) < 0.2 ? number(1, 5) : often(1)};
    if (number(0, 1) < 0.5) m.specular_color = color();
    m.specular_roughness = number(0, 1);
    m.specular_roughness_anisotropy = often(0);
    m.specular_ior = number(1, 3);
    return m;
}

}  // namespace

TEST_CASE("reflection/openpbr is the specification's base at 10^5 random points, to 1e-5") {
    check_random_points(1, random_surface);
}

TEST_CASE("reflection/openpbr is the specification's coat and fuzz at 10^5 random points, to 1e-5") {
    check_random_points(2, [](Random& random) {
        Surface m = random_surface(random);
        const auto number = [&](double low, double high) { return in_single(random.number(low, high)); };
        const auto often = [&](double otherwise) { return number(0, 1) < 0.5 ? number(0, 1) : otherwise; };
        const auto channel = [&] { return static_cast<float>(number(0, 1)); };
        m.coat_weight = often(1);
        if (number(0, 1) < 0.5) m.coat_color = {channel(), channel(), channel()};
        m.coat_roughness = number(0, 1);
        m.coat_roughness_anisotropy = often(0);
        m.coat_ior = number(1, 3.5);
        m.coat_darkening = often(1);
        m.fuzz_weight = often(0);
        m.fuzz_color = {channel(), channel(), channel()};
        m.fuzz_roughness = number(0, 1);
        return m;
    });
}

TEST_CASE("reflection/openpbr computes the same with all instruction sets, in batches and one by one") {
    const Surface m{.base_color = {0.9f, 0.7f, 0.5f},
                    .base_metalness = 0.4,
                    .base_diffuse_roughness = 0.5,
                    .specular_color = {1, 0.8f, 0.6f},
                    .specular_roughness = 0.5,
                    .specular_roughness_anisotropy = 0.5,
                    .coat_weight = 0.6,
                    .coat_color = {1, 0.9f, 0.5f},
                    .coat_roughness = 0.4,
                    .fuzz_weight = 0.5,
                    .fuzz_color = {0.3f, 0.5f, 1}};
    check_reflection(
        *model_of(m),
        [&](Double3 n, Double3 v, Double3 l, Double3 color) {
            const candela::Rgb rounded_color{static_cast<float>(color.x), static_cast<float>(color.y),
                                             static_cast<float>(color.z)};
            const auto base =
                reflect(*matt(m.base_diffuse_roughness, m.base_color),
                        {{rounded(n), rounded(v), rounded(l), {1, 1, 1}, {1, 1, 1}}}, rounded_color);
            return exact_of(m, n, v, l, color, exact(base[0].diffuse));
        },
        1e-3);
}
