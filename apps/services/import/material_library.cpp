#include "import/material_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "import/images.h"
#include "import/named_file.h"
#include "mesh_io/bad_file.h"
#include "mesh_io/text_scanner.h"

import candela.util;

namespace fs = std::filesystem;

namespace importing::obj {

namespace {

constexpr std::size_t k_most_library_bytes = std::size_t{16} << 20;

/// The name without a possible comment: "red" of "red # the door".
std::string_view without_comment(std::string_view name) { return name.substr(0, name.find(" #")); }

bool are_all(const std::vector<double>& values, double value) {
    return !values.empty() && std::ranges::all_of(values, [&](double x) { return x == value; });
}

/// A surface must not reflect more light than it receives: scales both coefficients by the same factor, which
/// keeps the material's look. Rounds down, so that the sum in a scene's text does not exceed 1. Returns
/// whether it scaled them.
bool limit(std::vector<double>& kd, std::vector<double>& ks) {
    double most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, kd[c] + ks[c]);
    constexpr double k_rounding = 1e-6;
    if (most <= 1 + k_rounding) return false;
    constexpr double k_digits = 1e4;
    for (std::vector<double>* const values : {&kd, &ks})
        for (double& x : *values) x = std::floor(k_digits * x / most) / k_digits;
    return true;
}

/// The map where its statement places it.
ParameterMap placed(ParameterMap map, const mesh_io::MtlMap& statement) {
    constexpr double k_most = 1e6;
    if (statement.clamps) map.placing.wrap = map.placing.wrap_v = "clamp";
    for (std::size_t k = 0; k < 2; ++k) {
        map.placing.scale[k] = std::clamp(statement.scale[k], -k_most, k_most);
        map.placing.offset[k] = std::clamp(statement.offset[k], -k_most, k_most);
    }
    return map;
}

}  // namespace

void MaterialLibraries::read_named(std::string_view names) {
    if (names.empty() || !named_.emplace(names).second) return;
    constexpr std::size_t k_most_statements = 1000;
    if (named_.size() > k_most_statements)
        return model_.note(
            fmt::format("mtllib statements after the first {} are left out", k_most_statements));
    if (read_if_there(names)) return;
    // Several names, if each has an extension.
    std::vector<std::string_view> words;
    mesh_io::TextScanner scanner(names);
    for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) words.push_back(word);
    const bool are_several =
        std::ranges::all_of(words, [](std::string_view word) { return word.find('.') != word.npos; });
    if (!are_several) words = {names};
    for (const std::string_view word : words)
        if ((words.size() == 1 && word == names) || !read_if_there(word))
            model_.count("unreadable libraries",
                         fmt::format("the material library '{}' cannot be read", word),
                         fmt::format("{{}} material libraries cannot be read, the first of them '{}'", word));
}

bool MaterialLibraries::read_if_there(std::string_view name) {
    const auto found = find_named(source_.file.parent_path(), name);
    if (!found) return false;
    if (found->is_renamed)
        model_.note(fmt::format("the material library '{}' is read from '{}'", name,
                                found->path.filename().string()));
    read(found->path);
    return true;
}

void MaterialLibraries::read(const fs::path& file) {
    if (!source_.may_read(file)) {
        return model_.note(fmt::format("the material library '{}' is outside the model's folder{}",
                                       file.string(), k_outside_remedy));
    }
    if (!known_files_.insert(file).second) return;
    const auto text = candela::read_text_file(file, k_most_library_bytes);
    if (!text) return model_.note(fmt::format("the material library '{}' cannot be read", file.string()));
    if (text->size() > k_most_library_bytes)
        return model_.note(fmt::format("the material library '{}' is too large", file.string()));
    mesh_io::MaterialLibrary library;
    try {
        library = mesh_io::read_mtl(*text);
    } catch (const mesh_io::BadFile&) {
        return model_.note(fmt::format(
            "the material library '{}' is left out: it is UTF-16; save it as UTF-8", file.string()));
    }
    for (std::string& note : library.notes) model_.note(std::move(note));
    for (mesh_io::MtlMaterial& material : library.materials) {
        if (const std::string_view bare = without_comment(material.name); bare != material.name)
            commented_.try_emplace(std::string(bare), material.name);
        std::string name = material.name;
        descriptions_.insert_or_assign(std::move(name), Description{std::move(material), file.parent_path()});
    }
}

const MaterialLibraries::Description* MaterialLibraries::find(const std::string& name) const {
    const auto same = descriptions_.find(name);
    if (same != descriptions_.end()) return &same->second;
    // One of them may be followed by a comment.
    const std::string_view bare = without_comment(name);
    if (const auto plain = descriptions_.find(bare); plain != descriptions_.end()) return &plain->second;
    const auto commented = commented_.find(bare);
    return commented != commented_.end() ? &descriptions_.find(commented->second)->second : nullptr;
}

std::vector<double> MaterialLibraries::coefficients(const std::vector<double>& value, double otherwise) {
    std::vector<double> rgb = value.empty() ? std::vector(3, otherwise) : value;
    for (double& x : rgb) {
        if (x < 0 || x > 1) model_.note("material coefficients outside 0 to 1 are clamped");
        x = std::clamp(x, 0.0, 1.0);
    }
    return rgb;
}

bool MaterialLibraries::is_physical(const mesh_io::MtlMaterial& material) {
    return material.roughness || material.metallic || material.sheen || material.coat ||
           !material.roughness_map.file.empty() || !material.metallic_map.file.empty();
}

void MaterialLibraries::add(const mesh_io::MtlMap& map, const MeasuredImage& picture, const char* parameter,
                            double scale, double offset, Material& to) {
    const std::size_t channel = map.channel == 'g' ? 1 : map.channel == 'b' ? 2 : 0;
    const auto at =
        std::ranges::find(to.values, parameter, &std::pair<std::string, std::vector<double>>::first);
    at->second = {rounded(offset + scale * picture.means.stored[channel])};
    to.maps.push_back(placed({.parameter = parameter,
                              .image = picture.index,
                              .channel = std::string(1, map.channel),
                              .scale = {rounded(scale)},
                              .offset = {rounded(offset)}},
                             map));
}

void MaterialLibraries::become_metallic_roughness(const Description& description, Material& to) {
    const mesh_io::MtlMaterial& from = description.material;
    const auto share = [&](const std::optional<double>& value, double otherwise) {
        return rounded(std::clamp(value.value_or(otherwise), 0.0, 1.0));
    };
    to.reflection = "metallic-roughness";
    std::vector<double> color = coefficients(from.kd, 0.8);
    if (!from.color_map.file.empty() && are_all(color, 0)) color = {1, 1, 1};
    to.color = encoded(color);
    if (to.color_map) to.color_map->scale = shortened(color);
    const double metallic = share(from.metallic, 0);
    // As for glTF: ambient light stands for half of the surroundings that a metal mirrors.
    to.values = {{"ka", {rounded(0.96 - 0.46 * metallic)}},
                 {"metallic", {metallic}},
                 {"roughness", {share(from.roughness, 0.5)}}};
    // Like a colour, a number multiplies its picture; some programs write 0 next to one.
    const auto factor = [&](const std::optional<double>& value) {
        const double number = share(value, 1);
        return number > 0 ? number : 1;
    };
    if (const auto& map = from.roughness_map; !map.file.empty()) {
        if (const auto picture = image(map.file, to.name, description))
            add(map, *picture, "roughness", factor(from.roughness), 0, to);
    }
    if (const auto& map = from.metallic_map; !map.file.empty()) {
        if (const auto picture = image(map.file, to.name, description)) {
            add(map, *picture, "ka", -0.46 * factor(from.metallic), 0.96, to);
            add(map, *picture, "metallic", factor(from.metallic), 0, to);
        }
    }
    if (share(from.coat, 0) > 0) {
        to.values.push_back({"clearcoat", {share(from.coat, 0)}});
        to.values.push_back({"clearcoat_roughness", {share(from.coat_roughness, 0)}});
    }
    if (share(from.sheen, 0) > 0) {
        to.values.push_back({"sheen_color", {share(from.sheen, 0)}});
        to.values.push_back({"sheen_roughness", {0.5}});
    }
    if (share(from.anisotropy, 0) > 0) {
        to.values.push_back({"anisotropy_strength", {share(from.anisotropy, 0)}});
        to.values.push_back({"anisotropy_rotation", {360 * share(from.rotation, 0)}});
    }
}

void MaterialLibraries::tilt_normals(const Description& from, Material& to) {
    const mesh_io::MtlMaterial& material = from.material;
    const bool is_bump = material.normal_map.file.empty();
    const mesh_io::MtlMap& map = is_bump ? material.bump_map : material.normal_map;
    if (map.file.empty()) return;
    const auto picture = image(map.file, to.name, from);
    if (!picture) return;
    // Many programs write a normal map as a bump map. On average, it is light blue; heights are grey.
    const auto& mean = picture->means.stored;
    constexpr double k_near = 0.15, k_least_blue = 0.6;
    const bool has_normals = std::abs(mean[0] - 0.5) < k_near && std::abs(mean[1] - 0.5) < k_near &&
                             mean[2] > k_least_blue && mean[2] > mean[0] + k_near / 2;
    to.has_heights = is_bump && !has_normals;
    to.normals = placed({.parameter = {},
                         .image = picture->index,
                         .scale = {is_bump ? std::clamp(map.multiplier, -1e3, 1e3) : 1}},
                        map);
}

void MaterialLibraries::add_emission(const Description& description, Material& to) {
    const mesh_io::MtlMaterial& from = description.material;
    constexpr double k_strongest = 1e30;
    std::vector<double> color = from.ke;
    for (double& channel : color) channel = std::clamp(channel, 0.0, k_strongest);
    const auto picture =
        from.emission_map.file.empty() ? std::nullopt : image(from.emission_map.file, to.name, description);
    // Black next to a texture means the texture, as for Kd.
    if (picture && (color.empty() || are_all(color, 0))) color = {1, 1, 1};
    if (color.empty()) return;
    set_emission(color, to);
    if (!picture) return;
    for (double& channel : color) channel /= to.emission_strength;
    to.maps.push_back(
        placed({.parameter = "emission", .image = picture->index, .channel = "", .scale = shortened(color)},
               from.emission_map));
}

void MaterialLibraries::add_opacity(const Description& description, Material& to) {
    const mesh_io::MtlMaterial& from = description.material;
    double opacity = rounded(from.opacity);
    const auto picture =
        from.opacity_map.file.empty() ? std::nullopt : image(from.opacity_map.file, to.name, description);
    // Some programs write 0 next to a picture.
    if (picture && opacity == 0) opacity = 1;
    if (!picture && opacity == 1) return;
    to.values.push_back({"opacity", {opacity}});
    if (!picture) return;
    if (picture->means.is_opacity_equal) return add(from.opacity_map, *picture, "opacity", opacity, 0, to);
    // A picture with opacity means that.
    to.values.back().second = {rounded(opacity * picture->means.opacity)};
    to.maps.push_back(
        placed({.parameter = "opacity", .image = picture->index, .channel = "a", .scale = {opacity}},
               from.opacity_map));
}

Material MaterialLibraries::material(const std::string& name) {
    const Description& description = *find(name);
    const mesh_io::MtlMaterial& d = description.material;
    Material material{.name = name};
    if (!d.color_map.file.empty()) {
        if (const auto picture = image(d.color_map.file, name, description))
            material.color_map = placed({.parameter = "color", .image = picture->index}, d.color_map);
    }
    tilt_normals(description, material);
    add_emission(description, material);
    if (is_physical(d)) {
        become_metallic_roughness(description, material);
        add_opacity(description, material);
        return material;
    }
    if (d.illumination == 0)
        model_.note("materials of illumination model 0, a constant colour, are lit like the others");
    if (d.illumination > 2)
        model_.note("reflections, refraction and other effects of illumination models 3 to 10 are left out");
    std::vector<double> kd = coefficients(d.kd, 0.8),
                        ks = coefficients(d.illumination < 2 ? std::vector<double>{} : d.ks, 0.0);
    constexpr double k_sharpest = 1e6;  // a highlight of a tenth of a degree; files have up to 1000
    if (d.shininess > k_sharpest) model_.note("highlight exponents above a million are clamped to it");
    const double shininess = std::clamp(d.shininess, 0.0, k_sharpest);
    if (shininess == 0 && !are_all(ks, 0)) {
        model_.note("highlights without an exponent (Ns) are left out: they would cover everything");
        ks = {0, 0, 0};
    }
    // Some programs write black next to a texture, and mean the texture.
    if (!d.color_map.file.empty() && are_all(kd, 0)) kd = {1, 1, 1};
    if (limit(kd, ks))
        model_.note("materials that reflect more light than they receive (Kd + Ks above 1) are scaled to 1");
    std::vector<double> ka = coefficients(d.ka, 1);
    // Programs without ambient colours write white and mean the surface's own colour. The same applies,
    // weaker, if there is none; grey would bleach it.
    if (d.ka.empty() || d.illumination == 0) {
        for (std::size_t c = 0; c < 3; ++c) ka[c] = 0.2 * kd[c];
    } else if (are_all(ka, 1)) {
        ka = kd;
    }
    for (const auto& [parameter, rgb] : {std::pair{"ka", &ka}, {"kd", &kd}, {"ks", &ks}})
        material.values.emplace_back(parameter, are_all(*rgb, (*rgb)[0]) ? std::vector{(*rgb)[0]} : *rgb);
    material.values.push_back({"shininess", {shininess}});
    add_opacity(description, material);
    return material;
}

std::optional<MaterialLibraries::MeasuredImage> MaterialLibraries::image(const std::string& name,
                                                                         const std::string& material,
                                                                         const Description& of) {
    const auto say = [&](const char* kind, std::string_view of_one, std::string_view of_many,
                         std::string_view rest = "") {
        const std::string which = fmt::format("'{}' of material '{}'", name, material);
        model_.count(kind, fmt::format("the texture {} {}{}", which, of_one, rest),
                     fmt::format("{{}} textures {}, the first of them {}{}", of_many, which, rest));
    };
    const auto found = find_named(of.folder, name);
    if (!found) {
        say("missing textures", "does not exist", "do not exist");
        return std::nullopt;
    }
    if (!source_.may_read(found->path)) {
        say("outside textures", "is outside the model's folder", "are outside the model's folder",
            k_outside_remedy);
        return std::nullopt;
    }
    const fs::path file = candela::canonical_path(found->path);
    const auto [known, is_new] = images_.try_emplace(file);
    if (!is_new) return known->second;
    if (found->is_renamed)
        say("renamed textures", "is read from", "are read from files with other names",
            fmt::format(" '{}'", found->path.filename().string()));
    Image image{file};
    Means means;
    try {
        // A scene is UTF-8 and could not name the file.
        if (candela::first_invalid_byte(file.string())) {
            image.content = candela::read_text_file(file).value_or("");
            image.file = fmt::format("texture_{}{}", model_.images.size(), file.extension().string());
            if (candela::first_invalid_byte(image.file.string())) image.file.replace_extension();
        }
        const ReadImage read = read_image(image, registry_);
        image.brightness = brightness_of(read.pixels);
        means = means_of(read.pixels);
        if (!read.other_format.empty())
            say("misnamed textures",
                fmt::format("is read as {}, according to its content", read.other_format),
                "are read according to their content");
    } catch (const candela::Error& problem) {
        say("broken textures", "is left out", "are left out", fmt::format(": {}", problem.what()));
        return std::nullopt;
    }
    model_.images.push_back(std::move(image));
    return known->second = MeasuredImage{model_.images.size() - 1, means};
}

}  // namespace importing::obj
