// The base of every plugin: how it is described and created, and its two exported functions.
//
// A plugin's source includes the header of its kind (light_plugin.h, reflection_plugin.h, …), which includes
// this one, and ends with that header's macro. CANDELA_PLUGIN_NAME, CANDELA_PLUGIN_VERSION and
// CANDELA_KERNEL_FILE come from candela_add_plugin().
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "candela/color.h"
#include "candela/fields.h"
#include "candela/kernel/batch.h"
#include "candela/kernel/kernel.h"
#include "candela/light.h"
#include "candela/math.h"
#include "candela/plugin/abi.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"
#include "candela/shading_model.h"

namespace candela::sdk {

#ifdef CANDELA_KERNEL_FILE
/// The text of the plugin's .kernel file, which CANDELA_EMBED_KERNEL embeds in the library.
extern const char k_kernel_text[] __asm__("candela_kernel_text") __attribute__((visibility("hidden")));
#else
inline constexpr const char* k_kernel_text = nullptr;
#endif

using kernel::add_product;
using kernel::load;
using kernel::store;
using kernel::vec2;

CANDELA_KERNEL_INLINE vec3 kernel_vector(Vec3 v) { return vec3(v.x, v.y, v.z); }
CANDELA_KERNEL_INLINE vec3 kernel_vector(Rgb c) { return vec3(c.r, c.g, c.b); }

/// The numbers of an instance's tables, by parameter.
using TableNumbers = std::vector<std::vector<float>>;

/// An instance that owns the numbers that its tables refer to.
template <class Model>
class WithTables final : public Model {
  public:
    template <class Constants>
    WithTables(TableNumbers&& tables, const Constants& constants)
        : Model(constants), tables_(std::move(tables)) {}
    /// Of a class that also reads values which are not among the constants, such as a file's name.
    template <class Constants>
        requires std::is_constructible_v<Model, const Constants&, std::span<const ParamValue>>
    WithTables(TableNumbers&& tables, const Constants& constants, std::span<const ParamValue> values)
        : Model(constants, values), tables_(std::move(tables)) {}

    std::span<const float> table(std::size_t parameter) const noexcept override {
        return parameter < tables_.size() ? std::span<const float>(tables_[parameter])
                                          : std::span<const float>();
    }

  private:
    TableNumbers tables_;
};

/// The parameters of a kernel, as they are.
struct NoPreparation {
    template <class Params>
    CANDELA_KERNEL_INLINE static const Params& run(const Params& params) {
        // NOLINTNEXTLINE(bugprone-return-const-ref-from-parameter): callers copy it at once
        return params;
    }
};

/// Whether instances of `Model` can evaluate the kernel with other parameters at each point. A Table has no
/// values of points.
template <class Model, class Params, class Preparation, const auto& fields>
constexpr bool can_vary() {
    if constexpr (have_tables(fields) || fields.empty()) {
        return false;
    } else {
        // Not for a class that derives from such a model, and changes it.
        return requires {
            requires std::is_base_of_v<Model, typename Model::template Varying<Params, Preparation, fields>>;
        };
    }
}

/// The class of the instances of `Model`.
template <class Model, class Params, class Preparation, const auto& fields>
struct InstanceOf {
    using type = Model;
};
template <class Model, class Params, class Preparation, const auto& fields>
    requires(can_vary<Model, Params, Preparation, fields>())
struct InstanceOf<Model, Params, Preparation, fields> {
    using type = typename Model::template Varying<Params, Preparation, fields>;
};

/// Creates an instance of `Model` from what `Preparation` makes of the parameters, which `values` fill
/// according to `fields`.
template <class Model, class Params, class Preparation, const auto& fields>
Instance* created(std::span<const ParamValue> values) {
    Params params = params_from(fields, values);
    if constexpr (have_tables(fields)) {
        static_assert(!std::is_final_v<Model>,
                      "a class whose parameters have tables is not final: its instances get their numbers");
        TableNumbers tables(fields.size());
        for (std::size_t i = 0; i < fields.size(); ++i) {
            tables[i] = fields[i].numbers_of(values[i]);
            if (tables[i].empty()) continue;
            Table table;
            table.numbers = tables[i].data();
            table.count = static_cast<int>(tables[i].size());
            params.*fields[i].table = table;
        }
        using Constants = std::remove_cvref_t<decltype(Preparation::run(params))>;
        if constexpr (std::is_constructible_v<Model, const Constants&, std::span<const ParamValue>>) {
            return new WithTables<Model>(std::move(tables), Preparation::run(params), values);
        } else {
            return new WithTables<Model>(std::move(tables), Preparation::run(params));
        }
    } else if constexpr (can_vary<Model, Params, Preparation, fields>()) {
        return new typename Model::template Varying<Params, Preparation, fields>(params);
    } else {
        return new Model(Preparation::run(params));
    }
}

/// The description of a plugin, apart from its parameters.
struct About {
    const char* title = "";
    const char* summary = "";
    const char* formula = "";
    const char* reference = "";
    std::span<const RelationSpec> relations{};
    std::span<const Property> properties{};
    std::span<const FileFormat> formats{};
    std::span<const PresetSpec> presets{};
};

template <class Params, class Result>
constexpr bool takes_first(Result (*)()) {
    return false;
}
template <class Params, class Result, class First, class... Rest>
constexpr bool takes_first(Result (*)(First, Rest...)) {
    return std::is_same_v<First, Params>;
}
/// The kernel function <prefix>_<name>, as a class of kernel functions lists it in `k_kernel_functions`.
template <class Params, auto function>
constexpr KernelFunction kernel_function(const char* name) {
    return {name, takes_first<Params>(function)};
}

/// The functions of `Model`, preceded by x_prepare if the kernel has it.
template <class Model, bool is_prepared>
std::span<const KernelFunction> kernel_functions() {
    if constexpr (is_prepared) {
        static constexpr auto all = [] {
            std::array<KernelFunction, std::size(Model::k_kernel_functions) + 1> functions{};
            functions[0] = {"prepare", true};
            std::ranges::copy(Model::k_kernel_functions, functions.begin() + 1);
            return functions;
        }();
        return all;
    } else {
        return Model::k_kernel_functions;
    }
}

/// The descriptor's entry for the kernel behind `Model`, which lists its functions in `k_kernel_functions`;
/// `parameters` is the name of `Params`, as its author wrote it.
template <class Model, class Params, bool is_prepared, std::size_t count>
KernelText kernel_text(const char* prefix, const char* parameters,
                       const std::array<Field<Params>, count>& fields) {
    static const std::array<std::size_t, count> members = by_member(fields);
    const std::string_view qualified = parameters;
    const auto colon = qualified.rfind(':');
    const bool takes_none = std::is_same_v<Params, NoParams>;
    return {.text = k_kernel_text,
            .prefix = prefix,
            .parameters = takes_none ? "" : parameters + (colon == qualified.npos ? 0 : colon + 1),
            .functions = kernel_functions<Model, is_prepared>(),
            .members = members};
}

/// The needs of the instances of `Model`: its public static member `k_needs`, if that is a `Needs`; otherwise
/// the default.
template <class Needs, class Model>
constexpr Needs needs_of() {
    if constexpr (requires { requires std::same_as<decltype(Model::k_needs), const Needs>; }) {
        return Model::k_needs;
    } else {
        return {};
    }
}

/// Whether `Model` is a light with an ambient part.
template <class Model>
constexpr bool has_ambient() {
    // A function that is not overridden is a member of the interface; one that cannot be named here is
    // overridden by a private function.
    constexpr bool is_default = requires {
        requires std::same_as<decltype(&Model::illuminate_ambient), decltype(&Light::illuminate_ambient)>;
    };
    return std::is_base_of_v<Light, Model> && !is_default;
}

/// Like needs_of(), for a shading model: whether it has its own vertex normals need not be declared.
template <class Model>
constexpr ShadingNeeds shading_needs() {
    auto needs = needs_of<ShadingNeeds, Model>();
    needs.default_vertex_normals = requires {
        requires std::same_as<decltype(&Model::vertex_normals), decltype(&ShadingModel::vertex_normals)>;
    };
    return needs;
}

/// Calls a kernel function with the parameters first, or without them if it takes none.
template <auto function, class Params, class... Arguments>
CANDELA_KERNEL_INLINE auto call(const Params& params, Arguments... arguments) {
    if constexpr (std::is_invocable_v<decltype(function), Params, Arguments...>) {
        return function(params, arguments...);
    } else {
        return function(arguments...);
    }
}

}  // namespace candela::sdk

/// Exports a plugin of `kind_` whose instances are created by `new Model(params)`, with `params` filled
/// according to `fields_`, an array of candela::sdk::Field. The other arguments initialise a
/// candela::sdk::About.
#define CANDELA_PLUGIN(kind_, Model, fields_, ...)                                                   \
    CANDELA_EXPORT_PLUGIN(kind_, Model, fields_, candela::sdk::NoPreparation, candela::KernelText{}, \
                          __VA_ARGS__)

#ifdef CANDELA_KERNEL_FILE
// The assembler reads the file: C++ cannot yet.
#define CANDELA_EMBED_KERNEL                                                             \
    __asm__(".pushsection .rodata\ncandela_kernel_text:\n.incbin \"" CANDELA_KERNEL_FILE \
            "\"\n"                                                                       \
            ".byte 0\n.popsection\n");
#else
#define CANDELA_EMBED_KERNEL
#endif

/// The type of the first argument of a kernel's functions, within CANDELA_KERNEL_PLUGIN: the result of
/// `prefix_prepare(Params_)` if that function exists, otherwise `Params_`.
#define CANDELA_KERNEL_CONSTANTS(prefix_, Params_) \
    decltype(prefix_##_preparation::run(std::declval<const Params_&>()))

/// Like CANDELA_PLUGIN, for a plugin made of kernel functions: their names begin with `prefix_`, and their
/// first argument is `Params_`, or what `prefix_prepare` makes of it. `Model` lists them in a static member
/// `k_kernel_functions`. `prefix_prepare` is found by argument-dependent lookup, as it need not exist.
#define CANDELA_KERNEL_PLUGIN(kind_, Model, prefix_, Params_, fields_, ...)                                  \
    CANDELA_EMBED_KERNEL                                                                                     \
    namespace {                                                                                              \
    struct prefix_##_preparation {                                                                           \
        template <class Params>                                                                              \
        static constexpr bool is_there = requires(const Params& params) { prefix_##_prepare(params); };      \
        template <class Params>                                                                              \
        CANDELA_KERNEL_INLINE static auto run(const Params& params) {                                        \
            if constexpr (is_there<Params>) {                                                                \
                return prefix_##_prepare(params);                                                            \
            } else {                                                                                         \
                return params;                                                                               \
            }                                                                                                \
        }                                                                                                    \
    };                                                                                                       \
    }                                                                                                        \
    static_assert(candela::sdk::fill_all_members<Params_>(fields_),                                          \
                  "each member of a kernel's struct is one of the plugin's parameters");                     \
    CANDELA_EXPORT_PLUGIN(                                                                                   \
        kind_, Model, fields_, prefix_##_preparation,                                                        \
        (candela::sdk::kernel_text<                                                                          \
            std::remove_pointer_t<decltype(new Model(prefix_##_preparation::run(std::declval<Params_>())))>, \
            Params_, prefix_##_preparation::is_there<Params_>>(#prefix_, #Params_, fields_)),                \
        __VA_ARGS__)

#define CANDELA_EXPORT_PLUGIN(kind_, Model, fields_, Preparation, kernel_, ...)                              \
    extern "C" CANDELA_EXPORT const char* candela_plugin_abi() { return CANDELA_ABI; }                       \
    extern "C" CANDELA_EXPORT const candela::PluginDescriptor* candela_plugin_descriptor() {                 \
        static constexpr auto specs = candela::sdk::specs_of(fields_);                                       \
        static const candela::sdk::About about = __VA_ARGS__;                                                \
        using Params = std::remove_cvref_t<decltype(candela::sdk::params_from(fields_, {}))>;                \
        using Model_ = std::remove_pointer_t<decltype(new Model(Preparation::run(std::declval<Params>())))>; \
        using Made = candela::sdk::InstanceOf<Model_, Params, Preparation, fields_>::type;                   \
        static const candela::PluginDescriptor descriptor{                                                   \
            .kind = candela::PluginKind::kind_,                                                              \
            .name = CANDELA_PLUGIN_NAME,                                                                     \
            .version = CANDELA_PLUGIN_VERSION,                                                               \
            .title = about.title,                                                                            \
            .summary = about.summary,                                                                        \
            .formula = about.formula,                                                                        \
            .reference = about.reference,                                                                    \
            .parameters = specs,                                                                             \
            .relations = about.relations,                                                                    \
            .properties = about.properties,                                                                  \
            .presets = about.presets,                                                                        \
            .formats = about.formats,                                                                        \
            .has_ambient = candela::sdk::has_ambient<Made>(),                                                \
            .surface_needs = candela::sdk::needs_of<candela::SurfaceNeeds, Made>(),                          \
            .shading_needs = candela::sdk::shading_needs<Made>(),                                            \
            .kernel = kernel_,                                                                               \
            .create = candela::sdk::created<Model_, Params, Preparation, fields_>};                          \
        return &descriptor;                                                                                  \
    }
