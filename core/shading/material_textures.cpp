module;

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

module candela.shading;

import :texture_footprints;
import candela.api;
import candela.plugins;
import candela.raster;
import candela.scene;
import candela.util;

namespace candela {

namespace {

/// From 0 to 1, also for NaN.
float wrapped(float x, TextureWrap wrap) {
    if (wrap == TextureWrap::repeat) x -= std::floor(x);
    if (wrap == TextureWrap::mirror) x = std::abs(x - 2 * std::round(x / 2));
    return x > 0 ? std::min(x, 1.0f) : 0.0f;
}

constexpr float k_radians = std::numbers::pi_v<float> / 180;

using Numbers = std::array<float, k_batch_size>;

/// Texture coordinates of a batch, placed as a texture asks.
struct PlacedCoordinates {
    std::array<Numbers, 6> arrays;
    TextureCoordinates at{.uv = {arrays[0].data(), arrays[1].data()},
                          .per_x = {arrays[2].data(), arrays[3].data()},
                          .per_y = {arrays[4].data(), arrays[5].data()}};

    void place(const TextureTransform& transform, std::size_t count, const TextureCoordinates& of) {
        const std::array<float, 6> m = placing_of(transform);
        const std::array from{&of.uv, &of.per_x, &of.per_y};
        for (std::size_t k = 0; k < from.size(); ++k) {
            // Derivatives are not moved.
            const float u0 = k == 0 ? m[2] : 0, v0 = k == 0 ? m[5] : 0;
            for (std::size_t i = 0; i < count; ++i) {
                const float u = from[k]->x[i], v = from[k]->y[i];
                arrays[2 * k][i] = m[0] * u + m[1] * v + u0;
                arrays[2 * k + 1][i] = m[3] * u + m[4] * v + v0;
            }
        }
    }
};

/// The channel of the texels that number `of` of a parameter takes.
std::size_t texel_channel_of(TextureChannel channel, std::size_t of) {
    switch (channel) {
        case TextureChannel::rgb:
            return of;
        case TextureChannel::green:
            return 1;
        case TextureChannel::blue:
            return 2;
        case TextureChannel::red:
        case TextureChannel::alpha:  // all three of read_opacity_map()
            return 0;
    }
    return 0;
}

/// The channel of an attribute that number `of` of a parameter takes.
std::size_t attribute_channel_of(TextureChannel channel, std::size_t of) {
    return channel == TextureChannel::alpha ? 3 : texel_channel_of(channel, of);
}

std::size_t numbers_of(const Parameter& parameter) { return parameter.type == ParamType::real ? 1 : 3; }

std::size_t index_of(std::span<const VertexChannel> channels, const VertexChannel& wanted) {
    return static_cast<std::size_t>(std::ranges::find(channels, wanted) - channels.begin());
}

}  // namespace

std::array<float, 6> placing_of(const TextureTransform& transform) noexcept {
    const float angle = k_radians * transform.rotation;
    const float c = std::cos(angle), s = std::sin(angle);
    const auto [u, v] = transform.scale;
    return {c * u, -s * v, transform.offset[0], s * u, c * v, transform.offset[1]};
}

std::array<int, 2> PlacedTexture::texel_at(float u, float v) const noexcept {
    const std::array<float, 6> m = placing_of(placing.transform);
    const auto place = [&](float x, TextureWrap wrap, int size) {
        return std::clamp(static_cast<int>(wrapped(x, wrap) * static_cast<float>(size)), 0, size - 1);
    };
    const std::array<TextureWrap, 2> wraps = placing.wraps();
    return {place(m[0] * u + m[1] * v + m[2], wraps[0], picture->width()),
            picture->height() - 1 - place(m[3] * u + m[4] * v + m[5], wraps[1], picture->height())};
}

std::vector<VertexChannel> vertex_channels_of(const Object& object) {
    std::vector<VertexChannel> channels;
    bool has_second_uv = object.normal_map && object.normal_map->placing.uv == 1;
    const auto add = [&](const ParameterTexture& texture, const Parameter& parameter) {
        has_second_uv = has_second_uv || texture.placing.uv == 1;
        if (texture.attribute.empty()) return;
        for (std::size_t c = 0; c < numbers_of(parameter); ++c) {
            const VertexChannel channel{texture.attribute, attribute_channel_of(texture.channel, c)};
            if (index_of(channels, channel) == channels.size()) channels.push_back(channel);
        }
    };
    const ParamSet& values = object.reflection.parameters;
    for (const ParameterTexture& texture : object.textures)
        add(texture, values.schema()[values.index_of(texture.parameter)]);
    for (const ParameterTexture& texture : object.common.textures)
        add(texture, material_parameter(texture.parameter));
    if (object.color_texture) add(*object.color_texture, color_parameter());
    if (has_second_uv) channels.insert(channels.begin(), {{"uv1", 0}, {"uv1", 1}});
    return channels;
}

ColorEncoding encoding_of(const ParameterTexture& texture, const Parameter& parameter,
                          ColorEncoding of_scene) noexcept {
    if (texture.channel == TextureChannel::alpha) return ColorEncoding::none;
    switch (texture.encoding) {
        case TextureEncoding::linear:
            return ColorEncoding::none;
        case TextureEncoding::srgb:
            return ColorEncoding::srgb;
        default:
            break;
    }
    const bool takes_three = parameter.type != ParamType::real && texture.channel == TextureChannel::rgb;
    return takes_three ? of_scene : ColorEncoding::none;
}

std::size_t MaterialTextures::number_of(const PlacedTexture& picture) {
    const auto same = std::ranges::find_if(textures, [&](const PlacedTexture& t) {
        return t.key == picture.key && t.placing == picture.placing;
    });
    const auto number = static_cast<std::size_t>(same - textures.begin());
    if (same == textures.end()) textures.push_back(picture);
    return number;
}

void MaterialTextures::add(const NormalMap& map, const PlacedTexture& picture, int width, int height) {
    const std::array<float, 6> m = placing_of(map.placing.transform);
    TexturedNormal added{.texture = number_of(picture), .has_slopes = map.has_heights};
    if (map.has_heights) {
        // By the chain rule, from slopes per texel.
        const float x = map.scale * static_cast<float>(width), y = map.scale * static_cast<float>(height);
        added.to_uv = {m[0] * x, m[3] * y, m[1] * x, m[4] * y};
    } else {
        // The picture's axes on the surface, whatever their length.
        const float u = std::hypot(m[0], m[3]), v = std::hypot(m[1], m[4]);
        const float x = u > 0 ? map.scale / u : 0, y = v > 0 ? map.scale / v : 0;
        added.to_uv = {m[0] * x, m[3] * x, m[1] * y, m[4] * y};
    }
    normal = added;
}

void MaterialTextures::add_all(const Object& object, const Placing& place, MaterialTextures& material,
                               MaterialTextures& opacity) {
    const std::vector<VertexChannel> channels = vertex_channels_of(object);
    const ParamSet& values = object.reflection.parameters;
    for (const ParameterTexture& texture : object.textures) {
        const std::size_t index = values.index_of(texture.parameter);
        material.add(texture, values.schema()[index], index, channels, place);
    }
    material.of_model = material.numbers.size();
    // The first number of what was added.
    const auto add = [&](MaterialTextures& to, const ParameterTexture& texture, const Parameter& parameter) {
        const std::size_t first = to.numbers.size();
        to.add(texture, parameter, 0, channels, place);
        return to.numbers.size() > first ? first : k_none;
    };
    for (const ParameterTexture& texture : object.common.textures) {
        MaterialTextures& to = texture.parameter == "opacity" ? opacity : material;
        const std::size_t first = add(to, texture, material_parameter(texture.parameter));
        if (texture.parameter == "emission") to.emission = first;
        if (texture.parameter == "occlusion") to.occlusion = first;
    }
    if (object.color_texture) material.color = add(material, *object.color_texture, color_parameter());
}

void MaterialTextures::add(const ParameterTexture& texture, const Parameter& parameter, std::size_t index,
                           std::span<const VertexChannel> channels, const Placing& place) {
    std::size_t picture = 0;
    if (texture.attribute.empty()) {
        const auto placed = place(texture, parameter);
        if (!placed) return;
        picture = number_of(*placed);
    }
    const float unit = parameter.unit == "deg" ? k_radians : 1.0f;
    const bool is_color = parameter.type == ParamType::color;
    const float low = is_color ? 0.0f : parameter.minimum, high = is_color ? 1.0f : parameter.maximum;
    const auto inwards = [](float bound, bool is_excluded) {
        return is_excluded ? 1e-6f * std::max(1.0f, std::abs(bound)) : 0.0f;
    };
    const std::array scales{texture.scale.x, texture.scale.y, texture.scale.z},
        offsets{texture.offset.x, texture.offset.y, texture.offset.z};
    for (std::size_t c = 0; c < numbers_of(parameter); ++c) {
        TexturedNumber number{.texture = picture,
                              .texel_channel = texel_channel_of(texture.channel, c),
                              .parameter = index,
                              .channel = c,
                              .scale = unit * scales[c],
                              .offset = unit * offsets[c],
                              .minimum = unit * (low + inwards(low, parameter.minimum_excluded)),
                              .maximum = unit * (high - inwards(high, parameter.maximum_excluded))};
        if (!texture.attribute.empty())
            number.vertex_channel =
                index_of(channels, {texture.attribute, attribute_channel_of(texture.channel, c)});
        numbers.push_back(number);
    }
}

namespace {

/// The numbers that come from `from`, of a picture or the vertices.
void put(const TexturedNumber& number, const float* from, std::size_t count, float* to) {
    for (std::size_t i = 0; i < count; ++i)
        to[i] = std::min(std::max(number.offset + number.scale * from[i], number.minimum), number.maximum);
}

}  // namespace

void evaluate(const MaterialTextures& textures, std::size_t count, const TexturedPoints& at,
              std::span<AlignedVector<float>> values) {
    alignas(64) std::array<Numbers, 3> texel;
    PlacedCoordinates placed;
    TextureFootprints footprints;
    const TexturePlacing* found = nullptr;  // the placing for which they are
    for (std::size_t t = 0; t < textures.textures.size(); ++t) {
        const PlacedTexture& texture = textures.textures[t];
        if (found == nullptr || *found != texture.placing || !footprints.fit(*texture.picture)) {
            const TextureCoordinates& uv = at.uv[texture.placing.uv == 0 ? 0 : 1];
            const bool is_moved = texture.placing.transform != TextureTransform{};
            if (is_moved) placed.place(texture.placing.transform, count, uv);
            footprints.find(*texture.picture, texture.placing.wraps(), count, is_moved ? placed.at : uv);
            found = &texture.placing;
        }
        for (Numbers& channel : texel) std::fill_n(channel.begin(), count, 1.0f);
        texture.picture->multiply(footprints, {texel[0].data(), texel[1].data(), texel[2].data()});
        if (textures.normal && textures.normal->texture == t) {
            for (std::size_t c = 0; c < texel.size(); ++c)
                std::copy_n(texel[c].data(), count, values[textures.numbers.size() + c].data());
        }
        for (std::size_t k = 0; k < textures.numbers.size(); ++k) {
            const TexturedNumber& number = textures.numbers[k];
            if (number.vertex_channel == TexturedNumber::k_none && number.texture == t)
                put(number, texel[number.texel_channel].data(), count, values[k].data());
        }
    }
    for (std::size_t k = 0; k < textures.numbers.size(); ++k) {
        const TexturedNumber& number = textures.numbers[k];
        if (number.vertex_channel != TexturedNumber::k_none)
            put(number, at.channels[number.vertex_channel].data(), count, values[k].data());
    }
}

}  // namespace candela
