#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/decoded.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

constexpr int k_width = 75, k_height = 41;  // not a whole number of blocks

using Bytes = std::vector<unsigned char>;

/// Slowly changing colours with a little noise.
Bytes smooth_image(std::size_t channels) {
    std::minstd_rand random(5);
    Bytes pixels;
    for (int y = 0; y < k_height; ++y) {
        for (int x = 0; x < k_width; ++x) {
            for (std::size_t c = 0; c < channels; ++c) {
                const double angle = 0.05 * x * static_cast<double>(c + 1) + 0.07 * y;
                pixels.push_back(static_cast<unsigned char>(128 + 110 * std::sin(angle) +
                                                            static_cast<double>(random() % 8)));
            }
        }
    }
    return pixels;
}

std::string jpeg_of(const Bytes& pixels, TJPF format, TJSAMP subsampling, int flags = 0) {
    const tjhandle handle = tjInitCompress();
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    REQUIRE(tjCompress2(handle, pixels.data(), k_width, 0, k_height, format, &bytes, &size, subsampling, 90,
                        flags) == 0);
    std::string file(reinterpret_cast<const char*>(bytes), size);
    tjFree(bytes);
    tjDestroy(handle);
    return file;
}

class Memory final : public candela::ByteSink {
  public:
    void write(std::span<const std::byte> more) override {
        bytes.append(reinterpret_cast<const char*>(more.data()), more.size());
    }
    std::string bytes;
};

std::string written(const Bytes& pixels, int quality) {
    Memory memory;
    instance<candela::ImageFormat>("jpeg", {{"quality", candela::Value(quality)}})
        ->write({.width = k_width, .height = k_height, .bytes = pixels}, "jpg", memory);
    return memory.bytes;
}

double root_mean_square_difference(const Decoded& image, const Bytes& pixels) {
    double sum = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const double difference = 255 * static_cast<double>(image.values.at(i)) - pixels[i];
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(pixels.size()));
}

}  // namespace

TEST_CASE("a JPEG of any kind is read the same as by OpenImageIO") {
    const fs::path file = scratch_directory() / "kind.jpg";
    const auto check = [&](const char* kind, const std::string& content, float tolerance = 1e-6f) {
        INFO(kind);
        write_file(file, content);
        const Decoded ours = read_by("jpeg", file), theirs = read_by("openimageio", file);
        CHECK(ours.width == k_width);
        CHECK(ours.height == k_height);
        CHECK(ours.is_encoded);
        CHECK(std::ranges::equal(ours.values, theirs.values,
                                 [&](float a, float b) { return std::abs(a - b) <= tolerance; }));
    };
    const Bytes rgb = smooth_image(3), cmyk = smooth_image(4), grey = smooth_image(1);
    check("4:4:4", jpeg_of(rgb, TJPF_RGB, TJSAMP_444));
    check("4:2:2", jpeg_of(rgb, TJPF_RGB, TJSAMP_422));
    check("4:2:0", jpeg_of(rgb, TJPF_RGB, TJSAMP_420));
    check("progressive", jpeg_of(rgb, TJPF_RGB, TJSAMP_420, TJFLAG_PROGRESSIVE));
    check("grey", jpeg_of(grey, TJPF_GRAY, TJSAMP_GRAY));
    // OpenImageIO rounds the product of inks to eight bits.
    check("inks", jpeg_of(cmyk, TJPF_CMYK, TJSAMP_444), 0.6f / 255);
}

TEST_CASE("a JPEG of higher quality is larger and closer to its picture") {
    const Bytes pixels = smooth_image(3);
    const fs::path file = scratch_directory() / "written.jpg";
    double last_difference = 1e9;
    std::size_t last_size = 0;
    for (const int quality : {20, 60, 95}) {
        const std::string bytes = written(pixels, quality);
        write_file(file, bytes);
        const double difference = root_mean_square_difference(read_by("openimageio", file), pixels);
        CHECK(difference < last_difference);
        CHECK(bytes.size() > last_size);
        last_difference = difference;
        last_size = bytes.size();
    }
    CHECK(last_difference < 3);
    CHECK(written(pixels, 95) == written(pixels, 95));
}

TEST_CASE("a JPEG that is cut off anywhere is an error, and so is another file") {
    const fs::path file = scratch_directory() / "cut.jpg";
    for (const int flags : {0, TJFLAG_PROGRESSIVE}) {
        const std::string whole = jpeg_of(smooth_image(3), TJPF_RGB, TJSAMP_420, flags);
        write_file(file, whole);
        REQUIRE(problem_of("jpeg", file).empty());
        for (std::size_t size = 0; size < whole.size(); size += 7) {
            INFO(size);
            write_file(file, whole.substr(0, size));
            CHECK(problem_of("jpeg", file) == (size < 3 ? "it is not a JPEG file" : "it is cut off"));
        }
    }
    write_file(file, "\x89PNG\r\n\x1a\n");
    CHECK(holds(problem_of("jpeg", file), "PNG"));
    CHECK(problem_of("jpeg", scratch_directory() / "nowhere.jpg") == "it cannot be read");
}

TEST_CASE("a JPEG whose header declares more pixels than its bytes can hold is refused before it is read") {
    std::string content = jpeg_of(smooth_image(3), TJPF_RGB, TJSAMP_420);
    const std::size_t frame = content.find("\xff\xc0");  // its length, precision, height and width follow
    REQUIRE(frame != std::string::npos);
    content.replace(frame + 5, 4, "\xff\x00\xff\x00", 4);
    const fs::path file = scratch_directory() / "claimed.jpg";
    write_file(file, content);
    CHECK(holds(problem_of("jpeg", file), "too small for its pixels"));
}
