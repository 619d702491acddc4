// candela assemble: puts the parts of a picture together.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/output_format.h"
#include "console/reporting.h"
#include "console/stopwatch.h"
#include "console/terminal.h"
#include "film/render_cache.h"
#include "jobs/image_parts.h"

import candela.api;
import candela.render;
import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;
using candela::Links;

namespace {

/// The rows of all parts, part after part.
class PartRows final : public candela::ImageRows {
  public:
    PartRows(const fs::path& image, const PartedImage& parted, ProgressBar& bar)
        : image_(image), parted_(parted), bar_(bar) {}

    candela::ImageView next(int count) override {
        const bool is_byte = parted_.whole.pixels == candela::PixelType::byte;
        candela::ImageView rows = parted_.whole;
        rows.height = std::min(count, parted_.whole.height - done_);
        const std::size_t size = parted_.row_size() * static_cast<std::size_t>(rows.height);
        if (is_byte) {
            bytes_.resize(size);
            read({reinterpret_cast<char*>(bytes_.data()), size});  // NOLINT: bytes are bytes
            rows.bytes = bytes_;
        } else {
            reals_.resize(size / sizeof(float));
            read({reinterpret_cast<char*>(reals_.data()), size});  // NOLINT: written the same way
            rows.reals = reals_;
        }
        done_ += rows.height;
        bar_.update(static_cast<std::size_t>(done_), static_cast<std::size_t>(parted_.whole.height));
        return rows;
    }

  private:
    void read(std::span<char> to) {
        while (!to.empty()) {
            if (left_ == 0) open_next();
            const std::size_t some = std::min(to.size(), left_);
            if (file_->read(to.first(some)) != some) fail();
            left_ -= some;
            to = to.subspan(some);
        }
    }

    void open_next() {
        const PartNumber part{++number_, parted_.parts};
        const fs::path file = file_of_part(image_, part);
        if (!is_up_to_date(file, parted_.inputs_of_parts(), Links::not_followed)) {
            throw Error(
                ErrorCategory::failure,
                fmt::format("'{}' has changed since it was rendered; render it again with --part {}/{}",
                            file.string(), part.number, part.of));
        }
        file_.emplace(file, Links::not_followed);
        if (!file_->is_open()) fail();
        const candela::RowRange rows = rows_of(part, parted_.whole.height);
        left_ = parted_.row_size() * static_cast<std::size_t>(rows.end - rows.first);
    }

    [[noreturn]] void fail() const {
        throw Error(
            ErrorCategory::failure,
            fmt::format("'{}' cannot be read", file_of_part(image_, {number_, parted_.parts}).string()));
    }

    const fs::path& image_;
    const PartedImage& parted_;
    ProgressBar& bar_;
    std::optional<candela::RegularFile> file_;
    int number_ = 0, done_ = 0;
    std::size_t left_ = 0;  // of the open part, in bytes
    std::vector<std::uint8_t> bytes_;
    std::vector<float> reals_;
};

/// Rising numbers as ranges: "1, 4-6".
std::string ranges_of(const std::vector<int>& numbers) {
    std::vector<std::string> ranges;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t end = i + 1;
        while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
        ranges.push_back(end > i + 1 ? fmt::format("{}-{}", numbers[i], numbers[end - 1])
                                     : fmt::format("{}", numbers[i]));
        i = end;
    }
    return fmt::format("{}", fmt::join(ranges, ", "));
}

void require_all_parts(const fs::path& image, const PartedImage& parted) {
    std::vector<int> missing, other;
    for (int i = 1; i <= parted.parts; ++i) {
        const CacheState is =
            recorded(file_of_part(image, {i, parted.parts}), parted.inputs_of_parts(), Links::not_followed);
        if (is == CacheState::missing) missing.push_back(i);
        if (is == CacheState::other) other.push_back(i);
    }
    if (missing.empty() && other.empty()) return;
    std::string problem;
    if (!missing.empty()) problem = fmt::format("missing: {}", ranges_of(missing));
    if (!other.empty())
        problem += fmt::format("{}made from other inputs than the part rendered last: {}",
                               problem.empty() ? "" : "; ", ranges_of(other));
    throw Error(ErrorCategory::failure,
                fmt::format("'{}' is incomplete ({} parts); {}", image.string(), parted.parts, problem));
}

int assemble(const CommandLine& line) {
    if (!line.has("picture"))
        throw Error(ErrorCategory::bad_request,
                    "candela assemble needs the picture's name, the same as for candela render --part");
    const Stopwatch total;
    const fs::path image = line.all("picture").front();
    std::error_code problem;
    if (!fs::exists(folder_of_parts(image), problem) && is_recorded(image)) {
        say(fmt::format("{} is already complete; it has no parts left\n", image.string()));
        return 0;
    }
    candela::Registry registry = registry_from(line);
    const candela::OutputFormat format = output_format_from(line, image, registry);
    const PartedImage parted = read_description(image);
    if (format.pixels != parted.whole.pixels)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("the parts of '{}' and the format differ in pixel type", image.string()));
    require_all_parts(image, parted);
    try {
        ProgressBar bar("assembling", !is_quiet());
        PartRows rows(image, parted, bar);
        candela::with_threads(threads_from(line),
                              [&] { candela::write_rows(parted.whole, rows, format, image, registry); });
        record(image, parted.inputs, Links::followed);
    } catch (const Error&) {
        // Another process has assembled it and removed the parts.
        if (recorded(image, parted.inputs, Links::followed) != CacheState::made) throw;
    }
    if (!line.has("keep-parts")) fs::remove_all(folder_of_parts(image), problem);
    say_afterwards([&] {
        return fmt::format("{}: {} x {}, of {} part{}, {}\n", image.string(), parted.whole.width,
                           parted.whole.height, parted.parts, parted.parts == 1 ? "" : "s",
                           duration_text(total.milliseconds()));
    });
    return 0;
}

}  // namespace

int run_assemble(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela assemble PICTURE [options]",
        "Put together the parts of a picture made by candela render --part, and remove them. Report missing "
        "parts. The picture is byte-identical to one rendered in one go. PICTURE is the name given to -o.");
    line.positional("picture", 1);
    line.options()("keep-parts", "do not remove the parts")("threads", po::value<int>()->value_name("N"),
                                                            "threads to use; default: all cores");
    add_format_option(line);
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;
    return assemble(line);
}
