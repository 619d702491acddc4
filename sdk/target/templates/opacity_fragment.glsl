
#if defined(TEXTURED_OPACITY) && !defined(LIT_AT_FRAGMENT)
#define OPACITY_AT_FRAGMENT
@CHANNELS_IN@
#ifdef READS_PICTURES
in vec3 seen_place;
in vec2 seen_uv;
#endif
#endif
