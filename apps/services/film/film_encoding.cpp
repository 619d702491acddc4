#include "film/film_encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

#include "files/output_folder.h"
#include "film/frame_pattern.h"
#include "process/process.h"
#include "sandbox/temporary_folder.h"

import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// How ffmpeg encodes one kind of film.
struct Encoding {
    std::string_view extension;
    std::vector<std::string> options;
};

/// Most players show H.264 only with chroma at half the size, which needs an even width and height.
const std::vector<Encoding>& encodings() {
    static const std::string k_even = "pad=ceil(iw/2)*2:ceil(ih/2)*2";
    static const std::vector<Encoding> k_all = {
        {".mp4",
         {"-vf", k_even, "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "16", "-movflags", "+faststart"}},
        {".webm",
         {"-vf", k_even, "-c:v", "libvpx-vp9", "-pix_fmt", "yuv420p", "-crf", "24", "-b:v", "0", "-row-mt",
          "1"}},
        // The 256 colours that suit this film best.
        {".gif", {"-vf", "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse", "-loop", "0"}},
    };
    return k_all;
}

const Encoding* encoding_of(const fs::path& film) {
    std::string extension = film.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto found = std::ranges::find(encodings(), extension, &Encoding::extension);
    return found != encodings().end() ? &*found : nullptr;
}

}  // namespace

bool is_film(const fs::path& file) { return encoding_of(file) != nullptr; }

void require_encoder(const fs::path& film) {
    if (candela::program_called("ffmpeg")) return;
    throw Error(ErrorCategory::failure,
                fmt::format("'{}' needs ffmpeg, which is not installed (Debian, Ubuntu: apt install ffmpeg); "
                            "-o frames/%04d.png writes the frames without it",
                            film.string()));
}

void encode(const std::vector<fs::path>& images, double frames_per_second, const fs::path& film) {
    const Encoding* const encoding = encoding_of(film);
    if (encoding == nullptr || images.empty())
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' cannot be written as a film", film.string()));
    OutputFolder output(folder_of(film));
    // ffmpeg counts files without gaps.
    const fs::path links = output.draft() / "frames";
    std::error_code problem;
    fs::create_directory(links, problem);
    const std::string extension = images.front().extension().string();
    for (std::size_t i = 0; i < images.size() && !problem; ++i)
        fs::create_symlink(fs::absolute(images[i]), links / fmt::format("{:08}{}", i, extension), problem);
    if (problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be written: {}", film.string(), problem.message()));
    }
    std::vector<std::string> words = {
        "ffmpeg",     "-hide_banner",
        "-loglevel",  "error",
        "-nostdin",   "-y",
        "-framerate", fmt::format("{}", frames_per_second),
        "-i",         escaped_for_pattern(links.string()) + "/%08d" + extension};
    words.insert(words.end(), encoding->options.begin(), encoding->options.end());
    // Keeps the film reproducible: no trace of the machine or the time.
    words.insert(words.end(), {"-fflags", "+bitexact", "-flags:v", "+bitexact"});
    words.push_back((output.draft() / film.filename()).string());
    const candela::ProgramOutput done = candela::run_program(words);
    fs::remove_all(links, problem);
    if (done.exit_code != 0) {
        throw Error(ErrorCategory::failure,
                    fmt::format("ffmpeg could not make '{}':\n{}", film.string(), done.err));
    }
    output.finish();
}
