// Requirements for image formats.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "at_once.h"
#include "checks/sample_images.h"
#include "sandbox/temporary_folder.h"
#include "subject.h"

import candela.api;
import candela.plugins;

namespace fs = std::filesystem;
using candela::FileFormat;
using candela::ImageFormat;
using candela::PixelType;

namespace {

/// A disk that becomes full after some bytes.
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

/// Whether `write`, called with a disk that has room for so many bytes, throws.
bool reports_full_disk(std::size_t room, const std::function<void(candela::ByteSink&)>& write) {
    FullDisk disk(room);
    try {
        write(disk);
    } catch (const std::exception&) {
        return true;
    }
    return false;
}

class ReadBack final : public candela::ImageSink {
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

/// A plugin that reads the format: preferably another installed one, otherwise this one; null if none does.
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

/// The largest allowed mean difference of a round trip: some formats are lossy, some round as floats.
constexpr double k_mean_difference = 0.06;

/// The same limit for each run of so many numbers.
constexpr double k_local_difference = 0.2;
constexpr std::size_t k_stretch = 96;

/// The pixel at which a run begins that comes back different, or nothing.
std::optional<std::size_t> differing_stretch(const std::vector<float>& sent, const std::vector<float>& back) {
    for (std::size_t first = 0; first + k_stretch <= sent.size(); first += k_stretch) {
        double difference = 0;
        for (std::size_t i = first; i < first + k_stretch; ++i)
            difference += std::abs(double{sent[i]} - double{back[i]});
        if (!(difference <= k_local_difference * static_cast<double>(k_stretch))) return first / 3;
    }
    return std::nullopt;
}

/// Layers are for computing, so floats must come back unchanged, up to the precision of a half.
std::optional<std::size_t> first_difference(const std::vector<float>& sent, const std::vector<float>& back) {
    for (std::size_t i = 0; i < sent.size(); ++i) {
        if (!(std::abs(sent[i] - back[i]) <= 1e-3f)) return i;
    }
    return std::nullopt;
}

}  // namespace

TEST_CASE("round trip: what it writes reads back as the same picture, of any size", "[image]") {
    const std::shared_ptr<ImageFormat> writer = make<ImageFormat>(default_values());
    const TemporaryFolder folder("candela-image-");
    int compared = 0;
    for (const FileFormat& format : subject().formats) {
        const auto reader = reader_of(format, writer);
        if (reader == nullptr) continue;
        for (const Image& picture :
             {Image(1, 1), Image(7, 5), Image(64, 64), Image(1000, 3), Image::of_runs()}) {
            Memory memory;
            writer->write(picture.view(format.pixels), format.extension, memory);
            const fs::path file = folder.path() / (std::string("picture.") + format.extension);
            write_file(file, memory.bytes);
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
            if (const auto pixel = differing_stretch(picture.reals, back.values))
                FAIL("from pixel " << *pixel << " on, the pixels of a ." << format.extension << " of "
                                   << picture.size() << " come back different");
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

TEST_CASE("layers: the picture in a file of layers is its first three channels", "[image]") {
    const std::shared_ptr<ImageFormat> writer = make<ImageFormat>(default_values());
    const TemporaryFolder folder("candela-image-");
    bool has_any = false;
    for (const FileFormat& format : subject().formats) {
        if (!format.layers) continue;
        has_any = true;
        if (format.pixels != PixelType::real)
            FAIL("a ." << format.extension << " has layers, whose values are unbounded, but pixels of bytes");
        for (const Image& picture : {Image(1, 1), Image(7, 5), Image(64, 48)}) {
            const LayeredImage layers(picture);
            const auto write = [&](candela::ByteSink& sink) {
                writer->write_layers(picture.width, picture.height, layers.channels, format.extension, sink);
            };
            Memory memory, again;
            write(memory);
            write(again);
            if (memory.bytes != again.bytes)
                FAIL("a ." << format.extension << " in layers is a different file the second time");
            if (!reports_full_disk(memory.bytes.size() - 1, write))
                FAIL("a ." << format.extension
                           << " in layers runs out of disk space, but no error is reported");
            const auto reader = reader_of(format, writer);
            if (reader == nullptr) continue;
            const fs::path file = folder.path() / (std::string("layers.") + format.extension);
            write_file(file, memory.bytes);
            ReadBack back;
            reader->read(file.c_str(), back);
            if (back.width != picture.width || back.height != picture.height)
                FAIL("a ." << format.extension << " in layers of " << picture.size() << " comes back as "
                           << back.width << " x " << back.height);
            if (const auto value = first_difference(picture.reals, back.values))
                FAIL("a ." << format.extension << " in layers of " << picture.size() << ": channel "
                           << *value % 3 << " of pixel " << *value / 3 << " was " << picture.reals[*value]
                           << " and comes back as " << back.values[*value]);
        }
    }
    if (!has_any) SKIP("it writes no layers");
}

TEST_CASE("truncated: a truncated file is refused, not read as a picture", "[image]") {
    const std::shared_ptr<ImageFormat> format_plugin = make<ImageFormat>(default_values());
    const TemporaryFolder folder("candela-image-");
    bool reads_any = false;
    for (const FileFormat& format : subject().formats) {
        if (!format.reads) continue;
        reads_any = true;
        Memory memory;
        format_plugin->write(Image(64, 48).view(format.pixels), format.extension, memory);
        const std::size_t whole = memory.bytes.size();
        const fs::path file = folder.path() / (std::string("cut.") + format.extension);
        for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{5}, std::size_t{20},
                                         whole / 4, whole / 2, 3 * whole / 4, 9 * whole / 10}) {
            write_file(file, std::span(memory.bytes).first(std::min(length, whole)));
            bool is_refused = false;
            try {
                ReadBack back;
                format_plugin->read(file.c_str(), back);
            } catch (const std::exception&) {
                is_refused = true;
            }
            if (!is_refused)
                FAIL("a ." << format.extension << " that is truncated after " << length << " of " << whole
                           << " bytes is read as if it were whole");
        }
    }
    if (!reads_any) SKIP("it reads no files");
}

TEST_CASE("repeatable: the same picture yields the same file, again and from 4 threads at once", "[image]") {
    const auto writer = make<ImageFormat>(default_values());
    const TemporaryFolder folder("candela-image-");
    // A sanitizer slows a plugin down, and one plugin may have twenty formats: all of them share the time.
    constexpr int k_rounds = 5;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(8);
    const auto latest = [&] {
        return std::min(std::chrono::steady_clock::now() + std::chrono::seconds(1), end);
    };
    for (const FileFormat& format : subject().formats) {
        const auto written = [&](const Image& picture) {
            Memory memory;
            writer->write(picture.view(format.pixels), format.extension, memory);
            return memory.bytes;
        };
        const std::vector<Image> pictures{Image(64, 48), Image(31, 17), Image(100, 9), Image(5, 80)};
        std::vector<std::vector<std::byte>> first;
        for (const Image& picture : pictures) {
            first.push_back(written(picture));
            if (written(picture) != first.back())
                FAIL("a ." << format.extension << " of " << picture.size()
                           << " is a different file the second time");
        }
        if (!hold_at_once(pictures.size(), k_rounds, latest(),
                          [&](std::size_t t) { return written(pictures[t]) == first[t]; }))
            FAIL("a ." << format.extension << " is a different file while other threads write");
        if (!format.reads) continue;
        const fs::path file = folder.path() / format.extension;
        write_file(file, first.front());
        const auto read = [&] {
            ReadBack back;
            try {
                writer->read(file.c_str(), back);
            } catch (const std::exception&) {
                back.values.clear();
            }
            return back.values;
        };
        const std::vector<float> alone = read();
        if (!hold_at_once(pictures.size(), k_rounds, latest(), [&](std::size_t) { return read() == alone; }))
            FAIL("a ." << format.extension << " is a different picture while other threads read it");
    }
}

TEST_CASE("failing writes: it reports that its bytes cannot be stored", "[image]") {
    const auto writer = make<ImageFormat>(default_values());
    const Image picture(64, 48);
    for (const FileFormat& format : subject().formats) {
        Memory whole;
        writer->write(picture.view(format.pixels), format.extension, whole);
        for (const std::size_t room : {std::size_t{0}, whole.bytes.size() / 2, whole.bytes.size() - 1}) {
            if (!reports_full_disk(room, [&](candela::ByteSink& sink) {
                    writer->write(picture.view(format.pixels), format.extension, sink);
                }))
                FAIL("after " << room << " of " << whole.bytes.size() << " bytes of a ." << format.extension
                              << " the disk is full, but it reports nothing");
        }
    }
}

TEST_CASE("files of its own: it leaves none in the working directory", "[image]") {
    const TemporaryFolder folder("candela-image-");
    fs::current_path(folder.path());
    const auto writer = make<ImageFormat>(default_values());
    for (const FileFormat& format : subject().formats) {
        Memory memory;
        writer->write(Image(8, 8).view(format.pixels), format.extension, memory);
    }
    std::string left;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        left += " " + entry.path().filename().string();
    fs::current_path("/");
    if (!left.empty()) FAIL("writing pictures left in the working directory:" << left);
}
