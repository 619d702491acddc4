#include "jobs/image_parts.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

#include "files/output_folder.h"
#include "files/owned_files.h"
#include "film/render_cache.h"
#include "json/json.h"
#include "programs/shell_words.h"

import candela.util;

namespace fs = std::filesystem;
using candela::ColorEncoding;
using candela::Error;
using candela::ErrorCategory;
using candela::PixelType;

namespace {

constexpr std::size_t k_largest_description = 1 << 16;

std::optional<int> number_of(std::string_view text) {
    int number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

fs::path description_of(const fs::path& picture) { return folder_of_parts(picture) / "picture.json"; }

}  // namespace

std::string PartNumber::name() const { return fmt::format("{}-of-{}", number, of); }

PartNumber part_from(const std::string& text) {
    const std::size_t slash = text.find('/');
    const auto number = number_of(std::string_view(text).substr(0, slash));
    const auto of =
        slash == std::string::npos ? std::nullopt : number_of(std::string_view(text).substr(slash + 1));
    if (!number || !of || *of < 1)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--part is '{}'; expected a part such as 3/16, the third of sixteen", text));
    if (*number < 1 || *number > *of)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--part is {}; expected 1/{} to {}/{}", text, *of, *of, *of));
    return {*number, *of};
}

candela::RowRange rows_of(PartNumber part, int height) {
    if (part.of > height)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("a picture of {} rows cannot be split into {} parts", height, part.of));
    // Large parts end where tiles end, so that each tile is rendered once.
    constexpr int k_rows_of_tiles = 64;
    const int unit = height / part.of >= k_rows_of_tiles ? k_rows_of_tiles : 1;
    const auto end_of = [&](int number) {
        if (number == part.of) return height;
        return static_cast<int>(std::int64_t{height / unit} * number / part.of) * unit;
    };
    return {end_of(part.number - 1), end_of(part.number)};
}

fs::path folder_of_parts(const fs::path& picture) {
    fs::path folder = picture;
    folder += ".parts";
    return folder;
}

fs::path file_of_part(const fs::path& picture, PartNumber part) {
    return folder_of_parts(picture) / (part.name() + ".pixels");
}

std::string PartedImage::inputs_of_parts() const {
    return fmt::format("{} of {} x {} {} {} in {}", inputs, whole.width, whole.height,
                       whole.pixels == PixelType::byte ? "bytes" : "floats",
                       whole.encoding == ColorEncoding::srgb ? "srgb" : "linear", parts);
}

std::size_t PartedImage::row_size() const {
    return 3 * static_cast<std::size_t>(whole.width) * (whole.pixels == PixelType::byte ? 1 : sizeof(float));
}

PartedImage parted_image_of(const candela::SceneDraft& draft, const candela::OutputFormat& format, int parts,
                            candela::Registry& registry) {
    const candela::ImageSettings& image = draft.scene.image;
    return {.whole = {.width = image.width,
                      .height = image.height,
                      .pixels = format.pixels,
                      .encoding = image.color_management},
            .parts = parts,
            .inputs = InputFingerprints(registry, format).of(draft)};
}

void write_description(const PartedImage& parted, const fs::path& picture) {
    const Json description = {{"version", 1},
                              {"width", parted.whole.width},
                              {"height", parted.whole.height},
                              {"pixels", parted.whole.pixels == PixelType::byte ? "byte" : "float"},
                              {"srgb", parted.whole.encoding == ColorEncoding::srgb},
                              {"parts", parted.parts},
                              {"inputs", parted.inputs}};
    const std::string text = json_text(description, 1) + '\n';
    make_owned_folder(folder_of(picture), folder_of_parts(picture).filename());
    // All parts have the same description.
    if (read_owned_file(description_of(picture), k_largest_description) != text)
        write_owned_file(description_of(picture), text);
}

PartedImage read_description(const fs::path& picture) {
    const fs::path file = description_of(picture);
    const auto text = read_owned_file(file, k_largest_description);
    if (!text) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' has no parts: '{}' does not exist; make one with candela render SCENE "
                                "-o {} --part 1/16",
                                picture.string(), file.string(), quoted_for_shell(picture.string())));
    }
    try {
        const Json description = parse_json(*text);
        PartedImage parted{.whole = {.width = description.at("width"), .height = description.at("height")},
                           .parts = description.at("parts"),
                           .inputs = description.at("inputs")};
        const bool is_byte = description.at("pixels") == "byte";
        parted.whole.pixels = is_byte ? PixelType::byte : PixelType::real;
        parted.whole.encoding =
            description.at("srgb").get<bool>() ? ColorEncoding::srgb : ColorEncoding::none;
        constexpr int k_most = 65536;  // as in a scene
        if (parted.whole.width < 1 || parted.whole.width > k_most || parted.whole.height > k_most ||
            parted.parts < 1 || parted.parts > parted.whole.height)
            throw Error(ErrorCategory::failure,
                        fmt::format("'{}' does not describe a picture", file.string()));
        return parted;
    } catch (const Json::exception& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' does not describe a picture: {}", file.string(), problem.what()));
    }
}
