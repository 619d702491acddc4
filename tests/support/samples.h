// Random points and directions, and references in double precision that are derived from the equations alone.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

import candela.core;

/// The batch sizes of all tests: one, an odd few, a full vector, many.
inline constexpr std::array<std::size_t, 4> k_batch_sizes = {1, 7, 64, 1000};

/// Double-precision vectors for references.
struct Double3 {
    double x = 0, y = 0, z = 0;
};
inline Double3 exact(candela::Vec3 v) { return {v.x, v.y, v.z}; }
inline candela::Vec3 rounded(Double3 d) {
    return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}
inline Double3 operator+(Double3 a, Double3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Double3 operator-(Double3 a, Double3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Double3 operator*(double s, Double3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Double3 a, Double3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Double3 cross(Double3 a, Double3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Double3 a) { return std::sqrt(dot(a, a)); }
inline Double3 unit(Double3 a) { return (1 / length(a)) * a; }

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    candela::Vec3 direction();
    candela::Vec3 point(double half_size);

  private:
    std::mt19937 engine_;
};

/// Runs `check(batch size)` for each instruction set of the machine and each of k_batch_sizes.
void each_way(const std::function<void(std::size_t)>& check);

/// The inputs of a reflection model: a surface point, a light's sample and the observer.
struct ReflectionSample {
    candela::Vec3 normal, to_observer, to_light;
    candela::Vec3 diffuse, specular;  // light's intensities
};

/// The tangent of the samples below at a point with that unit normal.
Double3 tangent_at(Double3 normal);

struct ReflectedPair {
    candela::Vec3 diffuse, specular;
};

/// Runs `model` over the samples as one batch; the sums start at zero.
std::vector<ReflectedPair> reflect(const candela::ReflectionModel& model,
                                   const std::vector<ReflectionSample>& samples, candela::Rgb color);
/// Like reflect(), for ambient light of intensity `ambient`.
std::vector<candela::Vec3> reflect_ambient(const candela::ReflectionModel& model,
                                           const std::vector<ReflectionSample>& samples, candela::Rgb color,
                                           candela::Vec3 ambient);

struct ExactPair {
    Double3 diffuse, specular;
};
using ReflectionReference = std::function<ExactPair(Double3 n, Double3 v, Double3 l, Double3 color)>;

/// Compares a reflection model with a reference at random samples, for every instruction set and batch size,
/// and each sample on its own with the batch (1e-5).
void check_reflection(const candela::ReflectionModel& model, const ReflectionReference& reference,
                      double tolerance);

/// The light that a receiver gets.
struct IncidentSample {
    candela::Vec3 to_light, diffuse, specular;
};
std::vector<IncidentSample> illuminate(const candela::Light& light,
                                       const std::vector<candela::Vec3>& positions,
                                       candela::Vec3 normal = {0, 1, 0});
std::vector<candela::Vec3> illuminate_ambient(const candela::Light& light,
                                              const std::vector<candela::Vec3>& positions);

struct ExactIncident {
    Double3 to_light, intensity;
};
using LightReference = std::function<ExactIncident(Double3 position)>;

/// Compares a light with a reference at random points within 5 m, like check_reflection().
void check_light(const candela::Light& light, const LightReference& reference, double tolerance);

/// Whether two numbers agree to `relative` of the larger, or to `absolute` near zero.
bool agree(double a, double b, double relative, double absolute = 1e-7);
bool agree(candela::Vec3 a, candela::Vec3 b, double relative, double absolute = 1e-7);
bool agree(candela::Vec3 a, Double3 b, double relative, double absolute = 1e-7);
std::string text(candela::Vec3 v);
std::string text(Double3 v);
