// Calls a plugin from several threads at once, each with its own inputs. This program and the plugin are
// built with ThreadSanitizer, which reports data races and then makes the exit code non-zero.
// candela_add_plugin() builds it if CANDELA_SANITIZE is "thread".
//
//     candela_threads PLUGIN.so [PARAMETER=VALUE...]     besides, required parameters get values of its own
#include <candela/plugin_test.h>
#include <dlfcn.h>

#include <array>
#include <barrier>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace fs = std::filesystem;

using candela::ParamSetting;
using candela::ParamSpec;
using candela::ParamType;
using candela::PluginDescriptor;

namespace {

constexpr unsigned k_threads = 4;
constexpr int k_rounds = 25;
constexpr std::size_t k_points = 64;

const PluginDescriptor& descriptor_of(const fs::path& library) {
    void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) throw std::runtime_error(::dlerror());
    void* const symbol = ::dlsym(handle, "candela_plugin_descriptor");
    if (symbol == nullptr) throw std::runtime_error(library.string() + " is not a plugin");
    return *reinterpret_cast<const PluginDescriptor* (*)()>(symbol)();
}

/// As in a scene: true, 3, 0.5, or text.
ParamSetting setting_from(std::string_view name, const std::string& value) {
    if (value == "true" || value == "false") return {name, value == "true"};
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != '\0') return {name, value};
    if (value.find_first_not_of("+-0123456789") == std::string::npos)
        return {name, static_cast<std::int64_t>(number)};
    return {name, number};
}

/// A valid value for the parameter.
ParamSetting usual_setting(const ParamSpec& p) {
    const float least = std::max(p.minimum, -1e3f), most = std::min(p.maximum, 1e3f);
    const double number = least <= 1 && most >= 1 ? 1.0 : 0.5 * (static_cast<double>(least) + most);
    switch (p.type) {
        case ParamType::integer:
            return {p.name, static_cast<std::int64_t>(number)};
        case ParamType::boolean:
            return {p.name, true};
        case ParamType::choice:
            return {p.name, std::string(p.choices.front())};
        case ParamType::point:
            return {p.name, candela::Vec3{0.4f, 1.2f, -0.3f}};
        case ParamType::direction:
            return {p.name, candela::Vec3{0, -1, 0}};
        case ParamType::vector:
            return {p.name, candela::Vec3{1, 1, 1}};
        case ParamType::color:
            return {p.name, candela::Vec3{200, 150, 100}};
        case ParamType::matrix:
            return {p.name, candela::Matrix{1, 0, 0, 0, 1, 0, 0, 0, 1}};
        case ParamType::numbers:
            return {p.name, candela::NumberList{static_cast<float>(number)}};
        case ParamType::file:
            throw std::runtime_error("the plugin needs a file: CONFORMANCE_VALUES " + std::string(p.name) +
                                     "=/full/path");
        case ParamType::text:
            return {p.name, std::string("text")};
        default:
            return {p.name, number};
    }
}

std::vector<ParamSetting> settings_of(const PluginDescriptor& plugin, const std::vector<std::string>& given) {
    std::vector<ParamSetting> settings;
    for (const std::string& words : given) {
        const std::size_t at = words.find('=');
        if (at == std::string::npos) throw std::runtime_error("'" + words + "' is not PARAMETER=VALUE");
        settings.push_back(setting_from(std::string_view(words).substr(0, at), words.substr(at + 1)));
    }
    for (const ParamSpec& p : plugin.parameters) {
        bool is_given = !p.required;
        for (const ParamSetting& setting : settings) is_given = is_given || setting.name == p.name;
        if (!is_given) settings.push_back(usual_setting(p));
    }
    return settings;
}

struct Vectors {
    std::array<std::vector<float>, 3> axes;

    Vectors() {
        for (std::vector<float>& axis : axes) axis.resize(k_points);
    }
    candela::Vec3Span span() { return {axes[0].data(), axes[1].data(), axes[2].data()}; }
    candela::ConstVec3Span span() const { return {axes[0].data(), axes[1].data(), axes[2].data()}; }
};

/// The inputs and results of one thread.
struct Work {
    explicit Work(unsigned seed) : random(seed) {
        for (Vectors* const unit : {&normal, &observer, &tangent, &light}) fill(*unit);
        for (std::size_t i = 0; i < k_points; ++i) barycentric.span().set(i, {0.5f, 0.25f, 0.25f});
        for (Vectors* const any : {&position, &intensity}) {
            for (std::vector<float>& axis : any->axes) {
                for (float& x : axis) x = uniform();
            }
        }
    }

    float uniform() { return std::uniform_real_distribution<float>(0, 1)(random); }
    void fill(Vectors& vectors) {
        for (std::size_t i = 0; i < k_points; ++i) {
            const candela::Vec3 v{uniform() - 0.5f, uniform() + 0.1f, uniform() - 0.5f};
            vectors.span().set(i, normalized(v));
        }
    }
    candela::ConstVec2Span uv() const { return {position.axes[0].data(), position.axes[1].data()}; }

    std::mt19937 random;
    Vectors normal, observer, tangent, light, position, intensity, barycentric;
    std::array<Vectors, 3> results;
};

const Vectors& as_input(Vectors& vectors) { return vectors; }

void call(const candela::Light& light, Work& work) {
    const candela::ReceiverBatch receivers{.count = k_points,
                                           .position = as_input(work.position).span(),
                                           .normal = as_input(work.normal).span()};
    auto& [first, second, third] = work.results;
    for (int sample = 0; sample < light.sample_count(); ++sample)
        light.illuminate(sample, receivers,
                         {.to_light = first.span(), .diffuse = second.span(), .specular = third.span()});
    if (light.has_ambient()) light.illuminate_ambient(receivers, first.span());
}

class SameEverywhere final : public candela::Environment {
  public:
    void look(std::size_t count, const candela::ConstVec3Span&, const candela::Vec3Span& intensity) override {
        for (std::size_t i = 0; i < count; ++i) intensity.set(i, {1, 1, 1});
    }
    float max_intensity() const noexcept override { return 1; }
    void trace_exit(std::size_t count, const candela::ConstVec3Span& origin,
                    const candela::ConstVec3Span& direction, const candela::ExitBatch& exit) override {
        for (std::size_t i = 0; i < count; ++i) {
            exit.position.set(i, origin[i] + direction[i]);
            exit.normal.set(i, direction[i]);
            exit.distance[i] = 1;
        }
    }
};

void call(const candela::ReflectionModel& model, Work& work) {
    const candela::ConstVec3Span tangent = as_input(work.tangent).span();
    const candela::SurfaceBatch surface{.count = k_points,
                                        .normal = as_input(work.normal).span(),
                                        .to_observer = as_input(work.observer).span(),
                                        .tangent = model.needs_tangent() ? tangent : candela::ConstVec3Span{},
                                        .color = {0.8f, 0.5f, 0.2f},
                                        .position = as_input(work.position).span(),
                                        .uv = model.needs_uv() ? work.uv() : candela::ConstVec2Span{}};
    const candela::ReflectedBatch reflected{.ambient = work.results[0].span(),
                                            .diffuse = work.results[1].span(),
                                            .specular = work.results[2].span()};
    const candela::ConstVec3Span intensity = as_input(work.intensity).span();
    model.reflect(surface,
                  {.to_light = as_input(work.light).span(), .diffuse = intensity, .specular = intensity},
                  reflected);
    model.reflect_ambient(surface, intensity, reflected);
    if (!model.shows_environment()) {
        const candela::PunctualLight lamp{.position = {2, 3, 4}, .diffuse = {1, 1, 1}, .specular = {1, 1, 1}};
        const candela::PunctualLighting lighting{
            .observer = {0, 0, 5}, .ambient = {0.1f, 0.1f, 0.1f}, .lights = {&lamp, 1}};
        model.reflect_all_lights(surface, lighting, work.results[0].span());
    }
    if (model.shows_environment()) {
        SameEverywhere environment;
        model.show_environment(surface, environment, reflected);
    }
}

void call(const candela::ShadingModel& model, Work& work) {
    const candela::ShadingNeeds needs = model.needs();
    const candela::ConstVec3Span along = as_input(work.tangent).span(), across = as_input(work.light).span();
    candela::ShadingPointBatch points;
    points.count = k_points;
    if (needs.face_normal) points.face_normal = as_input(work.normal).span();
    if (needs.vertex_normal) points.vertex_normal = as_input(work.normal).span();
    if (needs.barycentric) points.barycentric = as_input(work.barycentric).span();
    if (needs.uv) points.uv = work.uv();
    if (needs.derivatives) points.dpdu = along, points.dpdv = across;
    const candela::ConstVec3Span place = as_input(work.position).span(),
                                 normal = as_input(work.normal).span();
    const candela::TriangleBatch triangle{.position = {place, along, across},
                                          .normal = {normal, normal, normal}};
    if (needs.triangle && model.shading_rate() != candela::ShadingRate::vertex) points.triangle = &triangle;
    model.normals(points, work.results[0].span());

    std::array<std::uint32_t, k_points> group{};
    std::array<std::uint32_t, 3 * (k_points / 3)> indices{};
    for (std::uint32_t i = 0; i < k_points; ++i) group[i] = i;
    for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    candela::MeshView mesh;
    mesh.vertex_count = mesh.group_count = k_points;
    mesh.position = as_input(work.position).span();
    mesh.indices = indices;
    mesh.face_normal = as_input(work.normal).span();
    mesh.smooth_group = group;
    model.vertex_normals(mesh, work.results[1].span());
}

void call(const candela::Shape& shape, Work&) {
    const candela::sdk::Triangles triangles(shape, {.uv = true, .derivatives = true});
}

class Bytes final : public candela::ByteSink {
  public:
    void write(std::span<const std::byte> bytes) override {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    const std::vector<std::byte>& all() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
};

class Picture final : public candela::PictureSink {
  public:
    std::span<float> allocate(int width, int height, bool) override {
        values_.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        return values_;
    }

  private:
    std::vector<float> values_;
};

Bytes written(const candela::ImageFormat& image, const candela::FileFormat& format, Work& work) {
    constexpr std::size_t k_side = 8;
    std::array<std::uint8_t, 3 * k_side * k_side> bytes{};
    std::array<float, 3 * k_side * k_side> reals{};
    for (std::size_t i = 0; i < reals.size(); ++i) {
        reals[i] = work.uniform();
        bytes[i] = static_cast<std::uint8_t>(255 * reals[i]);
    }
    candela::PictureView picture{.width = k_side, .height = k_side, .pixels = format.pixels};
    if (format.pixels == candela::PixelType::byte) {
        picture.bytes = bytes;
    } else {
        picture.reals = reals;
    }
    Bytes sink;
    image.write(picture, format.extension, sink);
    return sink;
}

/// Files of an image format, including one that all threads read.
class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "candela-threads-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw fs::filesystem_error(name, std::error_code(errno, std::generic_category()));
        path_ = name;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

void call(const candela::ImageFormat& image, const PluginDescriptor& plugin, const fs::path& folder,
          Work& work) {
    for (const candela::FileFormat& format : plugin.formats) {
        written(image, format, work);
        if (!format.reads) continue;
        Picture picture;
        image.read((folder / format.extension).c_str(), picture);
    }
}

/// Runs `use` in all threads at once.
void run(const std::function<void(Work&)>& use) {
    std::barrier all_are_here(k_threads);
    std::vector<std::exception_ptr> problems(k_threads);
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < k_threads; ++t) {
        threads.emplace_back([&, t] {
            Work work(t);
            all_are_here.arrive_and_wait();
            try {
                for (int round = 0; round < k_rounds; ++round) use(work);
            } catch (...) {
                problems[t] = std::current_exception();
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::exception_ptr& problem : problems) {
        if (problem != nullptr) std::rethrow_exception(problem);
    }
}

void test(const fs::path& library, const std::vector<std::string>& given) {
    const PluginDescriptor& plugin = descriptor_of(library);
    const std::vector<ParamSetting> settings = settings_of(plugin, given);
    const std::string directory = fs::absolute(library).parent_path().string();
    const std::unique_ptr<candela::Instance> instance =
        candela::make_instance(directory, plugin.kind, plugin.name, settings);
    const Folder folder;
    if (const auto* const image = dynamic_cast<const candela::ImageFormat*>(instance.get())) {
        Work work(0);
        for (const candela::FileFormat& format : plugin.formats) {
            const Bytes bytes = written(*image, format, work);
            std::ofstream(folder.path() / format.extension, std::ios::binary)
                .write(reinterpret_cast<const char*>(bytes.all().data()),
                       static_cast<std::streamsize>(bytes.all().size()));
        }
    }
    run([&](Work& work) {
        const candela::Instance& shared = *instance;
        if (const auto* const light = dynamic_cast<const candela::Light*>(&shared)) call(*light, work);
        if (const auto* const model = dynamic_cast<const candela::ReflectionModel*>(&shared))
            call(*model, work);
        if (const auto* const model = dynamic_cast<const candela::ShadingModel*>(&shared)) call(*model, work);
        if (const auto* const shape = dynamic_cast<const candela::Shape*>(&shared)) call(*shape, work);
        if (const auto* const image = dynamic_cast<const candela::ImageFormat*>(&shared))
            call(*image, plugin, folder.path(), work);
    });
    // Instances are also created in any thread.
    run([&](Work&) { candela::make_instance(directory, plugin.kind, plugin.name, settings); });
    std::printf("%s: called from %u threads\n", library.filename().c_str(), k_threads);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("usage: candela_threads PLUGIN.so [PARAMETER=VALUE...]\n", stderr);
        return 2;
    }
    try {
        test(argv[1], {argv + 2, argv + argc});
        return 0;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "candela_threads: %s\n", problem.what());
        return 1;
    }
}
