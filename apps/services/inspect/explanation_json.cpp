// Explanations as JSON.

#include <algorithm>
#include <string>

#include "inspect/explanation.h"
#include "json/json.h"

import candela.api;

using candela::InspectedFragment;
using candela::LightTrace;
using candela::PointTrace;
using candela::Vec3;

namespace {

Json json_of(Vec3 v) { return {v.x, v.y, v.z}; }

const char* name_of(candela::ShadingRate rate) {
    switch (rate) {
        case candela::ShadingRate::face:
            return "face";
        case candela::ShadingRate::vertex:
            return "vertex";
        default:
            return "fragment";
    }
}

const char* name_of(KernelStep::Kind kind) {
    switch (kind) {
        case KernelStep::Kind::function:
            return "function";
        case KernelStep::Kind::argument:
            return "argument";
        case KernelStep::Kind::value:
            return "value";
        default:
            return "result";
    }
}

Json json_of(const std::vector<KernelValue>& steps) {
    Json result = Json::array();
    for (const KernelValue& value : steps) {
        const KernelStep& step = *value.step;
        Json item = {{"kind", name_of(step.kind)}, {"name", step.name + value.member},
                     {"depth", value.depth},       {"file", step.file},
                     {"line", step.line},          {"text", step.text}};
        if (step.kind != KernelStep::Kind::function)
            item["value"] = value.numbers.size() == 1 ? Json(value.numbers[0]) : Json(value.numbers);
        result.push_back(std::move(item));
    }
    return result;
}

Json json_of(const Explanation& e, const PointTrace& point, const LightTrace& light,
             const std::string& reflection) {
    const candela::LightSource& source = e.scene.lights[light.light];
    Json result = {{"light", source.label.text()}, {"type", candela::shown_model_name(source.model.name)}};
    if (light.sample == LightTrace::k_mirrored) {
        result["mirrored"] = true;
        result["I_s"] = json_of(light.reflected_specular);
        return result;
    }
    if (light.sample == LightTrace::k_ambient) {
        result["ambient"] = json_of(light.diffuse);
    } else {
        const Vec3 n = point.normal, l = light.to_light, half = l + point.to_observer;
        result["sample"] = light.sample;
        result["L"] = json_of(l);
        result["R"] = json_of(2 * dot(n, l) * n - l);
        result["H"] = length(half) > 0 ? json_of((1 / length(half)) * half) : Json();
        result["N.L"] = dot(n, l);
        result["diffuse"] = json_of(light.diffuse);
        result["specular"] = json_of(light.specular);
    }
    if (e.may_be_blocked(light)) result["visibility"] = json_of(light.visibility);
    if (light.blocker)
        result["blocked_by"] = {{"object", e.scene.objects[light.blocker->object].label.text()},
                                {"triangle", light.blocker->triangle},
                                {"distance", light.blocker->distance}};
    result["light_steps"] = json_of(e.light_steps(light));
    result["reflection"] = reflection;
    result["reflection_steps"] = json_of(e.reflection_steps(light));
    result["I_a"] = json_of(light.reflected_ambient);
    result["I_d"] = json_of(light.reflected_diffuse);
    result["I_s"] = json_of(light.reflected_specular);
    return result;
}

/// The material's parameters that have textures, in the units in which the model receives them.
Json parameters_of(const PointTrace& point, const candela::Object& object) {
    Json parameters = Json::object();
    for (const candela::VaryingValue& own : point.parameters) {
        const candela::Parameter& parameter = object.reflection.parameters.schema()[own.parameter];
        if (parameter.type == candela::ParamType::real)
            parameters[parameter.name] = own.value;
        else
            parameters[parameter.name].push_back(own.value);
    }
    return parameters;
}

Json json_of(const Explanation& e, const PointTrace& point, const candela::Object& object) {
    const std::string reflection = candela::shown_model_name(object.reflection.name);
    Json lights = Json::array();
    for (const LightTrace& light : point.lights) lights.push_back(json_of(e, point, light, reflection));
    return {{"position", json_of(point.position)},
            {"N", json_of(point.normal)},
            {"shading_normal", json_of(point.shading_normal)},
            {"V", json_of(point.to_observer)},
            {"C_o", json_of(point.color)},
            {"parameters", parameters_of(point, object)},
            {"tangent", json_of(point.tangent)},
            {"from_behind", point.from_behind},
            {"normal_steps", json_of(e.normal_steps(point))},
            {"lights", std::move(lights)},
            {"surroundings", json_of(point.surroundings)},
            {"I_a", json_of(point.ambient)},
            {"I_d", json_of(point.diffuse)},
            {"I_s", json_of(point.specular)},
            {"I_e", json_of(point.emission)},
            {"occlusion", point.occlusion},
            {"I", json_of(point.intensity)}};
}

Json json_of(const Explanation& e, const InspectedFragment& fragment) {
    const candela::Object& object = e.scene.objects[fragment.object];
    Json points = Json::array();
    for (const PointTrace& point : fragment.points) points.push_back(json_of(e, point, object));
    return {{"object", object.label.text()},
            {"index", fragment.object},
            {"type", object.shape.name},
            {"triangle", fragment.triangle},
            {"barycentric", json_of(fragment.barycentric)},
            {"weight", fragment.weight},
            {"layer", fragment.layer},
            {"opacity", fragment.opacity},
            {"position", json_of(fragment.position)},
            {"shading", candela::shown_model_name(object.shading.name)},
            {"shaded_per", name_of(fragment.rate)},
            {"points", std::move(points)},
            {"I", json_of(fragment.intensity)}};
}

}  // namespace

std::string explanation_json(const Explanation& e, JsonLayout layout) {
    Json fragments = Json::array();
    for (const InspectedFragment& fragment : e.pixel.fragments) fragments.push_back(json_of(e, fragment));
    const candela::DisplayTransform transform = candela::display_of(e.compiled);
    const bool is_srgb = transform.encoding == candela::ColorEncoding::srgb;
    const candela::Rgb intensity{e.pixel.intensity.x, e.pixel.intensity.y, e.pixel.intensity.z};
    const candela::Rgb toned = candela::toned(intensity, transform);
    const candela::Rgb shown = candela::displayed(intensity, transform);
    Json encoded = {shown.r, shown.g, shown.b};
    Json result = {{"pixel", {e.x, e.y}},
                   {"width", e.compiled.image.width},
                   {"height", e.compiled.image.height},
                   {"fragments", std::move(fragments)},
                   {"background_weight", e.pixel.background_weight},
                   {"background", json_of(e.pixel.background)},
                   {"I", json_of(e.pixel.intensity)},
                   {"luminance", e.luminance()},
                   {"color_management", is_srgb ? "srgb" : "none"},
                   {"encoded", std::move(encoded)},
                   {"bytes", e.pixel.bytes}};
    if (transform != candela::DisplayTransform(transform.encoding)) {
        result["exposure"] = transform.exposure;
        result["tone"] = candela::name_of(transform.tone);
        result["toned"] = {toned.r, toned.g, toned.b};
    }
    const auto difference = e.kernel_difference();
    result["kernel_difference"] = difference ? Json(*difference) : Json();
    if (!e.why_no_steps().empty()) result["note"] = e.why_no_steps();
    return json_text(result, layout == JsonLayout::indented ? 2 : -1);
}
