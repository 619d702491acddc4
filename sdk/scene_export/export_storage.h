// Owns the memory behind the spans of an ExportedScene.
#pragma once

#include <cstddef>
#include <cstdint>  // before <memory>, whose std::align depends on it
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

import candela.api;
import candela.geometry;
import candela.plugins;
import candela.shading;
import candela.util;

namespace candela {

struct ExportStorage : ExportedGeometry {
    struct Object {
        std::string label;
        std::unique_ptr<Shape> tessellator;
        Transform transform;
        bool encloses = false;
        std::vector<ExportedValues> shadings, materials;
        std::vector<ParamSet> shading_values;
        std::vector<ExportedTexturedNumber> textured_numbers, color_numbers, emission_numbers,
            occlusion_numbers, opacity_numbers;
        std::optional<ExportedNormalMap> normal_map;
        std::vector<VertexChannel> channels;
    };

    explicit ExportStorage(Registry& plugins) : registry(plugins) {}

    ExportedMesh in_object_space(std::size_t object) override;
    ExportedMesh in_world_space(std::size_t object) override;
    bool has_default_normals(std::size_t object, std::size_t shading) override;

    /// The values of a set, which is kept as long as they are.
    ExportedValues kept(const ParamSet& values);

    /// Like kept(), for a plugin whose kernel may have tables: those of the instance that `make` creates.
    template <class Make>
    ExportedValues kept(const PluginDescriptor& plugin, const ParamSet& values, Make make) {
        const ExportedValues result = kept(values);
        if (has_tables(plugin)) put_tables(plugin, *make());
        return result;
    }

    /// Call it when all tables exist and no longer move.
    void connect_tables();

    struct PlacedTable {
        ParamValue* value;
        std::size_t size;
    };

    Registry& registry;
    bool has_vertex_colors = false;  // the target's ability
    std::string title, environment;
    std::vector<ExportedSample> samples;
    std::deque<ParamSet> sets;                    // the values point into its texts
    std::deque<std::vector<ParamValue>> numbers;  // a deque, so that its elements do not move
    std::deque<std::string> labels;
    std::vector<float> tables;
    std::vector<PlacedTable> placed_tables;
    std::map<const PluginDescriptor*, std::string>
        names;  // of shading and reflection models, in the registry
    std::vector<ExportedModel> light_models;
    std::vector<ExportedLight> lights;
    std::vector<RenderLight> sources;                 // of the lights, which point into their radiance
    std::deque<std::vector<PunctualLight>> punctual;  // the lights point into it
    std::vector<ExportedShading> shadings;
    std::vector<ExportedReflection> reflections;
    std::vector<ExportedObject> exported_objects;
    std::vector<Object> objects;
    std::deque<std::shared_ptr<const MipMap>> mip_maps;  // the textures point into it
    std::deque<std::vector<ExportedTextureLevel>> levels;
    std::vector<ExportedTexture> textures;
    std::vector<const char*> left_out;
    ExportedScene scene;

    // Of the mesh that was last requested:
    PlacedShape placed;
    std::vector<std::span<const float>> channels;
    std::vector<Vec3Arrays> normal_sets;
    std::vector<ConstVec3Span> normals_view;
    std::vector<std::size_t> normals_of;

  private:
    static bool has_tables(const PluginDescriptor& plugin);
    /// Puts the tables of an instance whose values were kept last.
    void put_tables(const PluginDescriptor& plugin, const Instance& instance);
    void put_table(std::span<const float> table, ParamValue& value);

    MeshRequest request(const Object& of, bool needs_uv) const;
    ExportedMesh view(bool encloses);
    /// Throws if the object's mesh has colours that the target cannot express.
    void require_no_colors(std::size_t object) const;
};

}  // namespace candela
