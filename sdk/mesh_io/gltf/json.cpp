#include "mesh_io/gltf/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <set>

#include "mesh_io/gltf/losses.h"
#include "mesh_io/gltf/values.h"
#include "mesh_io/surface.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io::gltf {

namespace {

/// A copy with only the named members.
Json only(const Json& object, std::initializer_list<const char*> members) {
    if (!object.is_object()) return object;  // left for tinygltf to reject
    Json result = Json::object();
    for (const char* const name : members)
        if (const auto found = object.find(name); found != object.end()) result[name] = *found;
    return result;
}

Json copies(const Json& json, const char* array, std::initializer_list<const char*> members) {
    Json result = Json::array();
    for (const Json& one : array_of(json, array)) result.push_back(only(one, members));
    return result;
}

constexpr std::array k_attributes = {"POSITION", "NORMAL",   "TANGENT",   "TEXCOORD_0", "COLOR_0",
                                     "JOINTS_0", "JOINTS_1", "WEIGHTS_0", "WEIGHTS_1"};

const Json* meshopt_of(const Json& view) {
    return extension_of(view, "EXT_meshopt_compression", "KHR_meshopt_compression");
}

/// Extracts the members of the file that concern triangles.
class Geometries {
  public:
    Geometries(const Json& json, bool has_binary, Attributes attributes)
        : json_(json),
          has_binary_(has_binary),
          attributes_(attributes),
          accessors_(array_of(json, "accessors")) {
        // Without skins and weights, joints and targets have no effect.
        is_skinned_ = !array_of(json, "skins").empty();
        for (const char* const array : {"meshes", "nodes"})
            for (const Json& one : array_of(json, array))
                for (const Json& weight : array_of(one, "weights"))
                    is_morphed_ = is_morphed_ || !weight.is_number() || weight.get<double>() != 0;
    }

    Geometry read() {
        Json result = {{"asset", {{"version", "2.0"}}}};
        if (const auto scene = json_.find("scene"); scene != json_.end()) result["scene"] = *scene;
        const auto set = [&](const char* name, Json&& array) {
            if (!array.empty()) result[name] = std::move(array);
        };
        set("scenes", copies(json_, "scenes", {"nodes"}));
        set("nodes", nodes());
        set("meshes", meshes());
        add_skins();
        set("accessors",
            copies(json_, "accessors",
                   {"bufferView", "byteOffset", "componentType", "normalized", "count", "type", "sparse"}));
        set("bufferViews", views());
        geometry_.json = result.dump();
        std::erase_if(geometry_.compressed_views,
                      [&](const CompressedView& view) { return !needed_views_.contains(view.view); });
        add_buffers();
        for (const Json& material : array_of(json_, "materials"))
            geometry_.materials.push_back(text_of(material, "name"));
        geometry_.losses = losses_of(json_, attributes_);
        return std::move(geometry_);
    }

  private:
    Json nodes() {
        for (const Json& node : array_of(json_, "nodes")) {
            const std::size_t number = geometry_.is_hidden.size();
            const Json* const visibility = extension_of(node, "KHR_node_visibility");
            geometry_.is_hidden.push_back(visibility != nullptr && visibility->contains("visible") &&
                                          visibility->at("visible") == false);
            const Json* const instancing = extension_of(node, "EXT_mesh_gpu_instancing");
            if (instancing == nullptr) continue;
            const Json& attributes = object_of(*instancing, "attributes");
            const auto accessor = [&](const char* name) {
                const auto index = index_of(attributes, name);
                if (!index) return -1;
                if (*index >= accessors_.size()) throw BadFile(fmt::format("has no accessor {}", *index));
                need_accessor(index);
                return static_cast<int>(*index);
            };
            geometry_.instances[number] = {accessor("TRANSLATION"), accessor("ROTATION"), accessor("SCALE")};
        }
        return copies(json_, "nodes",
                      {"children", "mesh", "skin", "weights", "matrix", "translation", "rotation", "scale"});
    }

    Json meshes() {
        Json meshes = Json::array();
        for (const Json& mesh : array_of(json_, "meshes")) {
            Json primitives = Json::array();
            for (const Json& one : array_of(mesh, "primitives"))
                primitives.push_back(primitive(one, meshes.size(), primitives.size()));
            meshes.push_back(only(mesh, {"weights"}));
            meshes.back()["primitives"] = std::move(primitives);
        }
        return meshes;
    }

    void add_skins() {
        const auto number = [](std::optional<std::size_t> index) {
            constexpr std::size_t k_most = std::numeric_limits<int>::max();
            return index && *index <= k_most ? static_cast<int>(*index) : -1;
        };
        for (const Json& skin : array_of(json_, "skins")) {
            const auto matrices = index_of(skin, "inverseBindMatrices");
            need_accessor(matrices);
            Skin& result = geometry_.skins.emplace_back();
            result.inverse_matrices = number(matrices);
            for (const Json& joint : array_of(skin, "joints"))
                result.joints.push_back(number(
                    joint.is_number_unsigned() ? std::optional(joint.get<std::size_t>()) : std::nullopt));
        }
    }

    Json primitive(const Json& from, std::size_t mesh, std::size_t number) {
        Json result = only(from, {"attributes", "indices", "mode", "material"});
        if (!result.is_object() || !result.contains("attributes")) return result;
        Json attributes = Json::object();
        const Json& all = object_of(from, "attributes");
        for (const auto& [name, index] : all.items())
            if (attributes_ == Attributes::read && (name == k_second_uv || name.starts_with('_')))
                attributes[name] = index;
        for (const char* const name : k_attributes) {
            const bool is_of_skin =
                std::string_view(name).starts_with("J") || std::string_view(name).starts_with("W");
            if (const auto found = all.find(name); found != all.end() && (is_skinned_ || !is_of_skin))
                attributes[name] = *found;
        }
        if (const Json* const draco = extension_of(from, "KHR_draco_mesh_compression"))
            take_draco(*draco, mesh, number, attributes, result);
        for (const auto& [name, index] : attributes.items())
            need_accessor(index_of(attributes, name.c_str()));
        need_accessor(index_of(result, "indices"));
        result["attributes"] = std::move(attributes);
        if (is_morphed_) {
            Json targets = Json::array();
            for (const Json& target : array_of(from, "targets")) {
                targets.push_back(only(target, {"POSITION", "NORMAL", "TANGENT"}));
                for (const char* const name : {"POSITION", "NORMAL", "TANGENT"})
                    need_accessor(index_of(targets.back(), name));
            }
            if (!targets.empty()) result["targets"] = std::move(targets);
        }
        return result;
    }

    /// Removes compressed data from `attributes` and `primitive`, unless an uncompressed form exists as well.
    void take_draco(const Json& draco, std::size_t mesh, std::size_t number, Json& attributes,
                    Json& primitive) {
        const Json* const position = element(accessors_, index_of(attributes, "POSITION"));
        if (position == nullptr || !position->is_object() || position->contains("bufferView")) return;
        const auto view = index_of(draco, "bufferView");
        if (!view) throw BadFile("has a primitive compressed by Draco, but no buffer view with its bytes");
        DracoPrimitive result{.mesh = mesh, .primitive = number, .view = *view};
        const Json& ids = object_of(draco, "attributes");
        for (const auto& [name, unused] : ids.items()) {
            const auto accessor = index_of(attributes, name.c_str());
            const auto id = index_of(ids, name.c_str());
            if (!accessor || element(accessors_, accessor) == nullptr || !id || *id > 0xffff'ffffu) continue;
            result.attributes[name] = {*accessor, static_cast<std::uint32_t>(*id)};
            attributes.erase(name);
        }
        primitive.erase("indices");
        need_view(view);
        geometry_.draco_primitives.push_back(std::move(result));
    }

    Json views() {
        Json views = Json::array();
        for (const Json& view : array_of(json_, "bufferViews")) {
            Json copy = only(view, {"buffer", "byteOffset", "byteLength", "byteStride"});
            if (const Json* const meshopt = meshopt_of(view)) {
                const auto member = [&](const char* name) {
                    const auto value = index_of(*meshopt, name);
                    if (!value)
                        throw BadFile(
                            fmt::format("has a buffer view {} compressed by meshoptimizer without {}",
                                        views.size(), name));
                    return *value;
                };
                geometry_.compressed_views.push_back({.view = views.size(),
                                                      .count = member("count"),
                                                      .stride = member("byteStride"),
                                                      .mode = text_of(*meshopt, "mode"),
                                                      .filter = text_of(*meshopt, "filter")});
                copy["buffer"] = member("buffer");
                copy["byteOffset"] = index_of(*meshopt, "byteOffset").value_or(0);
                copy["byteLength"] = member("byteLength");
            }
            views.push_back(std::move(copy));
        }
        return views;
    }

    void need_accessor(std::optional<std::size_t> index) {
        const Json* const accessor = element(accessors_, index);
        if (accessor == nullptr || !accessor->is_object()) return;
        need_view(index_of(*accessor, "bufferView"));
        const Json& sparse = object_of(*accessor, "sparse");
        for (const char* const part : {"indices", "values"})
            need_view(index_of(object_of(sparse, part), "bufferView"));
    }
    void need_view(std::optional<std::size_t> index) {
        const Json* const view = element(array_of(json_, "bufferViews"), index);
        if (view == nullptr) return;
        needed_views_.insert(*index);
        const Json* const meshopt = meshopt_of(*view);
        if (const auto buffer = index_of(meshopt != nullptr ? *meshopt : *view, "buffer"))
            needed_.insert(*buffer);
    }

    void add_buffers() {
        for (const Json& buffer : array_of(json_, "buffers")) {
            const std::size_t number = geometry_.buffers.size();
            BufferSource source{.is_needed = needed_.contains(number)};
            if (buffer.is_object() && buffer.contains("uri")) source.uri = text_of(buffer, "uri");
            if (source.is_needed && !source.uri && (number > 0 || !has_binary_))
                throw BadFile(fmt::format("has no data for buffer {}", number));
            const auto length = index_of(buffer, "byteLength");
            if (source.is_needed && !length)
                throw BadFile(fmt::format("is not valid glTF: buffer {} has no byteLength", number));
            source.length = length.value_or(0);
            geometry_.buffers.push_back(std::move(source));
        }
    }

    const Json& json_;
    bool has_binary_;
    Attributes attributes_;
    const Json& accessors_;
    bool is_skinned_ = false, is_morphed_ = false;
    std::set<std::size_t> needed_, needed_views_;  // buffers, views of them
    Geometry geometry_;
};

void require_version_2(const Json& json) {
    std::string version = text_of(object_of(json, "asset"), "version");
    // Not every version 1 file declares its version, but its arrays were objects.
    if (version.empty() && !object_of(json, "meshes").empty()) version = "1.0";
    if (version.empty()) throw BadFile("is not a glTF file: it has no asset with a version");
    if (version.starts_with("2.")) return;
    const bool is_old = version.starts_with("1.") || version.starts_with("0.");
    throw BadFile(fmt::format("is glTF {}; Candela reads glTF 2{}", in_quotes(version),
                              is_old ? ". Convert it with: npx gltf-pipeline -i OLD.gltf -o NEW.gltf" : ""));
}

}  // namespace

Geometry geometry_of(std::string_view text, bool has_binary, Attributes attributes) {
    const Json json = parsed(text);
    require_version_2(json);
    require_known_extensions(json);
    return Geometries(json, has_binary, attributes).read();
}

}  // namespace mesh_io::gltf
