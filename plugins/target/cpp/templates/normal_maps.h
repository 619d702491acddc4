// A picture that tilts the normals of an object.
struct NormalMap {
    ColorTexture texture;
    Placing placing;
    bool has_slopes = false;  // of heights, instead of normals
    vec2 along_u, along_v;    // the picture's axes
@ON_SECOND_UV_MEMBER@
};

@KERNEL@
