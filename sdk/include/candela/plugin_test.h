// For tests of a plugin, with any compiler: creates instances as a host does, evaluates reflection models,
// and collects the triangles of a shape.
//
//     const auto light = candela::sdk::make<candela::Light>(CANDELA_PLUGIN_DIR, "lantern",
//     {{"intensity", 3.0}});
//
// CANDELA_PLUGIN_DIR comes from candela_add_plugin_test().
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "candela/extensions.h"
#include "candela/image_format.h"
#include "candela/light.h"
#include "candela/plugin/instances.h"
#include "candela/reflection_model.h"
#include "candela/shading_model.h"
#include "candela/shape.h"
#include "candela/target.h"

namespace candela::sdk {

/// The kind of plugin whose instances implement `Interface`.
template <class Interface>
constexpr PluginKind kind_of() {
    if constexpr (std::is_same_v<Interface, Light>) return PluginKind::light;
    if constexpr (std::is_same_v<Interface, ReflectionModel>) return PluginKind::reflection;
    if constexpr (std::is_same_v<Interface, ShadingModel>) return PluginKind::shading;
    if constexpr (std::is_same_v<Interface, Shape>) return PluginKind::shape;
    if constexpr (std::is_same_v<Interface, ImageFormat>) return PluginKind::image;
    if constexpr (std::is_same_v<Interface, Target>) return PluginKind::target;
}

/// Creates an instance of the plugin in `directory`; parameters not among `settings` have their defaults.
/// Throws std::exception with the message that a user would see.
template <class Interface>
std::unique_ptr<Interface> make(std::string_view directory, std::string_view name,
                                std::initializer_list<ParamSetting> settings = {}) {
    std::unique_ptr<Instance> made =
        make_instance(directory, kind_of<Interface>(), name, std::span(settings.begin(), settings.size()));
    auto* const typed = dynamic_cast<Interface*>(made.get());
    if (typed == nullptr) throw std::runtime_error(std::string(name) + " made something of another kind");
    static_cast<void>(made.release());
    return std::unique_ptr<Interface>(typed);
}

/// The reflection of white light by a model at a white point.
struct Reflection {
    Vec3 ambient, diffuse, specular;
};

/// For a light of intensity 1, without ambient light. The normal is +y; observer and light are in the plane
/// x = 0, at angles in degrees from the normal towards +z.
inline Reflection reflected(const ReflectionModel& model, float observer, float light) {
    constexpr float k_degree = 0.0174532925f;
    const float zero = 0, one = 1;
    const float v[] = {std::cos(observer * k_degree), std::sin(observer * k_degree)};
    const float l[] = {std::cos(light * k_degree), std::sin(light * k_degree)};
    float out[9] = {};
    model.reflect(
        {.count = 1,
         .normal = {&zero, &one, &zero},
         .to_observer = {&zero, &v[0], &v[1]},
         .tangent = {&one, &zero, &zero},
         .color = {1, 1, 1},
         .position = {&zero, &zero, &zero},
         .uv = {&zero, &zero}},
        {.to_light = {&zero, &l[0], &l[1]}, .diffuse = {&one, &one, &one}, .specular = {&one, &one, &one}},
        {.ambient = {out, out + 1, out + 2},
         .diffuse = {out + 3, out + 4, out + 5},
         .specular = {out + 6, out + 7, out + 8}});
    return {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}, {out[6], out[7], out[8]}};
}

/// Like the above, for the reflection model in `directory` with `settings`. Throws like make().
inline Reflection reflected(std::string_view directory, std::string_view name,
                            std::initializer_list<ParamSetting> settings, float observer, float light) {
    return reflected(*make<ReflectionModel>(directory, name, settings), observer, light);
}

/// The triangles of a shape, in object space.
class Triangles final : public MeshSink {
  public:
    explicit Triangles(const Shape& shape, const MeshRequest& request = {}) {
        shape.tessellate(request, *this);
    }

    MeshSpans allocate(const MeshLayout& layout) override {
        layout_ = layout;
        indices_.assign(3 * layout.triangles, 0);
        smooth_group_.assign(layout.has_smooth_groups ? layout.vertices : 0, 0);
        return {.position = array(0, true),
                .indices = indices_,
                .normal = array(1, layout.has_normals),
                .uv = uv(layout.has_uv),
                .dpdu = array(2, layout.has_derivatives),
                .dpdv = array(3, layout.has_derivatives),
                .smooth_group = smooth_group_};
    }

    const MeshLayout& layout() const noexcept { return layout_; }
    std::size_t size() const noexcept { return layout_.triangles; }
    /// Corner 0, 1 or 2 of a triangle.
    Vec3 corner(std::size_t triangle, std::size_t index) const {
        const std::size_t vertex = indices_[3 * triangle + index];
        return {arrays_[0].x[vertex], arrays_[0].y[vertex], arrays_[0].z[vertex]};
    }

  private:
    struct Array {
        std::vector<float> x, y, z;
    };

    Vec3Span array(std::size_t index, bool wanted) {
        if (!wanted) return {};
        Array& a = arrays_[index];
        for (std::vector<float>* axis : {&a.x, &a.y, &a.z}) axis->assign(layout_.vertices, 0);
        return {a.x.data(), a.y.data(), a.z.data()};
    }
    Vec2Span uv(bool wanted) {
        const Vec3Span span = array(4, wanted);
        return {span.x, span.y};
    }

    MeshLayout layout_;
    Array arrays_[5];  // positions, normals, dp/du, dp/dv, uv
    std::vector<std::uint32_t> indices_, smooth_group_;
};

}  // namespace candela::sdk
