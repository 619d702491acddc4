#include "robustness/fuzz/fuzz.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "console/diagnostics_text.h"

namespace fuzz {

namespace fs = std::filesystem;

void require(bool holds, std::string_view sentence) {
    if (holds) return;
    std::fprintf(stderr, "finding: %.*s\n", static_cast<int>(sentence.size()), sentence.data());
    std::abort();
}

std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

namespace {

/// A directory that is removed with the process, unless that crashes.
class Scratch {
  public:
    Scratch() : path_(fs::temp_directory_path() / ("candela-fuzz-" + std::to_string(::getpid()))) {
        fs::create_directories(path_);
    }
    ~Scratch() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

}  // namespace

fs::path written(const std::string& name, std::string_view content) {
    static const Scratch scratch;
    const fs::path file = scratch.path() / name;
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out << content;
    require(static_cast<bool>(out.flush()), "cannot write the input to a file");
    return file;
}

namespace {

/// Whether a terminal would only display it, unchanged.
bool is_harmless(std::string_view text) {
    return candela::printable(text, candela::LineBreaks::kept) == text;
}

void check_place(const candela::Diagnostics& diagnostics, const candela::SourceLocation& place) {
    require(place.line >= 0 && place.column >= 0 && place.length >= 0, "a place is negative");
    if (place.line == 0 || !diagnostics.source_line({place.file, 1, 1, 0})) return;
    const auto line = diagnostics.source_line(place);
    require(line.has_value(), "a place is beyond the last line");
    require(place.column >= 1, "a place in a line has no column");
    require(static_cast<std::size_t>(place.column) <= line->size() + 1, "a place is beyond its line");
}

void check_finite(candela::Vec3 v) {
    require(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z),
            "a vector of a valid scene is not finite");
}

void check_finite(const candela::Model& model) {
    for (std::size_t i = 0; i < model.parameters.schema().size(); ++i) {
        const auto& value = model.parameters.get(i);
        require(value.has_value(), "a parameter of a valid scene has no value");
        if (const auto* number = std::get_if<double>(&*value)) {
            require(std::isfinite(static_cast<float>(*number)), "a number of a valid scene is not finite");
        } else if (const auto* vector = std::get_if<candela::Vec3>(&*value)) {
            check_finite(*vector);
        }
    }
}

}  // namespace

void check_diagnostics(const candela::Diagnostics& diagnostics, bool returned_something) {
    require(returned_something != diagnostics.has_errors(), "a scene with errors, or none without");
    const auto all = diagnostics.sorted();
    const bool some_error = std::ranges::any_of(
        all, [](const candela::Diagnostic& d) { return d.severity == candela::Severity::error; });
    require(some_error == diagnostics.has_errors(),
            "an exit code without an error, or an error without an exit code");
    for (const candela::Diagnostic& d : all) {
        require(!d.message.empty(), "a diagnostic is empty");
        check_place(diagnostics, d.place);
    }
    require(is_harmless(diagnostics_text(diagnostics, false)),
            "a diagnostic contains terminal control characters");
    static_cast<void>(diagnostics_text(diagnostics, true, all.size()));
    require(is_json(diagnostics_json(diagnostics)), "the diagnostics' JSON is invalid");
}

void check_finite(const candela::Scene& scene) {
    check_finite(candela::Vec3{scene.room.height, scene.room.width, scene.room.depth});
    check_finite(scene.observer.position);
    check_finite(scene.observer.look_at);
    check_finite(scene.observer.up);
    check_finite(candela::Vec3{scene.observer.fov, scene.observer.height, 0});
    check_finite(scene.image.background);
    require(scene.image.width > 0 && scene.image.height > 0, "a valid picture has no pixels");
    for (const candela::LightSource& light : scene.lights) check_finite(light.model);
    for (const candela::Object& object : scene.objects) {
        check_finite(object.transform.position);
        check_finite(object.transform.rotation);
        check_finite(object.transform.scale);
        check_finite(object.color);
        check_finite(object.shape);
        check_finite(object.shading);
        check_finite(object.reflection);
    }
}

float Bytes::number() {
    constexpr float k_special[] = {0.0f,
                                   -0.0f,
                                   1.0f,
                                   -1.0f,
                                   1e-38f,
                                   1e-30f,
                                   1e18f,
                                   -1e19f,
                                   1e30f,
                                   std::numeric_limits<float>::max(),
                                   std::numeric_limits<float>::lowest(),
                                   std::numeric_limits<float>::denorm_min(),
                                   std::numeric_limits<float>::infinity(),
                                   -std::numeric_limits<float>::infinity(),
                                   std::numeric_limits<float>::quiet_NaN()};
    const std::uint32_t kind = take<std::uint8_t>();
    if (kind < std::size(k_special)) return k_special[kind];
    if (kind < 0xe0) return (static_cast<float>(kind) - 128.0f) / 16.0f;
    return take<float>();
}

}  // namespace fuzz
