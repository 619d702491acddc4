#include "uniforms.h"

#include <bit>

#include "candela/target/glsl.h"
#include "candela/target/mirror.h"

namespace candela::three_target {

namespace {

Json member_json(const ParamSpec& p, const ParamValue& value) {
    switch (p.type) {
        case ParamType::matrix: {
            Json columns = Json::array();
            for (const Vec3& c : target::columns_of(value))
                columns.insert(columns.end(), {shortest(c.x), shortest(c.y), shortest(c.z)});
            return columns;
        }
        case ParamType::file:
        case ParamType::numbers:
            return {{"first", value.integer}, {"count", value.list.size()}};
        case ParamType::real:
            return shortest(value.number[0]);
        case ParamType::integer:
        case ParamType::boolean:
        case ParamType::choice:
            return value.integer;
        default:
            return vector_json({value.number[0], value.number[1], value.number[2]});
    }
}

/// A texel has room for four numbers.
class Texels {
  public:
    void add(std::int32_t x, std::int32_t y = 0, std::int32_t z = 0) {
        numbers_.insert(numbers_.end(), {x, y, z, 0});
    }
    void add(Vec3 v) {
        add(std::bit_cast<std::int32_t>(v.x), std::bit_cast<std::int32_t>(v.y),
            std::bit_cast<std::int32_t>(v.z));
    }
    void add(const ParamSpec& p, const ParamValue& value) {
        switch (p.type) {
            case ParamType::matrix:
                for (const Vec3& column : target::columns_of(value)) add(column);
                break;
            case ParamType::file:
            case ParamType::numbers:
                add(value.integer, static_cast<std::int32_t>(value.list.size()));
                break;
            case ParamType::integer:
            case ParamType::boolean:
            case ParamType::choice:
                add(value.integer);
                break;
            default:
                add(Vec3{value.number[0], value.number[1], value.number[2]});
        }
    }
    const std::vector<std::int32_t>& numbers() const { return numbers_; }

  private:
    std::vector<std::int32_t> numbers_;
};

}  // namespace

Json struct_json(const ExportedModel& model, const ExportedValues& values) {
    Json json = Json::object();
    for (const std::size_t i : model.plugin->kernel.members) {
        const ParamSpec& p = model.plugin->parameters[i];
        json[p.name] = member_json(p, values.runtime[i]);
    }
    return json;
}

Json light_counts(const ExportedScene& scene) {
    Json counts = Json::object();
    for (const target::LightBlock& block : target::light_blocks(scene)) counts[block.count] = block.lights;
    return counts;
}

std::vector<std::int32_t> light_table(const ExportedScene& scene) {
    Texels texels;
    for (std::size_t m = 0; m < scene.light_models.size(); ++m) {
        const PluginDescriptor& plugin = *scene.light_models[m].plugin;
        for (const ExportedLight& light : scene.lights) {
            if (light.model != m) continue;
            for (const std::size_t i : plugin.kernel.members)
                texels.add(plugin.parameters[i], light.values.runtime[i]);
            if (target::has_mirror_images(scene))
                texels.add(
                    target::radiance_place(scene, static_cast<std::size_t>(&light - scene.lights.data())));
            if (scene.has_shadows) texels.add(target::shadow_texel(light));
        }
    }
    return texels.numbers();
}

}  // namespace candela::three_target
