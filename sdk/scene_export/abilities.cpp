#include "scene_export/abilities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

import candela.api;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

namespace {

bool has_second_uv(const Object& object) {
    const std::vector<VertexChannel> channels = vertex_channels_of(object);
    return !channels.empty() && channels.front().attribute == "uv1";
}
bool has_attributes(const Object& object) {
    return std::ranges::any_of(vertex_channels_of(object),
                               [](const VertexChannel& channel) { return channel.attribute != "uv1"; });
}

}  // namespace

std::string name_in(const Label& label) {
    const std::string name = label.name.empty() ? label.text() : label.name;
    std::string shown;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        shown += byte < 0x20 || byte == 0x7f ? fmt::format("\\u{{{:x}}}", byte) : std::string(1, c);
    }
    return shown;
}

void require_abilities(const Object& object, const ExportRequest& request) {
    const CommonMaterial& common = object.common;
    const auto refuse = [&](const char* what, const char* remedy) {
        throw Error(ErrorCategory::failure,
                    fmt::format("object {} {}, which this target does not support; {}", object.label.text(),
                                what, remedy));
    };
    if (object.color_texture && !request.abilities.textures) refuse("has a texture", "give 'color' a value");
    if (!object.textures.empty() && !request.abilities.textured_numbers)
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' of object {} has a texture, which this target supports only for "
                                "colours; give it a value",
                                object.textures.front().parameter, object.label.text()));
    if (common.emits() && !request.abilities.emission)
        refuse("emits light", "remove 'emission' from its material");
    if ((common.occlusion != 1 || common.has_texture("occlusion")) && !request.abilities.occlusion)
        refuse("has an occlusion of ambient light", "remove 'occlusion' from its material");
    if (common.is_see_through() && !request.abilities.opacity && !request.leaves_out)
        refuse("is not opaque", "remove 'opacity' from its material");
    if (has_second_uv(object) && !request.abilities.second_uv && !request.leaves_out)
        refuse("has a texture placed by its second texture coordinates", "remove 'uv' from the texture");
    if (has_attributes(object) && !request.abilities.vertex_channels && !request.leaves_out)
        refuse("takes values from an attribute of its vertices", "give them a value or a texture");
}

std::vector<std::string> left_out_of(const Object& object, const TargetAbilities& able) {
    std::vector<std::string> sentences;
    const auto declare = [&](bool has, bool is_able, const char* what) {
        if (has && !is_able)
            sentences.push_back(fmt::format("{} of object {} {} left out", what, name_in(object.label),
                                            std::string_view(what).ends_with('s') ? "are" : "is"));
    };
    declare(object.common.is_see_through(), able.opacity, "the opacity");
    declare(has_second_uv(object), able.second_uv, "textures on the second texture coordinates");
    declare(has_attributes(object), able.vertex_channels, "values from attributes of the vertices");
    return sentences;
}

}  // namespace candela
