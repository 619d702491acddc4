#include "scene_export/export_storage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

import candela.api;
import candela.geometry;
import candela.plugins;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

namespace {

/// Whether a parameter is a table of the plugin's kernel, which has neither texts nor lists.
bool is_table(const PluginDescriptor& plugin, std::size_t parameter) {
    const ParamType type = plugin.parameters[parameter].type;
    return (type == ParamType::file || type == ParamType::numbers) &&
           std::ranges::find(plugin.kernel.members, parameter) != plugin.kernel.members.end();
}

bool are_equal(const Vec3Arrays& a, const Vec3Arrays& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

ConstVec3Span span_of(const Vec3Arrays& arrays) { return arrays.empty() ? ConstVec3Span{} : arrays.span(); }

}  // namespace

ExportedMesh ExportStorage::view(bool encloses) {
    const Mesh& mesh = placed.mesh;
    channels.assign(mesh.channels.begin(), mesh.channels.end());
    ExportedMesh view{.vertex_count = mesh.vertex_count(),
                      .indices = mesh.indices,
                      .position = mesh.position.span(),
                      .authored_normal = span_of(placed.authored_normal),
                      .smooth_group = placed.smooth_group,
                      .channels = channels,
                      .color = span_of(mesh.color),
                      .dpdu = span_of(mesh.dpdu),
                      .dpdv = span_of(mesh.dpdv),
                      .closed = encloses ? mesh.one_sided : mesh.closed,
                      .is_solid = mesh.closed && !mesh.one_sided && !encloses};
    if (!mesh.u.empty()) view.uv = {mesh.u.data(), mesh.v.data()};
    if (mesh.has_second_uv) view.second_uv = {mesh.channels[0].data(), mesh.channels[1].data()};
    return view;
}

ExportedMesh ExportStorage::in_object_space(std::size_t object) {
    const Object& from = objects[object];
    placed = place(*from.tessellator, request(from, true), {});
    require_no_colors(object);
    return view(from.encloses);
}

ExportedMesh ExportStorage::in_world_space(std::size_t object) {
    normal_sets.clear();
    normals_of.clear();
    const Object& from = objects[object];
    placed = place(*from.tessellator, request(from, scene.needs_uv), from.transform);
    require_no_colors(object);
    make_face_normals(placed.mesh);
    std::vector<std::unique_ptr<ShadingModel>> models;
    for (std::size_t i = 0; i < scene.shadings.size(); ++i)
        models.push_back(registry.create<ShadingModel>(names.at(scene.shadings[i].plugin),
                                                       from.shading_values[i], scene.image.color_management));
    std::vector<Vec3Arrays> all(models.size());
    parallel_for(models.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) all[i] = vertex_normals(placed, *models[i]);
    });
    for (Vec3Arrays& normals : all) {
        const auto same =
            std::ranges::find_if(normal_sets, [&](const Vec3Arrays& set) { return are_equal(set, normals); });
        normals_of.push_back(static_cast<std::size_t>(same - normal_sets.begin()));
        if (same == normal_sets.end()) normal_sets.push_back(std::move(normals));
    }
    normals_view.clear();
    for (const Vec3Arrays& set : normal_sets) normals_view.push_back(set.span());
    ExportedMesh mesh = view(from.encloses);
    mesh.normals = normals_view;
    mesh.normals_of = normals_of;
    return mesh;
}

MeshRequest ExportStorage::request(const Object& of, bool needs_uv) const {
    return {.uv = needs_uv,
            .derivatives = scene.needs_derivatives,
            .color = true,
            .color_management = scene.image.color_management,
            .channels = of.channels};
}

void ExportStorage::require_no_colors(std::size_t object) const {
    if (has_vertex_colors || placed.mesh.color.empty()) return;
    throw Error(ErrorCategory::failure, fmt::format("object {} has vertex colours, which this target does "
                                                    "not support; vertex_colors = false removes them",
                                                    scene.objects[object].label));
}

bool ExportStorage::has_default_normals(std::size_t object, std::size_t shading) {
    struct Default final : ShadingModel {
        ShadingRate shading_rate() const noexcept override { return {}; }
        void normals(const ShadingPointBatch&, const Vec3Span&) const override {}
    };
    const Object& from = objects[object];
    const auto model = registry.create<ShadingModel>(
        names.at(scene.shadings[shading].plugin), from.shading_values[shading], scene.image.color_management);
    const Mesh expected = build_mesh(*from.tessellator, {}, from.transform, Default());
    const Mesh actual = build_mesh(*from.tessellator, {}, from.transform, *model);
    return std::ranges::equal(expected.vertices, actual.vertices, {}, &MeshVertex::normal,
                              &MeshVertex::normal);
}

ExportedValues ExportStorage::kept(const ParamSet& values) {
    const ParamSet& set = sets.emplace_back(values);
    std::vector<ParamValue> written;
    for (std::size_t i = 0; i < set.schema().size(); ++i)
        written.push_back(set.get(i) ? written_value(*set.get(i), set.schema()[i]) : ParamValue{});
    return {.written = numbers.emplace_back(std::move(written)),
            .runtime = numbers.emplace_back(set.runtime(scene.image.color_management))};
}

bool ExportStorage::has_tables(const PluginDescriptor& plugin) {
    return std::ranges::any_of(plugin.kernel.members,
                               [&](std::size_t parameter) { return is_table(plugin, parameter); });
}

void ExportStorage::put_tables(const PluginDescriptor& plugin, const Instance& instance) {
    std::vector<ParamValue>& runtime = numbers.back();
    for (std::size_t i = 0; i < runtime.size(); ++i) {
        if (!is_table(plugin, i)) continue;
        const std::span<const float> table = instance.table(i);
        if (!std::ranges::all_of(table, [](float x) { return std::isfinite(x); }))
            throw Error(ErrorCategory::failure,
                        fmt::format("plugin {}/{}: the table of '{}' has a non-finite number",
                                    name_of(plugin.kind), plugin.name, plugin.parameters[i].name));
        put_table(table, runtime[i]);
    }
}

void ExportStorage::put_table(std::span<const float> table, ParamValue& value) {
    const auto same = std::ranges::search(tables, table);
    const auto first = static_cast<std::size_t>(same.begin() - tables.begin());
    if (same.empty()) tables.insert(tables.end(), table.begin(), table.end());
    // The largest number up to which floats count exactly.
    if (tables.size() > std::size_t{1} << 24)
        throw Error(ErrorCategory::failure,
                    "the tables of the scene's models have more than 16777216 numbers, the limit of "
                    "generated programs");
    value.integer = static_cast<std::int32_t>(table.empty() ? 0 : first);
    placed_tables.push_back({&value, table.size()});
}

void ExportStorage::connect_tables() {
    for (const PlacedTable& placed_table : placed_tables) {
        ParamValue& value = *placed_table.value;
        value.list = std::span<const float>(tables).subspan(static_cast<std::size_t>(value.integer),
                                                            placed_table.size);
    }
    scene.tables = tables;
}

}  // namespace candela
