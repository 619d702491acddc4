// What must hold of image formats.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernel_program.h"
#include "subject.h"

namespace fs = std::filesystem;
using candela::FileFormat;
using candela::ImageFormat;
using candela::PixelType;

namespace {

/// A picture whose channels differ: red grows to the right, green downwards, as gently as lossy formats want
/// it.
struct Picture {
    int width, height;
    std::vector<float> reals;
    std::vector<std::uint8_t> bytes;

    Picture(int w, int h) : width(w), height(h) {
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                const float across = w > 1 ? static_cast<float>(x) / static_cast<float>(w - 1) : 1.0f;
                const float down = h > 16 ? static_cast<float>(y) / static_cast<float>(h - 1) : 0.5f;
                for (const float value : {across, down, 0.25f}) {
                    reals.push_back(value);
                    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
                }
            }
        }
    }

    candela::PictureView view(PixelType pixels) const {
        candela::PictureView result{
            .width = width, .height = height, .pixels = pixels, .encoding = candela::ColorEncoding::srgb};
        if (pixels == PixelType::byte) {
            result.bytes = bytes;
        } else {
            result.reals = reals;
        }
        return result;
    }
    std::string size() const { return fmt::format("{} x {}", width, height); }
};

class Memory final : public candela::ByteSink {
  public:
    void write(std::span<const std::byte> written) override {
        bytes.insert(bytes.end(), written.begin(), written.end());
    }
    std::vector<std::byte> bytes;
};

/// A disk that is full after some bytes.
class FullDisk final : public candela::ByteSink {
  public:
    explicit FullDisk(std::size_t room) : room_(room) {}
    void write(std::span<const std::byte> written) override {
        if (written.size() > room_) throw std::runtime_error("the disk is full");
        room_ -= written.size();
    }

  private:
    std::size_t room_;
};

class ReadBack final : public candela::PictureSink {
  public:
    std::span<float> allocate(int w, int h, bool) override {
        width = w;
        height = h;
        values.assign(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h), -1);
        return values;
    }
    int width = 0, height = 0;
    std::vector<float> values;
};

/// Where a format is read: an installed plugin that is another one, or else this one; null where none reads
/// it.
std::shared_ptr<ImageFormat> reader_of(const FileFormat& format, const std::shared_ptr<ImageFormat>& writer) {
    static candela::Registry registry(candela::plugin_search_path({}));
    const candela::PluginFile* const other = registry.find_format(format.extension, candela::FormatUse::read);
    const std::string own = subject_manifest().name;
    if (other != nullptr && other->manifest.name != own) {
        const std::string& name = other->manifest.name;
        return registry.create<ImageFormat>(name, registry.parameters(candela::PluginKind::image, name),
                                            candela::ColorEncoding::srgb);
    }
    return format.reads ? writer : nullptr;
}

/// What comes back must be that on average: some formats are lossy, some round as floats.
constexpr double k_mean_difference = 0.06;

}  // namespace

TEST_CASE("round trip: what it writes is read as the same picture, of any size", "[image]") {
    const std::shared_ptr<ImageFormat> writer = make<ImageFormat>(default_values());
    const TemporaryDirectory directory;
    int compared = 0;
    for (const FileFormat& format : subject().formats) {
        const auto reader = reader_of(format, writer);
        if (reader == nullptr) continue;
        for (const Picture& picture : {Picture(1, 1), Picture(7, 5), Picture(64, 64), Picture(1000, 3)}) {
            Memory memory;
            writer->write(picture.view(format.pixels), format.extension, memory);
            const fs::path file = directory.path() / (std::string("picture.") + format.extension);
            std::ofstream(file, std::ios::binary)
                .write(reinterpret_cast<const char*>(memory.bytes.data()),
                       static_cast<std::streamsize>(memory.bytes.size()));
            ReadBack back;
            try {
                reader->read(file.c_str(), back);
            } catch (const std::exception& problem) {
                FAIL("a ." << format.extension << " of " << picture.size()
                           << " cannot be read: " << problem.what());
            }
            if (back.width != picture.width || back.height != picture.height)
                FAIL("a ." << format.extension << " of " << picture.size() << " comes back as " << back.width
                           << " x " << back.height);
            for (std::size_t c = 0; c < 3; ++c) {
                double difference = 0;
                for (std::size_t i = c; i < picture.reals.size(); i += 3)
                    difference +=
                        std::abs(static_cast<double>(picture.reals[i]) - static_cast<double>(back.values[i]));
                difference /= static_cast<double>(picture.reals.size()) / 3;
                if (!(difference <= k_mean_difference))
                    FAIL("the " << (c == 0   ? "red"
                                    : c == 1 ? "green"
                                             : "blue")
                                << " of a ." << format.extension << " of " << picture.size()
                                << " comes back different by " << difference << " on average");
            }
            ++compared;
        }
    }
    if (compared == 0) SKIP("no installed plugin reads its formats");
}

TEST_CASE("failing writes: where its bytes cannot be stored it says so", "[image]") {
    const auto writer = make<ImageFormat>(default_values());
    const Picture picture(64, 48);
    for (const FileFormat& format : subject().formats) {
        Memory whole;
        writer->write(picture.view(format.pixels), format.extension, whole);
        for (const std::size_t room : {std::size_t{0}, whole.bytes.size() / 2, whole.bytes.size() - 1}) {
            FullDisk disk(room);
            bool says_so = false;
            try {
                writer->write(picture.view(format.pixels), format.extension, disk);
            } catch (const std::exception&) {
                says_so = true;
            }
            if (!says_so)
                FAIL("after " << room << " of " << whole.bytes.size() << " bytes of a ." << format.extension
                              << " the disk is full, and it reports nothing");
        }
    }
}

TEST_CASE("files of its own: it leaves none where it runs", "[image]") {
    const TemporaryDirectory directory;
    fs::current_path(directory.path());
    const auto writer = make<ImageFormat>(default_values());
    for (const FileFormat& format : subject().formats) {
        Memory memory;
        writer->write(Picture(8, 8).view(format.pixels), format.extension, memory);
    }
    std::string left;
    for (const auto& entry : fs::directory_iterator(directory.path()))
        left += " " + entry.path().filename().string();
    fs::current_path("/");
    if (!left.empty()) FAIL("writing pictures left in the working directory:" << left);
}
