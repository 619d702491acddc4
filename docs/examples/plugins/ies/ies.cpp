// A lamp as its maker has measured it: IES LM-63 (ANSI/IES LM-63-19), photometry of type C. The table would
// not fit into a kernel's parameters, so this light renders and is not exported to programs.
#include <candela/light_plugin.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using candela::Vec3;
using namespace candela::sdk;

namespace {

struct IesParams {
    vec3 color;
    float intensity;
    vec3 position;
    vec3 direction;
    const char* file;
};

/// Candela by vertical angle (0 is along the lamp's axis) for each horizontal angle; both ascend, in degrees.
struct Photometry {
    std::vector<float> vertical, horizontal, candela;

    explicit Photometry(const char* path) {
        std::ifstream file(path);
        std::string line;
        while (std::getline(file, line) && !line.starts_with("TILT=")) {
        }
        if (!line.starts_with("TILT=NONE"))
            throw std::runtime_error("it has no 'TILT=NONE': it is no IES file, or its lamp is tilted");
        std::string rest{std::istreambuf_iterator<char>(file), {}};
        std::ranges::replace(rest, ',', ' ');
        std::istringstream numbers(rest);
        const auto next = [&] {
            float number = 0;
            if (!(numbers >> number)) throw std::runtime_error("it ends before its last candela value");
            return number;
        };
        const auto list = [&](std::size_t count) {
            std::vector<float> values(count);
            for (float& value : values) value = next();
            return values;
        };
        const std::vector<float> head =
            list(13);  // lamps, lumens, multiplier, counts, type, unit, size, factors
        for (const std::size_t i : {3, 4})
            if (!(head[i] >= 1 && head[i] <= 1000))
                throw std::runtime_error("its number of angles is none from 1 to 1000");
        if (head[5] != 1) throw std::runtime_error("its photometry is not of type C");
        vertical = list(static_cast<std::size_t>(head[3]));
        horizontal = list(static_cast<std::size_t>(head[4]));
        candela = list(vertical.size() * horizontal.size());
        for (float& value : candela) value = std::max(value, 0.0f) * head[2] * head[10];
        for (const auto* angles : {&vertical, &horizontal})
            if (!std::ranges::is_sorted(*angles)) throw std::runtime_error("its angles do not ascend");
    }

    /// Between two angles the values are mixed; what was not measured is dark below and above, and symmetric
    /// around.
    float at(float down, float around) const {
        if (down < vertical.front() || down > vertical.back()) return 0;
        const float last = horizontal.back();
        if (last <= 90 && around > 180) around = 360 - around;
        if (last <= 90 && around > 90) around = 180 - around;
        if (last <= 180 && around > 180) around = 360 - around;
        const auto [v, vt] = between(vertical, down);
        const auto [h, ht] = between(horizontal, around);
        const auto value = [&](std::size_t i, std::size_t j) {
            return candela[std::min(i, horizontal.size() - 1) * vertical.size() +
                           std::min(j, vertical.size() - 1)];
        };
        return std::lerp(std::lerp(value(h, v), value(h, v + 1), vt),
                         std::lerp(value(h + 1, v), value(h + 1, v + 1), vt), ht);
    }

  private:
    static std::pair<std::size_t, float> between(const std::vector<float>& angles, float angle) {
        const auto above = std::ranges::upper_bound(angles, angle);
        if (above == angles.begin()) return {0, 0.0f};
        const auto i = static_cast<std::size_t>(above - angles.begin()) - 1;
        return {i, above == angles.end() ? 0.0f : (angle - angles[i]) / (*above - angles[i])};
    }
};

class Ies final : public candela::Light {
  public:
    explicit Ies(const IesParams& params)
        : photometry_(params.file),
          color_(params.color),
          position_{params.position.x, params.position.y, params.position.z},
          axis_{params.direction.x, params.direction.y, params.direction.z},
          scale_(params.intensity) {
        const Vec3 aside = std::abs(axis_.z) < 0.9f ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
        across_ = candela::normalized(aside - dot(aside, axis_) * axis_);
    }

    int sample_count() const noexcept override { return 1; }
    bool has_ambient() const noexcept override { return false; }

    void illuminate(int, const candela::ReceiverBatch& receivers,
                    const candela::IncidentBatch& incident) const override {
        const float degree = 57.2957795f;
        const Vec3 third = cross(axis_, across_);
        for (std::size_t i = 0; i < receivers.count; ++i) {
            const Vec3 offset = position_ - receivers.position[i];
            const float distance = length(offset);
            const Vec3 to_light = distance > 1e-18f ? 1 / distance * offset : receivers.normal[i];
            const float around = degree * std::atan2(-dot(to_light, third), -dot(to_light, across_));
            const float down = degree * std::acos(std::clamp(-dot(to_light, axis_), -1.0f, 1.0f));
            const float sent = scale_ * photometry_.at(down, around < 0 ? around + 360 : around) /
                               std::pow(std::max(distance, 1e-4f), 2.0f);
            incident.to_light.set(i, to_light);
            incident.diffuse.set(i, {sent * color_.x, sent * color_.y, sent * color_.z});
            incident.specular.set(i, incident.diffuse[i]);
        }
    }

  private:
    Photometry photometry_;
    vec3 color_;
    Vec3 position_, axis_, across_;
    float scale_;
};

constexpr auto k_fields =
    fields(light_color(&IesParams::color),
           real(&IesParams::intensity, "intensity", 0.001f, "that one candela of the file is").minimum(0),
           point(&IesParams::position, "position", "where the lamp is"),
           direction(&IesParams::direction, "direction", "the lamp's axis, where its vertical angle is 0"),
           file(&IesParams::file, "file", "the lamp's photometry (.ies, LM-63, type C)"));

constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

}  // namespace

CANDELA_PLUGIN(
    light, Ies, k_fields,
    {.title = "IES light",
     .summary = "A lamp as its maker has measured it, from a photometric file.",
     .formula = "I_L = color intensity I(vertical, horizontal) / r^2",
     .reference = "ANSI/IES LM-63-19, Approved method: IES standard file format for photometric data",
     .properties = k_properties})
