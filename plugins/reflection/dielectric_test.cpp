#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

namespace {

constexpr double k_degree = std::numbers::pi / 180;

Vec3 direction(Double3 d) {
    return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

/// The world around a perfect ball of radius 1 at the origin: rays within it are followed in double
/// precision.
class BallEnvironment final : public candela::Environment {
  public:
    std::function<double(Double3)> intensity = [](Double3) { return 1.0; };
    float most = 1;                 // of what it returns
    std::vector<Double3> looked;    // where the first point looked, in order
    std::vector<Double3> followed;  // the first point's rays within

    void look(std::size_t count, const candela::ConstVec3Span& towards,
              const candela::Vec3Span& seen) override {
        looked.push_back(exact(towards[0]));
        for (std::size_t i = 0; i < count; ++i) {
            const auto value = static_cast<float>(intensity(exact(towards[i])));
            seen.set(i, {value, value, value});
        }
    }

    float max_intensity() const noexcept override { return most; }
    void trace_exit(std::size_t count, const candela::ConstVec3Span& origin,
                    const candela::ConstVec3Span& ray, const candela::ExitBatch& exit) override {
        followed.push_back(exact(ray[0]));
        for (std::size_t i = 0; i < count; ++i) {
            const Double3 p = exact(origin[i]), d = exact(ray[i]);
            const double along = -2 * dot(p, d);
            const Double3 q = unit(p + along * d);
            exit.position.set(i, direction(q));
            exit.normal.set(i, direction(q));
            exit.distance[i] = static_cast<float>(along);
        }
    }
};

/// A surface that only the first ray within meets, at a given angle. Only the second direction looked in,
/// where that ray leaves, is visible.
class Wall final : public candela::Environment {
  public:
    explicit Wall(double angle) : angle_(angle) {}

    void look(std::size_t, const candela::ConstVec3Span&, const candela::Vec3Span& seen) override {
        const float value = ++looks_ == 2 ? 1.0f : 0.0f;
        seen.set(0, {value, value, value});
    }
    float max_intensity() const noexcept override { return 1; }
    void trace_exit(std::size_t, const candela::ConstVec3Span& origin, const candela::ConstVec3Span& ray,
                    const candela::ExitBatch& exit) override {
        const Double3 d = exact(ray[0]);
        const Double3 aside = unit(cross(d, {0, 1, 0}));
        exit.position.set(0, origin[0]);
        exit.normal.set(0, direction(std::cos(angle_) * d + std::sin(angle_) * aside));
        exit.distance[0] = ++hits_ == 1 ? 0.0f : -1.0f;
    }

  private:
    double angle_;
    int looks_ = 0;
    int hits_ = 0;
};

/// The light that the observer sees from the ball at the point with normal +z, looking at `angle` to it from
/// +x.
Vec3 seen_at(const ReflectionModel& model, double angle, candela::Environment& around,
             candela::Rgb color = {1, 1, 1}) {
    float normal[] = {0, 0, 1}, position[] = {0, 0, 1};
    float observer[] = {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))};
    float sum[9] = {};
    const auto span = [](float* v) { return candela::Vec3Span{v, v + 1, v + 2}; };
    const auto* const transparent = candela::extension_of<candela::EnvironmentReflection>(model);
    REQUIRE(transparent != nullptr);
    transparent->show_environment({.count = 1,
                                   .normal = span(normal),
                                   .to_observer = span(observer),
                                   .tangent = {},
                                   .color = color,
                                   .position = span(position)},
                                  around, {span(sum), span(sum + 3), span(sum + 6)});
    CHECK((sum[0] == 0 && sum[1] == 0 && sum[2] == 0 && sum[3] == 0 && sum[4] == 0 && sum[5] == 0));
    return {sum[6], sum[7], sum[8]};
}

std::unique_ptr<ReflectionModel> dielectric(double ior, std::int64_t internal_reflections = 4,
                                            double depth = 1) {
    return instance<ReflectionModel>(
        "dielectric", {{"ior", ior}, {"internal_reflections", internal_reflections}, {"depth", depth}});
}

/// The mirrored share: something is seen only towards the mirror image, which is on the -x side.
double mirrored_share(double ior, double angle) {
    BallEnvironment around;
    const Double3 mirror{-std::sin(angle), 0, std::cos(angle)};
    around.intensity = [&](Double3 towards) { return length(towards - mirror) < 1e-3 ? 1.0 : 0.0; };
    return static_cast<double>(seen_at(*dielectric(ior, 0), angle, around).x);
}

/// Fresnel's equations for the two polarisations (Born, Wolf 1999, 1.5.2 (21)), averaged.
double fresnel(double ior, double angle) {
    const double refracted = std::asin(std::sin(angle) / ior);
    const double s = std::sin(angle - refracted) / std::sin(angle + refracted);
    const double p = std::tan(angle - refracted) / std::tan(angle + refracted);
    return (s * s + p * p) / 2;
}

}  // namespace

TEST_CASE(
    "reflection/dielectric mirrors 4 % of light that falls straight on glass, 2 % on water, 17 % on "
    "diamond") {
    // ((n - 1) / (n + 1))^2
    CHECK(agree(mirrored_share(1.5, 0), 0.04, 1e-5));
    CHECK(agree(mirrored_share(4.0 / 3, 0), 1.0 / 49, 1e-5));
    CHECK(agree(mirrored_share(2.42, 0), 0.1724, 1e-3));
}

TEST_CASE(
    "reflection/dielectric follows Fresnel's equations at every angle: 7.4 % at glass's Brewster angle, all "
    "at 90") {
    for (const double ior : {1.1, 1.5, 2.42}) {
        for (double degrees = 5; degrees < 89; degrees += 7) {
            INFO("ior " << ior << ", " << degrees << " degrees");
            CHECK(agree(mirrored_share(ior, degrees * k_degree), fresnel(ior, degrees * k_degree), 1e-4));
        }
    }
    // There one polarisation is not mirrored at all, and the other ((n^2 - 1) / (n^2 + 1))^2.
    CHECK(agree(mirrored_share(1.5, std::atan(1.5)), 0.5 * std::pow(1.25 / 3.25, 2), 1e-4));
    CHECK(mirrored_share(1.5, 89.99 * k_degree) > 0.99);
}

TEST_CASE("reflection/dielectric obeys Snell's law: sin(theta_1) = n sin(theta_2)") {
    for (const double ior : {1.0, 1.33, 1.5, 4.0}) {
        for (const double degrees : {0.0, 10.0, 45.0, 80.0}) {
            INFO("ior " << ior << ", " << degrees << " degrees");
            BallEnvironment around;
            seen_at(*dielectric(ior), degrees * k_degree, around);
            const Double3 within = around.followed.at(0);
            CHECK(agree(-within.x * ior, std::sin(degrees * k_degree), 1e-5, 1e-6));
            CHECK(std::abs(within.y) < 1e-6);
            CHECK(within.z < 0);
            CHECK(agree(length(within), 1, 1e-5));
        }
    }
}

TEST_CASE("reflection/dielectric lets nothing out beyond the critical angle, 41.81 degrees for glass") {
    const auto share_out_at_first = [](double degrees) {
        Wall wall(degrees * k_degree);
        return static_cast<double>(seen_at(*dielectric(1.5), 0, wall).x);
    };
    CHECK(share_out_at_first(41.7) > 0.1);
    CHECK(share_out_at_first(41.9) == 0);
    CHECK(share_out_at_first(70) == 0);
    CHECK(agree(share_out_at_first(0), 0.96 * 0.96, 1e-5));
}

TEST_CASE(
    "reflection/dielectric makes the rainbow: light mirrored once within water is turned by 138 degrees at "
    "least") {
    // Descartes (1637), Les Météores, discourse 8: an angle of 42 degrees to the shadow of one's head.
    double least = 360;
    for (double degrees = 0; degrees < 89; degrees += 0.25) {
        BallEnvironment around;
        seen_at(*dielectric(4.0 / 3), degrees * k_degree, around);
        // Directions looked in: the mirror image, straight through, and once mirrored within.
        const Double3 view{-std::sin(degrees * k_degree), 0, -std::cos(degrees * k_degree)};
        const double turned =
            std::acos(std::clamp(dot(view, unit(around.looked.at(2))), -1.0, 1.0)) / k_degree;
        least = std::min(least, turned);
    }
    CHECK(agree(180 - least, 42.03, 1e-3));
}

TEST_CASE(
    "reflection/dielectric loses no light: in surroundings of one intensity a clear ball cannot be seen") {
    for (const double ior : {1.0, 1.33, 2.42, 4.0}) {
        for (const std::int64_t within : {0, 1, 4, 16}) {
            for (double degrees = 0; degrees < 90; degrees += 6) {
                INFO("ior " << ior << ", " << within << " reflections within, " << degrees << " degrees");
                BallEnvironment around;
                const Vec3 seen = seen_at(*dielectric(ior, within), degrees * k_degree, around);
                CHECK(agree(seen, Vec3{1, 1, 1}, 2e-5));
            }
        }
    }
}

TEST_CASE("reflection/dielectric follows light until it can contribute less than 1/1024 of the result") {
    // Straight through glass, 4 % are mirrored each time: 0.04, 0.0016, 6e-5, 2.6e-6, 1e-7 ... of 0.96.
    const auto rays = [](float most) {
        BallEnvironment around;
        around.most = most;
        seen_at(*dielectric(1.5, 16), 0, around);
        return around.followed.size();
    };
    CHECK(rays(1) == 3);
    CHECK(rays(1e3f) == 5);  // a sun: even the little that is left of it may be visible
    CHECK(rays(1e30f) == 17);
}

TEST_CASE("reflection/dielectric shows the sum of all reflections within, to a thousandth") {
    // On the straight path, light leaves forwards and backwards alternately.
    const double mirrored = 0.04, refracted = 0.96;
    for (const double behind : {0.0, 0.01, 1.0}) {
        for (const double ahead : {0.0, 0.02, 1.0}) {
            double expected = mirrored * behind, share = refracted * refracted;
            for (int within = 0; within < 40; ++within, share *= mirrored)
                expected += share * (within % 2 == 0 ? ahead : behind);
            BallEnvironment around;
            around.intensity = [&](Double3 towards) { return towards.z < 0 ? ahead : behind; };
            const Vec3 seen = seen_at(*dielectric(1.5, 16), 0, around);
            INFO("ahead " << ahead << ", behind " << behind);
            CHECK(agree(seen, Double3{expected, expected, expected}, 1e-3));
        }
    }
}

TEST_CASE("reflection/dielectric terminates in non-finite surroundings") {
    BallEnvironment around;
    around.intensity = [](Double3) { return std::numeric_limits<double>::quiet_NaN(); };
    CHECK(std::isnan(seen_at(*dielectric(1.5), 0.3, around).x));
    Wall wall(std::numeric_limits<double>::quiet_NaN());
    seen_at(*dielectric(1.5), 0.3, wall);
}

TEST_CASE(
    "reflection/dielectric obeys Beer's law: the object's colour after `depth`, its square after twice "
    "that") {
    // Straight through the ball, 2 m, with one reflection within: F + (1 - F) T ((1 - F) + F T).
    for (const double depth : {0.5, 1.0, 3.0}) {
        BallEnvironment around;
        const Vec3 seen = seen_at(*dielectric(1.5, 1, depth), 0, around, {0.25f, 0.5f, 1});
        const auto expected = [&](double color) {
            const double t = std::pow(color, 2 / depth);
            return 0.04 + 0.96 * t * (0.96 + 0.04 * t);
        };
        INFO("depth " << depth);
        CHECK(agree(seen, Double3{expected(0.25), expected(0.5), expected(1)}, 1e-4));
    }
}

TEST_CASE(
    "reflection/dielectric shows a light where Blinn's half vector is near the normal, as much as is "
    "mirrored there") {
    const auto model = instance<ReflectionModel>("dielectric", {{"ks", 1.0}, {"shininess", 100.0}});
    const double angle = 70 * k_degree;
    const ReflectionSample mirror{{0, 0, 1},
                                  direction({std::sin(angle), 0, std::cos(angle)}),
                                  direction({-std::sin(angle), 0, std::cos(angle)}),
                                  {1, 1, 1},
                                  {2, 2, 2}};
    const ReflectedPair seen = reflect(*model, {mirror}, {1, 1, 1})[0];
    CHECK(agree(static_cast<double>(seen.specular.x), 2 * fresnel(1.5, angle), 1e-4));
    CHECK(seen.diffuse == Vec3{});
    ReflectionSample below = mirror;
    below.to_light = direction({-std::sin(angle), 0, -std::cos(angle)});
    CHECK(reflect(*model, {below}, {1, 1, 1})[0].specular == Vec3{});
}
