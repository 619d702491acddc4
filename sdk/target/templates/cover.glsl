    ivec2 at_pixel = ivec2(gl_FragCoord.xy);
    float opacity = object_opacity;
@FIND_OPACITY@
    if (object_opacity_cutoff > 0.0) opacity = opacity >= object_opacity_cutoff ? 1.0 : 0.0;
    if (opacity <= 0.0 || texelFetch(covered, at_pixel, 0).a >= 1.0) discard;
    if (!is_first_layer && gl_FragDepth @NOT_BEHIND@ texelFetch(depth_before, at_pixel, 0).r) discard;
    intensity *= opacity;
