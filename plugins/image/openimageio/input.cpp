#include "input.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

#include "candela/image_plugin.h"

using candela::sdk::require_plausible;

namespace openimageio {

namespace {

constexpr std::size_t k_head = 32;

std::string head_of(const char* path) {
    std::string head(k_head, '\0');
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error("it cannot be opened");
    in.read(head.data(), k_head);
    head.resize(static_cast<std::size_t>(in.gcount()));
    return head;
}

/// OpenImageIO's name of the format that a file's first bytes indicate. Otherwise OpenImageIO tries some
/// thirty formats.
std::string_view format_of(std::string_view head, const std::filesystem::path& path) {
    struct Beginning {
        std::string_view bytes, format;
    };
    constexpr std::array<Beginning, 9> k_beginnings = {{{"\x89PNG\r\n\x1a\n", "png"},
                                                        {"\xff\xd8\xff", "jpeg"},
                                                        {{"II*\0", 4}, "tiff"},
                                                        {{"MM\0*", 4}, "tiff"},
                                                        {{"II+\0", 4}, "tiff"},
                                                        {{"MM\0+", 4}, "tiff"},
                                                        {"v/1\x01", "openexr"},
                                                        {"#?", "hdr"},
                                                        {"BM", "bmp"}}};
    for (const Beginning& beginning : k_beginnings)
        if (head.starts_with(beginning.bytes)) return beginning.format;
    if (head.starts_with("RIFF") && head.substr(0, 12).ends_with("WEBP")) return "webp";
    if (head.size() > 2 && head[0] == 'P' &&
        std::string_view("123456Ff").find(head[1]) != std::string_view::npos)
        return "pnm";
    if (path.extension() == ".tga" || path.extension() == ".TGA")
        return "targa";  // has no distinctive beginning
    throw std::runtime_error("its content is not a picture of a known format");
}

/// Whether the end-of-image marker follows the last scan of a JPEG file; neither marker occurs within a scan.
/// If it is missing, libjpeg fills the picture with grey, and OpenImageIO does not pass on its warning.
bool is_whole_jpeg(const char* path) {
    std::ifstream in(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    const std::size_t scan = bytes.rfind("\xff\xda"), end = bytes.rfind("\xff\xd9");
    return scan != std::string::npos && end != std::string::npos && end > scan;
}

/// Whether a file that begins like a PNG ends before its last chunk, IEND. If libpng asks for bytes beyond
/// the end, OpenImageIO jumps out over the destructor of its error message.
bool is_cut_off_png(const char* path) {
    constexpr std::size_t k_signature = 8, k_around = 12;  // a chunk's length, type and checksum
    std::ifstream in(path, std::ios::binary);
    in.seekg(k_signature);
    std::array<char, 8> bytes{};
    const std::string_view text(bytes.data(), bytes.size());
    std::uintmax_t left = std::filesystem::file_size(path) - k_signature;
    while (left >= k_around && in.read(bytes.data(), bytes.size())) {
        std::uint32_t length = 0;
        for (const char byte : text.substr(0, 4)) length = length << 8 | static_cast<unsigned char>(byte);
        if (length > left - k_around) return true;
        if (text.substr(4) == "IEND") return false;
        left -= k_around + length;
        in.seekg(std::streamoff{length} + 4, std::ios::cur);
    }
    return true;
}

/// A little-endian number of `count` bytes.
std::uint32_t number_at(std::string_view head, std::size_t first, std::size_t count) {
    std::uint32_t number = 0;
    for (std::size_t k = count; k-- > 0;) number = number << 8 | static_cast<unsigned char>(head[first + k]);
    return number;
}

/// Whether the attributes of an OpenEXR file's headers end within the file. OpenEXR allocates what an
/// attribute declares before it reads it.
bool are_exr_headers_whole(const char* path) {
    constexpr std::uint32_t k_is_multipart = 0x1000;
    std::ifstream in(path, std::ios::binary);
    std::string magic_and_version(8, '\0'), name, type, length(4, '\0');
    in.read(magic_and_version.data(), 8);
    const bool is_multipart = (number_at(magic_and_version, 4, 4) & k_is_multipart) != 0;
    const auto file_size = static_cast<std::streamoff>(std::filesystem::file_size(path));
    for (bool is_first_of_header = true; std::getline(in, name, '\0'); is_first_of_header = name.empty()) {
        if (name.empty()) {
            if (is_first_of_header || !is_multipart) return true;
            continue;
        }
        if (!std::getline(in, type, '\0') || !in.read(length.data(), 4)) return false;
        const std::streamoff end = in.tellg() + std::streamoff{number_at(length, 0, 4)};
        if (end > file_size) return false;
        in.seekg(end);
    }
    return false;
}

/// The size of a WebP file, which OpenImageIO decodes as a whole when it opens it. Zero if the header is not
/// WebP's.
std::uintmax_t webp_pixels(std::string_view head) {
    if (head.size() < 30) return 0;
    const std::string_view chunk = head.substr(12, 4);
    std::uintmax_t width = 0, height = 0;
    if (chunk == "VP8X") {
        width = std::uintmax_t{1} + number_at(head, 24, 3);
        height = std::uintmax_t{1} + number_at(head, 27, 3);
    } else if (chunk == "VP8L") {
        const std::uint32_t bits = number_at(head, 21, 4);
        width = 1 + (bits & 0x3fff);
        height = 1 + (bits >> 14 & 0x3fff);
    } else if (chunk == "VP8 ") {
        width = number_at(head, 26, 2) & 0x3fff;
        height = number_at(head, 28, 2) & 0x3fff;
    }
    return width * height;
}

/// The size of a BMP file, whose compressed pixels OpenImageIO decodes when it opens it. Zero if the header
/// is that of OS/2, which has no compression.
std::uintmax_t bmp_pixels(std::string_view head) {
    constexpr char k_size_of_os2 = 12;
    if (head.size() < k_head || head[14] == k_size_of_os2) return 0;
    const auto magnitude_at = [&](std::size_t first) {
        // Rows from the top have a negative height.
        const std::int64_t value = static_cast<std::int32_t>(number_at(head, first, 4));
        return static_cast<std::uintmax_t>(value < 0 ? -value : value);
    };
    return magnitude_at(18) * magnitude_at(22);
}

/// Deflate expands one byte to at most 1032, each holding up to eight one-bit pixels; most formats expand
/// less.
constexpr std::uintmax_t k_most_pixels_per_byte = std::uintmax_t{1032} * 8;

/// For formats without a bound on compression, in which a picture of one colour takes a few bytes at any
/// size: decoding the pixels allowed for a small file takes little time.
void require_moderate(std::uintmax_t samples, std::uintmax_t file_size) {
    constexpr std::uintmax_t k_always = std::uintmax_t{1} << 22;
    if (samples > 4 * k_always) require_plausible(samples, file_size, 4 * k_most_pixels_per_byte);
}

void require_plausible_size(const OIIO::ImageInput& input, std::uintmax_t file_size) {
    constexpr std::array<std::string_view, 6> k_bounded = {"png", "bmp", "targa", "hdr", "jpeg", "pnm"};
    const OIIO::ImageSpec& spec = input.spec();
    if (std::ranges::find(k_bounded, input.format_name()) != k_bounded.end()) {
        require_plausible(spec.image_pixels(), file_size, k_most_pixels_per_byte);
        return;
    }
    const auto samples = [&](std::uintmax_t pixels) {
        return pixels * static_cast<std::uintmax_t>(std::max(spec.nchannels, 1));
    };
    require_moderate(samples(spec.image_pixels()), file_size);
    require_moderate(samples(spec.tile_pixels()),
                     file_size);  // read whole, however few of its pixels are used
}

}  // namespace

std::unique_ptr<OIIO::ImageInput> opened(const char* path) {
    const std::string head = head_of(path);
    const std::string format(format_of(head, path));
    const std::uintmax_t size = std::filesystem::file_size(path);
    if (format == "png" && is_cut_off_png(path)) throw std::runtime_error("it is cut off");
    if (format == "openexr" && !are_exr_headers_whole(path))
        throw std::runtime_error("its header declares more bytes than the file has");
    if (format == "webp") require_moderate(4 * webp_pixels(head), size);
    if (format == "bmp") require_plausible(bmp_pixels(head), size, k_most_pixels_per_byte);
    // The colours stay as in the file, however transparent the pixels.
    OIIO::ImageSpec wanted, found;
    wanted.attribute("oiio:UnassociatedAlpha", 1);
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    if (input == nullptr) throw std::runtime_error(OIIO::geterror());
    if (!input->open(path, found, wanted)) throw std::runtime_error(input->geterror());
    if (format == "jpeg" && !is_whole_jpeg(path)) throw std::runtime_error("it is cut off");
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.nchannels < 1) throw std::runtime_error("it has no channels");
    if (spec.deep) throw std::runtime_error("it has multiple values per pixel, which is not supported");
    require_plausible_size(*input, size);
    return input;
}

}  // namespace openimageio
