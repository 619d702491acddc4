// To move a light is to move the receiver the other way: as if the light's sample were elsewhere within its part of the light.
Receiver displaced(const Receiver& r, const ShadowPlace& at, const Extent& part, int sample) {
    if (!at.object.receives_shadows) return r;
    const vec2 offset = sample_offset(at, sample);
    Receiver moved = r;
    moved.position = r.position - offset.x * part.u - offset.y * part.v;
    return moved;
}
