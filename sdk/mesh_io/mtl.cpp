#include "mesh_io/mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "mesh_io/obj_statements.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io {

namespace {

std::string lower(std::string_view word) {
    std::string result;
    for (const char c : word) result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

/// Takes the first word from `rest`.
std::string_view word_from(std::string_view& rest) {
    TextScanner scanner(rest);
    const std::string_view word = scanner.word();
    rest = scanner.rest_of_line();
    return word;
}

/// Up to four finite numbers.
std::vector<double> numbers_from(std::string_view rest) {
    std::vector<double> numbers;
    TextScanner scanner(rest);
    for (std::string_view word = scanner.word(); !word.empty() && numbers.size() < 4; word = scanner.word()) {
        const auto value = number_from(word);
        if (!value || !std::isfinite(*value)) break;
        numbers.push_back(*value);
    }
    return numbers;
}

bool are_all(const std::vector<double>& values, double value) {
    return !values.empty() && std::ranges::all_of(values, [&](double x) { return x == value; });
}

class MaterialReader {
  public:
    MaterialLibrary read(std::string_view text) {
        MtlMaterial* current = nullptr;
        each_statement(text, [&](const Statement& s) {
            if (s.keyword == "newmtl") {
                std::string name = material_name(s.rest);
                const std::size_t number = numbers_.of(name);
                library_.materials.resize(numbers_.names().size());
                current = &library_.materials[number];
                *current = {};
                current->name = std::move(name);
                has_d_ = false;
            } else if (current != nullptr) {
                statement(lower(s.keyword), s.rest, *current);
            }
        });
        return std::move(library_);
    }

  private:
    void note(std::string sentence) {
        if (std::ranges::find(library_.notes, sentence) == library_.notes.end())
            library_.notes.push_back(std::move(sentence));
    }

    void statement(const std::string& keyword, std::string_view rest, MtlMaterial& to) {
        if (keyword == "ka") return color(rest, to.ka);
        if (keyword == "kd") return color(rest, to.kd);
        if (keyword == "ks") return color(rest, to.ks);
        if (keyword == "ke") return color(rest, to.ke);
        if (keyword == "map_kd") {
            to.color_map = texture(rest);
            return;
        }
        if (keyword == "map_ke") {
            to.emission_map = texture(rest);
            return;
        }
        if (keyword == "map_d") {
            to.opacity_map = texture(rest);
            return;
        }
        if (keyword == "map_pr" || keyword == "map_pm") {
            (keyword == "map_pr" ? to.roughness_map : to.metallic_map) = texture(rest);
            return;
        }
        if (keyword == "norm" || keyword == "map_bump" || keyword == "bump") {
            (keyword == "norm" ? to.normal_map : to.bump_map) = texture(rest);
            return;
        }
        const std::vector<double> numbers = numbers_from(rest);
        const double first = numbers.empty() ? 0 : numbers[0];
        if (keyword == "ns") {
            to.shininess = first;
        } else if (keyword == "illum") {
            to.illumination = static_cast<int>(std::clamp(first, 0.0, 10.0));
        } else if (keyword == "d" || keyword == "tr") {
            opacity(keyword == "d", numbers, to);
        } else if (keyword.starts_with("map_") || keyword == "disp" || keyword == "decal" ||
                   keyword == "refl") {
            note(fmt::format(
                "textures other than those of colour, emission, opacity, roughness, metalness and "
                "normals are left out, such as '{}'",
                keyword));
        } else if (std::optional<double>* const value = physical(keyword, to)) {
            if (!numbers.empty()) *value = first;
        } else if (keyword == "tf") {
            // White transmits everything, and so says nothing.
            if (!are_all(numbers, 1)) note("the transmission of materials is left out");
        }
        // Ni, the index of refraction, matters only with opacity; sharpness only for reflections.
    }

    /// `d` is the opacity, `Tr` one minus that; where they differ, `d` counts. `d -halo` depends on the
    /// angle.
    void opacity(bool is_d, const std::vector<double>& numbers, MtlMaterial& to) {
        if (numbers.empty()) return note("an opacity that depends on the angle is left out");
        if (!is_d && has_d_) return;
        has_d_ = has_d_ || is_d;
        to.opacity = std::clamp(is_d ? numbers[0] : 1 - numbers[0], 0.0, 1.0);
    }

    /// The value of a keyword of Clara.io's extension for physically based materials.
    static std::optional<double>* physical(std::string_view keyword, MtlMaterial& of) {
        const std::pair<std::string_view, std::optional<double>*> values[] = {
            {"pr", &of.roughness},       {"pm", &of.metallic},      {"ps", &of.sheen},       {"pc", &of.coat},
            {"pcr", &of.coat_roughness}, {"aniso", &of.anisotropy}, {"anisor", &of.rotation}};
        for (const auto& [name, value] : values)
            if (name == keyword) return value;
        return nullptr;
    }

    void color(std::string_view rest, std::vector<double>& to) {
        std::string_view after = rest;
        const std::string_view first = word_from(after);
        if (first == "spectral" || first == "xyz")
            return note("material colours given as spectra or XYZ are left out");
        std::vector<double> numbers = numbers_from(rest);
        if (numbers.size() == 1) numbers = {numbers[0], numbers[0], numbers[0]};
        if (numbers.size() < 3) return note("material colours that are not numbers are left out");
        numbers.resize(3);
        to = numbers;
    }

    /// Options precede the name, which may contain blanks.
    MtlMap texture(std::string_view rest) {
        MtlMap map;
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
                if (option == "-clamp") map.clamps = value == "on";
                if (const auto numbers = numbers_from(value); option == "-bm" && !numbers.empty())
                    map.multiplier = numbers[0];
                if (option == "-imfchan" && (value == "g" || value == "b")) map.channel = value[0];
            } else {
                for (std::size_t i = 0; i < 3; ++i) {
                    std::string_view next = after;
                    const std::vector<double> numbers = numbers_from(word_from(next));
                    if (next.empty() || numbers.empty()) break;
                    after = next;
                    if (i < 2 && option == "-s") map.scale[i] = numbers[0];
                    if (i < 2 && option == "-o") map.offset[i] = numbers[0];
                }
                if (option == "-t" || option == "-mm")
                    note("the turbulence and the range of textures are left out");
            }
            rest = after;
        }
        map.file = rest;
        return map;
    }

    MaterialLibrary library_;
    bool has_d_ = false;  // the current material
    MaterialNumbers numbers_;
};

}  // namespace

MaterialLibrary read_mtl(std::string_view text) { return MaterialReader().read(text); }

}  // namespace mesh_io
