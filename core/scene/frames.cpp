// A document as of one frame of its animation, and the scene read from it.
module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

module candela.scene;

import :animating;
import :document;
import :setting;
import :reading;
import :tables;
import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

using Numbers3 = std::array<double, 3>;

/// A value as a node of a file.
Node node_of(const Value& value, ParamType type, const SourceLocation& place) {
    const auto list = [&](const auto& numbers) {
        ArrayNode array;
        for (const float x : numbers) {
            array.push_back({place, static_cast<double>(x)});
            if (type == ParamType::color) array.back().value = static_cast<std::int64_t>(x);
        }
        return array;
    };
    if (const auto* const boolean = std::get_if<bool>(&value)) return {place, *boolean};
    if (const auto* const integer = std::get_if<std::int64_t>(&value)) return {place, *integer};
    if (const auto* const real = std::get_if<double>(&value)) return {place, *real};
    if (const auto* const text = std::get_if<std::string>(&value)) return {place, *text};
    if (const auto* const numbers = std::get_if<NumberList>(&value)) return {place, list(*numbers)};
    if (const auto* const m = std::get_if<Matrix>(&value)) {
        ArrayNode rows;
        for (std::size_t i = 0; i < 9; i += 3)
            rows.push_back({place, list(std::array{(*m)[i], (*m)[i + 1], (*m)[i + 2]})});
        return {place, std::move(rows)};
    }
    const Vec3 v = std::get<Vec3>(value);
    return {place, list(std::array{v.x, v.y, v.z})};
}

std::optional<Numbers3> three_numbers(const TableNode& table, const char* key) {
    const TableNode::Entry* const entry = table.find(key);
    const ArrayNode* const array = entry != nullptr ? entry->node.array() : nullptr;
    if (array == nullptr || array->size() != 3) return std::nullopt;
    Numbers3 result{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto* const integer = std::get_if<std::int64_t>(&(*array)[i].value);
        const auto* const real = std::get_if<double>(&(*array)[i].value);
        if (integer == nullptr && real == nullptr) return std::nullopt;
        result[i] = real != nullptr ? *real : static_cast<double>(*integer);
    }
    return result;
}

/// `v` turned about an axis by an angle in radians (Rodrigues).
Numbers3 turned(const Numbers3& v, const Numbers3& axis, double angle) {
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    if (!(length > 0)) return v;
    const Numbers3 k{axis[0] / length, axis[1] / length, axis[2] / length};
    const double c = std::cos(angle), s = std::sin(angle);
    const double along = (1 - c) * (k[0] * v[0] + k[1] * v[1] + k[2] * v[2]);
    const Numbers3 across{k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2], k[0] * v[1] - k[1] * v[0]};
    Numbers3 result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = c * v[i] + s * across[i] + along * k[i];
    return result;
}

/// Moves the observer. Problems with its position are reported when it is read.
void go_around(TableNode& root, const Orbit& orbit, double part) {
    TableNode::Entry* const observer = root.find("observer");
    TableNode* const table = observer != nullptr ? observer->node.table() : nullptr;
    if (table == nullptr || part == 0) return;
    const auto position = three_numbers(*table, "position");
    const auto look_at = three_numbers(*table, "look_at");
    const auto up = table->find("up") != nullptr ? three_numbers(*table, "up") : Numbers3{0, 1, 0};
    if (!position || !look_at || !up) return;
    Numbers3 offset{};
    for (std::size_t i = 0; i < 3; ++i) offset[i] = (*position)[i] - (*look_at)[i];
    const Numbers3 around = turned(offset, *up, 2 * std::numbers::pi * orbit.turns * part);
    ArrayNode& array = *table->find("position")->node.array();
    for (std::size_t i = 0; i < 3; ++i) array[i].value = (*look_at)[i] + around[i];
}

const Key& key_before(const Track& track, double time) {
    const auto next = std::ranges::upper_bound(track.keys, time, {}, &Key::time);
    return next == track.keys.begin() ? *next : *std::prev(next);
}

}  // namespace

TableNode at_frame(const TableNode& root, const Animation& animation, int frame) {
    TableNode result = root;
    const ElementIndex elements(root);
    const double time = animation.time_of(frame);
    Diagnostics ignored;  // the paths are known to lead somewhere
    for (const Track& track : animation.tracks) {
        const SourceLocation& place = key_before(track, time).place;
        set_value(result, parts_of(track.path), node_of(value_at(track, time), track.type, place), place,
                  ignored, &elements);
    }
    if (animation.orbit) go_around(result, *animation.orbit, static_cast<double>(frame) / animation.frames);
    return result;
}

struct SceneFrames::Content {
    SceneRequest request;
    Registry& registry;
    MergedDocument document;
    std::optional<Animation> animation;
    bool is_broken = false;
};

SceneFrames::SceneFrames(std::unique_ptr<Content> content) : content_(std::move(content)) {}
SceneFrames::SceneFrames(SceneFrames&&) noexcept = default;
SceneFrames& SceneFrames::operator=(SceneFrames&&) noexcept = default;
SceneFrames::~SceneFrames() = default;

std::optional<SceneFrames> SceneFrames::read(const SceneRequest& request, Registry& registry,
                                             Diagnostics& diagnostics) {
    auto document = merge_documents(request, diagnostics);
    if (!document) return std::nullopt;
    auto content =
        std::make_unique<Content>(Content{request, registry, *std::move(document), std::nullopt, false});
    for (auto* const chosen : {&content->request.shading, &content->request.reflection})
        if (*chosen) (*chosen)->name = absolute_model_name((*chosen)->name);
    SceneTables tables(content->document, registry, diagnostics);
    const std::size_t errors = diagnostics.error_count();
    content->animation = read_animation(tables, content->request);
    content->is_broken = diagnostics.error_count() != errors;
    return SceneFrames(std::move(content));
}

const std::optional<Animation>& SceneFrames::animation() const { return content_->animation; }
int SceneFrames::count() const { return content_->animation ? content_->animation->frames : 1; }
bool SceneFrames::is_broken() const { return content_->is_broken; }

SceneDraft SceneFrames::draft(int frame, Diagnostics& diagnostics) {
    Content& all = *content_;
    if (frame < 0 || (frame >= count() && !all.is_broken)) {
        throw Error(ErrorCategory::bad_request,
                    all.animation ? fmt::format("there is no frame {}: the animation has the frames 0 to {}",
                                                frame, count() - 1)
                                  : fmt::format("there is no frame {}: the scene has no [animation]", frame));
    }
    // Consent to the default models applies to every frame.
    SceneRequest request = all.request;
    if (request.ask) {
        request.ask = [&](const std::string& question) {
            all.request.use_defaults = all.request.ask(question);
            return all.request.use_defaults;
        };
    }
    SceneDraft draft;
    if (all.animation) {
        const MergedDocument document{all.document.place, at_frame(all.document.root, *all.animation, frame),
                                      all.document.files};
        draft = read_draft(request, document, all.registry, diagnostics);
        draft.scene.animation = all.animation;
    } else {
        draft = read_draft(request, all.document, all.registry, diagnostics);
    }
    all.request.ask = nullptr;
    return draft;
}

std::optional<SceneDraft> draft_scene(const SceneRequest& request, Registry& registry,
                                      Diagnostics& diagnostics) {
    auto frames = SceneFrames::read(request, registry, diagnostics);
    if (!frames) return std::nullopt;
    return frames->draft(request.frame, diagnostics);
}

}  // namespace candela
