module;

#include "candela/plugin/export.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

export module candela.shading:surface;

import :environment_map;
import :texture;
import candela.api;
import candela.geometry;
import candela.plugins;
import candela.raster;
import candela.scene;

export namespace candela {

/// A light as data.
struct LightData {
    std::vector<PunctualLight> samples;
    Rgb ambient{};
};

/// A light, and the plugin it comes from. See render_light().
struct RenderLight {
    std::string plugin;
    std::unique_ptr<Light> light;
    bool has_ambient = false;
    std::optional<LightData> data{};  // empty: only the light itself knows
};

/// Creates the light, and asks it once whether it is data. Throws Error, naming the plugin.
CANDELA_EXPORT RenderLight render_light(Registry& registry, const Model& model, ColorEncoding encoding);

/// The appearance of an object's surface.
struct CANDELA_EXPORT SurfaceModels {
    Rgb color;
    std::shared_ptr<const MipMap> color_texture{};  // multiplies the colour; null: none
    TextureWrap color_texture_wrap = TextureWrap::repeat;
    std::string shading_plugin;
    std::unique_ptr<ShadingModel> shading;
    ShadingNeeds shading_needs{};
    std::string reflection_plugin;
    std::unique_ptr<ReflectionModel> reflection;
    SurfaceNeeds reflection_needs{};
    // The extensions that `reflection` offers.
    const AllLightsReflection* all_lights_reflection = nullptr;
    const EnvironmentReflection* environment_reflection = nullptr;

    /// Create the models, and ask them once what they need and offer. Throw Error, naming the plugin.
    void set_shading(Registry& registry, const Model& model, ColorEncoding encoding);
    void set_reflection(Registry& registry, const Model& model, ColorEncoding encoding);

    PointNeeds needs() const;
};

/// The inside of an object, for a transparent model.
struct Interior {
    const Mesh* mesh = nullptr;
    const TriangleTree* tree =
        nullptr;  // of that mesh; null: light that enters does not meet the object again
};

/// The lights of a scene, and the view of it.
struct LightingContext {
    std::span<const RenderLight> lights;
    const EnvironmentMap* environment = nullptr;  // null: transparent objects show no surroundings
    Camera camera;
};

}  // namespace candela
