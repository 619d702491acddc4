// The steps of shading one point.
module;

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

export module candela.shading:trace;

import candela.api;
import candela.geometry;

export namespace candela {

/// The light that one sample of a light source sends to a point, and what the surface reflects of it.
struct LightTrace {
    static constexpr int k_ambient = -1;
    static constexpr int k_mirrored = -2;

    std::size_t light = 0;   // index among the scene's
    int sample = k_ambient;  // of the light; k_ambient: its ambient part; k_mirrored: its mirror image
    Vec3 to_light{};         // L, unit; zero for ambient light and a mirror image
    Vec3 diffuse{};  // the intensity that arrives, per channel; the ambient intensity for ambient light
    Vec3 specular{};
    /// The fraction that is not blocked, which both intensities include; 1 without shadows, and where no ray
    /// is traced, because the light does not shine there or the surface faces away from it.
    Vec3 visibility{1, 1, 1};
    std::optional<Blocker> blocker{};  // nearest to the point; its distance is in metres
    Vec3 reflected_ambient{};
    Vec3 reflected_diffuse{};
    Vec3 reflected_specular{};
};

/// The value of a number of the material that differs from point to point.
struct VaryingValue {
    std::size_t parameter = 0;  // of the reflection model
    std::size_t channel = 0;
    float value = 0;  // as the model receives it
};

/// A point at which light is evaluated. World space; directions are unit vectors that point away from the
/// surface.
struct PointTrace {
    Vec3 position{};
    Vec3 normal{};          // N
    Vec3 shading_normal{};  // from the shading model, before a normal map or bump map tilts it
    Vec3 normal_texel{};    // of that map: its channels, 0 to 1
    Vec3 to_observer{};
    Vec3 tangent{};                          // zero unless the reflection model needs it
    Vec3 color{};                            // C_o
    std::vector<VaryingValue> parameters{};  // those of the material that have textures
    Vec3 face_normal{};                      // of the visible side, as are the following
    Vec3 vertex_normal{};                    // interpolated, not unit
    Vec3 barycentric{};
    float u = 0, v = 0;
    std::array<float, 2> second_uv{};  // zero unless a texture is placed by them
    Vec3 dpdu{}, dpdv{};
    std::array<Vec3, 3> corner_position{};  // of its triangle; zero unless the shading model needs them
    std::array<Vec3, 3> corner_normal{};
    bool from_behind = false;  // the surface is open and its normal has been flipped
    std::vector<LightTrace> lights{};
    float occlusion = 1;                    // of ambient light, by the material: a factor of I_a
    Vec3 emission{};                        // I_e
    Vec3 surroundings{};                    // what a transparent surface shows of them
    Vec3 ambient{}, diffuse{}, specular{};  // I_a, I_d, I_s: sums over the lights
    Vec3 intensity{};                       // I, as the renderer computes it
};

}  // namespace candela
