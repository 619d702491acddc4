// Adds the picture of one sample to the sum of the previous ones.
uniform sampler2D picture;
uniform sampler2D sum;
uniform float weight;
out vec4 intensity;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    intensity = texelFetch(sum, at, 0) + weight * texelFetch(picture, at, 0);
}
