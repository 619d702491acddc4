// candela diff: compares its figures with differences computed by hand.
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;
using Catch::Approx;

namespace {

using Json = nlohmann::json;
using Numbers = std::vector<int>;

std::string bytes(const Numbers& numbers) {
    std::string result;
    for (const int number : numbers) result.push_back(static_cast<char>(number));
    return result;
}

/// A picture of red, green, blue, row by row from the top.
std::string ppm(int width, int height, const Numbers& numbers) {
    return "P6\n" + std::to_string(width) + ' ' + std::to_string(height) + "\n255\n" + bytes(numbers);
}

/// One colour everywhere.
std::string plain(int width, int height, int level) {
    return ppm(width, height, Numbers(static_cast<std::size_t>(3 * width * height), level));
}

/// Rows from the bottom, as in the format.
std::string pfm(int width, int height, const std::vector<float>& numbers) {
    return "PF\n" + std::to_string(width) + ' ' + std::to_string(height) + "\n-1.0\n" +
           std::string(reinterpret_cast<const char*>(numbers.data()), sizeof(float) * numbers.size());
}

/// Blue, green, red, alpha, row by row from the top.
std::string tga(int width, int height, const Numbers& numbers) {
    return bytes({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, width, 0, height, 0, 32, 0x28}) + bytes(numbers);
}

class Images : public Folder {
  public:
    CommandResult diff(const std::vector<std::string>& arguments) const { return run("diff", arguments); }

    Json figures(std::vector<std::string> arguments) const {
        arguments.emplace_back("--json");
        const CommandResult result = succeeded(diff(std::move(arguments)));
        CHECK(result.err.empty());
        return Json::parse(result.out);
    }

    /// The only line on stderr; nothing else is printed.
    std::string error(std::vector<std::string> arguments, int exit_code) const {
        const CommandResult result = expect(diff(std::move(arguments)), exit_code);
        CHECK(result.out.empty());
        CHECK(result.err.starts_with("candela: error: "));
        CHECK(result.err.find('\n') == result.err.size() - 1);
        return result.err;
    }
};

/// Three pixels that differ by nothing, by 3 and 4 levels, and by 12.
Images folder_with_images() {
    Images folder;
    folder.write("a.ppm", ppm(3, 1, {10, 20, 30, 100, 100, 100, 255, 0, 0}));
    folder.write("b.ppm", ppm(3, 1, {10, 20, 30, 103, 100, 96, 255, 0, 12}));
    folder.write("mask.ppm", ppm(3, 1, {0, 0, 0, 127, 127, 127, 128, 128, 128}));
    return folder;
}

/// The pixels of a binary PPM.
std::string pixels_of(const std::string& image, const std::string& header) {
    REQUIRE(image.starts_with(header));
    return image.substr(header.size());
}

int brightness(const std::string& pixels, std::size_t pixel) {
    int sum = 0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) sum += static_cast<unsigned char>(pixels.at(i));
    return sum;
}

}  // namespace

TEST_CASE("identical pictures differ by nothing, and have no finite PSNR") {
    const Images folder = folder_with_images();
    const CommandResult result = folder.diff({"a.ppm", "a.ppm", "--tolerance", "0"});
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    CHECK(result.out ==
          "size                3 x 1\n"
          "pixels compared     3\n"
          "identical           100 %\n"
          "maximum difference  0 levels\n"
          "mean difference     0 levels\n"
          "RMSE                0 levels\n"
          "PSNR                infinite\n"
          "perceptible         0 pixels, 0 %\n");
    const Json figures = folder.figures({"a.ppm", "a.ppm"});
    CHECK(figures["interior"]["identical"] == 3);
    CHECK(figures["interior"]["maximum"] == 0.0);
    CHECK(figures["interior"]["psnr"].is_null());
    CHECK(figures["edges"].is_null());
    CHECK(figures["perceptible"] == Json({{"pixels", 0}, {"share", 0.0}}));
}

TEST_CASE("the figures are those computed by hand") {
    const Images folder = folder_with_images();
    const Json figures = folder.figures({"a.ppm", "b.ppm"});
    CHECK(figures["width"] == 3);
    CHECK(figures["height"] == 1);
    const Json& interior = figures["interior"];
    CHECK(interior["pixels"] == 3);
    CHECK(interior["identical"] == 1);
    CHECK(interior["maximum"] == 12.0);
    CHECK(interior["at"] == Json({2, 0}));
    CHECK(interior["mean"].get<double>() == Approx(19.0 / 9));  // 3 + 4 + 12
    CHECK(interior["rmse"].get<double>() == Approx(13.0 / 3));  // of 9 + 16 + 144 = 13²
    CHECK(interior["psnr"].get<double>() == Approx(35.39436));  // 20 log10(255 / (13 / 3))
    CHECK(folder.figures({"b.ppm", "a.ppm"})["interior"] == interior);
}

TEST_CASE("they are aligned for people to read") {
    const Images folder = folder_with_images();
    const std::string text = folder.diff({"a.ppm", "b.ppm", "--mask", "mask.ppm"}).out;
    CHECK(
        text.starts_with("size                3 x 1\n"
                         "pixels compared     2\n"
                         "identical           50 %\n"
                         "maximum difference  4 levels, first at x 1, y 0\n"
                         "mean difference     1.16667 levels\n"
                         "RMSE                2.04124 levels\n"
                         "PSNR                41.93 dB\n"
                         "edges               1 pixels\n"
                         "  maximum           12 levels, first at x 2, y 0\n"
                         "  mean              4 levels\n"
                         "perceptible         "));
}

TEST_CASE("pixels under the mask's white (above a half) are counted separately") {
    const Images folder = folder_with_images();
    const Json figures = folder.figures({"a.ppm", "b.ppm", "--mask", "mask.ppm"});
    const Json& interior = figures["interior"];
    CHECK(interior["pixels"] == 2);
    CHECK(interior["identical"] == 1);
    CHECK(interior["maximum"] == 4.0);
    CHECK(interior["mean"].get<double>() == Approx(7.0 / 6));
    CHECK(interior["rmse"].get<double>() == Approx(std::sqrt(25.0 / 6)));
    const Json& edges = figures["edges"];
    CHECK(edges["pixels"] == 1);
    CHECK(edges["maximum"] == 12.0);
    CHECK(edges["mean"] == 4.0);

    // Red is not white; a mask that is white everywhere leaves nothing.
    folder.write("red.ppm", ppm(3, 1, {255, 0, 0, 255, 0, 0, 255, 0, 0}));
    CHECK(folder.figures({"a.ppm", "b.ppm", "--mask", "red.ppm"})["edges"]["pixels"] == 0);
    folder.write("white.ppm", plain(3, 1, 255));
    const Json nothing = folder.figures({"a.ppm", "b.ppm", "--mask", "white.ppm", "--tolerance", "0"});
    CHECK(nothing["interior"]["pixels"] == 0);
    CHECK(nothing["interior"]["maximum"] == 0.0);
    CHECK(nothing["interior"]["psnr"].is_null());
}

TEST_CASE("beyond the tolerance, which ignores edges, the exit code is 4 and the figures are printed") {
    const Images folder = folder_with_images();
    CHECK(folder.diff({"a.ppm", "b.ppm"}).exit_code == 0);
    CHECK(folder.diff({"a.ppm", "b.ppm", "--tolerance", "12"}).exit_code == 0);
    const CommandResult beyond = folder.diff({"a.ppm", "b.ppm", "--tolerance", "3.5"});
    CHECK(beyond.exit_code == 4);
    CHECK(holds(beyond.out, "maximum difference  12 levels"));
    CHECK(
        beyond.err ==
        "candela: error: 2 pixels differ by more than 3.5 levels; the largest difference is 12 levels, first "
        "at x 2, y 0\n");
    const std::vector<std::string> masked = {"a.ppm", "b.ppm", "--mask", "mask.ppm", "--tolerance"};
    const auto code = [&](const char* tolerance) {
        std::vector<std::string> words = masked;
        words.emplace_back(tolerance);
        return folder.diff(words).exit_code;
    };
    CHECK(code("4") == 0);
    CHECK(code("3") == 4);
}

TEST_CASE("a tolerance tolerates exactly that many levels, at any level") {
    const Images folder;
    Numbers before, after, deep;
    for (int level = 0; level + 7 < 256; ++level) {
        for (int c = 0; c < 3; ++c) {
            before.push_back(level);
            after.push_back(level + 7);
            deep.insert(deep.end(), {level, level});  // 257 * level, of 65535
        }
    }
    folder.write("a.ppm", ppm(249, 1, before));
    folder.write("b.ppm", ppm(249, 1, after));
    CHECK(folder.figures({"a.ppm", "b.ppm", "--tolerance", "7"})["interior"]["mean"] == 7.0);
    CHECK(folder.diff({"a.ppm", "b.ppm", "--tolerance", "6.999999"}).exit_code == 4);
    // OpenImageIO's reader of 16-bit PPMs may be off by 1 of 65535.
    folder.write("deep.ppm", "P6\n249 1\n65535\n" + bytes(deep));
    CHECK(folder.diff({"a.ppm", "deep.ppm", "--tolerance", "0.01"}).exit_code == 0);
}

TEST_CASE("alpha is ignored, and grey counts as equal red, green and blue") {
    const Images folder;
    folder.write("color.ppm", ppm(2, 1, {30, 20, 10, 60, 60, 60}));
    folder.write("alpha.tga", tga(2, 1, {10, 20, 30, 0, 60, 60, 60, 128}));
    CHECK(folder.figures({"color.ppm", "alpha.tga"})["interior"]["identical"] == 2);
    folder.write("color.ppm", ppm(2, 1, {30, 30, 30, 60, 60, 63}));
    folder.write("grey.pgm", "P5\n2 1\n255\n" + bytes({30, 60}));
    CHECK(folder.figures({"color.ppm", "grey.pgm"})["interior"]["mean"].get<double>() == Approx(3.0 / 6));
}

TEST_CASE("floats are compared unchanged, times 255, even beyond 1, below 0 and with whole numbers") {
    const Images folder;
    folder.write("a.pfm", pfm(1, 2, {0.5f, -1.0f, 8.0f, 0.0f, 0.0f, 0.0f}));
    folder.write("b.pfm", pfm(1, 2, {0.5f, -2.0f, 8.0f, 0.0f, 0.0f, 0.25f}));
    const Json interior = folder.figures({"a.pfm", "b.pfm"})["interior"];
    CHECK(interior["maximum"] == 255.0);
    CHECK(interior["at"] == Json({0, 1}));
    CHECK(interior["mean"].get<double>() == Approx(255 * 1.25 / 6));

    folder.write("whole.ppm", ppm(1, 1, {51, 102, 255}));
    folder.write("float.pfm", pfm(1, 1, {51 / 255.0f, 102 / 255.0f, 1.0f}));
    CHECK(folder.figures({"whole.ppm", "float.pfm"})["interior"]["identical"] == 1);

    folder.write("huge.pfm", pfm(1, 1, {3e38f, -3e38f, 0.0f}));
    folder.write("tiny.pfm", pfm(1, 1, {-3e38f, 3e38f, 0.0f}));
    const Json huge = folder.figures({"huge.pfm", "tiny.pfm", "-o", "heat.png"});
    CHECK(huge["interior"]["maximum"].get<double>() == Approx(255 * 6e38));
}

TEST_CASE("a non-finite number is an error that says where it is") {
    const Images folder;
    constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    folder.write("good.pfm", pfm(2, 2, std::vector<float>(12, 0.5f)));
    std::vector<float> numbers(12, 0.5f);
    numbers[4] = k_nan;  // the right of the lower row, green
    folder.write("nan.pfm", pfm(2, 2, numbers));
    CHECK(holds(folder.error({"good.pfm", "nan.pfm"}, 1), "'nan.pfm' contains NaN at x 1, y 1 (green)"));
    CHECK(holds(folder.error({"nan.pfm", "nan.pfm"}, 1), "contains NaN"));
    numbers[4] = 0;
    numbers[6] = -k_infinity;  // the left of the upper row, red
    folder.write("infinity.pfm", pfm(2, 2, numbers));
    CHECK(holds(folder.error({"infinity.pfm", "good.pfm", "-o", "heat.png"}, 1),
                "'infinity.pfm' contains infinity at x 0, y 0 (red)"));
    CHECK(holds(folder.error({"good.pfm", "good.pfm", "--mask", "nan.pfm"}, 1), "'nan.pfm' contains NaN"));
    CHECK_FALSE(fs::exists(folder / "heat.png"));
}

TEST_CASE("pictures of different sizes are an error that names both, and so is a mask of another size") {
    const Images folder;
    folder.write("a.ppm", plain(3, 2, 0));
    folder.write("b.ppm", plain(2, 3, 0));
    CHECK(holds(folder.error({"a.ppm", "b.ppm"}, 1), "'a.ppm' has 3 x 2 pixels, 'b.ppm' has 2 x 3"));
    CHECK(holds(folder.error({"a.ppm", "a.ppm", "--mask", "b.ppm"}, 1),
                "'a.ppm' has 3 x 2 pixels, 'b.ppm' has 2 x 3"));
}

TEST_CASE("a file that is not a picture is an error with a reason") {
    const Images folder = folder_with_images();
    CHECK(holds(folder.error({"a.ppm", "b.pmm"}, 1), "'b.pmm' does not exist; did you mean 'b.ppm'?"));
    CHECK(holds(folder.error({"none/a.ppm", "a.ppm"}, 1), "there is no folder 'none' either"));
    CHECK(holds(folder.error({".", "a.ppm"}, 1), "'.' is a directory; expected a picture file"));
    CHECK(holds(folder.error({"/dev/zero", "a.ppm"}, 1), "not a regular file"));
    folder.write("text.txt", "no picture\n");
    CHECK(holds(folder.error({"text.txt", "a.ppm"}, 1), "'text.txt' is not a picture: "));
    folder.write("text.png", "no picture\n");
    CHECK(holds(folder.error({"a.ppm", "text.png"}, 1), "'text.png' is not a picture: "));
    folder.write("empty.png", "");
    CHECK(holds(folder.error({"a.ppm", "empty.png"}, 1), "'empty.png' is not a picture: "));
    folder.write("short.ppm", plain(20, 20, 9).substr(0, 600));
    CHECK(holds(folder.error({"short.ppm", "a.ppm"}, 1), "'short.ppm' cannot be read: "));
    folder.write("huge.ppm", "P6\n2000000 2000000\n255\n");
    const std::string huge = folder.error({"huge.ppm", "a.ppm"}, 1);
    // The second message appears if OpenImageIO has a limit of its own, from 2.5 on.
    const bool has_limit = holds(huge, "2000000 x 2000000 pixels; expected 1 to 65536") ||
                           holds(huge, "'huge.ppm' is not a picture: pnm image resolution may not exceed");
    CHECK(has_limit);
    CHECK(holds(folder.error({"a.ppm", "a.ppm", "--mask", "text.png"}, 1), "'text.png' is not a picture"));
}

TEST_CASE("wrong usage of candela diff is an error with a suggestion") {
    const Images folder = folder_with_images();
    CHECK(holds(folder.error({}, 2), "needs two pictures"));
    CHECK(holds(folder.error({"a.ppm"}, 2), "needs two pictures"));
    CHECK(holds(folder.error({"a.ppm", "a.ppm", "a.ppm"}, 2), "too many arguments"));
    CHECK(holds(folder.error({"a.ppm", "a.ppm", "--tolerence", "3"}, 2), "did you mean '--tolerance'?"));
    for (const char* const wrong : {"-1", "nan", "inf", "many"})
        folder.error({"a.ppm", "a.ppm", "--tolerance", wrong}, 2);
    CHECK(holds(folder.error({"a.ppm", "a.ppm", "-o", "heat.pgn"}, 2), "did you mean '.png'?"));
    CHECK(holds(folder.error({"a.ppm", "a.ppm", "-o", "heat"}, 2), "has no file extension"));
    CHECK(holds(folder.diff({"--help"}).out, "Usage: candela diff A B [options]"));
}

TEST_CASE("candela diff never overwrites a picture or a mask that it reads") {
    const Images folder = folder_with_images();
    const std::string before = read_file(folder / "b.ppm"), mask = read_file(folder / "mask.ppm");
    for (const char* const flag : {"--output", "--decoded"}) {
        INFO(flag);
        CHECK(holds(folder.error({"a.ppm", "b.ppm", flag, "./b.ppm"}, 2),
                    "give " + std::string(flag) + " another name"));
        folder.error({"a.ppm", "b.ppm", "--mask", "mask.ppm", flag, "mask.ppm"}, 2);
    }
    CHECK(read_file(folder / "b.ppm") == before);
    CHECK(read_file(folder / "mask.ppm") == mask);
}

TEST_CASE("the heat-map is black where nothing differs, and brightest at the largest difference") {
    const Images folder;
    Numbers numbers(std::size_t{3} * 5 * 4, 40);
    folder.write("a.ppm", ppm(5, 4, numbers));
    numbers[3 * 7] = 60;       // x 2, y 1
    numbers[3 * 13 + 2] = 30;  // x 3, y 2
    folder.write("b.ppm", ppm(5, 4, numbers));
    REQUIRE(folder.diff({"a.ppm", "b.ppm", "-o", "heat.ppm"}).exit_code == 0);
    const std::string heat = pixels_of(read_file(folder / "heat.ppm"), "P6\n5 4\n255\n");
    REQUIRE(heat.size() == 60);
    for (std::size_t i = 0; i < 20; ++i) {
        INFO(i);
        if (i != 7 && i != 13) CHECK(brightness(heat, i) == 0);
    }
    CHECK(brightness(heat, 13) > 100);
    CHECK(brightness(heat, 7) > 600);
    CHECK(brightness(heat, 7) > brightness(heat, 13));

    // The same picture in every format.
    for (const char* const name : {"heat.png", "heat.bmp", "heat.tga"}) {
        INFO(name);
        CHECK(folder.diff({"a.ppm", "b.ppm", "-o", name}).exit_code == 0);
        CHECK(folder.figures({name, "heat.ppm"})["interior"]["identical"] == 20);
    }
    REQUIRE(folder.diff({"a.ppm", "a.ppm", "-o", "black.ppm"}).exit_code == 0);
    folder.write("zero.ppm", plain(5, 4, 0));
    CHECK((read_file(folder / "black.ppm") == read_file(folder / "zero.ppm")));
}

TEST_CASE("the heat-map is complete or not written") {
    const Images folder = folder_with_images();
    // It is also written beyond the tolerance, when it is needed most.
    CHECK(folder.diff({"a.ppm", "b.ppm", "-o", "heat.png", "--tolerance", "0"}).exit_code == 4);
    CHECK(folder.figures({"heat.png", "heat.png"})["width"] == 3);
    folder.write("kept.png", "old");
    folder.error({"a.ppm", "gone.ppm", "-o", "kept.png"}, 1);
    CHECK(read_file(folder / "kept.png") == "old");
    CHECK(holds(folder.error({"a.ppm", "b.ppm", "-o", "none/heat.png"}, 1), "there is no folder"));
    fs::create_directory(folder / "folder.png");
    CHECK(holds(folder.error({"a.ppm", "b.ppm", "-o", "folder.png"}, 1), "is a directory"));
    fs::create_symlink("/dev/full", folder / "full.png");
    CHECK(holds(folder.error({"a.ppm", "b.ppm", "-o", "full.png"}, 1), "No space left on device"));
    for (const auto& entry : fs::directory_iterator(folder / "."))
        CHECK_FALSE(entry.path().filename().string().starts_with(".candela"));
    expect(run_program({"sh", "-c",
                        std::string(CANDELA_TEST_COMMAND) + " diff " + (folder / "a.ppm").string() + " " +
                            (folder / "b.ppm").string() + " > /dev/full"}),
           1);
}

// On a uniform grey, the visible differences follow Ward Larson's threshold: at 47.4 cd/m² (between the
// levels 188 and 183) it is 3.03 cd/m², and these differ by 2.94; between 188 and 182 it is 3.02, and they
// differ by 3.51. At 19.9 cd/m² it is 1.67: 128 and 124 differ by 1.43, 128 and 123 by 1.78.
TEST_CASE("a difference of grey is visible from the eye's threshold on") {
    const Images folder;
    const auto seen = [&](int a, int b) {
        folder.write("a.ppm", plain(40, 30, a));
        folder.write("b.ppm", plain(40, 30, b));
        const Json perceptible = folder.figures({"a.ppm", "b.ppm"})["perceptible"];
        CHECK(perceptible["share"] == perceptible["pixels"].get<double>() / 1200);
        return perceptible["pixels"];
    };
    CHECK(seen(188, 183) == 0);
    CHECK(seen(188, 182) == 1200);
    CHECK(seen(128, 124) == 0);
    CHECK(seen(128, 123) == 1200);
    CHECK(seen(0, 255) == 1200);
}

TEST_CASE("a difference of colour alone is visible, and only in its place") {
    const Images folder;
    Numbers numbers(std::size_t{3} * 64 * 64, 128);
    folder.write("a.ppm", ppm(64, 64, numbers));
    numbers[3 * 1000 + 2] = 150;  // blue hardly adds light
    folder.write("b.ppm", ppm(64, 64, numbers));
    CHECK(folder.figures({"a.ppm", "b.ppm"})["perceptible"]["pixels"] == 1);
}

TEST_CASE("a texture hides a difference that is visible on a smooth surface") {
    const Images folder;
    const auto seen = [&](int low, int high) {
        Numbers before, after;
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) {
                const int level = (x / 4 + y / 4) % 2 == 0 ? low : high;
                before.insert(before.end(), 3, level);
                after.insert(after.end(), 3, level + 8);
            }
        }
        folder.write("a.ppm", ppm(256, 256, before));
        folder.write("b.ppm", ppm(256, 256, after));
        return folder.figures({"a.ppm", "b.ppm"})["perceptible"]["pixels"].get<int>();
    };
    CHECK(seen(128, 128) == 65536);
    CHECK(seen(60, 180) < 6554);
}
