// The fraction of what is behind that an object covers at a place; where an opacity has a cutoff, 0 or 1. `is_seen`: by a
// pixel, which covers an area of a texture.
float opacity_at(const Object& o, int@TRIANGLE@, vec3@B@, bool@IS_SEEN@) {
    @OPACITY@ opacity = o.opacity;
@CASES@
    return o.opacity_cutoff <= 0 ? opacity : opacity >= o.opacity_cutoff ? 1.0f : 0.0f;
}

