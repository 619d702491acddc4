#include "import/gltf_animation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "import/placement.h"
#include "import/vectors.h"
#include "mesh_io/gltf/affine.h"

import candela.util;

namespace importing::gltf {

namespace {

/// Values that are absent have no effect.
Placement placement_of(const std::vector<double>& translation, const std::vector<double>& rotation,
                       const std::vector<double>& scale) {
    const auto vector = [](const std::vector<double>& v, double otherwise) {
        return v.empty() ? Vector{otherwise, otherwise, otherwise} : Vector{v[0], v[1], v[2]};
    };
    std::array<double, 4> turn = {0, 0, 0, 1};
    if (!rotation.empty()) std::ranges::copy(rotation, turn.begin());
    const auto columns = mesh_io::gltf::affine_of(vector(translation, 0), turn, vector(scale, 1)).column;
    return {columns[0], columns[1], columns[2], columns[3]};
}

void normalize(std::vector<double>& q) {
    double size = 0;
    for (const double x : q) size += x * x;
    if (size > 0)
        for (double& x : q) x /= std::sqrt(size);
}

/// Along the shorter arc.
std::vector<double> slerp(std::vector<double> a, std::vector<double> b, double s) {
    normalize(a);
    normalize(b);
    double cosine = 0;
    for (std::size_t k = 0; k < 4; ++k) cosine += a[k] * b[k];
    const double sign = cosine < 0 ? -1 : 1;
    const double angle = std::acos(std::min(1.0, std::abs(cosine)));
    constexpr double k_hardly_any = 1e-6;
    const double from = angle < k_hardly_any ? 1 - s : std::sin((1 - s) * angle) / std::sin(angle);
    const double to = sign * (angle < k_hardly_any ? s : std::sin(s * angle) / std::sin(angle));
    for (std::size_t k = 0; k < 4; ++k) a[k] = from * a[k] + to * b[k];
    normalize(a);
    return a;
}

constexpr std::size_t k_most_values = 10'000'000;  // in all accessors, which may share their bytes

}  // namespace

Placement placement_of(const Json& node) {
    if (const std::vector<double> m = numbers(node, "matrix", 16); !m.empty())
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    return placement_of(numbers(node, "translation", 3), numbers(node, "rotation", 4),
                        numbers(node, "scale", 3));
}

std::vector<double> Animation::Channel::at(double time) const {
    const auto value = [&](std::size_t key, std::size_t which) {  // of a spline: tangent, value, tangent
        const std::size_t index = way == Way::spline ? 3 * key + which : key;
        const auto first = values->begin() + static_cast<std::ptrdiff_t>(index * components);
        return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(components));
    };
    const std::size_t next =
        static_cast<std::size_t>(std::ranges::upper_bound(*times, time) - times->begin());
    const bool is_rotation = components == 4;
    std::vector<double> result = value(next == 0 ? 0 : next - 1, 1);
    if (next > 0 && next < times->size() && way != Way::step) {
        const double length = (*times)[next] - (*times)[next - 1];
        const double s = (time - (*times)[next - 1]) / length;
        const std::vector<double> end = value(next, 1);
        if (way == Way::linear && is_rotation) return slerp(std::move(result), end, s);
        const std::vector<double> out = value(next - 1, 2), in = value(next, 0);
        for (std::size_t k = 0; k < components; ++k) {
            if (way == Way::linear) {
                result[k] += s * (end[k] - result[k]);
            } else {  // glTF 2.0, appendix C.5
                const double s2 = s * s, s3 = s2 * s;
                result[k] = (2 * s3 - 3 * s2 + 1) * result[k] + length * (s3 - 2 * s2 + s) * out[k] +
                            (3 * s2 - 2 * s3) * end[k] + length * (s3 - s2) * in[k];
            }
        }
    }
    if (is_rotation) normalize(result);
    return result;
}

Placement Animation::Node::at(double time) const {
    const auto value = [&](const char* name, const std::vector<double>& rest) {
        const auto found = channels.find(name);
        return found != channels.end() ? found->second.at(time) : rest;
    };
    return placement_of(value("translation", translation), value("rotation", rotation),
                        value("scale", scale));
}

Animation::Animation(Container& container, const Json& animation) {
    for (const Json& channel : array_of(animation, "channels")) {
        if (text_of(object_of(channel, "target"), "path") == "weights") {
            ++weights_;
        } else if (!add(container, animation, channel)) {
            ++unreadable_;
        }
    }
    accessors_.clear();
}

std::shared_ptr<const std::vector<double>> Animation::read(Container& container, std::size_t accessor,
                                                           std::size_t components) {
    const auto [known, is_new] = accessors_.try_emplace(accessor);
    if (!is_new) return known->second;
    try {
        const Json* const entry = element(array_of(container.json(), "accessors"), accessor);
        const std::size_t count = entry != nullptr ? index_of(*entry, "count").value_or(0) : 0;
        if (count == 0 || count > (k_most_values - values_read_) / components) return nullptr;
        values_read_ += count * components;
        known->second = std::make_shared<const std::vector<double>>(container.values(accessor, components));
    } catch (const candela::Error&) {
        return nullptr;
    }
    return known->second;
}

bool Animation::add(Container& container, const Json& animation, const Json& channel) {
    const Json& target = object_of(channel, "target");
    const auto node = index_of(target, "node");
    const std::string what = text_of(target, "path");
    const Json* const entry = element(array_of(container.json(), "nodes"), node);
    const Json* const sampler = element(array_of(animation, "samplers"), index_of(channel, "sampler"));
    if (entry == nullptr || sampler == nullptr || entry->contains("matrix")) return false;
    if (what != "translation" && what != "rotation" && what != "scale") return false;
    const auto input = index_of(*sampler, "input"), output = index_of(*sampler, "output");
    if (!input || !output) return false;
    Channel result;
    result.components = what == "rotation" ? 4 : 3;
    const std::string way = text_of(*sampler, "interpolation");
    result.way = way == "STEP" ? Way::step : way == "CUBICSPLINE" ? Way::spline : Way::linear;
    result.times = read(container, *input, 1);
    result.values = read(container, *output, result.components);
    if (result.times == nullptr || result.values == nullptr) return false;
    const std::size_t each = result.way == Way::spline ? 3 : 1;
    if (result.values->size() < each * result.components * result.times->size()) return false;
    if (std::ranges::adjacent_find(*result.times, std::ranges::greater_equal{}) != result.times->end())
        return false;
    has_splines_ = has_splines_ || result.way == Way::spline;
    length_ = std::max(length_, result.times->back());
    Node& moved = nodes_[*node];
    moved.translation = numbers(*entry, "translation", 3);
    moved.rotation = numbers(*entry, "rotation", 4);
    moved.scale = numbers(*entry, "scale", 3);
    return moved.channels.emplace(what, std::move(result)).second;
}

std::shared_ptr<const Motion> Animation::motion(const std::shared_ptr<const Animation>& animation,
                                                const Json& nodes, const std::vector<std::size_t>& chain,
                                                bool is_relative) {
    struct Link {
        Placement rest;              // the product of the fixed nodes before it
        const Node* node = nullptr;  // null: none
    };
    std::vector<Link> links(1);
    Placement rest;
    auto motion = std::make_shared<Motion>();
    bool has_steps_only = true;
    for (const std::size_t index : chain) {
        const Placement own = placement_of(nodes[index]);
        rest = within(rest, own);
        const auto moved = animation->nodes_.find(index);
        if (moved == animation->nodes_.end()) {
            links.back().rest = within(links.back().rest, own);
            continue;
        }
        links.back().node = &moved->second;
        links.emplace_back();
        for (const auto& [what, channel] : moved->second.channels) {
            // More than can be imported anyway.
            if (motion->times.size() + channel.times->size() > Motion::k_most_times) return nullptr;
            motion->times.insert(motion->times.end(), channel.times->begin(), channel.times->end());
            if (channel.way == Way::step)
                motion->jumps.insert(motion->jumps.end(), channel.times->begin() + 1, channel.times->end());
            has_steps_only = has_steps_only && channel.way == Way::step;
        }
    }
    for (std::vector<double>* const times : {&motion->times, &motion->jumps}) {
        std::ranges::sort(*times);
        const auto rest_of = std::ranges::unique(*times);
        times->erase(rest_of.begin(), rest_of.end());
    }
    motion->has_steps_only = has_steps_only;
    motion->cost = links.size();
    std::optional<Placement> undone;
    if (is_relative) {
        const double size = importing::length(rest.x) * importing::length(rest.y) * importing::length(rest.z);
        constexpr double k_flat = 1e-9;
        if (!(std::abs(determinant(rest)) > k_flat * size)) return nullptr;
        undone = inverse(rest);
    }
    motion->at = [animation, links = std::move(links), undone](double time) {
        Placement place;
        for (const Link& link : links) {
            place = within(place, link.rest);
            if (link.node != nullptr) place = within(place, link.node->at(time));
        }
        return undone ? within(place, *undone) : place;
    };
    return motion;
}

}  // namespace importing::gltf
