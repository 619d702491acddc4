#include "film/render_cache.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "files/output_folder.h"
#include "files/owned_files.h"

import candela.plugins;
import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;
using candela::Links;
using candela::PluginKind;

namespace {

constexpr std::size_t k_fingerprint = 36;  // characters

/// SHA-1, shortened to a UUID.
std::string fingerprint(std::string_view bytes) {
    static const boost::uuids::name_generator_sha1 k_generator{boost::uuids::uuid{}};
    return boost::uuids::to_string(k_generator(bytes.data(), bytes.size()));
}

/// The library that contains Candela itself.
fs::path core_library() {
    Dl_info info{};
    // The address of a function of the core.
    if (::dladdr(reinterpret_cast<const void*>(&candela::default_scene_text), &info) == 0 ||  // NOLINT
        info.dli_fname == nullptr)
        return "/proc/self/exe";
    return candela::canonical_path(info.dli_fname);
}

fs::path record_of(const fs::path& picture) {
    return picture.parent_path() / ".candela" / picture.filename();
}

/// The fingerprints of a file's pieces, so that the file need not fit into memory.
std::string fingerprint_of(candela::RegularFile& file, const fs::path& name) {
    constexpr std::uint64_t k_piece = std::uint64_t{1} << 24;
    std::string piece(static_cast<std::size_t>(std::min(file.size(), k_piece)), '\0'), all;
    for (std::uint64_t done = 0; done < file.size() || all.empty();) {
        const auto count = file.read(piece);
        if (!count) throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", name.string()));
        if (*count == 0 && !all.empty()) break;
        all += fingerprint({piece.data(), *count});
        done += *count;
    }
    return all.size() == k_fingerprint ? all : fingerprint(all);
}

std::optional<std::string> record_text_of(const fs::path& picture) {
    constexpr std::size_t k_most = 4096;
    return read_owned_file(record_of(picture), k_most);
}

/// Whether the picture has the size that its record gives.
bool has_recorded_size(const fs::path& picture, const std::string& record, Links links) {
    std::error_code problem;
    const fs::file_status is =
        links == Links::followed ? fs::status(picture, problem) : fs::symlink_status(picture, problem);
    if (!fs::is_regular_file(is)) return false;
    const auto size = fs::file_size(picture, problem);
    return !problem && record.find(fmt::format("\nbytes {}\n", size)) != std::string::npos;
}

/// The text of a picture's record; nothing if the picture does not exist.
std::optional<std::string> record_text(const fs::path& picture, const std::string& inputs, Links links) {
    candela::RegularFile file(picture, links);
    if (!file.is_open()) return std::nullopt;
    return fmt::format("inputs {}\nbytes {}\npicture {}\n", inputs, file.size(),
                       fingerprint_of(file, picture));
}

}  // namespace

InputFingerprints::InputFingerprints(candela::Registry& registry, const candela::OutputFormat& format)
    : registry_(registry), format_(format) {}

void InputFingerprints::depend_on(const std::string& text, const fs::path& file) {
    std::error_code problem;
    further_ += text + '\n';
    if (fs::is_regular_file(file, problem)) further_ += of_file(file) + '\n';
}

const std::string& InputFingerprints::of_file(const fs::path& file) {
    const auto [known, is_new] = files_.try_emplace(file);
    if (is_new) {
        const auto bytes = candela::read_text_file(file);
        if (!bytes) {
            files_.erase(known);
            throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", file.string()));
        }
        known->second = fingerprint(*bytes);
    }
    return known->second;
}

std::string InputFingerprints::of_plugin(PluginKind kind, const std::string& name) {
    const candela::PluginFile* const plugin = registry_.find(kind, name);
    return plugin == nullptr ? "" : fmt::format("{} {}\n", plugin->manifest.id(), of_file(plugin->library));
}

std::string InputFingerprints::of(const candela::SceneDraft& draft) {
    candela::Scene scene = draft.scene;
    scene.animation.reset();  // other frames do not affect this one
    std::string all = scene_text(scene) + further_;
    // The values of these files are in the text already.
    const std::set<fs::path> read(draft.files.begin(), draft.files.end());
    for (const fs::path& file : input_files(draft)) {
        if (!read.contains(file)) all += fmt::format("{} {}\n", file.string(), of_file(file));
    }
    std::set<std::string> plugins{of_plugin(PluginKind::image, format_.plugin)};
    for (const candela::LightSource& light : scene.lights)
        plugins.insert(of_plugin(PluginKind::light, light.model.name));
    for (const candela::Object& object : scene.objects) {
        plugins.insert(of_plugin(PluginKind::shape, object.shape.name));
        plugins.insert(of_plugin(PluginKind::shading, object.shading.name));
        plugins.insert(of_plugin(PluginKind::reflection, object.reflection.name));
    }
    for (const std::string& plugin : plugins) all += plugin;
    all += fmt::format("{} {}\n", format_.extension, of_file(core_library()));
    for (std::size_t i = 0; i < format_.parameters.schema().size(); ++i) {
        if (const auto& value = format_.parameters.get(i))
            all += fmt::format("{} {}\n", format_.parameters.schema()[i].name, text_of(*value));
    }
    return fingerprint(all);
}

CacheState recorded(const fs::path& picture, const std::string& inputs, Links links) {
    const auto record = record_text_of(picture);
    if (!record || !has_recorded_size(picture, *record, links)) return CacheState::missing;
    return record->starts_with(fmt::format("inputs {}\n", inputs)) ? CacheState::made : CacheState::other;
}

bool is_recorded(const fs::path& picture) {
    const auto record = record_text_of(picture);
    return record && has_recorded_size(picture, *record, Links::followed);
}

bool is_up_to_date(const fs::path& picture, const std::string& inputs, Links links) {
    // Other inputs, another size, or no record: there is no need to read the picture.
    if (recorded(picture, inputs, links) != CacheState::made) return false;
    const auto is = record_text(picture, inputs, links);
    return is && record_text_of(picture) == is;
}

void record(const fs::path& picture, const std::string& inputs, Links links) {
    const auto text = record_text(picture, inputs, links);
    if (!text) throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", picture.string()));
    const fs::path file = record_of(picture);
    make_owned_folder(folder_of(picture), file.parent_path().filename());
    // Fast is enough: after a crash, a damaged record does not match the picture, which is then rendered
    // again.
    write_owned_file(file, *text, candela::Durability::fast);
}
