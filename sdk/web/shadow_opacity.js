import { floatsOf, indicesOf } from "./arrays.js";
import { texelsOf } from "./texture_levels.js";

/** The number of the tree's texels that hold a picture. */
const pictureTexels = (picture, textures) => (picture ? Math.ceil((textures[picture.texture].width * textures[picture.texture].height) / 4) : 0);

/** The number of texels from which shadows read an object's opacity, if a texture or its vertices give it. */
export function opacityTexels({ mesh, shadow_opacity: use }, textures) {
    return use ? 2 + pictureTexels(use.picture, textures) + 2 * mesh.triangles : 0;
}

/** Returns a function of a vertex: two numbers, texture coordinates, as the picture is placed by them, or one that gives the opacity. */
function vertexNumbers({ mesh, opacity_channel: channel, shadow_opacity: { picture } }) {
    if (!picture) {
        const numbers = floatsOf(mesh.channels[channel]);
        return (vertex) => [numbers[vertex], 0];
    }
    const [a, b, c, d, e, f] = picture.placing;
    const placed = (u, v) => [a * u + b * v + c, d * u + e * v + f];
    if (channel !== null) {
        const [us, vs] = mesh.channels.slice(channel, channel + 2).map(floatsOf);
        return (vertex) => placed(us[vertex], vs[vertex]);
    }
    const uv = mesh.uv === null ? null : floatsOf(mesh.uv);
    return (vertex) => (uv === null ? [c, f] : placed(uv[2 * vertex], uv[2 * vertex + 1]));
}

/** Writes from the texel `at` on how a picture is read, and the picture. */
function writePicture(integers, at, { texture, channel, wraps }, textures, isSrgb) {
    const { width, height, texels } = texelsOf(textures[texture], isSrgb);
    integers.set([width, height, at + 1, wraps[0] + 3 * wraps[1]], 4 * at);
    for (let i = 0; i < width * height; ++i) integers[4 * (at + 1) + i] = texels[4 * i + channel];
}

/**
 * Writes them from the texel `at` on: how the opacity is made of a number, the picture that has it, and numbers of the corners of each
 * triangle. `triangles`: the first texel of each of the object's triangles in the tree, or null.
 */
export function writeOpacity(integers, at, object, triangles, textures, isSrgb) {
    const { mesh, shadow_opacity: { picture, scale, offset }, opacity_cutoff } = object, floats = new Float32Array(integers.buffer);
    floats.set([scale, offset, opacity_cutoff], 4 * at);
    if (picture) writePicture(integers, at + 1, picture, textures, isSrgb);
    const numbersOf = vertexNumbers(object), corners = indicesOf(mesh.indices);
    let next = at + 2 + pictureTexels(picture, textures);
    triangles.forEach((triangle, t) => {
        if (triangle === null) return;
        floats[4 * triangle + 7] = -1;
        integers[4 * triangle + 11] = next;
        for (let k = 0; k < 3; ++k) floats.set(numbersOf(corners[3 * t + k]), 4 * next + 2 * k);
        integers[4 * next + 6] = at;
        next += 2;
    });
}
