#include "aov/terms.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <span>
#include <string_view>
#include <utility>

import candela.api;
import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;
using candela::Film;
using candela::ParamType;
using candela::Term;

namespace {

/// A term, its name, and the names of its channels in a file of layers, which are those known to users of
/// OpenEXR: N, P and Z.
struct KnownTerm {
    std::string_view name;
    Term term;
    bool is_of_light;
    std::array<std::string_view, 3> channels;  // after the layer's name and a dot, unless the name is empty
    std::string_view layer;
};

constexpr std::array<std::string_view, 3> k_color{"R", "G", "B"}, k_vector{"X", "Y", "Z"};

constexpr KnownTerm k_terms[] = {
    {"ambient", Term::ambient, false, k_color, "ambient"},
    {"diffuse", Term::diffuse, false, k_color, "diffuse"},
    {"specular", Term::specular, false, k_color, "specular"},
    {"surroundings", Term::surroundings, false, k_color, "surroundings"},
    {"emission", Term::emission, false, k_color, "emission"},
    {"background", Term::background, false, k_color, "background"},
    {"luminance", Term::intensity, false, {""}, "luminance"},
    {"light", Term::intensity, true, k_color, "light"},
    {"n_dot_l", Term::n_dot_l, true, {""}, "n_dot_l"},
    {"visibility", Term::visibility, false, k_color, "visibility"},
    {"visibility", Term::visibility, true, k_color, "visibility"},
    {"ambient_occlusion", Term::ambient_occlusion, false, k_color, "ambient_occlusion"},
    {"normal", Term::normal, false, k_vector, "N"},
    {"color", Term::color, false, k_color, "color"},
    {"face_normal", Term::face_normal, false, k_vector, "Ng"},
    {"position", Term::position, false, k_vector, "P"},
    {"depth", Term::depth, false, {"Z"}, ""},
    {"barycentric", Term::barycentric, false, k_vector, "barycentric"},
    {"uv", Term::uv, false, {"U", "V"}, "uv"},
    {"opacity", Term::opacity, false, {"opacity"}, ""},
    {"facing", Term::facing, false, {"facing"}, ""},
    {"object", Term::object, false, {"object"}, ""},
    {"triangle", Term::triangle, false, {"triangle"}, ""},
};

/// A parameter of a reflection model.
constexpr std::string_view k_of_material = "material.";

const KnownTerm& known(const NamedTerm& named) {
    static constexpr KnownTerm k_number{"material", Term::parameter, false, {""}, "material"};
    static constexpr KnownTerm k_numbers{"material", Term::parameter, false, k_color, "material"};
    if (named.term == Term::parameter) return named.is_number ? k_number : k_numbers;
    return *std::ranges::find_if(k_terms, [&](const KnownTerm& t) {
        return t.term == named.term && t.is_of_light == named.light.has_value();
    });
}

/// A light's name, or its number.
std::string name_of_light(const candela::Label& label) {
    return label.name.empty() ? std::to_string(label.number) : label.name;
}

bool needs_shadows(Term term) { return term == Term::visibility || term == Term::ambient_occlusion; }

bool may_be_shown(ParamType type) {
    return type == ParamType::real || type == ParamType::rgb || type == ParamType::color;
}

/// The parameters of the objects' reflection models, in the order of the objects.
std::vector<std::string> shown_parameters(const candela::Scene& scene) {
    std::vector<std::string> names;
    for (const candela::Object& object : scene.objects)
        for (const candela::Parameter& parameter : object.reflection.parameters.schema())
            if (may_be_shown(parameter.type) && std::ranges::find(names, parameter.name) == names.end())
                names.push_back(parameter.name);
    return names;
}

/// The term of one of these.
NamedTerm parameter_term(const std::string& name, const candela::Scene& scene) {
    NamedTerm term{std::string(k_of_material) + name, Term::parameter};
    term.is_number = true;
    for (const candela::Object& object : scene.objects) {
        const candela::ParamSet& values = object.reflection.parameters;
        const std::size_t index = values.index_of(name);
        candela::ShownParameter& shown = term.parameter.emplace_back();
        if (index == values.schema().size() || !may_be_shown(values.schema()[index].type)) continue;
        const auto& number = values.runtime(scene.image.color_management)[index].number;
        const bool is_number = values.schema()[index].type == ParamType::real;
        shown = {index, is_number ? candela::Vec3{number[0], number[0], number[0]}
                                  : candela::Vec3{number[0], number[1], number[2]}};
        term.is_number &= is_number;
    }
    return term;
}

/// The possible words of a list: all terms, and those of each light.
std::vector<NamedTerm> possible_terms(const candela::Scene& scene) {
    std::vector<NamedTerm> all;
    for (const KnownTerm& known : k_terms) {
        if (needs_shadows(known.term) && !scene.shadows.enabled) continue;
        if (!known.is_of_light) {
            all.push_back({std::string(known.name), known.term});
            continue;
        }
        for (std::size_t i = 0; i < scene.lights.size(); ++i)
            all.push_back(
                {fmt::format("{}.{}", known.name, name_of_light(scene.lights[i].label)), known.term, i});
    }
    return all;
}

/// The meaning of one word of a list: a term by its name, a light's by its number, or several.
std::vector<NamedTerm> meant_by(const std::string& word, const std::vector<NamedTerm>& possible,
                                const candela::Scene& scene, const std::string& origin) {
    // For all lights; empty if the scene has none.
    const bool is_of_lights = word == "light" || word == "n_dot_l";
    std::vector<NamedTerm> meant;
    if (word == "material" || word.starts_with(k_of_material)) {
        for (const std::string& name : shown_parameters(scene))
            if (word == "material" || word.substr(k_of_material.size()) == name)
                meant.push_back(parameter_term(name, scene));
        if (!meant.empty()) return meant;
    }
    std::ranges::copy_if(possible, std::back_inserter(meant), [&](const NamedTerm& term) {
        return word == "all" || word == term.name ||
               (is_of_lights && term.light && term.name.starts_with(word + "."));
    });
    if (!meant.empty() || is_of_lights) return meant;
    for (const NamedTerm& term : possible) {
        if (term.light && word == fmt::format("{}.{}", known(term).name, *term.light))
            return {{word, term.term, term.light}};
    }
    for (const KnownTerm& term : k_terms) {
        if (needs_shadows(term.term) && word.substr(0, word.find('.')) == term.name)
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("{}: the term '{}' needs shadows, and the scene has none; add --shadows, or "
                            "[shadows] with enabled = true",
                            origin, candela::printable(word)));
    }
    std::vector<std::string> words{"all", "light", "n_dot_l"};
    for (const NamedTerm& term : possible) words.push_back(term.name);
    for (const std::string& name : shown_parameters(scene))
        words.push_back(std::string(k_of_material) + name);
    const std::string suggestion = candela::suggestion(word, words);
    throw Error(ErrorCategory::bad_request,
                fmt::format("{}: unknown term '{}'{}; possible: {}", origin, candela::printable(word),
                            suggestion.empty() ? "" : "; " + suggestion,
                            candela::printable(fmt::format("{}", fmt::join(words, ", ")))));
}

/// Adds a term that is not in the list yet.
void add(std::vector<NamedTerm>& terms, NamedTerm term, const std::string& origin) {
    const auto same = std::ranges::find(terms, term.name, &NamedTerm::name);
    if (same == terms.end()) return terms.push_back(std::move(term));
    if (same->light != term.light)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("{}: two lights of the scene are named '{}'; give them different names",
                                origin, candela::printable(term.name.substr(term.name.find('.') + 1))));
}

/// A light's name as part of a file name: characters that separate folders or are special to a shell become
/// underscores.
std::string in_file_name(std::string name) {
    for (char& c : name) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                              c == '.' || c == '-' || static_cast<unsigned char>(c) >= 0x80;
        if (!is_plain) c = '_';
    }
    return name;
}

/// The three channels of a film as planes, as needed by Film::store().
struct Planes {
    explicit Planes(const Film& film) : width(film.width()), height(film.height()) {
        const std::span<const float> reals = film.view().reals;
        for (std::size_t c = 0; c < 3; ++c) {
            channel[c].reserve(reals.size() / 3);
            for (std::size_t i = c; i < reals.size(); i += 3) channel[c].push_back(reals[i]);
        }
    }

    Film film(candela::PixelType pixels, const candela::DisplayTransform& transform) const {
        Film result(width, height, pixels, transform);
        result.store(0, 0, width, height, {channel[0].data(), channel[1].data(), channel[2].data()}, width);
        return result;
    }

    int width, height;
    std::array<std::vector<float>, 3> channel;
};

/// Colours that distinguish adjacent indices: hues a golden angle apart.
std::array<float, 3> color_of_index(float index) {
    if (index < 0) return {0, 0, 0};
    constexpr double k_golden = 0.6180339887498949;
    const double turns = static_cast<double>(index) * k_golden;
    const auto hue = static_cast<float>(6 * (turns - static_cast<double>(static_cast<long long>(turns))));
    const auto channel = [&](float at) {
        const float distance = std::abs(hue - at);
        const float nearest = std::min(distance, 6 - distance);
        return 0.25f + 0.7f * std::clamp(2 - nearest, 0.0f, 1.0f);
    };
    return {channel(0), channel(2), channel(4)};
}

/// Maps the range of the values, where there is an object, to [from, to].
void stretch(std::vector<float>& values, const std::vector<float>& facing, float from, float to) {
    float least = std::numeric_limits<float>::max(), most = std::numeric_limits<float>::lowest();
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (facing[i] == 0) continue;
        least = std::min(least, values[i]);
        most = std::max(most, values[i]);
    }
    const float range = most > least ? most - least : 1;
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = facing[i] == 0 ? 0 : from + (to - from) * (values[i] - least) / range;
}

/// Maps values that are not intensities to colours from 0 to 1. `facing`: 0 where there is no object.
void map_to_colors(Term term, Planes& planes, const std::vector<float>& facing) {
    auto& [r, g, b] = planes.channel;
    for (std::size_t i = 0; i < r.size(); ++i) {
        const bool is_object = facing[i] != 0;
        switch (term) {
            case Term::normal:
            case Term::face_normal:
                for (std::vector<float>* const v : {&r, &g, &b})
                    (*v)[i] = is_object ? 0.5f + 0.5f * (*v)[i] : 0;
                break;
            case Term::object:
            case Term::triangle: {
                const std::array<float, 3> color = color_of_index(r[i]);
                r[i] = color[0];
                g[i] = color[1];
                b[i] = color[2];
                break;
            }
            case Term::facing:
                r[i] = is_object && facing[i] < 0 ? 1 : 0;
                g[i] = is_object && facing[i] > 0 ? 1 : 0;
                b[i] = 0;
                break;
            case Term::uv:
                for (std::vector<float>* const v : {&r, &g}) (*v)[i] -= std::floor((*v)[i]);
                break;
            default:
                break;
        }
    }
    if (term == Term::depth) {
        stretch(r, facing, 1, 0.1f);
        g = b = r;
    }
    if (term == Term::parameter) {
        const float largest = std::max({std::ranges::max(r), std::ranges::max(g), std::ranges::max(b), 1.0f});
        for (std::vector<float>* const v : {&r, &g, &b})
            for (float& value : *v) value /= largest;
    }
    if (term == Term::position) {
        for (std::vector<float>* const v : {&r, &g, &b}) stretch(*v, facing, 0.1f, 1);
    }
}

bool is_intensity(Term term) {
    return term == Term::intensity || term == Term::ambient || term == Term::diffuse ||
           term == Term::specular || term == Term::surroundings || term == Term::emission ||
           term == Term::background;
}

}  // namespace

std::vector<NamedTerm> terms_from(const std::vector<std::string>& words, const candela::Scene& scene,
                                  const std::string& origin) {
    const std::vector<NamedTerm> possible = possible_terms(scene);
    std::vector<NamedTerm> terms;
    for (const std::string& word : words) {
        for (NamedTerm& term : meant_by(word, possible, scene, origin)) add(terms, std::move(term), origin);
    }
    return terms;
}

bool is_luminance(const NamedTerm& term) { return term.term == Term::intensity && !term.light; }

int channel_count(const NamedTerm& term) {
    int count = 1;
    for (const std::string_view channel : std::span(known(term).channels).subspan(1))
        count += channel.empty() ? 0 : 1;
    return count;
}

fs::path file_of_term(const std::string& name, const fs::path& picture) {
    fs::path file = picture;
    file.replace_filename(picture.stem().string() + "." + in_file_name(name) + picture.extension().string());
    return file;
}

std::vector<fs::path> files_of(const std::vector<NamedTerm>& terms, const fs::path& picture) {
    std::map<fs::path, std::string> names;
    std::vector<fs::path> files;
    for (const NamedTerm& term : terms) {
        files.push_back(file_of_term(term.name, picture));
        const auto [other, is_new] = names.emplace(files.back(), term.name);
        if (!is_new)
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("--terms: '{}' and '{}' would both be written to '{}'; choose one of them, or "
                            "write layers to an .exr",
                            candela::printable(other->second), candela::printable(term.name),
                            candela::printable(files.back().string())));
    }
    return files;
}

Film TermRenderer::rendered(const NamedTerm& term) {
    Film film(scene_.image.width, scene_.image.height, candela::PixelType::real,
              candela::ColorEncoding::none);
    candela::Renderer& renderer = candela::is_geometric(term.term) ? geometric_ : lit_;
    renderer.render(
        scene_, film,
        {.term = term.term, .parameter = term.parameter, .light = term.light, .threads = threads_});
    return film;
}

Film TermRenderer::luminance() {
    Planes light(rendered({"luminance", Term::intensity}));
    auto& [r, g, b] = light.channel;
    // A background that is only a colour of the picture is not light.
    if (scene_.environment.is_uniform()) {
        const Planes behind(rendered({"background", Term::background}));
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < r.size(); ++i) light.channel[c][i] -= behind.channel[c][i];
    }
    // ITU-R BT.709
    for (std::size_t i = 0; i < r.size(); ++i)
        r[i] = std::max(0.0f, 0.2126f * r[i] + 0.7152f * g[i] + 0.0722f * b[i]);
    g = b = r;
    return light.film(candela::PixelType::real, candela::ColorEncoding::none);
}

Film TermRenderer::values(const NamedTerm& term) { return is_luminance(term) ? luminance() : rendered(term); }

Film TermRenderer::image(const NamedTerm& term, candela::PixelType pixels, LuminanceDisplay& display) {
    Film film = values(term);
    if (pixels == candela::PixelType::real) return film;
    if (is_luminance(term)) {
        if (!display.scale) display.scale = scale_for(film);
        Film colors = in_false_colors(film, *display.scale);
        return display.has_legend ? with_legend(colors, *display.scale) : std::move(colors);
    }
    Planes planes(film);
    if (is_intensity(term.term)) return planes.film(pixels, candela::display_of(scene_));
    if (term.term == Term::color) return planes.film(pixels, scene_.image.color_management);
    if (facing_.empty()) facing_ = std::move(Planes(values({"facing", Term::facing})).channel[0]);
    map_to_colors(term.term, planes, facing_);
    return planes.film(pixels, candela::ColorEncoding::none);
}

void write_with_layers(const Film& film, const std::vector<NamedTerm>& terms, TermRenderer& renderer,
                       const candela::OutputFormat& format, const fs::path& path, candela::Registry& registry,
                       candela::Existing existing) {
    std::vector<Planes> planes{Planes(film)};
    std::vector<std::string> names(k_color.begin(), k_color.end());
    std::vector<std::span<const float>> values;
    const auto add = [&](std::size_t channels) {
        for (std::size_t c = 0; c < channels; ++c) values.emplace_back(planes.back().channel[c]);
    };
    add(3);
    for (const NamedTerm& term : terms) {
        const KnownTerm& kind = known(term);
        planes.emplace_back(renderer.values(term));
        const std::string layer =
            term.light || term.term == Term::parameter ? term.name : std::string(kind.layer);
        std::size_t channels = 0;
        for (const std::string_view channel : kind.channels) {
            if (channel.empty() && channels > 0) break;
            names.push_back(layer.empty() || channel.empty() ? fmt::format("{}{}", layer, channel)
                                                             : fmt::format("{}.{}", layer, channel));
            ++channels;
        }
        add(channels);
    }
    std::vector<candela::ImageChannel> channels;
    for (std::size_t i = 0; i < names.size(); ++i) channels.push_back({names[i].c_str(), values[i]});
    candela::write_layers(film.width(), film.height(), channels, format, path, registry, existing);
}
