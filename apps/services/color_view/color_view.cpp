#include "color_view/color_view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "programs/sibling_program.h"
#include "sandbox/temporary_folder.h"

import candela.api;
import candela.util;

using candela::Error;
using candela::ErrorCategory;
using candela::Film;

namespace {

std::vector<std::string> fields_of(std::string_view line) {
    std::vector<std::string> fields;
    for (;;) {
        const std::size_t end = line.find('\t');
        fields.emplace_back(line.substr(0, end));
        if (end == std::string_view::npos) return fields;
        line.remove_prefix(end + 1);
    }
}

}  // namespace

ColorView::ColorView(ViewName name) : name_(std::move(name)) {
    const char* const ocio = std::getenv("OCIO");  // NOLINT(concurrency-mt-unsafe): nothing sets it
    config_ = !name_.config.empty() ? name_.config : ocio != nullptr ? ocio : "";
    if (config_.empty())
        throw Error(ErrorCategory::bad_request,
                    "--view needs an OpenColorIO configuration; name its file with --color-config, or in the "
                    "environment variable OCIO");
    const auto program = sibling_program("candela-color-view", "the program that applies views",
                                         "package candela-openimageio");
    program_ = std::make_unique<candela::AnsweringProgram>(
        std::vector<std::string>{program.string(), name_.config, name_.display, name_.view});
}

std::string ColorView::text() const {
    return fmt::format("view {}\t{}\t{}", config_, name_.display, name_.view);
}

std::string ColorView::ask(const std::string& line) {
    constexpr std::chrono::minutes k_patience{10};
    const auto answer = program_->answer(line, k_patience);
    if (answer) return *answer;
    const std::string errors = program_->errors();
    throw Error(ErrorCategory::failure, fmt::format("candela-color-view ended{}{}",
                                                    errors.empty() ? "" : ": ", candela::printable(errors)));
}

void ColorView::require() {
    std::vector<std::string> answer = fields_of(ask(""));
    if (answer[0] == "ok") return;
    const std::string what = answer[0];
    answer.erase(answer.begin());
    if (what == "error") {
        const std::string config =
            name_.config.empty() ? std::string("OCIO") : fmt::format("--color-config '{}'", name_.config);
        throw Error(ErrorCategory::bad_request,
                    candela::printable(fmt::format("{}: {}", config, fmt::join(answer, " "))));
    }
    const std::string& name = what == "view" ? name_.view : name_.display;
    const std::string suggestion = candela::suggestion(name, answer);
    throw Error(ErrorCategory::bad_request,
                fmt::format("--{0}: unknown {0} '{1}'{2}{3}; possible: {4}", what, candela::printable(name),
                            suggestion.empty() ? "" : "; ", candela::printable(suggestion),
                            candela::printable(fmt::format("{}", fmt::join(answer, ", ")))));
}

Film ColorView::applied(const Film& intensity, float exposure) {
    const TemporaryFolder folder("candela-view.");
    const auto file = folder.path() / "pixels";
    const int width = intensity.width(), height = intensity.height();
    const std::span<const float> from = intensity.view().reals;
    const std::size_t numbers = 3 * static_cast<std::size_t>(width);
    std::vector<float> row(numbers);
    const auto size = static_cast<std::streamsize>(numbers * sizeof(float));
    const auto failed = [] {
        return Error(ErrorCategory::failure,
                     "the picture cannot be passed to candela-color-view: its temporary "
                     "file cannot be written or read");
    };
    {
        std::ofstream out(file, std::ios::binary);
        for (int y = 0; y < height; ++y) {
            const std::span<const float> values =
                from.subspan(static_cast<std::size_t>(y) * numbers, numbers);
            for (std::size_t i = 0; i < numbers; ++i) row[i] = exposure * values[i];
            out.write(reinterpret_cast<const char*>(row.data()), size);
        }
        if (!out.flush()) throw failed();
    }
    const std::vector<std::string> answer =
        fields_of(ask(fmt::format("{} {} {}", width, height, file.string())));
    if (answer[0] != "ok")
        throw Error(ErrorCategory::failure,
                    candela::printable(fmt::format("candela-color-view: {}", fmt::join(answer, " "))));
    Film film(width, height, candela::PixelType::byte, candela::ColorEncoding::none);
    std::ifstream in(file, std::ios::binary);
    std::array<std::vector<float>, 3> channel;
    for (std::vector<float>& plane : channel) plane.resize(static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        if (!in.read(reinterpret_cast<char*>(row.data()), size)) throw failed();
        for (std::size_t i = 0; i < numbers; ++i) channel[i % 3][i / 3] = row[i];
        film.store(0, y, width, 1, {channel[0].data(), channel[1].data(), channel[2].data()}, width);
    }
    return film;
}
