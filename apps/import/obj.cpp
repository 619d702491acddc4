#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "import/readers.h"

import candela.files;
import candela.formats;
import candela.text;

namespace fs = std::filesystem;

namespace importing {

namespace {

constexpr std::size_t k_most_library_bytes = std::size_t{16} << 20;

/// A statement: its first word, and what follows it.
struct Statement {
    std::string_view keyword, rest;
};

std::string_view trimmed(std::string_view text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view word_from(std::string_view& rest) {
    rest = trimmed(rest);
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
    rest = trimmed(rest.substr(word.size()));
    return word;
}

/// Words with one blank between them, as the shape `mesh` has the names of materials.
std::string joined(std::string_view rest) {
    std::string name;
    for (std::string_view word = word_from(rest); !word.empty(); word = word_from(rest)) {
        if (word.starts_with('#')) break;
        name.append(name.empty() ? "" : " ").append(word);
    }
    return name;
}

/// Calls `visit` for each line that is neither empty nor a comment.
template <class Visit>
void each_statement(std::string_view text, Visit visit) {
    while (!text.empty()) {
        const std::size_t end = text.find_first_of("\r\n");
        std::string_view rest = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const std::string_view keyword = word_from(rest);
        if (!keyword.empty() && keyword.front() != '#') visit(Statement{keyword, rest});
    }
}

std::vector<double> numbers_from(std::string_view rest) {
    std::vector<double> numbers;
    for (std::string_view word = word_from(rest); !word.empty() && numbers.size() < 4;
         word = word_from(rest)) {
        double value = 0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) break;
        numbers.push_back(value);
    }
    return numbers;
}

/// What a library says of a material, before it is a scene's.
struct Description {
    std::vector<double> ka, kd, ks;
    double shininess = 0;
    int illumination = 2;
    std::string texture;
    bool clamps = false;
};

std::string lower(std::string_view word) {
    std::string result;
    for (const char c : word) result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

class Libraries {
  public:
    Libraries(Model& model, fs::path model_file, candela::Registry& registry)
        : model_(model), model_file_(std::move(model_file)), registry_(registry) {}

    void read(const fs::path& file) {
        if (!known_files_.insert(file).second) return;
        if (!is_beside(file, model_file_)) {
            return model_.note(
                fmt::format("the material library '{}' is outside the model's folder", file.string()));
        }
        const auto text = candela::read_text_file(file, k_most_library_bytes);
        if (!text) return model_.note(fmt::format("the material library '{}' cannot be read", file.string()));
        if (text->size() > k_most_library_bytes)
            return model_.note(fmt::format("the material library '{}' is too large", file.string()));
        folder_ = file.parent_path();
        Description* current = nullptr;
        each_statement(*text, [&](const Statement& s) {
            if (s.keyword == "newmtl") {
                const std::string name = joined(s.rest);
                current = &descriptions_[name];
                *current = {};
            } else if (current != nullptr) {
                statement(lower(s.keyword), s.rest, *current);
            }
        });
    }

    bool has(const std::string& name) const { return descriptions_.contains(name); }

    Material material(const std::string& name) {
        const Description& d = descriptions_.at(name);
        Material material{.name = name};
        const auto add = [&](const char* parameter, const std::vector<double>& value, double otherwise) {
            std::vector<double> rgb = value.empty() ? std::vector{otherwise} : value;
            for (double& x : rgb) {
                if (x < 0 || x > 1) model_.note("coefficients of materials beyond 0 to 1 are clamped");
                x = std::clamp(x, 0.0, 1.0);
            }
            const bool is_grey = std::ranges::all_of(rgb, [&](double x) { return x == rgb[0]; });
            material.values.emplace_back(parameter, is_grey ? std::vector{rgb[0]} : rgb);
        };
        if (d.illumination == 0)
            model_.note("materials of illumination model 0, a constant colour, are lit like others");
        if (d.illumination > 2)
            model_.note(
                "reflections, refraction and other effects of illumination models 3 to 10 are left out");
        add("ka", d.illumination == 0 ? std::vector<double>{} : d.ka, 0.2);
        add("kd", d.kd, 0.8);
        add("ks", d.illumination < 2 ? std::vector<double>{} : d.ks, 0.0);
        constexpr double k_sharpest = 1e6;  // a highlight of a tenth of a degree; files have up to 1000
        if (d.shininess > k_sharpest) model_.note("exponents of highlights beyond a million are a million");
        material.values.push_back({"shininess", {std::clamp(d.shininess, 0.0, k_sharpest)}});
        if (!d.texture.empty()) {
            material.picture = picture(name, d.texture);
            material.clamps = d.clamps;
        }
        return material;
    }

  private:
    void statement(const std::string& keyword, std::string_view rest, Description& to) {
        if (keyword == "ka") return color(rest, to.ka);
        if (keyword == "kd") return color(rest, to.kd);
        if (keyword == "ks") return color(rest, to.ks);
        if (keyword == "map_kd") return texture(rest, to);
        const std::vector<double> numbers = numbers_from(rest);
        const double first = numbers.empty() ? 0 : numbers[0];
        if (keyword == "ns") {
            to.shininess = first;
        } else if (keyword == "illum") {
            to.illumination = static_cast<int>(std::clamp(first, 0.0, 10.0));
        } else if (keyword == "d" || keyword == "tr") {
            if (numbers.empty() || first != (keyword == "d" ? 1 : 0))
                model_.note("the opacity of materials is left out: they are opaque");
        } else if (keyword == "ke") {
            if (std::ranges::any_of(numbers, [](double x) { return x > 0; }))
                model_.note("the light that materials emit is left out");
        } else if (keyword.starts_with("map_") || keyword == "bump" || keyword == "norm" ||
                   keyword == "disp" || keyword == "decal" || keyword == "refl") {
            model_.note(
                fmt::format("textures other than those of colours are left out, such as '{}'", keyword));
        } else if (keyword == "pr" || keyword == "pm" || keyword == "ps" || keyword == "pc" ||
                   keyword == "pcr" || keyword == "aniso" || keyword == "anisor") {
            model_.note("the roughness and metalness of materials are left out; they are Phong's");
        } else if (keyword == "tf") {
            model_.note("the transmission of materials is left out");
        }
        // Ni, the index of refraction, matters only together with opacity; sharpness only to reflections.
    }

    void color(std::string_view rest, std::vector<double>& to) {
        std::string_view after = rest;
        const std::string_view first = word_from(after);
        if (first == "spectral" || first == "xyz")
            return model_.note("colours of materials as spectra or XYZ are left out");
        std::vector<double> numbers = numbers_from(rest);
        if (numbers.size() == 1) numbers = {numbers[0], numbers[0], numbers[0]};
        if (numbers.size() < 3) return model_.note("colours of materials that are no numbers are left out");
        numbers.resize(3);
        to = numbers;
    }

    /// Options come before the name, which may have blanks in it.
    void texture(std::string_view rest, Description& to) {
        while (rest.starts_with('-')) {
            std::string_view after = rest;
            const std::string option = lower(word_from(after));
            const bool takes_numbers = option == "-o" || option == "-s" || option == "-t" || option == "-mm";
            const bool takes_word = option == "-clamp" || option == "-blendu" || option == "-blendv" ||
                                    option == "-cc" || option == "-texres" || option == "-boost" ||
                                    option == "-bm" || option == "-imfchan" || option == "-type";
            if (!takes_numbers && !takes_word) break;
            if (takes_word) {
                const std::string value = lower(word_from(after));
                if (option == "-clamp") to.clamps = value == "on";
            } else {
                for (int i = 0; i < 3; ++i) {
                    std::string_view next = after;
                    const std::string_view word = word_from(next);
                    if (next.empty() || numbers_from(word).empty()) break;
                    after = next;
                }
                model_.note("the offset and scale of textures are left out");
            }
            rest = after;
        }
        to.texture = std::string(trimmed(rest));
        texture_folder_[to.texture] = folder_;
    }

    std::optional<std::size_t> picture(const std::string& material, const std::string& name) {
        std::error_code problem;
        fs::path file = texture_folder_[name] / name;
        if (!fs::is_regular_file(file, problem)) {
            std::string other = name;
            std::ranges::replace(other, '\\', '/');
            const fs::path turned = texture_folder_[name] / other;
            const fs::path beside = texture_folder_[name] / fs::path(other).filename();
            file = fs::is_regular_file(turned, problem) ? turned : beside;
        }
        if (!fs::is_regular_file(file, problem)) {
            model_.note(fmt::format("there is no texture '{}', which material '{}' names", name, material));
            return std::nullopt;
        }
        if (!is_beside(file, model_file_)) {
            model_.note(fmt::format("the texture '{}' of material '{}' is outside the model's folder", name,
                                    material));
            return std::nullopt;
        }
        if (!is_readable_picture(file, registry_)) {
            model_.note(
                fmt::format("the texture '{}' of material '{}' is of a format that no image plugin reads{}",
                            name, material, candela::possible_formats(registry_, candela::FormatUse::read)));
            return std::nullopt;
        }
        const fs::path canonical = candela::canonical_path(file);
        const auto same = std::ranges::find(model_.pictures, canonical, &Picture::file);
        if (same != model_.pictures.end()) return static_cast<std::size_t>(same - model_.pictures.begin());
        model_.pictures.push_back({canonical});
        return model_.pictures.size() - 1;
    }

    Model& model_;
    fs::path model_file_;
    candela::Registry& registry_;
    fs::path folder_;
    std::set<fs::path> known_files_;
    std::map<std::string, Description> descriptions_;
    std::map<std::string, fs::path> texture_folder_;
};

}  // namespace

Model read_obj(const fs::path& file, candela::Registry& registry) {
    Model model;
    Libraries libraries(model, file, registry);
    const auto text = candela::read_text_file(file);
    std::vector<std::string> used;  // in the order of their first faces
    std::set<std::string, std::less<>> known;
    std::map<std::string, std::size_t> numbers;  // as the shape `mesh` numbers them
    std::string current = "(none)";
    bool is_listed = false;
    each_statement(text ? *text : std::string_view(), [&](const Statement& s) {
        if (s.keyword == "mtllib") {
            // Usually one name, which may have blanks in it.
            const fs::path whole = file.parent_path() / trimmed(s.rest);
            std::error_code problem;
            if (fs::is_regular_file(whole, problem)) return libraries.read(whole);
            std::string_view rest = s.rest;
            for (std::string_view word = word_from(rest); !word.empty(); word = word_from(rest))
                libraries.read(file.parent_path() / word);
        } else if (s.keyword == "usemtl") {
            const std::string name = joined(s.rest);
            current = name.empty() ? "(none)" : name;
            numbers.try_emplace(current, numbers.size());
            is_listed = known.contains(current);
        } else if (!is_listed && (s.keyword == "f" || s.keyword == "fo")) {
            used.push_back(current);
            known.insert(current);
            numbers.try_emplace(current, numbers.size());
            is_listed = true;
        }
    });
    for (const std::string& name : used) {
        Part part;
        // A scene is UTF-8, which an OBJ file need not be.
        if (used.size() > 1)
            part.selector = candela::first_invalid_byte(name) ? fmt::format("#{}", numbers[name]) : name;
        if (libraries.has(name)) {
            part.material = model.materials.size();
            model.materials.push_back(libraries.material(name));
        } else if (name != "(none)") {
            model.note(fmt::format("no material library describes the material '{}'", name));
        }
        model.parts.push_back(part);
    }
    if (model.parts.empty()) model.parts.emplace_back();
    return model;
}

bool is_beside(const fs::path& part, const fs::path& model) {
    const fs::path folder = candela::canonical_path(fs::absolute(model).parent_path());
    const fs::path path = candela::canonical_path(fs::absolute(part));
    return std::ranges::mismatch(folder, path).in1 == folder.end();
}

bool is_readable_picture(const fs::path& file, candela::Registry& registry) {
    return registry.find_format(candela::extension_of(file), candela::FormatUse::read) != nullptr;
}

}  // namespace importing
