/** The pixels that a vertex of FIND_UNCOVERED looks at. */
export const RUN = 64;

/** Passes of depth peeling (Everitt 2001), which put the layers of surfaces together. */
export const PUT_BEHIND = `
uniform highp sampler2D in_front;
uniform highp sampler2D layer;
out vec4 intensity;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 front = texelFetch(in_front, at, 0);
    intensity = front + (1.0 - front.a) * texelFetch(layer, at, 0);
}`;

export const PUT_BACKGROUND_BEHIND = `
uniform highp sampler2D in_front;
uniform vec3 background;
out vec4 intensity;

void main() {
    vec4 front = texelFetch(in_front, ivec2(gl_FragCoord.xy), 0);
    intensity = front + (1.0 - front.a) * vec4(background, 1.0);
}`;

/** A vertex is within the picture, which is one pixel, if a surface was seen at one of its pixels and something may be behind it. */
export const FIND_UNCOVERED = `
uniform highp sampler2D in_front;
uniform highp sampler2D layer;
uniform int first_row;
uniform int runs;  // in a row

void main() {
    ivec2 at = ivec2((gl_VertexID % runs) * ${RUN}, first_row + gl_VertexID / runs);
    int end = min(at.x + ${RUN}, textureSize(layer, 0).x);
    bool any_uncovered = false;
    for (; at.x < end && !any_uncovered; ++at.x) any_uncovered = texelFetch(layer, at, 0).a > 0.0 && texelFetch(in_front, at, 0).a < 1.0;
    gl_Position = vec4(any_uncovered ? 0.0 : 2.0, 0.0, 0.0, 1.0);
    gl_PointSize = 1.0;
}`;

export const MARK = `
out vec4 mark;
void main() { mark = vec4(1.0); }`;
