
// The light of sample k of a light with an extent, from another point of the part that it stands for.
Punctual moved_within(Punctual light, Extent part, int k) {
    vec2 offsets = sample_offsets(k);
    light.position += offsets.x * part.u + offsets.y * part.v;
    return light;
}

Incident punctual_light(Punctual light, Receiver r) {
    vec3 to_source = light.position - r.position;
    float square = dot(to_source, to_source);
    float inverse = inversesqrt(max(square, 1.0e-36));
    vec3 to_light = square > 1.0e-36 ? to_source * inverse : r.normal;
    float far = max(square * inverse, 1.0e-4);
    float t = clamp((-dot(to_light, light.axis) - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1.0e-7), 0.0, 1.0);
    float cone = light.falloff == 0 ? 1.0 : (light.falloff == 1 ? t * t * (3.0 - 2.0 * t) : t);
    vec3 sent = light.color * (light.intensity * cone / (light.attenuation.x + far * (light.attenuation.y + far * light.attenuation.z)));
    return Incident(to_light, sent, sent);
}
