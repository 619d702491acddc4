#include "gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "surface.h"
#include "text_scanner.h"

namespace mesh::gltf {

namespace {

using Json = nlohmann::json;

/// Parsers may recurse; what is nested more deeply is no glTF file.
void require_shallow(std::string_view json) {
    constexpr int k_deepest = 64;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > k_deepest)
                throw BadFile(fmt::format("has JSON nested more than {} deep", k_deepest));
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

Json parsed(std::string_view text) {
    require_shallow(text);
    try {
        Json json = Json::parse(text);
        if (!json.is_object()) throw BadFile("is no glTF file: its JSON is no object");
        return json;
    } catch (const Json::parse_error& problem) {
        throw BadFile(fmt::format("is no JSON from byte {} on", problem.byte));
    }
}

const Json& none() {
    static const Json array = Json::array();
    return array;
}

/// The array of that name, or an empty one.
const Json& array_of(const Json& object, const char* name) {
    if (!object.is_object()) return none();
    const auto found = object.find(name);
    return found != object.end() && found->is_array() ? *found : none();
}

std::optional<std::size_t> index_of(const Json& object, const char* name) {
    if (!object.is_object()) return std::nullopt;
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
    return found->get<std::size_t>();
}

const Json* element(const Json& array, std::optional<std::size_t> index) {
    return index && *index < array.size() ? &array[*index] : nullptr;
}

bool has_extension(const Json& object, const char* name) {
    if (!object.is_object()) return false;
    const auto extensions = object.find("extensions");
    return extensions != object.end() && extensions->is_object() && extensions->contains(name);
}

/// A copy with only those members that are named.
Json only(const Json& object, std::initializer_list<const char*> members) {
    if (!object.is_object()) return object;  // for tinygltf to complain about
    Json result = Json::object();
    for (const char* const name : members)
        if (const auto found = object.find(name); found != object.end()) result[name] = *found;
    return result;
}

/// Extensions that change nothing about triangles.
bool is_about_appearance(std::string_view extension) {
    constexpr std::array<std::string_view, 7> k_prefixes = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                            "MSFT_texture_",  "KHR_lights_",  "EXT_lights_",
                                                            "KHR_xmp"};
    return std::ranges::any_of(k_prefixes, [&](std::string_view p) { return extension.starts_with(p); });
}

void require_known_extensions(const Json& json) {
    for (const Json& extension : array_of(json, "extensionsRequired")) {
        if (!extension.is_string()) continue;
        const auto& name = extension.get_ref<const std::string&>();
        if (is_about_appearance(name) || name == "KHR_mesh_quantization" || name.starts_with("KHR_animation"))
            continue;
        const bool is_compression = name == "KHR_draco_mesh_compression" ||
                                    name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression";
        throw BadFile(fmt::format("needs the glTF extension {}, which Candela does not read{}",
                                  in_quotes(name), is_compression ? "; save it without compression" : ""));
    }
}

// ---- losses

void note(std::vector<Loss>& losses, std::size_t count, std::string_view singular,
          bool is_appearance = false) {
    if (count > 0) losses.emplace_back(counted(count, singular), is_appearance);
}

std::vector<Loss> losses_of(const Json& json) {
    std::vector<Loss> losses;
    for (const char* const what : {"material", "texture", "image", "camera"})
        note(losses, array_of(json, (std::string(what) + "s").c_str()).size(), what, true);
    for (const char* const what : {"animation", "skin"})
        note(losses, array_of(json, (std::string(what) + "s").c_str()).size(), what);
    if (const auto extensions = json.find("extensions");
        extensions != json.end() && extensions->is_object()) {
        if (const auto lights = extensions->find("KHR_lights_punctual"); lights != extensions->end())
            note(losses, array_of(*lights, "lights").size(), "light", true);
    }
    std::size_t targets = 0, points = 0, lines = 0;
    bool has_more_colors = false, has_second_uv = false, has_other_attributes = false;
    for (const Json& mesh : array_of(json, "meshes")) {
        for (const Json& primitive : array_of(mesh, "primitives")) {
            targets += array_of(primitive, "targets").size();
            const std::size_t mode = index_of(primitive, "mode").value_or(4);
            if (mode == 0) ++points;
            if (mode >= 1 && mode <= 3) ++lines;
            const auto attributes = primitive.is_object() ? primitive.find("attributes") : primitive.end();
            if (attributes == primitive.end() || !attributes->is_object()) continue;
            for (const auto& [name, unused] : attributes->items()) {
                if (name.starts_with("COLOR_")) {
                    has_more_colors = has_more_colors || name != "COLOR_0";
                } else if (name.starts_with("TEXCOORD_")) {
                    has_second_uv = has_second_uv || name != "TEXCOORD_0";
                } else if (name != "POSITION" && name != "NORMAL" && name != "TANGENT" &&
                           !name.starts_with("JOINTS_") && !name.starts_with("WEIGHTS_")) {
                    has_other_attributes = true;
                }
            }
        }
    }
    note(losses, targets, "morph target");
    const auto note_sets = [&](std::size_t count, std::string_view of) {
        if (count > 0) losses.emplace_back(fmt::format("{} set{} of {}", count, count == 1 ? "" : "s", of));
    };
    note_sets(points, "points");
    note_sets(lines, "lines");
    if (has_more_colors) losses.emplace_back("further vertex colours");
    if (has_second_uv) losses.emplace_back("further texture coordinates");
    if (has_other_attributes) losses.emplace_back("attributes of vertices of its own");
    const std::size_t scenes = array_of(json, "scenes").size();
    if (scenes > 1) note(losses, scenes - 1, "other scene");
    std::set<std::string> extensions;
    for (const Json& extension : array_of(json, "extensionsUsed"))
        if (extension.is_string()) extensions.insert(extension.get<std::string>());
    std::vector<std::string> unknown;
    for (const std::string& name : extensions)
        if (!is_about_appearance(name) && name != "KHR_mesh_quantization") unknown.push_back(in_quotes(name));
    constexpr std::size_t k_most_named = 5;
    if (unknown.size() > k_most_named) {
        const std::size_t more = unknown.size() - k_most_named;
        unknown.resize(k_most_named);
        unknown.push_back(fmt::format("{} more", more));
    }
    if (!unknown.empty())
        losses.emplace_back(
            fmt::format("the extension{} {}", unknown.size() == 1 ? "" : "s", listed(unknown)));
    return losses;
}

// ---- what is left

/// Which buffers hold vertices and indices; the others need not even exist.
class NeededBuffers {
  public:
    explicit NeededBuffers(const Json& json)
        : accessors_(array_of(json, "accessors")), views_(array_of(json, "bufferViews")) {
        for (const Json& mesh : array_of(json, "meshes")) {
            for (const Json& primitive : array_of(mesh, "primitives")) {
                const bool is_draco = has_extension(primitive, "KHR_draco_mesh_compression");
                add_accessor(index_of(primitive, "indices"), is_draco);
                if (!primitive.is_object()) continue;
                const auto attributes = primitive.find("attributes");
                if (attributes == primitive.end()) continue;
                for (const char* const name : {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0"})
                    add_accessor(index_of(*attributes, name), is_draco);
            }
        }
    }
    bool contain(std::size_t buffer) const { return needed_.contains(buffer); }

  private:
    void add_accessor(std::optional<std::size_t> index, bool is_draco) {
        const Json* const accessor = element(accessors_, index);
        if (accessor == nullptr || !accessor->is_object()) return;
        // Such an accessor would be read as zeros.
        if (is_draco && !accessor->contains("bufferView")) {
            throw BadFile(
                "is compressed by the glTF extension 'KHR_draco_mesh_compression', which Candela does "
                "not read; save it without compression");
        }
        add_view(*accessor);
        if (const auto sparse = accessor->find("sparse"); sparse != accessor->end() && sparse->is_object()) {
            for (const char* const part : {"indices", "values"})
                if (const auto found = sparse->find(part); found != sparse->end()) add_view(*found);
        }
    }
    void add_view(const Json& of) {
        const Json* const view = element(views_, index_of(of, "bufferView"));
        if (view == nullptr) return;
        if (const auto buffer = index_of(*view, "buffer")) needed_.insert(*buffer);
    }

    const Json& accessors_;
    const Json& views_;
    std::set<std::size_t> needed_;
};

Json buffers_of(const Json& json, bool has_binary) {
    const NeededBuffers needed(json);
    Json buffers = Json::array();
    for (const Json& buffer : array_of(json, "buffers")) {
        const std::size_t index = buffers.size();
        if (!needed.contain(index)) {
            buffers.push_back({{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}});
            continue;
        }
        const bool has_uri = buffer.is_object() && buffer.contains("uri");
        if (!has_uri && (index > 0 || !has_binary)) {
            const bool is_meshopt = has_extension(buffer, "EXT_meshopt_compression") ||
                                    has_extension(buffer, "KHR_meshopt_compression");
            throw BadFile(
                is_meshopt
                    ? "is compressed by the glTF extension 'EXT_meshopt_compression', which Candela does "
                      "not read; save it without compression"
                    : fmt::format("has no data for buffer {}", index));
        }
        buffers.push_back(only(buffer, {"byteLength", "uri"}));
    }
    return buffers;
}

Json meshes_of(const Json& json) {
    Json meshes = Json::array();
    for (const Json& mesh : array_of(json, "meshes")) {
        Json primitives = Json::array();
        for (const Json& primitive : array_of(mesh, "primitives")) {
            Json copy = only(primitive, {"attributes", "indices", "mode", "material"});
            if (copy.is_object() && copy.contains("attributes"))
                copy["attributes"] =
                    only(copy["attributes"], {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0"});
            primitives.push_back(std::move(copy));
        }
        meshes.push_back({{"primitives", std::move(primitives)}});
    }
    return meshes;
}

Json copies(const Json& json, const char* array, std::initializer_list<const char*> members) {
    Json result = Json::array();
    for (const Json& one : array_of(json, array)) result.push_back(only(one, members));
    return result;
}

void require_version_2(const Json& json) {
    const auto asset = json.find("asset");
    const bool has_version = asset != json.end() && asset->is_object() && asset->contains("version") &&
                             (*asset)["version"].is_string();
    if (!has_version) throw BadFile("is no glTF file: it has no asset with a version");
    const auto& version = (*asset)["version"].get_ref<const std::string&>();
    if (!version.starts_with("2."))
        throw BadFile(fmt::format("is glTF {}; Candela reads glTF 2", in_quotes(version)));
}

}  // namespace

Geometry geometry_of(std::string_view text, bool has_binary) {
    const Json json = parsed(text);
    require_version_2(json);
    require_known_extensions(json);
    Json result = {{"asset", {{"version", "2.0"}}}};
    if (const auto scene = json.find("scene"); scene != json.end()) result["scene"] = *scene;
    const auto set = [&](const char* name, Json&& array) {
        if (!array.empty()) result[name] = std::move(array);
    };
    set("scenes", copies(json, "scenes", {"nodes"}));
    set("nodes", copies(json, "nodes", {"children", "mesh", "matrix", "translation", "rotation", "scale"}));
    set("meshes", meshes_of(json));
    set("accessors",
        copies(json, "accessors",
               {"bufferView", "byteOffset", "componentType", "normalized", "count", "type", "sparse"}));
    set("bufferViews", copies(json, "bufferViews", {"buffer", "byteOffset", "byteLength", "byteStride"}));
    set("buffers", buffers_of(json, has_binary));
    std::vector<std::string> materials;
    for (const Json& material : array_of(json, "materials")) {
        const auto name = material.is_object() ? material.find("name") : material.end();
        const bool has_name = material.is_object() && name != material.end() && name->is_string();
        materials.push_back(has_name ? name->get<std::string>() : "");
    }
    return {result.dump(), losses_of(json), std::move(materials)};
}

}  // namespace mesh::gltf
