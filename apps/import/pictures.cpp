#include "import/pictures.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <optional>
#include <system_error>

import candela.color;
import candela.diagnostics;
import candela.formats;
import candela.text;

namespace fs = std::filesystem;

namespace importing {

namespace {

/// Bytes that can be read like a file while this exists.
class MemoryFile {
  public:
    explicit MemoryFile(const std::string& content) : descriptor_(::memfd_create("picture", MFD_CLOEXEC)) {
        if (descriptor_ < 0) fail();
        for (std::size_t at = 0; at < content.size();) {
            const ::ssize_t some = ::write(descriptor_, content.data() + at, content.size() - at);
            if (some < 0 && errno == EINTR) continue;
            if (some <= 0) {
                ::close(descriptor_);
                fail();
            }
            at += static_cast<std::size_t>(some);
        }
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { ::close(descriptor_); }

    fs::path path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

  private:
    [[noreturn]] static void fail() {
        throw candela::Error(candela::ErrorCategory::failure, std::generic_category().message(errno));
    }

    int descriptor_;
};

double brightness_of(const candela::DecodedPicture& picture) {
    // Every pixel of small pictures, some thousands of large ones.
    const std::size_t pixels = picture.values.size() / 3, step = std::max<std::size_t>(pixels / 65536, 1);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels; i += step, ++count) {
        const float* const p = &picture.values[3 * i];
        const float most = std::max({p[0], p[1], p[2]});
        const float linear =
            picture.is_encoded ? candela::srgb_to_linear(std::clamp(most, 0.0f, 1.0f)) : most;
        sum += std::isfinite(linear) ? std::clamp(double{linear}, 0.0, 1.0) : 0;
    }
    return count > 0 ? sum / static_cast<double>(count) : 1;
}

/// The reason without the file's name, which is another one to the user.
std::string reason_of(const candela::Error& problem, const fs::path& file) {
    std::string reason = problem.what();
    const std::string begin = fmt::format("'{}' cannot be read as a picture: ", file.string());
    return reason.starts_with(begin) ? reason.substr(begin.size()) : reason;
}

}  // namespace

InspectedPicture inspect(const Picture& picture, candela::Registry& registry) {
    std::optional<MemoryFile> memory;
    if (!picture.content.empty()) memory.emplace(picture.content);
    const fs::path file = memory ? memory->path() : picture.file;
    std::optional<candela::DecodedPicture> decoded;
    try {
        decoded = candela::read_by_plugin(file, registry, candela::ColorEncoding::srgb);
    } catch (const candela::Error& problem) {
        throw candela::Error(candela::ErrorCategory::failure, reason_of(problem, file));
    }
    const std::string_view format = candela::format_of_content(file);
    if (!decoded)
        throw candela::Error(candela::ErrorCategory::failure,
                             fmt::format("no image plugin reads its format{}{}",
                                         format.empty() ? "" : fmt::format(", {}", format),
                                         candela::possible_formats(registry, candela::FormatUse::read)));
    if (!decoded->is_encoded &&
        !std::ranges::all_of(decoded->values, [](float value) { return std::isfinite(value); }))
        throw candela::Error(candela::ErrorCategory::failure, "it has a pixel that is not finite");
    InspectedPicture result{.other_format = {}, .brightness = brightness_of(*decoded)};
    if (!format.empty() && !candela::are_one_format(format, candela::extension_of(picture.file)))
        result.other_format = format;
    return result;
}

}  // namespace importing
